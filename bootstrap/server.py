"""JupyterLab with the book, for nobody but the user of this computer.

The environment's Python runs this, with JupyterLab's own arguments. JupyterLab, and what runs in
it, keep files of their own in the project's folder.
"""

import os
import secrets
import signal
import sys
from pathlib import Path

HOME = Path(__file__).resolve().parents[1]
OWN = HOME / ".jupyter"
PLACES = {
    # Which notebooks are trusted; the user's folder of other kernels is not looked into then.
    "JUPYTER_DATA_DIR": "data",
    "JUPYTER_RUNTIME_DIR": "runtime",
    # History, and what is done at each start of a kernel: the book's are all alike.
    "IPYTHONDIR": "ipython",
    "MPLCONFIGDIR": "matplotlib",  # a list of the computer's fonts
}
"""Variables, and the folders in OWN they name; ~/.jupyter stays, it has the user's settings."""
OPTIONS = [
    "--ServerApp.ip=127.0.0.1",
    "--ServerApp.port_retries=0",
    "--ServerApp.base_url=/",
    "--ServerApp.allow_root=True",
    "--LabApp.custom_css=True",
    # There are none; looking for them would start npm and others, which leave files in HOME.
    "--LanguageServerManager.autodetect=False",
    # Not WARN: that alarms beginners with "not trusted" at each opening of a clean notebook.
    "--ServerApp.log_level=ERROR",
    "--LabApp.log_level=ERROR",
]


def own_places() -> dict[str, str]:
    """Return the variables that keep files in OWN, but those that the user has set.

    None, if the folder cannot be kept from others, as on most sticks: what is in HOME is used then.
    """
    try:
        OWN.mkdir(mode=0o700, exist_ok=True)
        found = OWN.stat()
    except OSError:
        return {}
    if (
        os.name == "nt"
        or not os.access(OWN, os.W_OK)
        or found.st_uid != os.geteuid()
        or found.st_mode & 0o077
    ):
        return {}
    places = {name: str(OWN / folder) for name, folder in PLACES.items()}
    return {name: folder for name, folder in places.items() if name not in os.environ}


def main(arguments: list[str]) -> None:
    """Start JupyterLab and wait until it is told to stop."""
    os.environ.update(own_places())
    # The book's matrices are small: threads for them only get in the way of the browser.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    import zmq
    from jupyterlab.labapp import LabApp  # type: ignore[import-untyped]

    # Other users can read command lines; these arguments they cannot. They also win over a user's
    # configuration that switches tokens off. A cookie of an earlier start opens nothing.
    token = os.environ.pop("DRIFTLAB_TOKEN", "") or secrets.token_hex(24)
    secret = [f"--IdentityProvider.token={token}"]
    secret += [f"--ServerApp.cookie_secret={secrets.token_hex(32)}"]
    if zmq.has("curve"):  # what a kernel says is encrypted
        secret.append("--MappingKernelManager.transport_encryption=auto")
    server = LabApp.initialize_server([*OPTIONS, *arguments, *secret])
    # Only the server can say where its custom.css is; else that would be the user's own folder.
    style = str(HOME / "bootstrap/jupyter/custom")
    server.web_app.settings["static_custom_path"].insert(0, style)

    def stop(number: int, _: object) -> None:
        signal.signal(number, signal.SIG_IGN)  # an impatient second Ctrl-C
        print("\nStopping ...", flush=True)
        server.stop(from_signal=True)

    for name in ("SIGINT", "SIGTERM", "SIGHUP"):  # without JupyterLab's question
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), stop)
    address = f"http://127.0.0.1:{server.port}{server.default_url}?token={token}"
    welcome = f"Drift Lab is open at\n\n  {address}\n\nCtrl-C stops it."
    server.io_loop.add_callback(print, welcome, flush=True)  # when it listens
    server.start()


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except (OSError, OverflowError) as error:
        sys.exit(f"JupyterLab cannot start: {error}")
    except KeyboardInterrupt:
        sys.exit("\nStopped; it is safe to run this again.")

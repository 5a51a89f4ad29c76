"""Starts JupyterLab on a notebook of the book, for nobody but the user of this computer.

JupyterLab, and what runs in it, keep files of their own in the project's folder.
"""

import os
import secrets
import subprocess

from bootstrap.steps import HOME, JUPYTER, PYTHON, VENV, Trouble, running, say, surroundings

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
SECRET = ("JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR")
"""Where keys lie: of kernels and trusted notebooks."""

# The token travels in the environment because other users can read command lines. It becomes
# an argument inside the process because arguments, unlike JUPYTER_TOKEN, also win over a user's
# configuration that switches tokens off. Encryption keeps what a kernel says from other users of
# the computer. The book's matrices are small: threads for them only get in the way of the browser.
# The address is printed from the server's loop, hence when it listens. Only the server itself can
# say where its custom.css is; other than by this line that would be the user's own folder.
# Its standard input is a pipe that lab.py holds and never writes to: it closes when lab.py is gone,
# killed or not, and nobody would know the address any more. (A console of Windows ends both.)
SERVER = """\
import os, secrets, signal, sys, threading, zmq
def end_with_lab_py():
    os.read(0, 1)
    os.kill(os.getpid(), signal.SIGTERM)
if os.name != "nt":
    threading.Thread(target=end_with_lab_py, daemon=True).start()
from jupyterlab.labapp import LabApp
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
token = os.environ.pop("DRIFTLAB_TOKEN")
encryption = "auto" if zmq.has("curve") else "disabled"
options = [
    "--IdentityProvider.token=" + token,
    # A cookie of an earlier start, or of who has read its file, opens nothing.
    "--ServerApp.cookie_secret=" + secrets.token_hex(32),
    "--MappingKernelManager.transport_encryption=" + encryption,
]
try:
    server = LabApp.initialize_server([*sys.argv[1:], *options])
    server.web_app.settings["static_custom_path"].insert(0, os.environ["DRIFTLAB_STYLE"])
    address = f"http://127.0.0.1:{server.port}{server.default_url}?token={token}"
    welcome = f"Drift Lab is open at\\n\\n  {address}\\n\\nCtrl-C stops it."
    server.io_loop.add_callback(lambda: print(welcome, flush=True))
    server.start()
except OSError as error:
    sys.exit(f"JupyterLab cannot write its own files: {error}")
"""


def serve(notebook: str, port: int, browser: bool) -> None:
    """Start JupyterLab on a notebook and wait until it ends; for port 0 the system chooses one."""
    command = [
        *[str(PYTHON), "-c", SERVER],
        f"--ServerApp.root_dir={HOME}",
        "--ServerApp.ip=127.0.0.1",
        f"--ServerApp.port={port}",
        "--ServerApp.port_retries=0",
        "--ServerApp.base_url=/",
        f"--ServerApp.open_browser={browser}",
        f"--LabApp.default_url=/lab/tree/{notebook}",
        "--LabApp.custom_css=True",
        # There are none; looking for them would start npm and others, which leave files in HOME.
        "--LanguageServerManager.autodetect=False",
        # Not WARN: that alarms beginners with "not trusted" at each opening of a clean notebook.
        "--ServerApp.log_level=ERROR",
        "--LabApp.log_level=ERROR",
    ]
    if os.access(VENV, os.W_OK):  # or it would open the tabs of another folder's book as well
        command.append(f"--LabApp.workspaces_dir={VENV / 'workspaces'}")
    if os.name != "nt" and os.geteuid() == 0:
        command.append("--allow-root")
    say("Starting JupyterLab ...")
    # In a session of its own Ctrl-C does not reach the server, which would end in disorder from
    # that and our request together.
    own = {"DRIFTLAB_TOKEN": secrets.token_hex(24), "DRIFTLAB_STYLE": str(JUPYTER / "custom")}
    environment = {**surroundings(), **own, **own_places()}
    stdin = None if os.name == "nt" else subprocess.PIPE
    with running(command, env=environment, stdin=stdin, start_new_session=True) as server:
        try:
            code = abs(server.wait())
        except KeyboardInterrupt:
            say("\nStopping ...")
            return
    if code:
        raise Trouble("JupyterLab did not end as it should; its messages above tell why.")


def own_places() -> dict[str, str]:
    """Return the variables that keep files in OWN, but those that the user has set.

    None, if others cannot be kept out of there, as on most sticks, or if it is another user's.
    What is in HOME is used then, as it is on Windows for what is secret: whom a folder there is
    open to is not found out.
    """
    used = {name: str(OWN / folder) for name, folder in PLACES.items()}
    try:
        OWN.mkdir(exist_ok=True)
        if os.name != "nt":
            OWN.chmod(0o700)
            found = OWN.stat()
            if found.st_uid != os.geteuid() or found.st_mode & 0o077:
                return {}
    except OSError:
        return {}
    if os.name == "nt":
        used = {name: folder for name, folder in used.items() if name not in SECRET}
    return {name: folder for name, folder in used.items() if name not in os.environ}

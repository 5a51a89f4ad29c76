"""Where JupyterLab, and what runs in it, keep files of their own: in the project's folder."""

import os

from bootstrap.steps import HOME

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
"""Where keys lie: of kernels, cookies and trusted notebooks."""


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

"""Installs packages into environments: with uv, or with pip where there is no uv.

uv is the user's own or is fetched into ``.venv-uv``, which also has a pip. Both take mirrors,
certificates and proxies from pip's settings, and nothing else that could mislead them.
"""

import ast
import importlib.util
import os
import re
import shutil
import subprocess
import sys
from contextlib import suppress
from functools import cache
from pathlib import Path

from bootstrap import steps
from bootstrap.steps import HOME, VENV, NoPackages, Trouble, run_step

ENVIRONMENT = HOME / "environment.txt"
TOOLS = VENV.with_name(f"{VENV.name}-uv")
WANTED = TOOLS / "uv.txt"  # written when its pip is whole
UV = re.compile(r"^uv==.*\n(?: .*\n)*", re.M)  # in environment.txt
UV_OPTIONS = ("--no-config", "--no-python-downloads")
# --only-binary: building from source would fetch tools that environment.txt does not pin.
PINNED = ("--no-deps", "--only-binary=:all:", "--require-hashes", "-r")
SETTINGS = {
    "index-url": ("UV_DEFAULT_INDEX",),
    "extra-index-url": ("UV_EXTRA_INDEX_URL",),
    "find-links": ("UV_FIND_LINKS",),
    "no-index": (),  # an option of uv
    "cert": ("SSL_CERT_FILE",),
    "client-cert": ("SSL_CLIENT_CERT",),
    "proxy": ("HTTPS_PROXY", "HTTP_PROXY"),
    "trusted-host": ("UV_INSECURE_HOST",),
    "default-timeout": ("UV_HTTP_TIMEOUT",),
    "timeout": ("UV_HTTP_TIMEOUT",),
    "cache-dir": (),
}
"""What is taken from pip's settings, and the variables by which uv is told of it."""
OF_UV = {"UV_CACHE_DIR", "UV_INDEX", "UV_NATIVE_TLS", "UV_SYSTEM_CERTS"}
OF_UV |= {name for names in SETTINGS.values() for name in names}
"""Variables of the user that uv sees."""


def python_of(folder: Path) -> Path:
    return folder / steps.BIN / steps.PYTHON_NAME


def make_venv(folder: Path, pip: bool = False) -> None:
    """Make an empty environment, or one that holds the pip that comes with Python."""
    for module in ("venv", "ensurepip") if pip else ("venv",):
        if importlib.util.find_spec(module) is None:
            raise Trouble(
                f"This Python lacks its module {module}: install it (on Debian and Ubuntu: "
                f"sudo apt install python{steps.VERSION}-venv) and run this again."
            )
    # lab.py may have been started from the very environment that is to be replaced.
    python = getattr(sys, "_base_executable", sys.executable)
    run_step([python, "-m", "venv", "--clear", *([] if pip else ["--without-pip"]), str(folder)])
    with (folder / "pyvenv.cfg").open("a", encoding="utf-8") as settings:
        settings.write("relocatable = true\n")  # tells uv to write scripts that can be moved


def fill(folder: Path, *parts: list[str]) -> None:
    """Make an environment and install into it part by part."""
    if not find_uv():
        fetch_uv()
    make_venv(folder)
    for part in parts:
        install(folder, part)


def install(folder: Path, packages: list[str]) -> None:
    """Install packages into an environment with uv, or with pip, which is slower."""
    into = ["--python", str(python_of(folder))]
    if uv := find_uv():
        no_index = variables().get("PIP_NO_INDEX", "0").lower() in ("1", "true", "yes")
        options = [*UV_OPTIONS, *into, *["--no-index"] * no_index]
        run_step([uv, "pip", "install", *options, *packages], variables())
    else:  # there is no uv for this computer, so it is left out
        listed = TOOLS / "environment.txt"
        listed.write_text(UV.sub("", ENVIRONMENT.read_text("utf-8")), "utf-8")
        packages = [str(listed) if word == str(ENVIRONMENT) else word for word in packages]
        run_step([*pip(), *into, "install", *packages], variables())


def pip() -> list[str]:
    """Return the command of a pip: in ``.venv-uv`` or, as long as there is none, of this Python."""
    return [str(python_of(TOOLS)) if WANTED.exists() else sys.executable, "-m", "pip"]


@cache
def variables() -> dict[str, str]:
    """Return the variables of uv and pip: the user's without what misleads, and pip's settings."""
    kept = {"PIP_CONFIG_FILE", *OF_UV}
    around = {
        name: value
        for name, value in steps.surroundings().items()
        if not name.startswith(("PIP_", "UV_")) or name in kept
    }
    ask = [*pip(), "config", "list"]
    told = subprocess.run(ask, env=around, capture_output=True, encoding="utf-8").stdout
    around |= {"PIP_CONFIG_FILE": os.devnull, "PIP_RETRIES": "2", "PIP_NO_INPUT": "1"}
    around |= {"PIP_NO_COMPILE": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
    # As pip does: the best of all indexes; hashes say what is good.
    around |= {"UV_HTTP_RETRIES": "1", "UV_INDEX_STRATEGY": "unsafe-best-match"}
    if sys.platform in ("win32", "darwin"):  # whose certificates pip takes by itself
        around |= {"UV_NATIVE_TLS": "1", "UV_SYSTEM_CERTS": "1"}
    if sys.platform != "darwin":  # where copies share their blocks anyway
        # A file that is damaged in one environment must not be damaged in the cache and all others.
        around["UV_LINK_MODE"] = "copy"
    for name, names in SETTINGS.items():
        variable = f"PIP_{name.upper().replace('-', '_')}"
        found = re.findall(rf"^(?:global|install)\.{name}=(.*)$", told, re.M)
        value = os.environ.get(variable, ast.literal_eval(found[-1]) if found else "").strip()
        if value:
            around |= dict.fromkeys([variable, *names], value)
    if "PIP_FIND_LINKS" in around:  # uv separates by commas, pip by blanks, which a folder may have
        if (folder := Path(around["PIP_FIND_LINKS"])).is_dir():
            around["PIP_FIND_LINKS"] = folder.absolute().as_uri()
        around["UV_FIND_LINKS"] = ",".join(around["PIP_FIND_LINKS"].split())
    return around


def find_uv() -> str:
    """Return a uv that knows our options: the user's own, or the one in ``.venv-uv``."""
    for path in (shutil.which("uv"), shutil.which("uv", path=str(TOOLS / steps.BIN))):
        with suppress(OSError):
            ask = [path or "", *UV_OPTIONS, "--version"]
            if path and not subprocess.run(ask, capture_output=True).returncode:
                return path
    return ""


def fetch_uv() -> None:
    """Bring a pip and the uv that environment.txt names, if there is one, into ``.venv-uv``."""
    if not WANTED.exists() or not python_of(TOOLS).exists():
        make_venv(TOOLS, pip=True)
    WANTED.write_text("".join(UV.findall(ENVIRONMENT.read_text("utf-8"))), "utf-8")
    try:
        run_step([*pip(), "install", *PINNED, str(WANTED)], variables())
    except NoPackages as trouble:  # there is none for this computer, else
        if "cannot be reached" in str(trouble):
            raise

"""Installs packages into environments: with uv, or with pip where uv does not work.

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
from collections.abc import Iterator
from pathlib import Path

from bootstrap.steps import (
    BIN,
    HOME,
    PYTHON_NAME,
    VENV,
    VERSION,
    NoPackages,
    Trouble,
    diagnosis,
    run_step,
    say,
    surroundings,
)

ENVIRONMENT = HOME / "environment.txt"
TOOLS = VENV.with_name(f"{VENV.name}-uv")
WANTED = TOOLS / "uv.txt"  # written when its pip is whole
UV = re.compile(r"^uv==.*\n(?: .*\n)*", re.M)  # in environment.txt
OLDEST_UV = (0, 5)
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
OF_UV = {f"UV_{name}" for name in ("CACHE_DIR", "INDEX", "NATIVE_TLS", "SYSTEM_CERTS")}
OF_UV |= {name for names in SETTINGS.values() for name in names}
"""Variables of the user that uv sees."""


def python_of(folder: Path) -> Path:
    return folder / BIN / PYTHON_NAME


def make_venv(folder: Path, pip: bool = False) -> None:
    """Make an empty environment, or one that holds the pip that comes with Python."""
    for module in ("venv", "ensurepip") if pip else ("venv",):
        if importlib.util.find_spec(module) is None:
            raise Trouble(
                f"This Python lacks its module {module}: install it (on Debian and Ubuntu: "
                f"sudo apt install python{VERSION}-venv) and run this again."
            )
    # lab.py may have been started from the very environment that is to be replaced.
    python = getattr(sys, "_base_executable", sys.executable)
    run_step([python, "-m", "venv", "--clear", *([] if pip else ["--without-pip"]), str(folder)])
    with (folder / "pyvenv.cfg").open("a", encoding="utf-8") as settings:
        settings.write("relocatable = true\n")  # tells uv to write scripts that can be moved


def fill(folder: Path, *steps: list[str]) -> None:
    """Make an environment and install into it in some steps."""
    told = ""
    for command, env in installers(folder):
        if told:
            say("uv could not do it; pip tries, which takes longer.")
        try:
            make_venv(folder)
            for step in steps:
                run_step([*command, *(without_uv(word) for word in step)], env)
            return
        except NoPackages as trouble:
            told += trouble.output
    raise diagnosis(told)


def without_uv(word: str) -> str:
    """Return a list of packages without uv where there is none for this computer."""
    if not word.endswith(".txt") or find_uv():
        return word
    lines = UV.sub("", Path(word).read_text("utf-8"))
    (TOOLS / "list.txt").write_text(lines, "utf-8")
    return str(TOOLS / "list.txt")


def installers(folder: Path) -> Iterator[tuple[list[str], dict[str, str]]]:
    """Yield the commands that install into an environment, with their variables: of uv, of pip."""
    found = pip_settings()
    around = {n: v for n, v in surroundings().items() if not n.startswith("PIP_")}
    around["PIP_CONFIG_FILE"] = os.devnull
    around |= {pip_variable(name): value for name, value in found.items()}
    around |= {"PIP_RETRIES": "2", "PIP_NO_INPUT": "1", "PIP_NO_COMPILE": "1"}
    around |= {"PIP_PROGRESS_BAR": "off", "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
    for_uv = {n: v for n, v in around.items() if not n.startswith("UV_") or n in OF_UV}
    for name, value in found.items():
        if name == "find-links":  # uv separates by commas
            value = ",".join(value.split())
        for_uv |= dict.fromkeys(SETTINGS[name], value)
    for_uv["UV_HTTP_RETRIES"] = "1"
    if "extra-index-url" in found:  # as pip does: the best of all; hashes say what is good
        for_uv["UV_INDEX_STRATEGY"] = "unsafe-best-match"
    if sys.platform != "darwin":  # where copies share their blocks anyway
        # A file that is damaged in one environment must not be damaged in the cache and all others.
        for_uv["UV_LINK_MODE"] = "copy"
    uv = find_uv() or fetch_uv(around)
    if uv:
        options = ["--no-config", "--no-python-downloads", "--python", str(python_of(folder))]
        options += ["--no-index"] * (found.get("no-index", "0").lower() in ("1", "true", "yes"))
        yield [uv, "pip", "install", *options], for_uv
    if importlib.util.find_spec("ensurepip"):
        bring_pip()
        pip = [str(python_of(TOOLS)), "-m", "pip", "--python", str(python_of(folder)), "install"]
        yield pip, around


def pip_variable(name: str) -> str:
    return f"PIP_{name.upper().replace('-', '_')}"


def pip_settings() -> dict[str, str]:
    """Return those of pip's settings, from its files and variables, that uv is told as well."""
    python = python_of(TOOLS) if WANTED.exists() else Path(sys.executable)
    ask = [str(python), "-m", "pip", "config", "list"]
    # Variables count most, and could mislead this program, too.
    around = {n: v for n, v in surroundings().items() if n[:4] != "PIP_" or n == "PIP_CONFIG_FILE"}
    told = subprocess.run(ask, env=around, capture_output=True, encoding="utf-8").stdout
    found: dict[str, str] = {}
    for section in ("global", "install"):
        lines = re.findall(rf"^{section}\.([\w-]+)=(.*)$", told, re.M)
        found |= {name: ast.literal_eval(value) for name, value in lines}
    given = {name: os.environ.get(pip_variable(name)) for name in SETTINGS}
    found |= {name: value for name, value in given.items() if value is not None}
    return {name: found[name].strip() for name in SETTINGS if found.get(name, "").strip()}


def find_uv() -> str:
    """Return a uv that works: the user's own, or the one in ``.venv-uv``."""
    for path in (shutil.which("uv"), shutil.which("uv", path=str(TOOLS / BIN))):
        try:
            told = subprocess.run([path or "", "--version"], capture_output=True, encoding="utf-8")
        except OSError:
            continue
        version = re.match(r"uv (\d+)\.(\d+)", told.stdout)
        if path and version and tuple(map(int, version.groups())) >= OLDEST_UV:
            return path
    return ""


def bring_pip() -> None:
    """Make ``.venv-uv`` with the pip that comes with Python, if there is none."""
    if not WANTED.exists() or not python_of(TOOLS).exists():
        make_venv(TOOLS, pip=True)
        WANTED.touch()


def fetch_uv(around: dict[str, str]) -> str:
    """Bring the uv that environment.txt names into ``.venv-uv``; nothing if there is none."""
    bring_pip()
    pinned = UV.search(ENVIRONMENT.read_text("utf-8"))
    if not pinned:
        return ""
    WANTED.write_text(pinned[0], "utf-8")
    options = ["--only-binary=:all:", "--no-deps", "--require-hashes", "-r", str(WANTED)]
    try:
        run_step([str(python_of(TOOLS)), "-m", "pip", "install", *options], around)
    except NoPackages:
        return ""  # there is none for this computer, or pip will meet the same trouble
    return find_uv()

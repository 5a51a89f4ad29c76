"""Makes environments besides ``.venv``, each from a list of pinned packages.

The site's sees all that ``.venv`` has, and holds what one command adds: so the site is built with
the very packages that the tests run with, and ``.venv`` stays as its list says. Those of the
oldest and of the newest packages see nothing of ``.venv``, and have the book's own package besides.
The newest have no list: it would be old tomorrow.
"""

import hashlib
import json
import re
import subprocess
from pathlib import Path

from bootstrap.environment import PYPROJECT, STAMP, alone, make_venv, site_packages, write
from bootstrap.steps import (
    BIN,
    HOME,
    PYTHON_NAME,
    VENV,
    VERSION,
    pip_install,
    run_step,
    say,
)

SITE_LIST = HOME / "site/packages.txt"
SITE_HEAD = "# What 'python3 lab.py site' needs beside environment.txt; by 'python3 lab.py lock'.\n"
LOWEST_LIST = HOME / "bootstrap/lowest.txt"
LOWEST_HEAD = "# The oldest packages that pyproject.toml allows, for 'python3 lab.py lowest'.\n"


def beside(listed: Path) -> Path:
    """Return the Python of an environment with `.venv` and the packages of a list beside it."""
    return _python(listed, listed.parent.name, sees_venv=True)


def apart(listed: Path) -> Path:
    """Return the Python of an environment with the packages of a list and the book's own."""
    return _python(listed, listed.stem, sees_venv=False)


def of_today(extras: tuple[str, ...]) -> Path:
    """Return the Python of an environment with what is newest today, of all dependencies."""
    folder = VENV.with_name(f"{VENV.name}-newest")
    python = folder / BIN / PYTHON_NAME
    with alone():
        say("Bringing the newest packages ...")
        make_venv(folder)
        options = ["--no-input", "--only-binary=:all:", "--progress-bar=off"]
        what = f".[{','.join(extras)}]"
        run_step([str(python), "-m", "pip", "install", *options, "--editable", what])
    told = [str(python), "-m", "pip", "list", "--format=freeze"]
    say(", ".join(subprocess.run(told, check=True, capture_output=True, text=True).stdout.split()))
    return python


def _python(listed: Path, name: str, sees_venv: bool) -> Path:
    folder = VENV.with_name(f"{VENV.name}-{name}")
    python = folder / BIN / PYTHON_NAME
    # What the package says of itself, an editable one says as it was when it was laid.
    what = listed.read_bytes() + (b"" if sees_venv else PYPROJECT.read_bytes())
    below = str(site_packages(VENV))
    packages = hashlib.sha256(what).hexdigest()
    stamp = json.dumps({"packages": packages, "below": below, "python": VERSION})
    with alone():
        made = folder / STAMP
        if python.exists() and made.exists() and made.read_text("utf-8") == stamp:
            return python
        say(f"Bringing the packages of {listed.relative_to(HOME)} ...")
        make_venv(folder)
        pip = pip_install(str(python))
        if sees_venv:
            # Escaped, because Pythons before 3.13 read this file in the system's encoding.
            line = f"import site; site.addsitedir({below!a})\n"
            write(site_packages(folder) / "below.pth", line)
        options = ["--no-compile", "--progress-bar=off", "--require-hashes", "-r", str(listed)]
        run_step([*pip, *options])
        if not sees_venv:
            run_step([*pip, "--no-build-isolation", "--editable", "."])
        write(made, stamp)
    return python


def without(known: str, text: str) -> str:
    """Return a list of pinned packages without those, with the same hashes, of another list."""
    packages = re.findall(r"^[^\s#].*\n(?:[ \t].*\n)*", text, re.M)
    return "".join(package for package in packages if package not in known)

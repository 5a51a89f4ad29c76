"""Makes environments beside ``.venv``: they see all that it has, and hold what one command adds.

So the site is built with the very packages that the tests run with, and ``.venv`` stays as its list
says.
"""

import hashlib
import json
import re
from pathlib import Path

from bootstrap.environment import STAMP, alone, make_venv, site_packages, write
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


def beside(listed: Path) -> Path:
    """Return the Python of an environment with `.venv` and the packages of a list beside it."""
    name = listed.parent.name
    folder = VENV.with_name(f"{VENV.name}-{name}")
    python = folder / BIN / PYTHON_NAME
    digest = hashlib.sha256(listed.read_bytes()).hexdigest()
    below = str(site_packages(VENV))
    stamp = json.dumps({"packages": digest, "below": below, "python": VERSION})
    with alone():
        made = folder / STAMP
        if python.exists() and made.exists() and made.read_text("utf-8") == stamp:
            return python
        say(f"Bringing the packages of {listed.relative_to(HOME)} ...")
        make_venv(folder)
        # Escaped, because Pythons before 3.13 read this file in the system's encoding.
        line = f"import site; site.addsitedir({below!a})\n"
        write(site_packages(folder) / "below.pth", line)
        options = ["--no-compile", "--progress-bar=off", "--require-hashes", "-r", str(listed)]
        run_step([*pip_install(str(python)), *options])
        write(made, stamp)
    return python


def without(known: str, text: str) -> str:
    """Return a list of pinned packages without those, with the same hashes, of another list."""
    packages = re.findall(r"^[^\s#].*\n(?:[ \t].*\n)*", text, re.M)
    return "".join(package for package in packages if package not in known)

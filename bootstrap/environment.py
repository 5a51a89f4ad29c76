"""Makes ``.venv`` from environment.txt, and other environments beside it, and keeps them in line.

It is made aside and only then put in the place of the old one, which works until then.
"""

import errno
import hashlib
import json
import os
import platform
import re
import shutil
import subprocess
import sys
import sysconfig
import time
import tomllib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from itertools import chain
from pathlib import Path
from typing import Any

from bootstrap.installer import ENVIRONMENT, PINNED, fill, install, python_of
from bootstrap.steps import BIN, DISK_FULL, HOME, PYTHON, VENV, VERSION, NoPackages, Trouble, say

STAMP = "driftlab.json"  # in an environment, written last
LOCK = HOME / ".setup.lock"
PYPROJECT = HOME / "pyproject.toml"
SITE_LIST = HOME / "site/packages.txt"
WHEELS = "--only-binary=:all:"  # building from source would fetch tools that are not pinned
OWN = ["--no-deps", "--no-build-isolation", "--editable", "."]


def project() -> dict[str, Any]:
    return tomllib.loads(PYPROJECT.read_text("utf-8"))


def pins() -> list[str]:
    """Return the packages of environment.txt without their hashes."""
    return re.findall(r"^([^\s#].*?) *\\?$", ENVIRONMENT.read_text("utf-8"), re.M)


def wanted_stamp(listed: Path) -> dict[str, Any]:
    """Return what the stamp of an environment with the packages of a list says."""
    digest = hashlib.sha256(listed.read_bytes()).hexdigest()
    return {"environment": digest, "python": f"{platform.python_implementation()} {VERSION}"}


def read_stamp(folder: Path = VENV) -> dict[str, Any]:
    """Return the stamp of a finished set-up; empty if there is none."""
    try:
        return {**json.loads((folder / STAMP).read_text("utf-8"))}
    except (OSError, ValueError, TypeError):
        return {}


def runs() -> bool:
    """Tell whether the environment was finished once, and its Python runs."""
    call = [str(PYTHON), "-I", "-S", "-c", ""]
    return "environment" in read_stamp() and PYTHON.exists() and not subprocess.call(call)


def site_packages(venv: Path) -> Path:
    return Path(sysconfig.get_path("purelib", "venv", {"base": str(venv)}))


def size_of(venv: Path) -> int:
    """Return how many bytes of packages there are, without what Python compiles of them."""
    return sum(
        os.lstat(f"{folder}/{name}").st_size
        for folder, _, names in os.walk(site_packages(venv))
        if not folder.endswith("__pycache__")
        for name in names
    )


def reason_to_build() -> str:
    """Say why the environment has to be made; nothing if it can stay."""
    found = read_stamp()
    if not VENV.exists() or (VENV.is_dir() and not any(VENV.iterdir())):
        return f"Setting up Drift Lab in {HOME}; the first time takes up to a minute or two."
    if not (VENV / STAMP).exists():
        raise Trouble(f"{VENV} was not made by lab.py: move it away and run this again.")
    if found != {**found, **wanted_stamp(ENVIRONMENT)}:
        return "The project or Python has changed since the last set-up; updating the environment."
    if not runs() or size_of(VENV) < found.get("size", 0):  # more is what the user has added
        return "The environment is damaged; making it again."
    return ""


def set_up() -> Path:
    """Bring ``.venv`` in line with the project, at once if it is, and return its Python."""
    if os.pathsep in str(HOME):
        raise Trouble(f'Python cannot work in a folder with "{os.pathsep}" in its name: {HOME}.')
    for needed in (ENVIRONMENT, PYPROJECT):
        if not needed.exists():
            raise Trouble(f"The project is incomplete, get it afresh: it has no {needed.name}.")
    beside = f"{VENV.name}.lab*"  # left by an interrupted set-up
    to_clean = os.access(VENV.parent, os.W_OK) and any(VENV.parent.glob(beside))
    if not to_clean and not reason_to_build():
        return PYTHON  # without the lock, which a folder that can only be read would not give
    with alone():
        for left in VENV.parent.glob(beside):
            if (left / STAMP).exists() and not VENV.exists():
                left.rename(VENV)
            shutil.rmtree(left, ignore_errors=True)
        if reason := reason_to_build():
            say(reason)
            build()
    return PYTHON


def build() -> None:
    """Make the environment aside and, when it is ready, put it in the place of the old one."""
    # Nobody else uses these names, not even a step that outlives a lab.py that was killed.
    new, old = (VENV.with_name(f"{VENV.name}.lab{os.getpid()}{end}") for end in ("", ".old"))
    try:
        fill(new, [*PINNED, str(ENVIRONMENT)], OWN)
        settle(new)
        write(new / STAMP, json.dumps({**wanted_stamp(ENVIRONMENT), "size": size_of(new)}))
        if VENV.exists():
            VENV.rename(old)
        try:
            new.rename(VENV)
        except OSError:
            old.rename(VENV)
            raise
    finally:
        for folder in (new, old):
            shutil.rmtree(folder, ignore_errors=True)


def settle(new: Path) -> None:
    """Prepare the files of a new environment for its place, and for other places of the project."""
    # The absolute path of src is here, and Pythons before 3.13 misread it if it has letters
    # outside the system's encoding. A path relative to site-packages has none.
    write(site_packages(new) / "driftlab.pth", os.path.relpath(HOME / "src", site_packages(VENV)))
    for script in (new / BIN).iterdir():
        if script.is_file() and not script.is_symlink():
            text = script.read_bytes()
            if os.fsencode(new) in text:
                script.write_bytes(text.replace(os.fsencode(new), os.fsencode(VENV)))


def site_tools() -> Path:
    """Return the Python of ``.venv-site``, which has the site's tools and sees all of ``.venv``.

    So the site is built with the packages that the tests run with.
    """
    set_up()
    folder, below = VENV.with_name(f"{VENV.name}-site"), str(site_packages(VENV))
    stamp = {**wanted_stamp(SITE_LIST), "below": below}
    with alone():
        if not python_of(folder).exists() or read_stamp(folder) != stamp:
            say("Bringing the packages of the site ...")
            fill(folder, [*PINNED, str(SITE_LIST)])
            # Escaped, because Pythons before 3.13 read this file in the system's encoding.
            line = f"import site; site.addsitedir({below!a})\n"
            write(site_packages(folder) / "below.pth", line)
            write(folder / STAMP, json.dumps(stamp))
    return python_of(folder)


def of_age(age: str) -> Path:
    """Return the Python of an environment with the oldest packages allowed, or with the newest."""
    folder, extras = VENV.with_name(f"{VENV.name}-{age}"), project()["tool"]["uv"]["pip"]["extra"]
    options = ["--resolution", "lowest-direct"] if age == "lowest" else []
    wanted = chain(project()["project"]["dependencies"], needs_of(extras))
    with alone():
        say(f"Bringing the {age} packages ...")
        fill(folder, [WHEELS, *options, *wanted], OWN)
    return python_of(folder)


def with_extras(*extras: str) -> Path:
    """Return the environment's Python after packages of extras came to it, if they can be had."""
    set_up()
    try:  # they may not change what environment.txt pins
        install(VENV, [WHEELS, *needs_of(extras), *pins()])
    except NoPackages as trouble:
        say(f"{trouble}\nGoing on without the packages to compare with.")
    return PYTHON


def needs_of(extras: Iterable[str]) -> list[str]:
    return [*chain(*(project()["project"]["optional-dependencies"][extra] for extra in extras))]


@contextmanager
def alone() -> Iterator[None]:
    """Hold the set-up lock; the system takes it back when this process ends."""
    try:
        with LOCK.open("a") as file:
            if not try_to_lock(file.fileno()):
                say("Another start of Drift Lab is setting up this folder; waiting for it.")
                while not try_to_lock(file.fileno()):
                    time.sleep(0.2)
            yield
    except OSError as error:
        if error.errno in (errno.ENOSPC, errno.EDQUOT):
            raise Trouble(DISK_FULL) from error
        if error.errno in (errno.EACCES, errno.EPERM, errno.EROFS):
            raise Trouble(
                f"{error.filename} cannot be written: make the project folder writable "
                "(or close the program that uses it) and run this again."
            ) from error
        raise


def try_to_lock(descriptor: int) -> bool:
    try:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    return True


def write(path: Path, text: str) -> None:
    """Write `text` so that a reader finds the old file or the new one, never half of one."""
    path.parent.mkdir(parents=True, exist_ok=True)
    half = path.with_name(path.name + ".new")
    half.write_text(text, "utf-8", newline="\n")
    half.replace(path)

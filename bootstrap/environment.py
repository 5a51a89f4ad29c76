"""Makes ``.venv`` from environment.txt, and other environments beside it, and keeps them in line.

An environment is made aside and only then put in the place of the old one, which works until then.
"""

import csv
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
from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import chain
from pathlib import Path
from typing import Any

from bootstrap.installer import ENVIRONMENT, fill, python_of
from bootstrap.steps import BIN, DISK_FULL, HOME, PYTHON, VENV, VERSION, Trouble, say

STAMP = "driftlab.json"  # in an environment, written last
LOCK = HOME / ".setup.lock"
PYPROJECT = HOME / "pyproject.toml"
SITE_LIST, LOWEST_LIST = HOME / "site/packages.txt", HOME / "bootstrap/lowest.txt"
OWN = ["--no-deps", "--no-build-isolation", "--editable", "."]


def listed(path: Path) -> list[str]:
    # --only-binary: building from source would fetch tools that environment.txt does not pin.
    return ["--no-deps", "--only-binary=:all:", "--require-hashes", "-r", str(path)]


def project() -> dict[str, Any]:
    return tomllib.loads(PYPROJECT.read_text("utf-8"))


def lock_line() -> str:
    """Return the line by which environment.txt says for which dependencies it was written."""
    tables = project()
    asked = [tables["project"].get(key) for key in ("dependencies", "optional-dependencies")]
    wishes = [tables["build-system"]["requires"], *asked, tables.get("tool", {}).get("uv")]
    digest = hashlib.sha256(json.dumps(wishes, sort_keys=True).encode()).hexdigest()
    return f"# dependencies in pyproject.toml: sha256:{digest}\n"


def pins() -> list[str]:
    """Return the packages of environment.txt without their hashes."""
    return re.findall(r"^([^\s#].*?) *\\?$", ENVIRONMENT.read_text("utf-8"), re.M)


def wanted_stamp(*files: Path) -> dict[str, Any]:
    """Return what a stamp says, besides what was unlike its record from the beginning."""
    digest = hashlib.sha256(b"".join(path.read_bytes() for path in files)).hexdigest()
    return {"environment": digest, "python": f"{platform.python_implementation()} {VERSION}"}


def read_stamp(folder: Path = VENV) -> dict[str, Any]:
    """Return the stamp of the last finished set-up; empty if there is none."""
    try:
        stamp = json.loads((folder / STAMP).read_text("utf-8"))
    except (OSError, ValueError):
        return {}
    return stamp if isinstance(stamp, dict) else {}


def runs() -> bool:
    """Tell whether the environment was finished once, and its Python runs."""
    try:
        subprocess.run([PYTHON, "-I", "-S", "-c", ""], check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        return False
    return "unlike" in read_stamp()


def site_packages(venv: Path) -> Path:
    return Path(sysconfig.get_path("purelib", "venv", {"base": str(venv)}))


def unlike_records(venv: Path) -> list[str]:
    """Return the files that are lost, or whose size differs from the record of their package.

    Each folder is listed once and no file is opened: this takes a tenth of a second. Scripts and
    driftlab.pth are rewritten after the set-up, and Python's compiled files have no size.
    """
    packages, unlike = site_packages(venv), []
    folders: defaultdict[Path, list[tuple[str, str]]] = defaultdict(list)
    for record in packages.glob("*.dist-info/RECORD"):
        try:
            for path, _, size in csv.reader(record.read_text("utf-8").splitlines()):
                if size and not path.startswith("..") and path != "driftlab.pth":
                    folders[(packages / path).parent].append((path.rpartition("/")[2], size))
        except (OSError, ValueError, csv.Error):
            unlike.append(record.parent.name)
    for folder, files in folders.items():
        try:
            with os.scandir(folder) as entries:
                sizes = {entry.name: str(entry.stat().st_size) for entry in entries}
        except OSError:
            sizes = {}
        unlike += [f"{folder.name}/{name}" for name, size in files if sizes.get(name) != size]
    return unlike


def reason_to_build() -> str:
    """Say why the environment has to be made; nothing if it can stay."""
    found, wanted = read_stamp(), wanted_stamp(ENVIRONMENT)
    if not VENV.exists() or (VENV.is_dir() and not any(VENV.iterdir())):
        return f"Setting up Drift Lab in {HOME}; the first time takes up to a minute or two."
    if not (VENV / STAMP).exists():
        raise Trouble(f"{VENV} was not made by lab.py: move it away and run this again.")
    if found.get("python", wanted["python"]) != wanted["python"]:
        return f"Making the environment again, for {wanted['python']}."
    if found.get("environment", wanted["environment"]) != wanted["environment"]:
        return "The project has changed since the last set-up; updating its environment."
    if not runs() or not set(unlike_records(VENV)) <= set(found["unlike"]):
        return "The environment is damaged; making it again."
    return ""


def set_up() -> None:
    """Bring ``.venv`` in line with the project; return at once if it is."""
    if os.pathsep in str(HOME):
        raise Trouble(f'Python cannot work in a folder with "{os.pathsep}" in its name: {HOME}.')
    try:
        if lock_line() not in ENVIRONMENT.read_text("utf-8"):
            say("environment.txt is older than pyproject.toml; 'python3 lab.py lock' renews it.")
    except (FileNotFoundError, KeyError, ValueError) as error:
        raise Trouble(f"The project is incomplete or damaged, get it afresh: {error}.") from error
    if not reason_to_build():
        return  # without the lock, which a folder that can only be read would not give
    with alone():
        for left in VENV.parent.glob(f"{VENV.name}.lab*"):  # by an interrupted set-up
            if (left / STAMP).exists() and not VENV.exists():
                left.rename(VENV)
            shutil.rmtree(left, ignore_errors=True)
        reason = reason_to_build()
        if reason:
            say(reason)
            build()


def build() -> None:
    """Make the environment aside and, when it is ready, put it in the place of the old one."""
    # Nobody else uses these names, not even a step that outlives a lab.py that was killed.
    new, old = (VENV.with_name(f"{VENV.name}.lab{os.getpid()}{end}") for end in ("", ".old"))
    try:
        fill(new, listed(ENVIRONMENT), OWN)
        settle(new, VENV)
        stamp = {**wanted_stamp(ENVIRONMENT), "unlike": unlike_records(new)}
        write(new / STAMP, json.dumps(stamp))
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


def settle(new: Path, place: Path) -> None:
    """Prepare the files of a new environment for its place, and for other places of the project."""
    # The absolute path of src is here, and Pythons before 3.13 misread it if it has letters
    # outside the system's encoding. A path relative to site-packages has none.
    packages = site_packages(new)
    write(packages / "driftlab.pth", os.path.relpath(HOME / "src", site_packages(place)) + "\n")
    for script in (new / BIN).iterdir():
        if script.is_file() and not script.is_symlink():
            text = script.read_bytes()
            if os.fsencode(new) in text:
                script.write_bytes(text.replace(os.fsencode(new), os.fsencode(place)))


def beside(path: Path, name: str, sees_venv: bool = False) -> Path:
    """Return the Python of another environment, with the packages of a list.

    It has the book's own package, or it sees all that ``.venv`` has: so the site is built with the
    packages that the tests run with.
    """
    folder = VENV.with_name(f"{VENV.name}-{name}")
    below = str(site_packages(VENV))
    stamp = {**wanted_stamp(path, PYPROJECT), "folder": str(folder), "below": below}
    with alone():
        if not python_of(folder).exists() or read_stamp(folder) != stamp:
            say(f"Bringing the packages of {path.relative_to(HOME)} ...")
            fill(folder, listed(path), *([] if sees_venv else [OWN]))
            if sees_venv:
                # Escaped, because Pythons before 3.13 read this file in the system's encoding.
                line = f"import site; site.addsitedir({below!a})\n"
                write(site_packages(folder) / "below.pth", line)
            else:
                settle(folder, folder)
            write(folder / STAMP, json.dumps(stamp))
    return python_of(folder)


def of_today(extras: tuple[str, ...]) -> Path:
    """Return the Python of an environment with the newest packages, which have no list."""
    folder = VENV.with_name(f"{VENV.name}-newest")
    with alone():
        say("Bringing the newest packages ...")
        about = project()["project"]
        lists = (about["optional-dependencies"][extra] for extra in extras)
        fill(folder, ["--only-binary=:all:", *chain(about["dependencies"], *lists)], OWN)
    found = site_packages(folder).glob("*.dist-info")
    say(", ".join(sorted(path.stem.replace("-", "==", 1) for path in found)))
    return python_of(folder)


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

"""Makes ``.venv`` from environment.txt and keeps it in line with it.

The packages of environment.txt and the book's own package go into ``.venv``; elsewhere nothing
is installed. An environment is made aside, looked through, and only then put in the place of the
old one, which works until then.
"""

import errno
import hashlib
import importlib.util
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
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import metadata
from pathlib import Path
from typing import Any

from bootstrap.records import unlike_records
from bootstrap.steps import (
    BIN,
    DISK_FULL,
    HOME,
    PYTHON,
    PYTHON_NAME,
    VENV,
    VERSION,
    Trouble,
    pip_install,
    run_step,
    say,
)

STAMP = "driftlab.json"  # in .venv, written last
LOCK = HOME / ".setup.lock"
ENVIRONMENT, PYPROJECT = HOME / "environment.txt", HOME / "pyproject.toml"


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


def wanted_stamp() -> dict[str, str]:
    """Return what the stamp says, besides the contents, when the present project is set up."""
    return {
        "environment": hashlib.sha256(ENVIRONMENT.read_bytes()).hexdigest(),
        "python": f"{platform.python_implementation()} {VERSION}",
        "folder": str(VENV),
    }


def read_stamp() -> dict[str, Any]:
    """Return the stamp of the last finished set-up; empty if there is none."""
    try:
        stamp = json.loads((VENV / STAMP).read_text("utf-8"))
    except (OSError, ValueError):
        return {}
    return stamp if isinstance(stamp, dict) else {}


def is_whole() -> bool:
    """Tell whether the environment has all that was installed, each file of it, and runs."""
    if not runs():
        return False
    # What was unlike its record from the beginning, for whatever reason, would be so again.
    unlike = unlike_records(site_packages(VENV), VENV / BIN)
    return set(unlike) <= set(read_stamp().get("unlike") or [])


def runs() -> bool:
    """Tell whether the environment has its packages, if not all of each, and its Python runs."""
    contents = read_stamp().get("contents")
    if not contents or not all((VENV / name).exists() for name in contents):
        return False
    try:
        subprocess.run([PYTHON, "-I", "-S", "-c", ""], check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        return False
    return True


def reason_to_build() -> str:
    """Say why the environment has to be made; nothing if it can stay."""
    found, wanted = read_stamp(), wanted_stamp()
    if not VENV.exists() or (VENV.is_dir() and not any(VENV.iterdir())):
        return f"Setting up Drift Lab in {HOME}; the first time takes a minute or two."
    if not (VENV / STAMP).exists():
        raise Trouble(f"{VENV} was not made by lab.py: move it away and run this again.")
    if found.get("python", wanted["python"]) != wanted["python"]:
        return f"Making the environment anew, for {wanted['python']}."
    if found.get("environment", wanted["environment"]) != wanted["environment"]:
        return "The project has changed since the last set-up; updating its environment."
    if not is_whole():
        return "The environment is damaged; making it anew."
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
    if not reason_to_build() and read_stamp().get("folder") == str(VENV):
        return  # without the lock, which a folder that can only be read would not give
    with alone():
        clear_leftovers()
        reason = reason_to_build()
        if reason:
            say(reason)
            build()
        if read_stamp()["folder"] != str(VENV):
            settle()


def clear_leftovers() -> None:
    """Delete what an interrupted set-up left; what only lacks its place gets it."""
    for folder in VENV.parent.glob(f"{VENV.name}.lab*"):
        if (folder / STAMP).exists() and not VENV.exists():
            folder.rename(VENV)
        shutil.rmtree(folder, ignore_errors=True)


def build() -> None:
    """Make the environment aside and, when it is ready, put it in the place of the old one."""
    # Nobody else uses these names, not even a step that outlives a lab.py that was killed.
    new, old = (VENV.with_name(f"{VENV.name}.lab{os.getpid()}{end}") for end in ("", ".old"))
    try:
        make_venv(new)
        pip = pip_install(str(new / BIN / PYTHON_NAME))
        # --no-compile: Python compiles a module anyway when it is first used.
        listed = ["--no-compile", "--progress-bar=off", "--require-hashes", "-r", ENVIRONMENT.name]
        verify(new, run_step([*pip, *listed]))
        run_step([*pip, "--no-build-isolation", "--editable", "."])
        there = (path.relative_to(new).as_posix() for path in site_packages(new).iterdir())
        contents = [name for name in there if not name.endswith("__pycache__")]
        stamp = {**wanted_stamp(), "folder": str(new), "contents": contents}
        unlike = unlike_records(site_packages(new), new / BIN)
        write(new / STAMP, json.dumps({**stamp, "unlike": unlike}))
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


def make_venv(folder: Path) -> None:
    """Create an environment that holds only pip."""
    for module in ("venv", "ensurepip"):
        if importlib.util.find_spec(module) is None:
            raise Trouble(
                f"This Python lacks its module {module}: install it (on Debian and Ubuntu: "
                f"sudo apt install python{VERSION}-venv) and run this again."
            )
    # lab.py may have been started from the very environment that is to be replaced.
    python = getattr(sys, "_base_executable", sys.executable)
    run_step([python, "-m", "venv", "--clear", str(folder)])


def site_packages(venv: Path) -> Path:
    return Path(sysconfig.get_path("purelib", "venv", {"base": str(venv)}))


def verify(venv: Path, printed: str) -> None:
    """Raise a Trouble unless `venv` holds what environment.txt names and pip did not ignore."""
    installed = metadata.distributions(path=[str(site_packages(venv))])
    there = {re.sub("[-_.]+", "-", one.name).lower() + "==" + one.version for one in installed}
    elsewhere = re.findall(r"^Ignoring ([^:\s]+): markers", printed, re.M)  # for other systems
    wanted = (pin.split()[0] for pin in pins() if pin.split("==")[0] not in elsewhere)
    lost = [pin for pin in wanted if pin not in there]
    if lost:
        raise Trouble(
            f"pip reports success, but did not put {', '.join(lost)} into {venv}: take target, "
            "prefix, root and dry-run out of pip's settings (pip config list)."
        )


def settle() -> None:
    """Let the environment's files name the folders as they are now."""
    # pip leaves the absolute path of src here, and Pythons before 3.13 misread it if it has
    # letters outside the system's encoding. A path relative to site-packages has none.
    packages = site_packages(VENV)
    write(packages / "driftlab.pth", os.path.relpath(HOME / "src", packages) + "\n")
    stamp = read_stamp()
    for script in PYTHON.parent.iterdir():
        if script.is_file() and not script.is_symlink():
            text = script.read_bytes()
            settled = text.replace(os.fsencode(stamp["folder"]), os.fsencode(VENV))
            if settled != text:
                # Of a script that is half written the next start would not know what is missing.
                half = script.with_name(script.name + ".new")
                half.write_bytes(settled)
                shutil.copymode(script, half)
                half.replace(script)
    write(VENV / STAMP, json.dumps({**stamp, "folder": str(VENV)}))


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

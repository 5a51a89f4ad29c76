"""Brings what others made: Pyodide's runtime by npm, wheels by pip.

All is checked against its digest and kept in a folder, so that a second build fetches nothing.
"""

from __future__ import annotations

import hashlib
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from unfinished import Unfinished

from .versions import VERSIONS, Pin, older, wheel_pins

RUNTIME = ("pyodide.asm.js", "pyodide.asm.wasm", "pyodide.mjs", "python_stdlib.zip")
"""What a browser loads of the runtime."""
OFFICIAL = "pyodide-lock.json"
"""The lock of the whole distribution, which comes with the runtime."""
TARGET = ("--platform=any", "--implementation=py", "--abi=none", "--python-version=3.12")
"""Wheels of Python alone: pip on this machine chooses for a browser."""


class Brought(NamedTuple):
    """What others made."""

    runtime: Path  # folder of Pyodide's runtime, with its official lock
    wheels: dict[str, Path]  # wheels by the name of their package
    older: Path  # the wheel that holds an older package


def bring(folder: Path) -> Brought:
    """Bring all that the live book needs, but for what is in the folder already."""
    runtime = folder / "runtime"
    bring_runtime(runtime)
    pins = wheel_pins()
    wheels = bring_wheels(pins, folder / "wheels")
    (old,) = bring_wheels([older()], folder / "wheels")
    return Brought(runtime, dict(zip((pin.name for pin in pins), wheels, strict=True)), old)


def bring_runtime(folder: Path) -> None:
    """Put the runtime into a folder, unless it is there as it was published."""
    if _is_runtime(folder):
        return
    name = f"pyodide@{VERSIONS['pyodide']['version']}"
    folder.parent.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory(dir=folder.parent) as place:  # beside it: then it moves there whole
        command = [found("npm"), "install", name, f"--prefix={place}", "--ignore-scripts"]
        _run(command, f"npm does not bring {name}")
        whole = Path(place) / "node_modules/pyodide"
        if not _is_runtime(whole):
            raise Unfinished(f"{name} came with other contents than versions.toml says.")
        shutil.rmtree(folder, ignore_errors=True)
        whole.rename(folder)


def bring_wheels(pins: Sequence[Pin], folder: Path) -> list[Path]:
    """Return the wheels of some packages, in their order; fetch those missing in the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    missing = [pin for pin in pins if _kept(pin, folder) is None]
    if missing:
        wanted = folder / "wanted.txt"
        lines = [
            " ".join([f"{pin.name}=={pin.version}", *(f"--hash=sha256:{h}" for h in pin.sha256)])
            for pin in missing
        ]
        wanted.write_text("\n".join([*lines, ""]), "utf-8")
        pip = [sys.executable, "-m", "pip", "download", "--quiet", "--no-input", "--retries=2"]
        options = ["--no-deps", "--only-binary=:all:", *TARGET, "--require-hashes"]
        command = [*pip, *options, f"--dest={folder}", f"--requirement={wanted}"]
        _run(command, f"pip does not bring {', '.join(pin.name for pin in missing)}")
    wheels = [_kept(pin, folder) for pin in pins]
    if None in wheels:
        raise Unfinished("pip brought no wheel for one of the packages of the live book.")
    return [wheel for wheel in wheels if wheel is not None]


def found(program: str) -> str:
    """Return where a program is; its name where it is not found."""
    return shutil.which(program) or program  # npm is npm.cmd on Windows


def digest_of(path: Path) -> str:
    """Return the SHA-256 of a file."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _is_runtime(folder: Path) -> bool:
    return all(
        (folder / name).is_file() and digest_of(folder / name) == digest
        for name, digest in VERSIONS["pyodide"]["sha256"].items()
    )


def _kept(pin: Pin, folder: Path) -> Path | None:
    begin = f"{pin.name.replace('-', '_')}-{pin.version}-"
    for path in sorted(folder.glob("*.whl")):
        if path.name.lower().startswith(begin.lower()) and digest_of(path) in pin.sha256:
            return path
    return None


def _run(command: list[str], trouble: str) -> None:
    try:
        subprocess.run(command, capture_output=True, encoding="utf-8", check=True)
    except OSError as error:
        raise Unfinished(f"{trouble}: {error}") from error
    except subprocess.CalledProcessError as error:
        raise Unfinished(f"{trouble}:\n{error.stderr.strip()}") from error

"""Where findings come from: the log by its sum, the call, and the versions at work."""

from __future__ import annotations

import hashlib
import platform
import shlex
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import scipy

import driftlab
from driftlab.recordings.recording import Recording


@dataclass(frozen=True)
class Origin:
    """What a reader needs to have the same numbers again."""

    files: tuple[tuple[str, str], ...]  # name and SHA-256 of each file of the log
    call: str  # the command line
    log: str  # what the log was taken for, in words
    versions: str
    date: str = ""  # if one was told; a clock would make each report another


def origin(
    paths: Sequence[Path], recording: Recording, arguments: Sequence[str], date: str
) -> Origin:
    """Where the findings from a log come from."""
    files = tuple((path.name, _sum(path)) for path in paths)
    versions = (
        f"driftlab {driftlab.__version__}, Python {platform.python_version()}, "
        f"NumPy {np.__version__}, SciPy {scipy.__version__}"
    )
    call = shlex.join(["python", "-m", "driftlab", *arguments])
    return Origin(files, call, described(recording), versions, date)


def _sum(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def described(recording: Recording) -> str:
    """What a log was taken for: rows, time, kind, axes, place."""
    parts = [
        f"{len(recording)} rows of {recording.kind}",
        f"{recording.duration:.6g} s at {1 / recording.interval:.6g} Hz",
        f"body axes {recording.axes}" if recording.axes else "body axes not told",
    ]
    if recording.accelerometer is None:
        parts[0] += " of gyros only"
    if recording.latitude is not None:
        parts.append(f"latitude {np.degrees(recording.latitude):.6g} deg")
    if recording.gravity is not None:
        parts.append(f"gravity {recording.gravity:.6g} m/s^2")
    return ", ".join(parts)

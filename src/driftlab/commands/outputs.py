"""Findings as text, CSV and JSON, with their origin; no file is overwritten without being asked."""

from __future__ import annotations

import argparse
import codecs
import csv
import errno
import hashlib
import io
import json
import math
import os
import platform
import re
import shlex
import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import scipy

import driftlab
from driftlab.recordings.recording import Recording

from .findings import Findings, Table

WIDTH = 88
# What a terminal shows that lacks a sign; others become question marks.
SIGNS = {"±": "+-", "√": "sqrt ", "²": "^2", "·": "*", "°": "deg"}
PLAIN = "driftlab-plain"  # name of that rule, as a handler of errors of encoding
NUMBER = re.compile(r"(< )?[-+]?\d")


def _plain_signs(error: Any) -> tuple[str, int]:
    lacking = error.object[error.start : error.end]
    return "".join(SIGNS.get(sign, "?") for sign in lacking), error.end


codecs.register_error(PLAIN, _plain_signs)


def as_text(findings: Findings) -> str:
    """All that is to be read of findings, in lines that fit a terminal."""
    parts = [
        findings.title + "\n" + "=" * len(findings.title),
        *map(_table, (*findings.tables, *findings.details)),
        *map(_filled, findings.sentences),
        *(_filled(f"Warning: {warning}") for warning in findings.warnings),
    ]
    return "\n\n".join(parts) + "\n"


def _filled(sentence: str) -> str:
    return textwrap.fill(sentence, WIDTH, break_long_words=False, break_on_hyphens=False)


def numeric_columns(table: Table) -> list[bool]:
    """Which columns hold numbers only, and so stand to the right."""
    return [
        all(NUMBER.match(cell) or cell in ("", "-") for cell in column) and any(column)
        for column in zip(*table.rows, strict=True)
    ]


def _table(table: Table) -> str:
    columns = []
    cells = zip(table.head, *table.rows, strict=True)
    for column, numeric in zip(cells, numeric_columns(table), strict=True):
        width = max(map(len, column))
        head, *rows = (x.rjust(width) if numeric else x.ljust(width) for x in column)
        columns.append([head, "-" * width, *rows])
    rows = [f"  {'  '.join(row)}".rstrip() for row in zip(*columns, strict=True)]
    return "\n".join([table.title, *rows, *([_filled(table.note)] if table.note else [])])


@dataclass(frozen=True)
class Origin:
    """What a reader needs to have the same numbers again."""

    files: tuple[tuple[str, str], ...]  # name and SHA-256 of each file of the log
    call: str  # the command line
    log: str  # what the log was taken for, in words
    versions: str
    date: str = ""  # if one was told; a clock would make each report another


def origin(recording: Recording, options: argparse.Namespace, arguments: Sequence[str]) -> Origin:
    """Where the findings from a log come from."""
    versions = (
        f"driftlab {driftlab.__version__}, Python {platform.python_version()}, "
        f"NumPy {np.__version__}, SciPy {scipy.__version__}"
    )
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
    return Origin(
        tuple((path.name, _sum(path)) for path in options.log),
        shlex.join(["python", "-m", "driftlab", *arguments]),
        ", ".join(parts),
        versions,
        options.date,
    )


def _sum(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def as_json(findings: Findings, source: Origin) -> str:
    """The numbers in SI units and radians, with where they come from."""
    whole = {
        "title": findings.title,
        "origin": asdict(source),
        "units": "SI and radians",
        "values": _as_lists(findings.values),
        "warnings": findings.warnings,
    }
    return json.dumps(whole, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _as_lists(value: Any) -> Any:
    """Lists and numbers of arrays; what is not finite is null, as JSON has no word for it."""
    if isinstance(value, Mapping):
        return {key: _as_lists(item) for key, item in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [_as_lists(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def as_csv(findings: Findings) -> str:
    """The columns, numbers to twelve digits."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(findings.columns)
    for row in zip(*findings.columns.values(), strict=True):
        writer.writerow([x if isinstance(x, str) else f"{x:.12g}" for x in row])
    return buffer.getvalue()


def checked_outputs(logs: Sequence[Path], outputs: Mapping[str, Path | None], force: bool) -> None:
    """Refuse, before anything is computed, a file that is there, named twice, or the log itself."""
    taken: dict[Path, str] = {}
    for option, path in outputs.items():
        if path is None:
            continue
        whole = path.resolve()
        if any(log.exists() and path.exists() and path.samefile(log) for log in logs):
            raise ValueError(f"{option}: expected a file of its own, got the log, {path}.")
        if whole in taken:
            raise ValueError(f"{option}: expected a file of its own, got {taken[whole]}, {path}.")
        if path.is_dir():
            raise ValueError(f"{option}: expected a file, got the folder {path}.")
        if not whole.parent.is_dir():
            raise ValueError(f"{option}: expected a file in a folder that is there, got {path}.")
        if path.exists() and not force:
            raise ValueError(f"{option}: {path} is there already; --force overwrites it.")
        taken[whole] = f"the file of {option}"


def write(path: Path, text: str, force: bool) -> None:
    """Write a text completely or not at all, with the same bytes on every system.

    It is written next to its place and then moved there, so that a full disk spoils nothing.
    """
    whole = path.resolve()
    exists, device = whole.exists(), whole.exists() and not whole.is_file()
    beside = whole if device else whole.with_name(f"{whole.name}.{os.getpid()}.part")
    try:
        if exists and not force:
            raise FileExistsError(errno.EEXIST, "is there already; --force overwrites it")
        with beside.open("w", encoding="utf-8", newline="\n") as file:
            file.write(text)
        if not device:
            beside.replace(whole)
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from None
    finally:
        if not device:
            beside.unlink(missing_ok=True)

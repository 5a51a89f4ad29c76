"""Files that a command writes: a page, CSV, JSON; none is overwritten without being asked."""

from __future__ import annotations

import csv
import errno
import io
import json
import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from .findings import Findings
from .origin import Origin


def checked_outputs(logs: Sequence[Path], outputs: Mapping[str, Path | None], force: bool) -> None:
    """Refuse outputs before anything is computed.

    Refused are a file that exists without `force`, one file named twice, the log itself, and a
    missing folder.
    """
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


def as_json(findings: Findings, origin: Origin) -> str:
    """The numbers in SI units and radians, with where they come from."""
    whole = {"title": findings.title, "origin": asdict(origin), "units": "SI and radians"}
    plain = whole | {"values": _plain(findings.values), "warnings": list(findings.warnings)}
    return json.dumps(plain, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def as_csv(findings: Findings) -> str:
    """The columns, numbers to twelve digits."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(findings.columns)
    for row in zip(*findings.columns.values(), strict=True):
        writer.writerow([x if isinstance(x, str) else f"{x:.12g}" for x in row])
    return buffer.getvalue()


def _plain(value: Any) -> Any:
    """Lists and numbers of arrays; what is not finite is null, as JSON has no word for it."""
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value

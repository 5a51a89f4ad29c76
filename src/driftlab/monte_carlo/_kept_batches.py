"""Batches that are done, on a disk: each whole or not at all, and each for one study alone."""

from __future__ import annotations

import json
import os
import pickle
import tempfile
from hashlib import sha256
from pathlib import Path
from typing import Any

import driftlab
from driftlab.core import loops

from ._code import code_of
from ._descriptions import describe

MISSING = object()
"""What is read where there is no whole batch."""

_DIGEST = 32


class KeptBatches:
    """The batches of one study in a folder of its own.

    Parameters
    ----------
    folder : Path
        In it, a folder is made for each study, so that many may share one. What is in it is read by
        `pickle`, which runs what it reads: name no folder in which a stranger may write.
    task : callable
        See `describe`.
    seed, batch : int
        With the task, with the code that it runs, and with NumPy or Numba, they say which study it
        is: what was kept for another, or by another version of the code, is never taken.

    Attributes
    ----------
    folder : Path
        Of the study; ``study.json`` in it says what it is.

    Raises
    ------
    ValueError
        If the task cannot be described, or the folder cannot be written.
    """

    def __init__(self, folder: Path, task: Any, seed: int, batch: int) -> None:
        study = {
            "task": describe(task),
            "seed": seed,
            "batch": batch,
            "driftlab": driftlab.__version__,
            "code": code_of(task),
            "arithmetic": loops.arithmetic(),
        }
        text = json.dumps(study, indent=1, ensure_ascii=False)
        self.folder = folder / sha256(text.encode()).hexdigest()[:20]
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            self._put("study.json", text.encode())
        except OSError as error:
            raise ValueError(f"folder: expected one to write in, got {folder}: {error}.") from error

    def read(self, index: int, size: int) -> Any:
        """Return what was kept of a batch, or `MISSING`; a file that is damaged counts as none."""
        try:
            kept = (self.folder / _name(index, size)).read_bytes()
        except OSError:
            return MISSING
        digest, result = kept[:_DIGEST], kept[_DIGEST:]
        return pickle.loads(result) if sha256(result).digest() == digest else MISSING

    def write(self, index: int, size: int, result: Any) -> None:
        """Keep a batch."""
        data = pickle.dumps(result, protocol=5)
        self._put(_name(index, size), sha256(data).digest() + data)

    def _put(self, name: str, data: bytes) -> None:
        """Write a file whole or not at all, whoever is killed and whoever else writes it."""
        number, part = tempfile.mkstemp(prefix=f"{name}.", suffix=".part", dir=self.folder)
        try:
            with os.fdopen(number, "wb") as file:
                file.write(data)
                file.flush()
                os.fsync(file.fileno())
            os.replace(part, self.folder / name)
        except BaseException:
            Path(part).unlink(missing_ok=True)
            raise


def _name(index: int, size: int) -> str:
    return f"{index:07d}-{size}.batch"

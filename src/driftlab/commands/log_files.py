"""The files of a log, to be read more than once: to hash them, and to take their numbers."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory


@contextmanager
def readable_again(paths: Sequence[Path]) -> Iterator[list[Path]]:
    """The same files, and copies of those that can be read once only, as pipes."""
    with TemporaryDirectory() as folder:
        yield [
            _copied(path, Path(folder, str(number)))
            if path.is_fifo() or path.is_char_device()
            else path
            for number, path in enumerate(paths)
        ]


def _copied(path: Path, folder: Path) -> Path:
    """What a pipe gives, in a file of its name."""
    folder.mkdir()
    copy = folder / path.name
    with path.open("rb") as source, copy.open("wb") as target:
        shutil.copyfileobj(source, target)
    return copy

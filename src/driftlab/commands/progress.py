"""A bar that says how far a command has come; none without tqdm, and none but in a terminal."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager

from .findings import Step


@contextmanager
def steps(count: int) -> Iterator[Step]:
    """Count steps of work on a bar at the foot of the terminal."""
    try:
        from tqdm import tqdm
    except ImportError:
        yield lambda name: None
        return
    begun = 0
    with tqdm(
        total=count,
        file=sys.stderr,
        disable=not sys.stderr.isatty(),
        leave=False,
        bar_format="{desc:24.24} {bar:30} {n_fmt}/{total_fmt}",
    ) as bar:

        def begin(name: str) -> None:
            nonlocal begun
            bar.update(min(begun, 1))
            begun += 1
            bar.set_description_str(name)

        yield begin

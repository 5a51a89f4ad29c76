"""Contenders that may be missing: a peer that is not installed, a floor without a compiler."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from importlib.util import find_spec

import numpy as np

from driftlab.compilation import use_compiled
from driftlab.quaternion import conjugate, multiply, rotation_angle

from . import floor
from .measuring import Contender, Row

Maker = Callable[[], Contender]
IN_C = "the same in C"


def those_here(makers: dict[str, Maker]) -> tuple[list[Contender], list[str]]:
    """Contenders that could be made, and a sentence for each that could not."""
    here, left_out = [], []
    for name, make in makers.items():
        try:
            here.append(make())
        except ImportError as missing:
            left_out.append(f"{name} left out: {missing}.")
    return here, left_out


def floors_here(
    copied: np.ndarray, in_c: Callable[[], object] | None = None, error: object = None
) -> tuple[list[Contender], list[str]]:
    """A copy of the data, and the same in C if there is such a call; both need a compiler."""
    try:
        floor.library()
    except floor.NoCompiler as missing:
        return [], [f"The floor is left out: {missing}."]
    here = [Contender("copy of the data", lambda: floor.copy(copied))]
    if in_c is not None:
        here.append(Contender(IN_C, in_c, error))
    return here, []


def and_compiled(row: Row) -> Iterator[Row]:
    """The row as it is, and once more with the package's loops compiled, if Numba is here."""
    if find_spec("numba") is None:
        sentence = "Compiled loops left out: numba is not installed."
        yield replace(row, left_out=[*row.left_out, sentence])
        return
    yield row
    ours = replace(row.ours, name="driftlab, compiled", run=compiled(row.ours.run))
    yield replace(row, title=f"{row.title}, compiled", ours=ours)


def compiled(run: Callable[[], object]) -> Callable[[], object]:
    """The same call with compiled loops, and those alone."""

    def with_loops() -> object:
        use_compiled()
        try:
            return run()
        finally:
            use_compiled(False)

    return with_loops


def largest_angle(found: np.ndarray, true: np.ndarray) -> float:
    """Largest angle in rad between attitudes (n, 4), whose norms do not count."""
    return float(rotation_angle(multiply(conjugate(true), found)).max())


def every(rows: np.ndarray, count: int) -> np.ndarray:
    """Each `count`-th row, counted so that the first is the end of `count` increments."""
    return rows[count - 1 :: count]


def one_by_one(call: Callable[..., object], *columns: Iterable[object]) -> np.ndarray:
    """What a function of single cases gives for many."""
    return np.array([call(*each) for each in zip(*columns, strict=True)])

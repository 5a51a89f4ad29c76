"""Rows of turns by quarters on a table, as whole numbers: 24 orientations and the turns between."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import permutations, product

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import shown
from driftlab.core.quaternion import from_rotation_vector, to_matrix
from driftlab.motion.scheme import DIRECTIONS, Scheme, checked_scheme

IntArray = NDArray[np.int_]
Row = tuple[int, IntArray]
"""Orientation at the start, and turns (k,)."""

STARTS = tuple(
    names
    for names in permutations(DIRECTIONS, 3)
    if round(np.linalg.det([DIRECTIONS[name] for name in names])) == 1
)
"""The 24 orientations: where x, y and z point."""

_MATRICES = np.array([np.array([DIRECTIONS[name] for name in names]).T for names in STARTS])
_ALONG = np.abs(_MATRICES).argmax(axis=1)  # (24, 3): East, North or Up for each body axis


@dataclass(frozen=True)
class TableMoves:
    """Turns of a table by some angles, in degrees and multiples of 90."""

    angles: tuple[int, ...]

    @cached_property
    def words(self) -> list[str]:
        """The turns that are possible, as a `Scheme` has them."""
        return [f"{sign}{angle}{axis}" for angle in self.angles for axis in "XYZ" for sign in "+-"]

    @cached_property
    def axes(self) -> IntArray:
        """Body axis (m,) of each turn."""
        return np.array(["XYZ".index(word[-1]) for word in self.words])

    @cached_property
    def quarters(self) -> IntArray:
        """Size (m,) of each turn."""
        return np.array([abs(int(word[:-1])) // 90 for word in self.words])

    @cached_property
    def next(self) -> IntArray:
        """Orientation (24, m) to which each turn leads from each orientation."""
        places = {matrix.tobytes(): i for i, matrix in enumerate(_MATRICES)}
        vectors = np.array([angle * axis for axis, angle in Scheme(" ".join(self.words)).turns])
        matrices = np.rint(to_matrix(from_rotation_vector(vectors)))
        return np.array([
            [places[(before @ turn).astype(int).tobytes()] for turn in matrices]
            for before in _MATRICES
        ])  # fmt: skip

    @cached_property
    def _seen(self) -> tuple[list[list[tuple[int, int]]], list[dict[tuple[int, int], int]]]:
        """What each turn is to the room, from each orientation; and the turn that is that."""
        turns = Scheme(" ".join(self.words)).turns
        found = []
        for matrix in _MATRICES:
            rooms = [np.sign(angle) * matrix @ axis @ (1, 2, 3) for axis, angle in turns]
            found.append(
                [(int(room), int(q)) for room, q in zip(rooms, self.quarters, strict=True)]
            )
        return found, [{room: j for j, room in enumerate(rooms)} for rooms in found]

    def exchanged(self, start: int, turns: IntArray, place: int, other: int) -> IntArray:
        """Turns with another one in one place; later ones about other axes of the body keep theirs
        in the room, as those of a table's outer axis do when its inner axis turns."""
        rooms, back = self._seen
        found, axis = turns.copy(), self.axes[turns[place]]
        found[place] = other
        before = after = start
        for k, turn in enumerate(turns):
            if k > place and self.axes[turn] != axis:
                found[k] = back[after][rooms[before][turn]]
            before, after = self.next[before, turn], self.next[after, found[k]]
        return found

    def row(self, scheme: Scheme) -> Row:
        """Start and turns of a scheme, as numbers."""
        scheme = checked_scheme(scheme)
        words = [f"{np.degrees(angle):+.12g}{'XYZ'[np.argmax(u)]}" for u, angle in scheme.turns]
        if not set(words) <= set(self.words):
            raise ValueError(
                f"scheme: expected turns by {', '.join(map(str, self.angles))} degrees, "
                f"got {shown(scheme.rotations)}."
            )
        return STARTS.index(scheme.start), np.array([self.words.index(word) for word in words], int)

    def scheme(self, start: int, row: IntArray) -> Scheme:
        """The scheme of a start and turns, with the usual pauses and rate."""
        return Scheme(" ".join(self.words[i] for i in row), STARTS[start])

    def orientations(self, starts: IntArray, rows: IntArray) -> IntArray:
        """Orientation (b, k + 1) at the start and after each turn of rows (b, k)."""
        found = [starts]
        for turns in rows.T:
            found.append(self.next[found[-1], turns])
        return np.stack(found, axis=1)

    def on_two_axes(self, starts: IntArray, rows: IntArray) -> NDArray[np.bool_]:
        """Whether a table with a level outer axis and an inner one across it can do rows (b, k)."""
        orientation = self.orientations(starts, rows)
        axes = self.axes[rows]
        along = _ALONG[orientation[:, :-1], axes]
        possible = np.zeros(len(rows), bool)
        for inner, outer in product(range(3), range(2)):
            turns = (axes == inner) | (along == outer)
            possible |= turns.all(axis=1) & (_ALONG[starts, inner] != outer)
        return possible

    def drawn(
        self, rng: np.random.Generator, count: int, turns: int, two_axes: bool
    ) -> tuple[IntArray, IntArray]:
        """Random starts (count,) and rows (count, turns)."""
        inner, outer = rng.integers(3, size=count), rng.integers(2, size=count)
        across = outer[:, np.newaxis] != _ALONG[:, inner].T
        weight = across if two_axes else np.ones_like(across)
        starts = (rng.random(weight.shape) * weight).argmax(axis=1)
        rows, orientation = np.empty((count, turns), int), starts
        for turn in range(turns):
            along = _ALONG[orientation][:, self.axes]
            able = (self.axes == inner[:, np.newaxis]) | (along == outer[:, np.newaxis])
            weight = able if two_axes else np.ones_like(able)
            rows[:, turn] = (rng.random(weight.shape) * weight).argmax(axis=1)
            orientation = self.next[orientation, rows[:, turn]]
        return starts, rows

"""Rows of turns by quarters on a table, as whole numbers, and the covariances after many of them.

The table has 24 orientations, and a turn brings it from one to another. What a turn and the pause
after it do to the covariance is worked out once for each orientation.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, reduce
from itertools import permutations, product
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from driftlab.checks import FloatArray, checked_instance
from driftlab.imu import ImuNoise, PriorDeviations
from driftlab.motion.scheme import DIRECTIONS, Scheme

from ._condensed_steps import Condensed, condensed_steps
from .error_model import ErrorModel
from .linearization import linearize_along
from .observability import _segments_and_steps

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
    """What a table may do, and what it shows meanwhile.

    Attributes
    ----------
    duration : float
        Of each row of turns with its pauses, s.
    rate : float
        rad/s.
    angles : tuple of int
        Degrees, multiples of 90.
    latitude : float
        rad.
    model : ErrorModel
    noise : ImuNoise
    prior : PriorDeviations
    """

    duration: float
    rate: float
    angles: tuple[int, ...]
    latitude: float
    model: ErrorModel
    noise: ImuNoise
    prior: PriorDeviations

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
        turns = [Scheme(word).turns[0] for word in self.words]
        matrices = [np.rint(Rotation.from_rotvec(a * u).as_matrix()) for u, a in turns]
        return np.array([
            [places[(before @ turn).astype(int).tobytes()] for turn in matrices]
            for before in _MATRICES
        ])  # fmt: skip

    @cached_property
    def _seen(self) -> tuple[list[list[tuple[int, int]]], list[dict[tuple[int, int], int]]]:
        """What each turn is to the room, from each orientation; and the turn that is that."""
        turns = [Scheme(word).turns[0] for word in self.words]
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
        checked_instance(scheme, Scheme, "scheme")
        words = [f"{np.degrees(angle):+.12g}{'XYZ'[np.argmax(u)]}" for u, angle in scheme.turns]
        if not set(words) <= set(self.words):
            raise ValueError(
                f"scheme: expected turns by {', '.join(map(str, self.angles))} degrees, "
                f"got {scheme.rotations!r}."
            )
        turns = np.array([self.words.index(word) for word in words], int)
        if self._pause(scheme.positions, self.quarters[turns].sum()) <= 0:
            raise ValueError(
                f"scheme: expected turns and pauses in {self.duration:g} s, "
                f"got {scheme.rotations!r}."
            )
        return STARTS.index(scheme.start), turns

    def scheme(self, start: int, row: IntArray) -> Scheme:
        """The scheme of a start and turns."""
        words = " ".join(self.words[i] for i in row)
        return Scheme(words, STARTS[start], self._pause(row.size + 1, self.quarters[row].sum()),
                      self.rate)  # fmt: skip

    def _pause(self, positions: int, quarters: int) -> float:
        return (self.duration - quarters * np.pi / 2 / self.rate) / positions

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

    def covariances(self, starts: IntArray, rows: IntArray) -> FloatArray:
        """Covariances (b, size, size) at the end of rows (b, k), as `covariance_analysis` has."""
        found = np.empty((len(rows), self.model.size, self.model.size))
        orientation, quarters = self.orientations(starts, rows), self.quarters[rows].sum(axis=1)
        for total in np.unique(quarters):
            these = quarters == total
            pause, pieces = self._pieces(rows.shape[1] + 1, int(total))
            begin = starts[these]
            covariance = _chosen(pause, begin).after(self._before[begin])
            for place, turn in zip(orientation[these].T, rows[these].T, strict=False):
                covariance = _chosen(pieces, (place, turn)).after(covariance)
            found[these] = covariance
        return found

    @cached_property
    def _before(self) -> FloatArray:
        attitudes = [Scheme("", names).start_attitude for names in STARTS]
        return np.array([self.model.covariance(self.prior, attitude) for attitude in attitudes])

    @cached_property
    def _kept(self) -> dict[float, tuple[Condensed, Condensed]]:
        return {}

    def _pieces(self, positions: int, quarters: int) -> tuple[Condensed, Condensed]:
        """Pauses (24, ...), and turns with a pause (24, m, ...), in rows that turn so far."""
        dwell = self._pause(positions, quarters)
        if dwell not in self._kept:
            ways = [
                linearize_along(Scheme("", s, dwell), self.latitude, self.model) for s in STARTS
            ]
            step = np.stack([way.transitions[0] for way in ways])
            times = np.full(len(STARTS), ways[0].durations[0])
            pause = condensed_steps(step, times, self.noise).times(len(ways[0].durations))
            self._kept[dwell] = pause, self._turns.then(_chosen(pause, self.next))
        return self._kept[dwell]

    @cached_property
    def _turns(self) -> Condensed:
        """All turns (24, m, ...) without pauses."""
        # Every turn there and back, from each orientation; the ways there count.
        back = str.maketrans("+-", "-+")
        words = " ".join(f"{word} {word.translate(back)}" for word in self.words)
        schemes = [Scheme(words, names, 1.0, self.rate) for names in STARTS]
        ways = [linearize_along(scheme, self.latitude, self.model) for scheme in schemes]
        row = [steps for part, steps in _segments_and_steps(schemes[0], ways[0]) if part.rate][::2]
        turns = []
        for steps in row:
            matrices = np.stack([way.transitions[steps] for way in ways])
            lengths = np.tile(ways[0].durations[steps], (len(STARTS), 1))
            each = condensed_steps(matrices, lengths, self.noise)
            parts = (_chosen(each, np.s_[:, i]) for i in range(lengths.shape[1]))
            turns.append(reduce(Condensed.then, parts))
        return Condensed(*(np.stack(arrays, axis=1) for arrays in zip(*turns, strict=True)))


def _chosen(steps: Condensed, index: Any) -> Condensed:
    return Condensed(*(array[index] for array in steps))

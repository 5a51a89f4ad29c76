"""Covariances after many rows of turns in one time: pieces that are worked out once and composed.

What a turn and the pause after it do to the covariance is the same wherever they stand in a row;
it depends on the orientation of the table alone, and there are 24.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache, reduce
from typing import Any

import numpy as np

from driftlab.checks import FloatArray, shown
from driftlab.imu import ImuNoise, PriorDeviations
from driftlab.motion.scheme import Scheme, checked_scheme

from ._condensed_steps import Condensed, condensed_steps
from ._table_moves import STARTS, IntArray, Row, TableMoves
from .error_model import ErrorModel
from .linearization import linearize_along


@dataclass(frozen=True)
class RowCovariances:
    """What a table shows in rows of turns that take equally long.

    Attributes
    ----------
    moves : TableMoves
    duration : float
        Of each row with its pauses, s.
    rate : float
        Of the turns, rad/s.
    latitude : float
        rad.
    model : ErrorModel
    noise : ImuNoise
    prior : PriorDeviations
    """

    moves: TableMoves
    duration: float
    rate: float
    latitude: float
    model: ErrorModel
    noise: ImuNoise
    prior: PriorDeviations

    def row(self, scheme: Scheme) -> Row:
        """Start and turns of a scheme, as numbers, if they leave time for pauses."""
        scheme = checked_scheme(scheme)
        start, turns = self.moves.row(scheme)
        if self._pause(scheme.positions, self.moves.quarters[turns].sum()) <= 0:
            raise ValueError(
                f"scheme: expected turns and pauses in {self.duration:g} s, "
                f"got {shown(scheme.rotations)}."
            )
        return start, turns

    def scheme(self, start: int, row: IntArray) -> Scheme:
        """The scheme of a start and turns, in its time."""
        return replace(self.moves.scheme(start, row), rate=self.rate).lasting(self.duration)

    def _pause(self, positions: int, quarters: int) -> float:
        return (self.duration - quarters * np.pi / 2 / self.rate) / positions

    def after(self, rows: Sequence[Row]) -> FloatArray:
        """Covariances (b, size, size) at the end of rows of equally many turns."""
        starts, turns = (np.array(part) for part in zip(*rows, strict=True))
        return self.covariances(starts, turns)

    def covariances(self, starts: IntArray, rows: IntArray) -> FloatArray:
        """Covariances (b, size, size) at the end of rows (b, k), as `covariance_analysis` has."""
        found = np.empty((len(rows), self.model.size, self.model.size))
        orientation, quarters = (
            self.moves.orientations(starts, rows),
            self.moves.quarters[rows].sum(axis=1),
        )
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
            self._kept[dwell] = pause, self._turns.then(_chosen(pause, self.moves.next))
        return self._kept[dwell]

    @cached_property
    def _turns(self) -> Condensed:
        """All turns (24, m, ...) without pauses."""
        # Every turn there and back, from each orientation; the ways there count.
        back = str.maketrans("+-", "-+")
        words = " ".join(f"{word} {word.translate(back)}" for word in self.moves.words)
        schemes = [Scheme(words, names, 1.0, self.rate) for names in STARTS]
        ways = [linearize_along(scheme, self.latitude, self.model) for scheme in schemes]
        row = [steps for part, steps in ways[0].segments if part.rate][::2]
        turns = []
        for steps in row:
            matrices = np.stack([way.transitions[steps] for way in ways])
            lengths = np.tile(ways[0].durations[steps], (len(STARTS), 1))
            each = condensed_steps(matrices, lengths, self.noise)
            parts = (_chosen(each, np.s_[:, i]) for i in range(lengths.shape[1]))
            turns.append(reduce(Condensed.then, parts))
        return Condensed(*(np.stack(arrays, axis=1) for arrays in zip(*turns, strict=True)))


row_covariances = lru_cache(maxsize=4)(RowCovariances)
"""One object for each setting: its pieces are dear, and its settings cannot change."""


def _chosen(steps: Condensed, index: Any) -> Condensed:
    return Condensed(*(array[index] for array in steps))

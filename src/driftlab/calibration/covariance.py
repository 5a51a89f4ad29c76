"""Expected accuracy of rotation schemes: the filter's covariance, without any data.

`covariance_analysis` takes one scheme. `_RowCovariances` takes many rows of turns that last equally
long: what a turn and the pause after it do to the covariance is the same wherever they stand in a
row and depends only on the orientation of the table, of which there are 24. So each piece is worked
out once. _Condensed, it is ``P -> Phi (P^-1 + J)^-1 Phi^T + M``: J is the information that the
velocities of its steps hold on the state before them, Phi carries on what is left unknown, M is
what the noise adds. Two such pieces make one again.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache, reduce
from itertools import permutations, product
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray, checked_instance, positive_number, shown
from driftlab.core import loops
from driftlab.core.quaternion import from_rotation_vector, to_matrix
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.motion.scheme import DIRECTIONS, Scheme, checked_scheme

from .error_dynamics import (
    LinearizedErrors,
    _covariance_before,
    _moving_states,
    _states_of_model,
    checked_linearized,
    checked_noise,
    linearize_along,
)
from .error_model import ErrorModel


def covariance_analysis(
    linearized: LinearizedErrors,
    noise: ImuNoise,
    prior: PriorStandardDeviations,
    update: float = 1.0,
) -> FloatArray:
    """Covariance of the estimation errors at the end of a scheme, without any data.

    Parameters
    ----------
    linearized : LinearizedErrors
        The error equations along the scheme.
    noise : ImuNoise
        Of the sensors and of the reference velocity, with a bias instability as in `calibrate`.
    prior : PriorStandardDeviations
        Standard deviations of the errors before the calibration.
    update : float
        Time between two measurements of the velocity, s.

    Returns
    -------
    ndarray, shape (size, size)
        In the units of the states, squared.

    Raises
    ------
    ValueError
        If `update` or the noise of the velocity is not positive.

    See Also
    --------
    linearize_along : The error equations it needs.
    unobservable_subspace : What no measurement shows.
    design_scheme : A better scheme.

    Notes
    -----
    All measurements within a step are taken as one at its end. With pauses of minutes and a
    velocity known within 1 cm/s the standard deviations of the sensor errors come out about one per
    cent too small, those of the attitude about five, those of the velocity about ten; shorter
    pauses have shorter steps. With 0.1 mm/s or less, scale factors of gyros and the angles of the
    triads' axes come out 2.5 to 4 per cent too large, the level attitude up to a tenth (at
    0.01 mm/s), and the velocity half of what it is or less.

    References
    ----------
    - R. E. Kalman, *A new approach to linear filtering and prediction problems*, Journal of Basic
      Engineering 82(1), 1960.

    Examples
    --------
    How well the scheme of 19 positions finds the scale factor of a gyro, in ppm:

    >>> from driftlab.calibration import ERROR_MODELS, linearize_along
    >>> from driftlab.motion.scheme import NINETEEN_POSITIONS
    >>> linearized = linearize_along(NINETEEN_POSITIONS, 0.7, ERROR_MODELS["averaged"])
    >>> variances = np.diag(covariance_analysis(linearized, ImuNoise(), PriorStandardDeviations()))
    >>> round(1e6 * float(np.sqrt(variances[linearized.model.names.index("gyro scale x")])), 2)
    3.55
    """
    return _covariances(linearized, noise, prior, update)[0]


def standard_deviation_history(
    linearized: LinearizedErrors,
    noise: ImuNoise,
    prior: PriorStandardDeviations,
    update: float = 1.0,
) -> FloatArray:
    """Standard deviations of the estimation errors all along a scheme, without any data.

    Parameters
    ----------
    linearized, noise, prior, update : LinearizedErrors, ImuNoise, PriorStandardDeviations, float
        As for `covariance_analysis`, which has the covariance at the end; s steps.

    Returns
    -------
    ndarray, shape (s + 1, size)
        Before the first step and after each one, in the units of the states.

    Examples
    --------
    Three quarter turns about y tell the scale factor of the gyro y, and nothing of that of the
    gyro x. In ppm, before the turns and after them:

    >>> from driftlab.calibration import ERROR_MODELS, linearize_along
    >>> from driftlab.motion.scheme import Scheme
    >>> turns = Scheme("+90Y +90Y +90Y", ("Up", "East", "North"))
    >>> linearized = linearize_along(turns, 0.7, ERROR_MODELS["averaged"])
    >>> history = standard_deviation_history(linearized, ImuNoise(), PriorStandardDeviations())
    >>> scales = [linearized.model.names.index(f"gyro scale {axis}") for axis in "xy"]
    >>> (1e6 * history[[0, -1]][:, scales]).round()
    array([[100., 100.],
           [100.,   7.]])
    """
    _, variances = _covariances(linearized, noise, prior, update)
    # What is measured almost exactly has a variance of the size of the rounding, of either sign.
    return np.sqrt(np.maximum(variances, 0.0))


def _covariances(
    linearized: LinearizedErrors, noise: ImuNoise, prior: PriorStandardDeviations, update: float
) -> tuple[FloatArray, FloatArray]:
    """Covariance (size, size) after s steps; variances (s + 1, size) before and after each."""
    checked_linearized(linearized)
    checked_noise(noise)
    seconds = positive_number(update, "update")
    checked_instance(prior, PriorStandardDeviations, "prior")
    model = linearized.model
    start = _covariance_before(model, prior, noise, linearized.start)
    rows, added = _moving_states(model, noise, linearized.transitions, linearized.durations)
    observed = np.eye(3, len(start), 3)  # the velocity
    variances = noise.reference_velocity**2 * seconds / linearized.durations
    spreads = variances[:, np.newaxis, np.newaxis] * np.eye(3)
    found, variances = loops.covariances(start, rows, added, observed, spreads)
    own = _states_of_model(model, noise)
    return found[np.ix_(own, own)], np.vstack([start.diagonal(), variances])[:, own]


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
class _TableMoves:
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


class _Condensed(NamedTuple):
    """Steps, condensed; only the first k states change and gain noise, see `_moving_states`."""

    carried: FloatArray  # (..., k, n): rows of Phi for these
    information: FloatArray  # (..., n, n): J
    added: FloatArray  # (..., k, k): M

    def after(self, covariance: FloatArray) -> FloatArray:
        """Covariances (..., n, n) after the steps, from those before them."""
        moving, size = self.carried.shape[-2:]
        left = np.linalg.solve(np.eye(size) + covariance @ self.information, covariance)
        rows = self.carried @ left
        found = np.array(left, np.float64)
        found[..., :moving, :] = rows
        found[..., :, :moving] = np.swapaxes(rows, -1, -2)
        found[..., :moving, :moving] = rows @ np.swapaxes(self.carried, -1, -2) + self.added
        found += np.swapaxes(found, -1, -2)
        found *= 0.5
        return found

    def then(self, later: _Condensed) -> _Condensed:
        """These steps and later ones as one."""
        count = self.carried.shape[-2]
        moving = slice(count)
        # What these steps add is looked at by the later ones.
        inner = np.eye(count) + self.added @ later.information[..., moving, moving]
        known = np.linalg.solve(inner, self.added)
        columns = later.information[..., moving]
        information = later.information - columns @ known @ np.swapaxes(columns, -1, -2)
        shrunk = later.carried - later.carried[..., moving] @ known @ np.swapaxes(columns, -1, -2)
        first = later.carried[..., moving]
        added = first @ known @ np.swapaxes(first, -1, -2)
        back = _through(np.swapaxes(information, -1, -2), self.carried)
        return _Condensed(
            _through(shrunk, self.carried),
            self.information + _through(np.swapaxes(back, -1, -2), self.carried),
            later.added + added,
        )

    def times(self, count: int) -> _Condensed:
        """The same steps `count` times, one after the other."""
        if count == 1:
            return self
        half = self.times(count // 2)
        twice = half.then(half)
        return twice.then(self) if count % 2 else twice


def _through(matrix: FloatArray, carried: FloatArray) -> FloatArray:
    """The product of a matrix (..., m, n) and Phi."""
    moving = carried.shape[-2]
    found = matrix[..., :moving] @ carried
    found[..., moving:] += matrix[..., moving:]
    return found


def _condensed_steps(
    model: ErrorModel,
    transitions: FloatArray,
    durations: FloatArray,
    noise: ImuNoise,
    update: float = 1.0,
) -> _Condensed:
    """Return steps (...) in which errors grow, noise is added and the velocity is measured.

    The velocity is measured every `update` seconds; the measurements of a step of the given
    duration, s, count as one at its end.
    """
    carried, added = _moving_states(model, noise, transitions, durations)
    moving, size = carried.shape[-2:]
    look = np.zeros((*durations.shape, size, size))
    growth = _Condensed(carried, np.zeros_like(look), added)
    weight = durations / (noise.reference_velocity**2 * update)
    look[..., [3, 4, 5], [3, 4, 5]] = weight[..., np.newaxis]
    unit = np.broadcast_to(np.eye(moving, size), carried.shape)
    return growth.then(_Condensed(unit, look, np.zeros_like(growth.added)))


@dataclass(frozen=True)
class _RowCovariances:
    """What a table shows in rows of turns that take equally long."""

    moves: _TableMoves
    duration: float  # of each row with its pauses, s
    rate: float  # of the turns, rad/s
    latitude: float  # rad
    model: ErrorModel
    noise: ImuNoise
    prior: PriorStandardDeviations

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
        return replace(self.moves.scheme(start, row), rate=self.rate).with_duration(self.duration)

    def _pause(self, positions: int, quarters: int) -> float:
        return (self.duration - quarters * np.pi / 2 / self.rate) / positions

    def after(self, rows: Sequence[Row]) -> FloatArray:
        """Covariances (b, size, size) at the end of rows of equally many turns."""
        starts, turns = (np.array(part) for part in zip(*rows, strict=True))
        return self.covariances(starts, turns)

    def covariances(self, starts: IntArray, rows: IntArray) -> FloatArray:
        """Covariances (b, size, size) at the end of rows (b, k), as `covariance_analysis` has."""
        found = np.empty((len(rows), self.model.size, self.model.size))
        own = _states_of_model(self.model, self.noise)
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
            found[these] = covariance[:, own[:, np.newaxis], own]
        return found

    @cached_property
    def _before(self) -> FloatArray:
        attitudes = [Scheme("", names).start_attitude for names in STARTS]
        settings = self.model, self.prior, self.noise
        return np.array([_covariance_before(*settings, attitude) for attitude in attitudes])

    @cached_property
    def _kept(self) -> dict[float, tuple[_Condensed, _Condensed]]:
        return {}

    def _pieces(self, positions: int, quarters: int) -> tuple[_Condensed, _Condensed]:
        """Pauses (24, ...), and turns with a pause (24, m, ...), in rows that turn so far."""
        dwell = self._pause(positions, quarters)
        if dwell not in self._kept:
            ways = [
                linearize_along(Scheme("", s, dwell), self.latitude, self.model) for s in STARTS
            ]
            step = np.stack([way.transitions[0] for way in ways])
            times = np.full(len(STARTS), ways[0].durations[0])
            pause = _condensed_steps(self.model, step, times, self.noise).times(
                len(ways[0].durations)
            )
            self._kept[dwell] = pause, self._turns.then(_chosen(pause, self.moves.next))
        return self._kept[dwell]

    @cached_property
    def _turns(self) -> _Condensed:
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
            each = _condensed_steps(self.model, matrices, lengths, self.noise)
            parts = (_chosen(each, np.s_[:, i]) for i in range(lengths.shape[1]))
            turns.append(reduce(_Condensed.then, parts))
        return _Condensed(*(np.stack(arrays, axis=1) for arrays in zip(*turns, strict=True)))


_row_covariances = lru_cache(maxsize=4)(_RowCovariances)
"""One object for each setting: its pieces are dear, and its settings cannot change."""


def _chosen(steps: _Condensed, index: Any) -> _Condensed:
    return _Condensed(*(array[index] for array in steps))

"""What may have gone wrong in a calibration: asked by name, never run on its own.

Every slip is undone and tried: each unit, order and sign by gravity and the Earth's rate, which is
cheap. Those few that fit then go through the filter, over sums of neighbouring increments and with
a look at every tenth second only, so that each costs a fraction of a second; the steps are such
that a right record passes. A slip is named if nothing contradicts the record without it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import permutations, product
from typing import NamedTuple

import numpy as np
from scipy.constants import degree
from scipy.optimize import minimize_scalar

from driftlab.calibration._filter_inputs import (
    FITS,
    Evidence,
    FilterInputs,
    assumed_noise_contradictions,
    evidence,
    thinned,
)
from driftlab.calibration.calibration_history import BEYOND, Calibration
from driftlab.calibration.filter import LARGE_BIAS, TAKE_THE_MEAN, FilterFailure, calibrate
from driftlab.checks import FloatArray, shown
from driftlab.core import quaternion
from driftlab.earth import gravity
from driftlab.increments import Increments
from driftlab.recordings._slips import force_factors, gyro_factors
from driftlab.recordings.guards import data_problems
from driftlab.recordings.recording import Recording

_LOOSE = 5 * degree  # how far the start may be off where a slip is looked for in it, rad
_TURN = 0.02  # increments are added up to turns of about this, rad
_COARSE = 10.0  # interval of the updates, s,
_MOST = 250  # and about their number at most
_LADDER = (3e-3, 0.1), (3e-4, 0.1), (0.0, 0.02)
"""Least noise of the reference velocity, m/s, and longest time, s, to which increments are added
up: a turn that begins in the midst of 0.1 s makes errors of some 1e-5 m/s."""
_SMALL = 2e-3  # latitudes this far apart make innovations that differ by a multiple of it, rad
_NEAR = 1.5  # slips that leave not so many times the misfit of the best may be it as well
_RIGHT = 1.0
"""Misfit of a right record, or less: of slips that leave no more, the innovations have to tell."""
_TRIED = 8  # slips that go through the filter,
_TRIED_WITH_MORE = 3  # and through a filter with more states
_MORE = "lever arms", "time skew"  # states of errors that turns show, and that a model may lack
_LACKING = "errors that the model does not have, such as lever arms or a time skew"
_SIZE = 0.1  # specific force of this much more or less than gravity may still have the right unit
_NO_FORCE = 1e-12  # as a part of gravity: no interval explains less
_GRAVITY_A_METRE = 3.1e-7  # share of gravity that a metre of height takes away
_NEAREST_TO_POLE = float(np.radians(89.9))
_RULES = ("force", "rate", "half turn", "turning", "axes")
_UNIT, _LIKELY, _POSSIBLE, _FITTED = range(4)
"""Ranks of slips: of units; that often happen; others; whose size is fitted to the record."""
_UP = np.array([0.0, 0.0, 1.0])
_FRAMES = {
    "North, East, Down": np.array([1.0, 1.0, 0.0, 0.0]) / np.sqrt(2),
    "North, Up, East": np.array([0.5, 0.5, 0.5, 0.5]),
}
"""Other local axes, as quaternions from them to East, North, Up."""


class Diagnosis(NamedTuple):
    """What contradicts a calibration's arguments, and what may explain it; prints as sentences.

    Attributes
    ----------
    contradictions : tuple of str
        What was expected and what came instead; none if nothing contradicts the arguments.
    noise : tuple of str
        How the noise of the sensors differs from the one assumed: this is certain.
    slips : tuple of str
        Mistakes without any one of which the record fits, likely ones first.
    advice : str
        What to do if neither explains it.

    Examples
    --------
    >>> print(Diagnosis(("expected A, got B",), (), ("start: scalar first", "axes: swapped"), ""))
    expected A, got B: start: scalar first; or axes: swapped?
    """

    contradictions: tuple[str, ...]
    noise: tuple[str, ...] = ()
    slips: tuple[str, ...] = ()
    advice: str = ""

    def __str__(self) -> str:
        if not self.contradictions:
            return "Nothing contradicts what the filter was told."
        said = ". Besides, ".join(self.contradictions)
        causes = [*self.noise, *(["; or ".join(self.slips)] if self.slips else [])]
        if causes:
            return f"{said}: {'; and '.join(causes)}?"
        return f"{said}; {self.advice}." if self.advice else f"{said}."


def diagnose(found: Calibration | FilterFailure) -> Diagnosis:
    """Look for what explains a calibration that contradicts its arguments.

    Parameters
    ----------
    found : Calibration or FilterFailure
        What `driftlab.calibration.calibrate` returned, or the error it raised.

    Returns
    -------
    Diagnosis
        Of the run that is contradicted most.

    Raises
    ------
    ValueError
        If `found` does not have the arguments of the filter, as after ``check=False``.

    See Also
    --------
    driftlab.calibration.calibrate : The filter, which warns of contradictions.
    driftlab.calibration.innovation_test : Whether there are any.

    Notes
    -----
    Other units, orders and signs of axes, starts, latitudes and intervals are compared with gravity
    and the Earth's rate, which is fast. The few that fit go through the filter again, so this may
    take several times as long as the calibration. A mistake is named if nothing contradicts the
    record without it.

    "axes of the gyros alone: y, z, x would be right" means that the column now called y holds the
    gyro of axis x, and so on: use ``angle[:, [1, 2, 0]]`` instead of ``angle``, with a minus where
    the answer has one. For accelerometers the same holds of ``velocity``, for the log of both.

    Examples
    --------
    Rates in rad/s, where the filter expects increments in rad:

    >>> import warnings
    >>> from driftlab.calibration import calibrate
    >>> from driftlab.imu import TYPICAL_ERRORS, ImuNoise, PriorStandardDeviations
    >>> from driftlab.increments import measure
    >>> from driftlab.motion import Scheme, turntable_trajectory
    >>> true = turntable_trajectory(Scheme("+90Y +90Z", dwell=60.0), latitude=0.7, interval=0.5)
    >>> log = measure(true.increments, TYPICAL_ERRORS)
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("ignore")
    ...     found = calibrate(
    ...         log._replace(angle=log.mean_rate), latitude=0.7, start=true.attitude[0],
    ...         model="averaged", prior=PriorStandardDeviations(), noise=ImuNoise(),
    ...     )
    >>> diagnose(found).slips
    ('gyros: rates taken for increments',)
    """
    inputs = getattr(found, "inputs", None)
    if not isinstance(inputs, FilterInputs):
        raise ValueError(
            "found: expected what calibrate returned or the error it raised, without check=False, "
            f"got {shown(found)}."
        )
    if (seen := inputs.impossible()) is not None:
        one = inputs.run(seen[0])
        slips = _likely_slips(_Judge(one))
        return _explained(
            seen[1:], [] if slips else assumed_noise_contradictions(one)[0], slips, one
        )
    if not isinstance(found, Calibration):
        return Diagnosis((str(found).rstrip("."),), advice=TAKE_THE_MEAN)
    run, said = found._contradictions(inputs)
    one = inputs.run(run)
    noise, right = assumed_noise_contradictions(one)
    slips = []
    if said:
        judge = _Judge(one._replace(noise=right))
        # With the noise that it has, the record may be right.
        if not noise or judge.steps is not None:
            slips = _likely_slips(judge)
    elif noise:
        said = ["expected noise as assumed, got another"]
    more = found._too_large() if inputs.first and not slips and not noise else []
    if more and not said:
        return Diagnosis(tuple(more))
    return _explained([*said, *more], noise, slips, one)


def _explained(
    said: Sequence[str], noise: list[str], slips: list[str], inputs: FilterInputs
) -> Diagnosis:
    """A diagnosis, with advice if nothing explains what is said."""
    advice = ""
    if said and not (noise or slips):
        advice = "no slip is known that explains it. "
        if inputs.prior.gyro_bias > LARGE_BIAS:
            advice += TAKE_THE_MEAN
        else:
            advice += (
                "Are the errors larger than the prior says? Then a larger prior, and a second pass "
                "with this result as linearization_point"
            )
    plain = [tuple(part.rstrip(".?") for part in parts) for parts in (said, noise, slips)]
    return Diagnosis(plain[0], plain[1], plain[2], advice)


class _Slip(NamedTuple):
    """A slip, what would have been told without it, and how badly that fits."""

    rank: int
    """Of slips that fit as well, those of lower rank are likelier."""
    name: str
    inputs: FilterInputs
    misfit: float
    loose: bool = False
    """Whether the start is a guess, within some degrees."""


@dataclass(frozen=True)
class _Judge:
    """Runs the filter over what else may have been told, and looks at what it finds."""

    inputs: FilterInputs

    def accepts(self, other: FilterInputs, loose: bool = False) -> FloatArray | None:
        """The start (4,) that is found, if nothing contradicts what is told now."""
        if self.steps is None:
            return None
        rows, found = self._run(other, *self.steps, loose)
        if found is None or not _right(found, other):
            return None
        return found._linearization_point(rows, other.latitude)[1]

    def latitude(self, other: FilterInputs) -> tuple[float, float]:
        """The latitude that fits best, near one, and its deviation, rad: the innovations are linear
        in a small error of it."""
        none, latitude = (other.latitude, np.inf), other.latitude
        if self.steps is None:
            return none
        near = other._replace(latitude=latitude + _SMALL * (-1 if latitude > 0 else 1))
        here, there = (self._run(each, *self.steps)[1] for each in (other, near))
        if here is None or there is None:
            return none
        slope = (there.innovations - here.innovations) / (near.latitude - latitude)
        square = float(np.sum(slope**2))
        if not 0 < square < np.inf:
            return none
        step = -float(np.sum(slope * here.innovations)) / square
        return latitude + float(np.clip(step, -0.1, 0.1)), 1 / np.sqrt(square)

    @cached_property
    def steps(self) -> tuple[float, float] | None:
        """Noise of the reference velocity, m/s, and time to which increments are added up, s: the
        coarsest with which what was told is contradicted."""
        for least, longest in _LADDER:
            each = max(self.inputs.noise.reference_velocity, least), longest
            found = self._run(self.inputs, *each)[1]
            if found is None or not _right(found, self.inputs):
                return each
        return None

    def _run(
        self, other: FilterInputs, deviation: float, longest: float, loose: bool = False
    ) -> tuple[Increments, Calibration | None]:
        """Increments and what the filter finds with them; a start that is a guess takes two
        passes."""
        rows = thinned(other.increments, _TURN, longest)
        # The same moments, whatever the interval is now.
        count = len(other.ends)
        seconds = float(other.ends[-1] * self.inputs.increments.interval)
        skip = max(round(max(_COARSE, seconds / _MOST) * count / seconds), 1)
        ends, pair = other.ends[skip - 1 :: skip] * other.increments.interval, 2 * rows.interval
        places = np.round(ends / pair).astype(int)
        kept = np.flatnonzero(np.diff(places, prepend=0) > 0)
        kept = kept[places[kept] <= len(rows.angle) // 2]
        if len(kept) == 0:
            return rows, None
        rows = rows.part(0, 2 * int(places[kept][-1]))
        prior = replace(other.prior, attitude=max(other.prior.attitude, _LOOSE * loose))
        noise = replace(other.noise, reference_velocity=deviation)
        reference, found = other.reference[skip - 1 :: skip][kept], None
        try:
            with np.errstate(all="ignore"):
                for _ in range(1 + loose):
                    found = calibrate(
                        rows, reference, reference_times=places[kept] * pair,
                        latitude=other.latitude, start=other.start, model=other.model,
                        prior=prior, noise=noise, keep=count, linearization_point=found,
                        check=False,
                    )  # fmt: skip
        except (ValueError, np.linalg.LinAlgError):
            return rows, None
        return rows, found


def _right(found: Calibration, inputs: FilterInputs) -> bool:
    """Whether nothing speaks against a result."""
    return bool(np.isfinite(found.innovations).all()) and not found._contradictions(inputs)[1]


def _likely_slips(judge: _Judge) -> list[str]:
    """Slips without which the record fits, best first, or else what `data_problems` has to say."""
    inputs = judge.inputs
    units = list(_other_units(inputs))
    names = _named(units, judge)
    if names:
        return names
    tried = [*units, *_others(judge)]
    names = _named(tried, judge)
    larger = inputs.model.with_states(*_MORE)
    if not names and larger is not inputs.model:
        lacking = f"{_LACKING}: model.with_states{_MORE} has states for them"
        with_more = _Judge(inputs._replace(model=larger))
        if with_more.steps is None:
            return [lacking]
        again = [slip._replace(inputs=slip.inputs._replace(model=larger)) for slip in tried]
        names = [f"{name}, and {lacking}" for name in _named(again, with_more, _TRIED_WITH_MORE)]
        if not names and judge.accepts(with_more.inputs) is not None:
            names = [lacking]
    if names:
        return names
    interval, angle, velocity = inputs.increments
    log = Recording(angle, velocity, interval, "increments")
    return [doubt.sentence for doubt in data_problems(log) if doubt.rule in _RULES]


def _named(slips: list[_Slip], judge: _Judge, most: int = _TRIED) -> list[str]:
    """Names of those slips that the judge accepts, likely ones first."""
    fitting: list[_Slip] = []
    for slip in sorted(slips, key=lambda slip: slip.misfit)[:most]:
        if slip.misfit > (max(_NEAR * fitting[0].misfit, _RIGHT) if fitting else FITS):
            break
        if slip.loose and any(other.loose for other in fitting):
            continue  # two guesses of one start
        start = judge.accepts(slip.inputs, slip.loose)
        if start is None:
            continue
        if slip.loose:
            back = quaternion.multiply(judge.inputs.start, quaternion.conjugate(start))
            turn = quaternion.to_rotation_vector(back)
            if np.linalg.norm(turn) < BEYOND * judge.inputs.prior.attitude:
                continue
            slip = slip._replace(name=_turned(np.degrees(turn)))
        fitting.append(slip)
    fitting.sort(key=lambda slip: slip.rank)
    # What was fitted to the record is no news beside a likely slip.
    if fitting and fitting[0].rank <= _LIKELY:
        fitting = [slip for slip in fitting if slip.rank < _FITTED]
    return list(dict.fromkeys(slip.name for slip in fitting))


def _turned(turn: FloatArray) -> str:
    """Words for a start that the filter moved by a rotation vector in degrees."""
    if np.linalg.norm(turn[:2]) < 0.1 * abs(turn[2]):
        return f"start: a heading wrong by {abs(turn[2]):.3g} degrees"
    return f"start: an attitude wrong by {np.linalg.norm(turn):.3g} degrees"


def _other_units(inputs: FilterInputs) -> Iterator[_Slip]:
    """Other units, another interval, and the triads exchanged."""
    for name, increments in _rescaled(inputs):
        other = inputs._replace(increments=increments)
        yield _Slip(_UNIT, name, other, float(other.misfit(evidence(increments))))


def _rescaled(inputs: FilterInputs) -> Iterator[tuple[str, Increments]]:
    """What the increments may have been meant to be."""
    interval, angle, velocity = inputs.increments
    size = float(gravity(inputs.latitude))
    ratio = float(np.median(np.linalg.norm(velocity, axis=1))) / (interval * size)
    forces = {
        name: factor
        for name, factor in ({"": 1.0} | force_factors("increments", interval)).items()
        if abs(ratio / factor - 1) < _SIZE and "interval" not in name
    }
    gyros = {"": 1.0} | gyro_factors("increments", interval)
    for (force, b), (gyro, a) in product(forces.items(), gyros.items()):
        pairs = (("gyros", gyro), ("accelerometers", force))
        words = [f"{triad}: {name}" for triad, name in pairs if name]
        if words and "interval" not in gyro and max(a, 1 / a, b, 1 / b) > 1 + _SIZE:
            yield " and ".join(words), Increments(interval, angle / a, velocity / b)
    # Biases push up in one position and down in another.
    if abs(ratio - 1) > max(BEYOND * inputs.prior.scale_factor, 1e-4) and ratio > _NO_FORCE:
        name = _interval_slip(interval, ratio)
        yield name, Increments(ratio * interval, angle, velocity)
    if ratio < _SIZE or ratio > 1 / _SIZE:
        yield "gyros and accelerometers exchanged", Increments(interval, velocity, angle)


def _interval_slip(interval: float, ratio: float) -> str:
    """Words for an interval that gravity contradicts."""
    for power, name in ((-3, "milliseconds"), (-6, "microseconds")):
        if abs(ratio / 10.0**power - 1) < _SIZE:
            return f"interval: {name} taken for seconds"
    words = f"interval: {ratio * interval:.4g} s instead of {interval:.4g} s, by gravity"
    height = (1 - ratio) / _GRAVITY_A_METRE
    if 0 < height < 9000:
        return f"{words}, or a place {height:.0f} m high"
    return f"{words}, or accelerometers with that error of scale"


def _others(judge: _Judge) -> Iterator[_Slip]:
    """Slips of start, place and axes, and what would have been told without each."""
    inputs = judge.inputs
    shown = evidence(inputs.increments)
    if shown is None:
        return
    for name, start in _other_starts(inputs.start):
        other = inputs._replace(start=start)
        yield _Slip(_LIKELY, name, other, float(other.misfit(shown)))
    for level in (inputs.start, _levelled(inputs.start, shown)):
        other = inputs._replace(start=_headed(inputs._replace(start=level), shown))
        yield _Slip(_FITTED, "start: wrong", other, float(other.misfit(shown)), loose=True)
    for rank, name, latitude in _other_latitudes(judge, shown):
        if abs(latitude) < _NEAREST_TO_POLE:
            other = inputs._replace(latitude=latitude)
            yield _Slip(rank, name, other, float(other.misfit(shown)))
    yield from _other_axes(inputs)


def _other_starts(start: FloatArray) -> Iterator[tuple[str, FloatArray]]:
    """Other meanings of four numbers; those that come to the same together."""
    rolled = np.roll(start, -1)
    meanings = {
        "scalar first": rolled,
        "from East, North, Up to the body": quaternion.conjugate(start),
        "scalar first, and from East, North, Up to the body": quaternion.conjugate(rolled),
    } | {f"body to {name}": quaternion.multiply(turn, start) for name, turn in _FRAMES.items()}
    known: list[tuple[list[str], FloatArray]] = [([], start)]
    for name, other in meanings.items():
        for names, one in known:
            if abs(float(one @ other)) > 1 - 1e-6:
                names.append(name)
                break
        else:
            known.append(([name], other))
    for names, other in known[1:]:
        yield f"start: {', or '.join(names)}", other


def _levelled(start: FloatArray, shown: Evidence) -> FloatArray:
    """The start, turned so that the force of the first window points up."""
    force = quaternion.rotate(start, shown.force[0])
    axis = np.cross(force, _UP)
    across = float(np.linalg.norm(axis))
    turn = float(np.arctan2(across, force[2])) / max(across, 1e-12) * axis
    return quaternion.multiply(quaternion.from_rotation_vector(turn), start)


def _headed(inputs: FilterInputs, shown: Evidence) -> FloatArray:
    """The start with the heading that fits best."""
    angles = np.radians(np.arange(-178, 181, 2))[:, np.newaxis]
    starts = quaternion.multiply(quaternion.from_rotation_vector(angles * _UP), inputs.start)
    every = inputs._replace(start=starts[:, np.newaxis])
    return starts[np.argmin(every.misfit(shown))]


def _other_latitudes(judge: _Judge, shown: Evidence) -> Iterator[tuple[int, str, float]]:
    """Other latitudes, rad, with rank and name."""
    inputs = judge.inputs

    def size(latitude: float) -> float:
        return float(inputs._replace(latitude=latitude).misfit(shown))

    near = min(np.arange(-88, 89) * degree, key=size)
    nearest = float(minimize_scalar(size, bounds=(near - degree, near + degree)).x)
    yield _LIKELY, "latitude: the other sign", -inputs.latitude
    yield _LIKELY, "latitude: degrees turned into radians twice", float(np.degrees(inputs.latitude))
    yield _LIKELY, "latitude: degrees taken for radians", float(np.radians(inputs.latitude))
    if size(nearest) < FITS:
        latitude, deviation = judge.latitude(inputs._replace(latitude=nearest))
        if abs(latitude - inputs.latitude) > BEYOND * deviation:
            yield _FITTED, f"latitude: {np.degrees(latitude):.2f} degrees fits better", latitude


def _named_orders() -> Iterator[tuple[str, FloatArray]]:
    """Signed permutations but the identity."""
    for order in permutations(range(3)):
        for signs in product((1.0, -1.0), repeat=3):
            matrix = np.eye(3)[list(order)] * np.array(signs)[:, np.newaxis]
            words = ", ".join(
                f"{'-' * (sign < 0)}{'xyz'[axis]}" for sign, axis in zip(signs, order, strict=True)
            )
            if words == "x, y, z":
                continue
            hint = "" if np.linalg.det(matrix) > 0 else " (left-handed)"
            if words == "x, -y, -z":
                hint = " (forward, right, down taken for forward, left, up)"
            yield f"{words} would be right{hint}", matrix


_ORDERS = list(_named_orders())
_SETS = [
    (f"axes of {kind}: {name}", gyros, accelerometers)
    for kind, both in (("the log", 3), ("the gyros alone", 1), ("the accelerometers alone", 2))
    for name, matrix in _ORDERS
    for gyros, accelerometers in [[matrix if both & bit else np.eye(3) for bit in (1, 2)]]
]
"""Names, and matrices for gyros and accelerometers: of both triads, or of one."""


def _other_axes(inputs: FilterInputs) -> Iterator[_Slip]:
    """Orders and signs of the columns that fit."""
    interval, angle, velocity = thinned(inputs.increments)
    gyros, accelerometers = (np.array([each[k] for each in _SETS]).mT for k in (1, 2))
    seen = evidence(Increments(interval, angle @ gyros, velocity @ accelerometers))
    if seen is None:
        return
    sizes = inputs.misfit(seen)
    interval, angle, velocity = inputs.increments
    for (name, turn, push), size in zip(_SETS, sizes, strict=True):
        if size <= FITS:
            likely = "forward" in name or "alone" in name
            rows = Increments(interval, angle @ turn.T, velocity @ push.T)
            rank = _LIKELY if likely else _POSSIBLE
            yield _Slip(rank, name, inputs._replace(increments=rows), float(size))

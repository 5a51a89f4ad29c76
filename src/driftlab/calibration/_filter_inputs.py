"""What a filter is told, and what a record contradicts of it before any filter runs.

Gravity, carried by the gyros into axes that do not turn, must stay on the cone on which the Earth
carries Up; in pauses the gyros must show the Earth's rate, and no more noise than told.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.constants import degree, hour
from scipy.special import chdtri

from driftlab.checks import FloatArray
from driftlab.core import quaternion
from driftlab.core.carried_gravity import carried_velocity, cone_velocity
from driftlab.core.loops import attitudes
from driftlab.earth import EARTH_RATE, earth_rate, gravity
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.increments import Increments
from driftlab.strapdown import ALGORITHM

from .error_model import ErrorModel

FITS = 6.0
"""Misfit that may still be a right record's."""
_STEP = 0.1  # increments are added up to steps of about this, rad
_WINDOWS = 100
_REST = 2e-3
"""A window in which the body turns faster is no rest, rad/s; nor is one whose quarters differ"""
_NOISE = 3.0  # by more than so many times what they differ by in the quietest tenth of such windows
_STILL = 0.02 * EARTH_RATE  # and by more than this, rad/s
_FEWEST = 0.1
"""If fewer of the windows look like rests, none is taken for one: they may be ends of turns."""
_TRUSTED = 0.75
"""Share of the rests that count, those that fit best: one may yet end as a turn begins."""
_LEAST_ANGLE = 3e-4
_LEAST_RATE = 0.1 * degree / hour
"""Of gravity's direction, rad, and of rates at rest, rad/s, nobody should ask for more here."""
_EAST_NORTH_UP = [2, 0, 1]  # places of East, North, Up among North, Up, East


class Evidence(NamedTuple):
    """Means over k windows of a record, or of several along leading axes."""

    window: float
    """s"""
    elapsed: FloatArray
    """Ends (k + 1,) of the windows, s"""
    force: FloatArray
    """Mean specific force (..., k, 3), m/s^2, and"""
    rate: FloatArray
    """mean rate (..., k, 3), rad/s, both in the axes in which the body stood at the start"""
    rest: NDArray[np.bool_]
    """Whether (..., k) the body rests"""
    way: FloatArray
    """Angle (..., k) that the body has turned by so far, rad"""

    def misfit(self, inputs: FilterInputs) -> FloatArray:
        """Contradictions (...) of gravity or the Earth's rate, in units of what is expected."""
        start, latitude, prior, noise = inputs.start, inputs.latitude, inputs.prior, inputs.noise
        sway = float(np.abs(inputs.reference).max())
        size = float(gravity(latitude))
        cone = cone_velocity(np.asarray(latitude), self.elapsed)[:, _EAST_NORTH_UP]
        up = np.diff(cone, axis=0) / self.window
        off = quaternion.rotate(start, self.force) / size - up
        middle = (self.elapsed[1:] + self.elapsed[:-1]) / 2
        gyro_bias = prior.gyro_bias**2 + noise.gyro_bias_instability**2
        bent = prior.scale_factor**2 + 2 * prior.installation**2
        variance = (
            _LEAST_ANGLE**2
            + prior.attitude**2
            + gyro_bias * middle**2
            + noise.angle_random_walk**2 * middle
            + bent * (1 + self.way * (1 + self.way) / 2)
            + (prior.accelerometer_bias**2 + noise.accelerometer_bias_instability**2) / size**2
            + (noise.velocity_random_walk / size) ** 2 / self.window
            + (2 * sway / (self.window * size)) ** 2
        )
        force = np.mean(np.sum(off**2, axis=-1) / variance, axis=-1)
        wrong = quaternion.rotate(start, self.rate) - earth_rate(latitude)
        least = (
            _LEAST_RATE**2
            + gyro_bias
            + noise.angle_random_walk**2 / self.window
            + EARTH_RATE**2 * (prior.attitude**2 + bent)
        )
        squares = np.sum(wrong**2, axis=-1)
        rests = np.broadcast_to(self.rest, squares.shape)
        ordered = np.cumsum(np.sort(np.where(rests, squares, np.inf), axis=-1), axis=-1)
        count = np.ceil(_TRUSTED * rests.sum(axis=-1, keepdims=True)).astype(int)
        summed = np.take_along_axis(ordered, np.maximum(count - 1, 0), axis=-1)[..., 0]
        rate = np.where(rests.any(axis=-1), summed / np.maximum(count[..., 0], 1), 0.0) / least
        return np.sqrt(np.maximum(force, rate))


class FilterInputs(NamedTuple):
    """Arguments of a calibration, checked: of several runs, or of one."""

    increments: Increments
    start: FloatArray
    latitude: float
    model: ErrorModel
    prior: PriorStandardDeviations
    noise: ImuNoise
    reference: FloatArray
    """Velocities (..., k, 3) of the table, m/s,"""
    ends: NDArray[Any]
    """and when (k,), as numbers of increments"""
    first: bool = True
    """Whether it is the first pass over the record"""

    def __repr__(self) -> str:
        return f"<arguments of a calibration of {self.reference.shape[-2]} updates>"

    @property
    def lead(self) -> tuple[int, ...]:
        """Leading axes of the runs."""
        rows = self.increments.angle, self.increments.velocity, self.reference
        return np.broadcast_shapes(*(row.shape[:-2] for row in rows), self.start.shape[:-1])

    def copied(self) -> FilterInputs:
        """The same with arrays of its own."""
        interval, angle, velocity = self.increments
        return self._replace(
            increments=Increments(interval, np.array(angle), np.array(velocity)),
            start=np.array(self.start),
            reference=np.array(self.reference),
        )

    def run(self, number: int) -> FilterInputs:
        """What one run was told."""

        def own(rows: FloatArray, core: int) -> FloatArray:
            shape = rows.shape[rows.ndim - core :]
            return np.broadcast_to(rows, (*self.lead, *shape)).reshape(-1, *shape)[number]

        interval, angle, velocity = self.increments
        return self._replace(
            increments=Increments(interval, own(angle, 2), own(velocity, 2)),
            start=own(self.start, 1),
            reference=own(self.reference, 2),
        )

    def misfit(self, shown: Evidence | None) -> FloatArray:
        """How badly evidence fits what one run was told; infinite where there is none."""
        if shown is None:
            return np.array(np.inf)
        return shown.misfit(self)

    def impossible(self) -> tuple[int, str] | None:
        """The first run (its number) that gravity or the Earth's rate contradict, and why."""
        for number in range(int(np.prod(self.lead))):
            one = self.run(number)
            size = float(one.misfit(evidence(one.increments)))
            if size > FITS:
                return number, (
                    "expected gravity and the Earth's rate to be where start, latitude and "
                    f"increments have them within {FITS:g} deviations, got {size:.3g}"
                )
        return None


def evidence(increments: Increments) -> Evidence | None:
    """Means over about a hundred windows; None if the body turns too far in one interval.

    Several records (..., n, 3) may be those of one body in other axes.
    """
    interval, angle, velocity = thinned(increments)
    count = angle.shape[-2]
    if float(np.abs(angle).max()) > np.pi / 2 or count < 4:
        return None
    pairs = count // 2
    each = max(pairs // _WINDOWS, 1)
    places = np.arange(0, pairs + 1, each)
    window, used = 2 * each * interval, 2 * int(places[-1])
    angle, velocity = angle[..., :used, :], velocity[..., :used, :]
    _, carried = carried_velocity(ALGORITHM, angle, velocity)
    carried = carried[..., places[1:] - 1, :]
    force = np.diff(carried, axis=-2, prepend=0.0) / window
    lead = angle.shape[:-2]
    rate = angle.reshape(*lead, -1, 2 * each, 3).sum(axis=-2) / window
    attitude = attitudes(ALGORITHM, angle)
    steps = np.linalg.norm(angle, axis=-1)
    return Evidence(
        window,
        2 * interval * places,
        force,
        quaternion.rotate(attitude[..., places[1:] - 1, :], rate),
        _rests(increments, round(window / increments.interval), len(places) - 1),
        np.cumsum(steps, axis=-1)[..., 2 * places[1:] - 1],
    )


def _rests(increments: Increments, each: int, count: int) -> NDArray[np.bool_]:
    """Whether (..., count) the body rests in windows of so many increments.

    The quarters of a window have the same rate then, as far as noise lets them.
    """
    quarter = each // 4
    if quarter == 0:
        return np.zeros((*increments.angle.shape[:-2], count), dtype=bool)
    rows = increments.angle[..., : each * count, :]
    windows = rows.reshape(*rows.shape[:-2], count, each, 3)[..., : 4 * quarter, :]
    parts = windows.reshape(*rows.shape[:-2], count, 4, quarter, 3).mean(axis=-2)
    parts = parts / increments.interval
    mean = parts.mean(axis=-2)
    slow = np.linalg.norm(mean, axis=-1) < _REST
    off = np.linalg.norm(parts - mean[..., np.newaxis, :], axis=-1).max(axis=-1)
    # Noise is alike in all rests, and a tenth of what is slow will be quiet.
    ordered = np.sort(np.where(slow, off, np.inf), axis=-1)
    tenth = slow.sum(axis=-1, keepdims=True) // 10
    quiet = np.take_along_axis(ordered, tenth, axis=-1)
    found = slow & (off <= np.maximum(_NOISE * quiet, _STILL))
    return found & (found.mean(axis=-1, keepdims=True) >= _FEWEST)


def thinned(
    increments: Increments, angle_step: float = _STEP, longest: float = np.inf
) -> Increments:
    """Sums of neighbouring increments, in which a table turns no farther; at least 400."""
    interval, angle, velocity = increments
    largest = max(float(np.abs(angle).max()), 1e-12)
    count = angle.shape[-2]
    most = min(angle_step / largest, longest / interval * (1 + 1e-9), count // (4 * _WINDOWS))
    many = max(int(most), 1)
    rows = count // (2 * many) * 2 * many
    return Increments(
        many * interval,
        *(
            part[..., :rows, :].reshape(*part.shape[:-2], -1, many, 3).sum(axis=-2)
            for part in (angle, velocity)
        ),
    )


_BLOCKS = 4
"""A rest window is compared in so many parts: long ones, so that counts of a coarse unit and what
vibrates do not pass for noise."""
_ENOUGH = 30  # degrees of freedom: of so many, the root of a mean square scatters by an eighth
LARGER = 2.0
"""Noise so many times what was told is named: of right records, not one in 10^12."""
_ANGLES = {
    "degrees for radians, or degrees/sqrt(h) for degrees/sqrt(s)?": np.degrees(1.0),
    "degrees/sqrt(h) for rad/sqrt(s)?": 60 * np.degrees(1.0),
}
_NEAR = 1.3
"""Sensors that are better than told are no slip; but noise so near to that in another unit is."""


def assumed_noise_contradictions(inputs: FilterInputs) -> tuple[list[str], ImuNoise]:
    """Sentences on the noise if it is not what one run was told, and what it is then."""
    increments, right, shown = inputs.increments, inputs.noise, evidence(inputs.increments)
    sentences: list[str] = []
    triads = (
        ("gyros", "angle_random_walk", increments.angle),
        ("accelerometers", "velocity_random_walk", increments.velocity),
    )
    for triad, name, rows in triads:
        size = float(getattr(inputs.noise, name))
        if shown is None or size == 0:
            continue
        found = _random_walk(rows, shown, increments.interval)
        if found is None:
            continue
        ratio = found / size
        unit = _unit(ratio) if triad == "gyros" else ""
        if ratio > LARGER or unit:
            sentences.append(f"{triad}: noise {ratio:.2g} times what was told{unit}")
            right = replace(right, **{name: found})
    return sentences, right


def _random_walk(rows: FloatArray, shown: Evidence, interval: float) -> float | None:
    """White noise of increments (n, 3) at rest, per square root of a second; or None."""
    rest, each = shown.rest, round(shown.window / interval)
    part = each // _BLOCKS if each >= _BLOCKS else 1
    blocks = each // part
    freedom = 3 * (blocks - 1)  # of one window
    if freedom * int(rest.sum()) < _ENOUGH:
        return None
    windows = rows[: each * len(rest)].reshape(len(rest), each, 3)[rest, : blocks * part]
    sums = windows.reshape(-1, blocks, part, 3).sum(axis=2)
    squares = np.sum((sums - sums.mean(axis=1, keepdims=True)) ** 2, axis=(1, 2))
    # The median, because one or another window may end as a turn begins.
    typical = float(np.median(squares)) / float(chdtri(freedom, 0.5))
    return float(np.sqrt(typical / (part * interval)))


def _unit(ratio: float) -> str:
    """Words for a factor that is one of units of angle."""
    for name, factor in _ANGLES.items():
        if 1 / _NEAR < ratio * factor < _NEAR:
            return f": {name}"
    return ""

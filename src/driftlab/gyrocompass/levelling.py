"""The gyrocompass at work: quaternion equations in the horizontal frame, corrected by gravity.

The computer carries a horizon, a frame eta that it keeps level. It integrates the quaternion from
the body to the horizon, resolves the specific force W in the horizon, and turns the horizon
accordingly:

    2 lambda_eta' = lambda_eta∘w - w_eta∘lambda_eta,
    w_eta1 = k1 W3 + k2 ∫W3 dt,  w_eta3 = -k1 W1 - k2 ∫W1 dt,  w_eta2 given.

The heading is the yaw of the body in the horizon plus the angle from the level part of w_eta to the
horizon's first axis, of the integrals alone: the rest has the accelerometers' pulses in it. The
paper describes these equations in words; they are reconstructed. Axes as in `driftlab.frames`.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    checked_instance,
    finite_array,
    finite_arrays,
    finite_number,
    shown,
    unit_quaternions,
    whole_number,
)
from driftlab.core.levelling import force_at_start, integrated_runs
from driftlab.core.quaternion import from_rotation_vector
from driftlab.core.vectors import wrap_angle
from driftlab.earth import EARTH_RATE
from driftlab.frames import EulerAngles, to_euler_angles
from driftlab.increments import Increments, checked_increments

from .alignment import Alignment
from .levelling_loop import Gains
from .two_position_alignment import MultiPositionAlignment

_MOST_TURN = 0.1  # rad in one interval, for which the series of a turn is exact to 1e-11


class LevelFrame(NamedTuple):
    """State of the computed horizon.

    Attributes
    ----------
    attitude : ndarray, shape (..., 4)
        Body to horizon.
    rate : ndarray, shape (..., 2)
        Integral parts of the horizon's level rates w_eta1 and w_eta3, rad/s.
    """

    attitude: FloatArray
    rate: FloatArray


class LevellingHistory(NamedTuple):
    """Result of `propagate_level_frame`, and the state from which it can continue.

    Attributes
    ----------
    times : ndarray, shape (k,)
        From the start, s.
    attitude : ndarray, shape (..., k, 4)
        Body to horizon.
    rate : ndarray, shape (..., k, 2)
        Integral parts of the level rates w_eta1 and w_eta3, rad/s, as in `LevelFrame`.
    proportional_rate : ndarray, shape (..., k, 2)
        Their proportional parts k1 W3 and -k1 W1, rad/s: means over the last interval.
    last : LevelFrame
        State at the last of the times.
    """

    times: FloatArray
    attitude: FloatArray
    rate: FloatArray
    proportional_rate: FloatArray
    last: LevelFrame

    @property
    def horizon_rate(self) -> FloatArray:
        """Whole level rates w_eta1 and w_eta3 (..., k, 2) with which the horizon turns, rad/s.

        For a compass too noisy: one pulse of a real accelerometer can be more than the Earth's.
        """
        return self.rate + self.proportional_rate

    @property
    def yaw_pitch_roll(self) -> EulerAngles:
        """Yaw psi (in the field `heading`), pitch and roll of the body in the horizon, rad."""
        return to_euler_angles(self.attitude)

    @property
    def compass_angle(self) -> FloatArray:
        """Angle Psi_K (..., k) from the compass's North to the horizon's first axis, rad."""
        return np.arctan2(self.rate[..., 1], self.rate[..., 0])

    @property
    def heading(self) -> FloatArray:
        """Heading Psi = psi + Psi_K (..., k), rad, from -pi to pi; (heading)."""
        return wrap_angle(self.yaw_pitch_roll.heading + self.compass_angle)


def initial_level_frame(alignment: Alignment) -> LevelFrame:
    """Initial horizon from an alignment: its axes are North, Up, East.

    Its rate is the one that the gyros measured, with their drift. With U cos(latitude) instead it
    would begin to oscillate.

    Parameters
    ----------
    alignment : Alignment
        From an angular rate (...) in rad/s.

    Returns
    -------
    LevelFrame
        Leading axes (...).

    Examples
    --------
    >>> from driftlab.gyrocompass.alignment import align
    >>> initial_level_frame(align([5.156e-5, 5.156e-5, 0.0], [0.0, 9.8, 0.0])).rate
    array([5.156e-05, 0.000e+00])
    """
    checked_instance(alignment, Alignment, "alignment", "from align(angular_rate, specific_force)")
    north = np.asarray(alignment.level_rate)
    return LevelFrame(alignment.attitude, np.stack([north, np.zeros_like(north)], axis=-1))


def propagate_level_frame(
    start: LevelFrame,
    increments: Increments,
    gains: Gains,
    azimuth_rate: ArrayLike,
    *,
    every: int = 1,
) -> LevellingHistory:
    """Propagate the horizon along the increments of gyros and accelerometers.

    Parameters
    ----------
    start : LevelFrame
        State before the first increment, leading axes (...).
    increments : Increments
        Arrays of shape (..., n, 3), body axes.
    gains : Gains
        Gains of the horizon.
    azimuth_rate : array_like, shape (..., n) or ()
        w_eta2, rad/s, one for all intervals or one for each. Without a log it is U sin(latitude),
        with the latitude from the alignment. Its error acts like a drift about Up. Refused beyond
        100 times the Earth's rate, which only another unit, or a latitude, can be.
    every : int
        Number of increments between two results; a divisor of n.

    Returns
    -------
    LevellingHistory
        Results (..., k), one after each `every` increments.

    Raises
    ------
    ValueError
        If kinds or shapes do not fit, if n is not a multiple of `every`, or if the gains are too
        large for the interval: the horizon must follow slowly in it.

    Examples
    --------
    Ten minutes on a table at 45 degrees: after the alignment the heading stays.

    >>> from driftlab.earth import EARTH_RATE
    >>> from driftlab.gyrocompass import align, schuler_gains
    >>> rate, force = EARTH_RATE * np.sqrt(0.5) * np.array([1.0, 1.0, 0.0]), np.array([0, 9.8, 0])
    >>> start, rows = initial_level_frame(align(rate, force)), np.ones((600, 1))
    >>> increments = Increments(1.0, rate * rows, force * rows)
    >>> found = propagate_level_frame(start, increments, schuler_gains(), rate[1])
    >>> bool(np.abs(found.heading).max() < 1e-7)
    True
    """
    seconds, angle, velocity = checked_increments(increments)
    k1, k2 = _loop_gains(gains, seconds)
    count = angle.shape[-2]
    every = whole_number(every, "every")
    if count % every:
        raise ValueError(
            f"every: expected a divisor of the number of increments, {count}, got {shown(every)}."
        )
    _refuse_alignment(start)
    beginning, level = checked_instance(start, LevelFrame, "start")
    parts: dict[str, Any] = {
        "start.attitude": (unit_quaternions(beginning, "start.attitude"), 4),
        "start.rate": (level, 2),
        "azimuth_rate": (_azimuth_rates(azimuth_rate, count), count),
        "increments.angle": (angle, count, 3),
        "increments.velocity": (velocity, count, 3),
    }
    attitude, rate, turn, *_ = finite_arrays(**parts)
    lead = np.broadcast_shapes(
        attitude.shape[:-1], rate.shape[:-1], turn.shape[:-1], angle.shape[:-2], velocity.shape[:-2]
    )
    for name, values in (("start.rate", rate), ("azimuth_rate", turn)):
        if seconds * np.abs(values).max() > _MOST_TURN:
            raise ValueError(
                f"{name}: expected rad/s that turn the horizon by at most {_MOST_TURN:g} rad in "
                f"one interval, got {np.abs(values).max():.3g} rad/s for {seconds:g} s."
            )
    first = np.concatenate(
        [np.broadcast_to(part, (*lead, part.shape[-1])) for part in (attitude, rate)], axis=-1
    )
    force = force_at_start(angle, velocity) / seconds
    steps = [
        np.broadcast_to(part, (*lead, *part.shape[-2:]))
        for part in (from_rotation_vector(angle), force, turn[..., np.newaxis])
    ]
    found = integrated_runs(first, steps, seconds, k1, k2, every)
    if not np.isfinite(found).all():
        raise ValueError(
            "increments: expected increments that a horizon can follow, "
            f"got up to {np.abs(angle).max():.3g} rad and {np.abs(velocity).max():.3g} m/s."
        )
    last = LevelFrame(found[..., -1, :4], found[..., -1, 4:6])
    times: FloatArray = seconds * every * np.arange(1.0, count // every + 1)
    return LevellingHistory(times, found[..., :4], found[..., 4:6], found[..., 6:], last)


_MOST_TIMES_THE_EARTH = 100.0
"""An azimuth rate beyond it, 0.4 deg/s, is hardly one of a horizon: a latitude, or degrees. A ship
at 20 m/s turns its meridian once as fast as the Earth at 85 degrees of latitude."""


def _refuse_alignment(start: object) -> None:
    """Refuse the natural slip of an alignment in the place of a horizon."""
    if isinstance(start, Alignment | MultiPositionAlignment):
        raise ValueError(
            "start: expected a LevelFrame(attitude, rate), got an alignment; say "
            "initial_level_frame(alignment)."
        )


def _loop_gains(gains: Gains, seconds: float) -> tuple[float, float]:
    """Return k1 and k2, of a horizon that follows slowly in one interval."""
    k1, k2 = (
        finite_number(value, f"gains.{name}")
        for name, value in zip(Gains._fields, checked_instance(gains, Gains, "gains"), strict=True)
    )
    # W is close to g times the tilt, so these are the loop's gains in one interval.
    loop = 9.8 * np.array([k1 * seconds, k2 * seconds**2])
    if not (loop.min() >= 0 and loop.max() <= 1):
        raise ValueError(
            "gains, increments.interval: expected a horizon that follows slowly in one interval, "
            f"with gains k1 g h and k2 g h^2 from 0 to 1, got {loop[0]:.3g} and {loop[1]:.3g}."
        )
    return k1, k2


def _azimuth_rates(azimuth_rate: ArrayLike, count: int) -> FloatArray:
    """Return an azimuth rate for each interval, (..., count)."""
    rate = finite_array(azimuth_rate, "azimuth_rate")
    fastest = float(np.abs(rate).max())
    if fastest > _MOST_TIMES_THE_EARTH * EARTH_RATE:
        raise ValueError(
            "azimuth_rate: expected rad/s near U sin(latitude), at rest at most "
            f"{EARTH_RATE:.3g}, got {fastest:.3g}. Is it a latitude, or in degrees?"
        )
    return np.broadcast_to(rate, count) if rate.ndim == 0 else rate

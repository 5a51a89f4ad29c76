"""The gyrocompass at work: quaternion equations in the horizontal frame, corrected by gravity.

The computer carries a horizon, a frame eta that it keeps level. It integrates the quaternion from
the body to the horizon, resolves the specific force W in the horizon, and turns the horizon
accordingly:

    2 Lambda' = Lambda∘w - w_eta∘Lambda,
    w_eta1 = k1 W3 + k2 ∫W3 dt,  w_eta3 = -k1 W1 - k2 ∫W1 dt,  w_eta2 given.

The heading is the yaw of the body in the horizon plus the angle from the level part of w_eta to the
horizon's first axis. The paper describes these equations and does not print them; they are
reconstructed. Axes and angles are those of `driftlab.frames`.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    finite_array,
    finite_arrays,
    finite_number,
    positive_number,
    unit_quaternions,
    whole_number,
)
from driftlab.core.quaternion import from_rotation_vector
from driftlab.core.vectors import cross, wrap_angle
from driftlab.earth import EARTH_RADIUS
from driftlab.frames import Angles, angles_from_attitude
from driftlab.imu import increment_rows

from .alignment import Alignment

_FEW = 12
"""Up to this many runs are integrated one by one in Python floats: faster than short arrays."""
_MOST_TURN = 0.1  # rad in one interval, for which the series of a turn is exact to 1e-11


class Tuning(NamedTuple):
    """Gains by which the horizon follows the accelerometers.

    Attributes
    ----------
    proportional : float
        k1, rad/s for each m/s^2.
    integral : float
        k2, rad/s^2 for each m/s^2.

    Examples
    --------
    >>> Tuning(proportional=0.0, integral=1e-5)
    Tuning(proportional=0.0, integral=1e-05)
    """

    proportional: float
    integral: float


class Horizon(NamedTuple):
    """State of the computed horizon.

    Attributes
    ----------
    attitude : ndarray, shape (..., 4)
        Body to horizon.
    rate : ndarray, shape (..., 2)
        Integral parts of the horizon's level rates w_eta1 and w_eta3, rad/s.

    Examples
    --------
    >>> Horizon(np.array([0.0, 0.0, 0.0, 1.0]), np.zeros(2)).rate
    array([0., 0.])
    """

    attitude: FloatArray
    rate: FloatArray


class Operation(NamedTuple):
    """Result of `operate`, and the state from which it can continue.

    Attributes
    ----------
    times : ndarray, shape (k,)
        From the start, s.
    attitude : ndarray, shape (..., k, 4)
        Body to horizon.
    rate : ndarray, shape (..., k, 2)
        Level rates w_eta1 and w_eta3 of the horizon, rad/s: the integral parts at these times plus
        the means of the proportional parts over the last interval.
    last : Horizon
        State at the last of the times.

    Examples
    --------
    >>> level, rate = np.array([[0.0, 0.0, 0.0, 1.0]]), np.array([[5e-5, 5e-5]])
    >>> found = Operation(np.ones(1), level, rate, Horizon(level[0], rate[0]))
    >>> np.degrees(found.compass_angle)
    array([45.])
    """

    times: FloatArray
    attitude: FloatArray
    rate: FloatArray
    last: Horizon

    @property
    def yaw_pitch_roll(self) -> Angles:
        """Angles of the body in the horizon.

        Returns
        -------
        Angles
            Yaw psi (in the field `heading`), pitch and roll, each (..., k), rad.

        Examples
        --------
        >>> yawed = np.array([[0.0, np.sin(0.1), 0.0, np.cos(0.1)]])
        >>> found = Operation(np.ones(1), yawed, np.zeros((1, 2)), Horizon(yawed[0], np.zeros(2)))
        >>> found.yaw_pitch_roll.heading.round(6)
        array([0.2])
        """
        return angles_from_attitude(self.attitude)

    @property
    def compass_angle(self) -> FloatArray:
        """Compass angle Psi_K: from the compass's North to the horizon's first axis.

        Returns
        -------
        ndarray, shape (..., k)
            rad, from -pi to pi.

        Examples
        --------
        >>> level, rate = np.array([[0.0, 0.0, 0.0, 1.0]]), np.array([[5e-5, 5e-5]])
        >>> Operation(np.ones(1), level, rate, Horizon(level[0], rate[0])).compass_angle.round(4)
        array([0.7854])
        """
        return np.arctan2(self.rate[..., 1], self.rate[..., 0])

    @property
    def heading(self) -> FloatArray:
        """Heading Psi = psi + Psi_K: yaw in the horizon plus compass angle; (heading).

        Returns
        -------
        ndarray, shape (..., k)
            rad, from -pi to pi, positive from North to West.

        Examples
        --------
        >>> yawed, north = np.array([[0.0, np.sin(0.1), 0.0, np.cos(0.1)]]), np.array([[1.0, 0.0]])
        >>> Operation(np.ones(1), yawed, north, Horizon(yawed[0], north[0])).heading.round(6)
        array([0.2])
        """
        return wrap_angle(self.yaw_pitch_roll.heading + self.compass_angle)


def schuler_tuning(radius: float = EARTH_RADIUS) -> Tuning:
    """Schuler's tuning, which has no ballistic error: k1 = 0 and k2 = 1/R.

    Parameters
    ----------
    radius : float
        R of the Earth, m.

    Returns
    -------
    Tuning
        With the period of 84 minutes of a pendulum of the Earth's radius.

    Examples
    --------
    >>> tuning = schuler_tuning()
    >>> round(2 * math.pi / math.sqrt(9.8 * tuning.integral) / 60, 1)  # period, minutes
    84.4
    """
    return Tuning(0.0, 1 / positive_number(radius, "radius"))


def damped_tuning(
    natural_frequency: float, gravity: float, damping: float = float(np.sqrt(0.5))
) -> Tuning:
    """Tuning of a damped horizon, for accelerated alignment.

    Parameters
    ----------
    natural_frequency : float
        wn, rad/s.
    gravity : float
        g, m/s^2.
    damping : float
        Damping ratio zeta, without unit.

    Returns
    -------
    Tuning
        k1 = 2 zeta wn/g and k2 = wn^2/g.

    Examples
    --------
    >>> tuning = damped_tuning(0.01, 9.8)
    >>> f"{tuning.proportional:.2e} {tuning.integral:.2e}"
    '1.44e-03 1.02e-05'
    """
    frequency = positive_number(natural_frequency, "natural_frequency")
    pull, ratio = positive_number(gravity, "gravity"), positive_number(damping, "damping")
    return Tuning(2 * ratio * frequency / pull, frequency * frequency / pull)


def horizon_of(alignment: Alignment) -> Horizon:
    """Initial horizon from an alignment: its axes are North, Up, East.

    Its rate is the one that the gyros measured, with their drift. With U cos(latitude) instead it
    would begin to oscillate.

    Parameters
    ----------
    alignment : Alignment
        From an angular rate (...) in rad/s.

    Returns
    -------
    Horizon
        Leading axes (...).

    Examples
    --------
    >>> from driftlab.gyrocompass.alignment import align
    >>> horizon_of(align([5e-5, 5e-5, 0.0], [0.0, 9.8, 0.0])).rate
    array([5.e-05, 0.e+00])
    """
    north = np.asarray(alignment.level_rate)
    return Horizon(alignment.attitude, np.stack([north, np.zeros_like(north)], axis=-1))


def operate(
    start: Horizon,
    angle_increments: ArrayLike,
    velocity_increments: ArrayLike,
    interval: float,
    tuning: Tuning,
    azimuth_rate: ArrayLike,
    *,
    every: int = 1,
) -> Operation:
    """Propagate the horizon along the increments of gyros and accelerometers.

    Parameters
    ----------
    start : Horizon
        State before the first increment, leading axes (...).
    angle_increments, velocity_increments : array_like, shape (..., n, 3)
        Integrals of angular rate (rad) and specific force (m/s) in body axes over equal intervals.
    interval : float
        Length of the intervals, s.
    tuning : Tuning
        Gains of the horizon.
    azimuth_rate : array_like, shape (..., n) or ()
        w_eta2, rad/s, one for all intervals or one for each. Without a log it is U sin(latitude),
        with the latitude from the alignment. Its error acts like a drift about Up.
    every : int
        Number of increments between two results; a divisor of n.

    Returns
    -------
    Operation
        Results (..., k), one after each `every` increments.

    Raises
    ------
    ValueError
        If shapes do not fit, if n is not a multiple of `every`, or if the gains are too large for
        the interval: the horizon must follow slowly in it.

    Examples
    --------
    Ten minutes on a table at 45 degrees: after the alignment the heading stays.

    >>> from driftlab.earth import EARTH_RATE
    >>> from driftlab.gyrocompass.alignment import align
    >>> rate, force = EARTH_RATE * np.sqrt(0.5) * np.array([1.0, 1.0, 0.0]), np.array([0, 9.8, 0])
    >>> start, rows = horizon_of(align(rate, force)), np.ones((600, 1))
    >>> found = operate(start, rate * rows, force * rows, 1.0, schuler_tuning(), rate[1])
    >>> bool(np.abs(found.heading).max() < 1e-7)
    True
    """
    seconds = positive_number(interval, "interval")
    k1, k2 = (
        finite_number(value, f"tuning.{name}")
        for name, value in zip(Tuning._fields, tuning, strict=True)
    )
    # W is close to g times the tilt, so these are the loop's gains in one interval.
    gains = 9.8 * np.array([k1 * seconds, k2 * seconds**2])
    if not (gains.min() >= 0 and gains.max() <= 1):
        raise ValueError(
            "tuning, interval: expected a horizon that follows slowly in one interval, with gains "
            f"k1 g h and k2 g h^2 from 0 to 1, got {gains[0]:.3g} and {gains[1]:.3g}."
        )
    angle, velocity = increment_rows(angle_increments, velocity_increments)
    count = angle.shape[-2]
    if count % whole_number(every, "every"):
        raise ValueError(
            f"every: expected a divisor of the number of increments, {count}, got {every!r}."
        )
    beginning, level = start
    attitude, rate, turn, *_ = finite_arrays(
        **{
            "start.attitude": (unit_quaternions(beginning, "start.attitude"), 4),
            "start.rate": (level, 2),
        },
        azimuth_rate=(_one_each(azimuth_rate, count), count),
        angle_increments=(angle, count, 3),
        velocity_increments=(velocity, count, 3),
    )
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
    force = _force_at_start(angle, velocity) / seconds
    steps = [
        np.broadcast_to(part, (*lead, *part.shape[-2:]))
        for part in (from_rotation_vector(angle), force, turn[..., np.newaxis])
    ]
    found = _results(first, steps, seconds, k1, k2, every)
    if not np.isfinite(found).all():
        raise ValueError(
            "angle_increments, velocity_increments: expected increments that a horizon can follow, "
            f"got up to {np.abs(angle).max():.3g} rad and {np.abs(velocity).max():.3g} m/s."
        )
    last = Horizon(found[..., -1, :4], found[..., -1, 6:])
    times: FloatArray = seconds * every * np.arange(1.0, count // every + 1)
    return Operation(times, found[..., :4], found[..., 4:6], last)


def _one_each(azimuth_rate: ArrayLike, count: int) -> FloatArray:
    rate = finite_array(azimuth_rate, "azimuth_rate")
    return np.broadcast_to(rate, count) if rate.ndim == 0 else rate


def _force_at_start(angle: FloatArray, velocity: FloatArray) -> FloatArray:
    """Velocity increments (..., n, 3) in the body axes at the start of each interval.

    The body turns at a constant rate while the force, most of which is gravity, stands still in
    space.
    """
    a, v = (np.moveaxis(part, -1, 0) for part in np.broadcast_arrays(angle, velocity))
    once = cross(a, v)
    return np.moveaxis(v + once / 2 + cross(a, once) / 12, 0, -1)


def _results(
    first: FloatArray, steps: list[FloatArray], interval: float, k1: float, k2: float, every: int
) -> FloatArray:
    """Results (..., k, 8) of `_integrate` from first (..., 6) with steps (..., n, m)."""
    lead = first.shape[:-1]
    if math.prod(lead) > _FEW:
        components = [np.moveaxis(part, (-2, -1), (0, 1)) for part in steps]
        rows = _integrate(np.moveaxis(first, -1, 0), components, interval, k1, k2, every)
        return np.moveaxis(np.array(rows), (0, 1), (-2, -1))
    try:
        runs = [
            _integrate(first[i].tolist(), [s[i].tolist() for s in steps], interval, k1, k2, every)
            for i in np.ndindex(lead)
        ]
    except ZeroDivisionError:  # where arrays have infinity
        return np.array(np.inf)
    return np.reshape(runs, (*lead, -1, 8))


def _integrate(
    first: Any, steps: Any, interval: float, k1: float, k2: float, every: int
) -> list[Any]:
    """Rows of attitude, level rates, and their integrals, after each `every` steps.

    All operations are plain arithmetic, so the same lines serve floats and arrays. In a step the
    horizon goes halfway, looks at the force there, and goes all the way with what it has seen: a
    leapfrog, which keeps the amplitude of an undamped oscillation.
    """
    x, y, z, w, i1, i3 = first
    half = 0.5 * interval
    rows = []
    for number, ((a, b, c, d), (f1, f2, f3), (u,)) in enumerate(zip(*steps, strict=True), 1):
        # The force in the horizon at the beginning of the step, v + 2 w q×v + 2 q×(q×v) ...
        t1, t2, t3 = 2 * (y * f3 - z * f2), 2 * (z * f1 - x * f3), 2 * (x * f2 - y * f1)
        g1 = f1 + w * t1 + y * t3 - z * t2
        g2 = f2 + w * t2 + z * t1 - x * t3
        g3 = f3 + w * t3 + x * t2 - y * t1
        # ... and in the horizon of the middle. It has turned by half of the integrals' rates and,
        # solved for the force there, by half of the proportional part.
        share = 1 / (1 + half * k1 * g2)
        w1 = share * (g1 - half * (u * g3 - i3 * g2))
        w3 = share * (g3 - half * (i1 * g2 - u * g1))
        i1, i3 = i1 + half * k2 * w3, i3 - half * k2 * w1
        r1, r3 = i1 + k1 * w3, i3 - k1 * w1
        i1, i3 = i1 + half * k2 * w3, i3 - half * k2 * w1
        # The body's turn on the right of the quaternion, ...
        x, y, z, w = (
            w * a + x * d + y * c - z * b,
            w * b + y * d + z * a - x * c,
            w * c + z * d + x * b - y * a,
            w * d - x * a - y * b - z * c,
        )
        # ... the horizon's on the left, by series: it turns by little.
        h1, h2, h3 = half * r1, half * u, half * r3
        s = h1 * h1 + h2 * h2 + h3 * h3
        small = 1 - s / 6 + s * s / 120
        h1, h2, h3, h4 = h1 * small, h2 * small, h3 * small, 1 - s / 2 + s * s / 24
        x, y, z, w = (
            h4 * x - h1 * w - h2 * z + h3 * y,
            h4 * y - h2 * w - h3 * x + h1 * z,
            h4 * z - h3 * w - h1 * y + h2 * x,
            h4 * w + h1 * x + h2 * y + h3 * z,
        )
        length = 1.5 - 0.5 * (x * x + y * y + z * z + w * w)
        x, y, z, w = length * x, length * y, length * z, length * w
        if number % every == 0:
            # The integrals are those of the end of the step; r1, r3 belong to its middle.
            rows.append((x, y, z, w, i1 + k1 * w3, i3 - k1 * w1, i1, i3))
    return rows

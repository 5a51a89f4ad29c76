"""Alignment on a base that is not still: gravity as it is seen in inertial space.

The means of `align` take the rate of the Earth from the gyros, so the body must not turn. Here the
body may turn as it likes: the attitude that the gyros give carries the specific force into the axes
in which the body stood at the start. There gravity's reaction goes round the Earth's axis with the
Earth, on a cone; and the direction in which it moves is East. Its integral is a velocity, in which
a swaying that stays near its place leaves little. The attitude is the one that turns the measured
velocities into those of the cone.

The method is known as coarse alignment in the inertial frame. Wu, Wu, Hu and Hu (Aerospace Science
and Technology 15, 2011) put it as Wahba's problem for velocity vectors; Silson (IEEE Transactions
on Instrumentation and Measurement 60, 2011) fits velocity loci on a ship; Yan's PSINS has it as
``aligni0``, with two vectors, and the Moscow toolkit pony as ``pony_ins_alignment_rotating``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS
from driftlab.checks import FloatArray, finite_arrays, nonnegative_number, one_pull, positive_array
from driftlab.core import carried_gravity as core
from driftlab.core.quaternion import multiply, rotate
from driftlab.core.velocity_noise import FEWEST_WINDOWS, STEPS_A_WINDOW, mean_deviation
from driftlab.earth import EARTH_RATE, checked_latitude, gravity as normal_gravity
from driftlab.frames import to_euler_angles
from driftlab.increments import Increments, checked_increments

from ._contradictions import NOTHING_KNOWN

_NO_FORCE = 1e-30
"""Velocity increments that are all smaller, m/s, have no direction left in double."""
_ALGORITHM = CONING_ALGORITHMS["two-step-4"].steps
_FEWEST = 2 * STEPS_A_WINDOW * (FEWEST_WINDOWS + 1)
_DENSITIES: FloatArray = np.array([100800.0, 1120.0, 280 / 11, 700 / 429])
"""Integrals from 0 to 1 of the squares of the third, second and first derivative of the bell
p = 140 x^3 (1 - x)^3 of `inertial_alignment_standard_deviation`, and of its own."""


class InertialAlignment(NamedTuple):
    """Attitude of a body from gravity seen in inertial space, and how well gravity obeyed.

    Attributes
    ----------
    heading, pitch, roll : ndarray, shape (...)
        At the end of the record, rad; the heading is positive from North to West.
    attitude, start_attitude : ndarray, shape (..., 4)
        At the end and at the start; body (forward, up, right) to North, Up, East.
    deviation : ndarray, shape (...)
        Standard deviation of the heading by noise and swaying, as what is left of the velocities
        shows them, rad. Constant errors of the sensors do not show.
    residual : ndarray, shape (...)
        Root mean square of what is left of the velocities, m/s.
    residual_angle : ndarray, shape (...)
        The same in units of the velocities, as an angle of gravity, rad.
    level_rate : ndarray, shape (...)
        Rate at which gravity is seen to move across the level, rad/s. Without errors it is
        U cos(latitude), where U is the Earth's rate. The difference is drift about North; with a
        drift about East of the same size the heading errs by the difference over U cos(latitude).
    gravity : ndarray, shape (...)
        m/s^2, as the accelerometers have it.
    """

    heading: FloatArray
    pitch: FloatArray
    roll: FloatArray
    attitude: FloatArray
    start_attitude: FloatArray
    deviation: FloatArray
    residual: FloatArray
    residual_angle: FloatArray
    level_rate: FloatArray
    gravity: FloatArray


def align_in_inertial_frame(increments: Increments, latitude: ArrayLike) -> InertialAlignment:
    """Heading, pitch and roll of a body that may sway, from its own six sensors.

    Parameters
    ----------
    increments : Increments
        Arrays (..., n, 3) of integrals of rate, rad, and specific force, m/s, in body axes forward,
        up, right. Of an odd number the first is left out, because steps are pairs.
    latitude : array_like, shape (...)
        rad. An error of 0.1 degrees turns the heading by some seconds of arc in five minutes.

    Returns
    -------
    InertialAlignment
        Attitudes, and what tells how far to trust them.

    Raises
    ------
    ValueError
        At a pole; if there are fewer than 72 increments; if the velocities are not such that
        gravity makes them in the time of the record, as rates in the place of increments or forces
        in g; or if gravity, carried by the gyros, moves more than ten times as fast as the Earth
        turns, as with rates or degrees, or hardly moves, as with gyros that do not feel the Earth.

    See Also
    --------
    align : For a body that lies still.
    inertial_alignment_standard_deviation : How well it can do.

    Notes
    -----
    The base may sway and turn, but not travel: a way to the North makes the speed error of every
    compass, `speed_error`. A swing may be under way at the start, as a constant is free in the fit.
    So the heading comes from the parabola in the level velocity, gravity times U cos(latitude) t²/2
    to the East. The velocities have the weights t (T - t): a swing that the record cuts in two then
    counts little.

    Of the ways to solve for the attitude this one takes all velocities (Wahba's problem, by
    Davenport's method). The cross products of two velocities, as of ``aligni0``, take the middle
    and the end, and what the base does just then goes into the heading undiminished. The headings
    of 26 stretches of 70 s of a parked car scatter five times as much by it, see chapter 17.

    Constant biases of the sensors do what they do in `align`: `alignment_attitude_error` holds here
    as well, at the end of the record, but for terms of the drift in half of the record's time.
    The stated deviation leaves open which noise there is: swaying, rounding, noise of the
    accelerometers and of the gyros, or a mixture. In simulations from 85 to 100 per cent of the
    errors lay within two of it; the less the gyros' noise shows, the more it is too large, up to
    three times. The parked car's headings of 70 s scatter by 0.7 of it, those of 180 s by 0.9, but
    the six of 300 s by 1.6, two of them outside.
    Some mistakes pass: gyros of the wrong sign, one dead gyro of three, and a latitude of the wrong
    sign, which turns the heading by U T sin(latitude).
    A record that is too short for the Earth to turn far is not refused; the deviation says it,
    which on a swaying base falls with the power -7/2 of the time.

    References
    ----------
    - M. Wu, Y. Wu, X. Hu, D. Hu, *Optimization-based alignment for inertial navigation systems:
      Theory and algorithm*, Aerospace Science and Technology 15, 2011.

    Examples
    --------
    A ship that rolls by five degrees, headed North West, for five minutes. The means of its gyros
    know of the turning, too, and the heading from them is worth nothing:

    >>> from driftlab.gyrocompass import align
    >>> from driftlab.motion import vehicle_trajectory
    >>> times = 0.05 * np.arange(6001)
    >>> roll, pitch = (0.09 * np.sin(0.8 * times), 0.03 * np.sin(times + 1.0))
    >>> ship = vehicle_trajectory(
    ...     0.9, np.zeros((6001, 2)), np.pi / 4, pitch, roll, interval=0.05
    ... ).increments
    >>> found = align_in_inertial_frame(ship, 0.9)
    >>> round(float(np.degrees(found.heading)), 3)
    45.0
    >>> no_warning = {"heading_tolerance": np.inf}
    >>> means = align(ship.mean_rate.mean(axis=0), ship.velocity.mean(axis=0), **no_warning)
    >>> bool(abs(np.degrees(means.heading) - 45.0) > 10.0)
    True
    """
    seconds, angle, velocity = checked_increments(increments)
    place = checked_latitude(latitude)
    count = angle.shape[-2]
    finite_arrays(
        **{"increments.angle": (angle, count, 3), "increments.velocity": (velocity, count, 3)},
        latitude=(place,),
    )
    if count < _FEWEST:
        raise ValueError(f"increments: expected at least {_FEWEST}, got {count}.")
    angle, velocity = angle[..., count % 2 :, :], velocity[..., count % 2 :, :]
    if np.abs(velocity).max(axis=(-2, -1)).min() < _NO_FORCE:
        _refuse_other_units(np.zeros(()), place)
    turn, carried = core.carried_velocity(_ALGORITHM, angle, velocity)
    part = np.arange(1, count // 2 + 1) / (count // 2)
    duration = seconds * (count - count % 2)
    weights = part * (1 - part)
    weights /= weights.sum()
    cone = core.centred(core.cone_velocity(place, duration * part), weights)
    carried = core.centred(carried, weights)
    start = core.wahba_rotation(carried, cone, weights)
    seen = rotate(start[..., np.newaxis, :], carried)
    size = np.einsum("n,...ni,...ni->...", weights, cone, cone)
    pull = np.einsum("n,...ni,...ni->...", weights, seen, cone) / size
    _refuse_other_units(pull, place)
    left = seen - pull[..., np.newaxis, np.newaxis] * cone
    residual = np.sqrt(np.einsum("n,...ni,...ni->...", weights, left, left))
    level_rate = _level_rate(left / pull[..., np.newaxis, np.newaxis], cone, part, weights, place)
    level = EARTH_RATE * np.cos(place)
    deviation = mean_deviation(left[..., [0, 2]], _DENSITIES) / (duration**2 * pull * level)
    _refuse_another_pace(level_rate, level, deviation)
    end = multiply(multiply(core.earth_turn(place, duration), start), turn)
    return InertialAlignment(
        *to_euler_angles(end),
        end,
        start,
        deviation,
        residual,
        residual / (pull * np.sqrt(size)),
        level_rate,
        pull,
    )


def inertial_alignment_standard_deviation(
    latitude: ArrayLike,
    duration: ArrayLike,
    angle_random_walk: float,
    velocity_noise: float = 0.0,
    gravity: float | None = None,
) -> FloatArray:
    """Standard deviation of the heading of `align_in_inertial_frame` by noise, before it is run.

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad.
    duration : array_like, shape (...)
        T of the record, s.
    angle_random_walk : float
        Of each gyro: square root of the density of its white noise, rad/√s.
    velocity_noise : float
        Square root of the density of the base's velocity along the level, where it forgets much
        faster than in T, m/s/√Hz; for samples of deviation s and interval h it is s √h.
    gravity : float, optional
        m/s^2; normal gravity of the latitude if not given.

    Returns
    -------
    ndarray, shape (...)
        rad; at most pi/sqrt(3), 104 degrees, where nothing is known.

    Raises
    ------
    ValueError
        At a pole, or if an argument is negative, or a duration not positive.

    Notes
    -----
    The heading's error is that of the East gyro's drift, seen through a bell: with x = t/T

        error = ∫ drift(t) p(x) dx / (U cos φ),   p(x) = 140 x³ (1 - x)³,

    where `align` has p = 1. The base's velocity v to the North enters by ∫ v p''(x) dx /
    (g U cos φ T²). Both are the weighted least squares of a parabola, integrated by parts.

    Examples
    --------
    A gyro of 0.003 degrees per root hour at 60 degrees, in degrees of heading: four times the time
    halves the error.

    >>> walk = np.radians(0.003) / 60
    >>> latitude, times = np.radians(60.0), [75.0, 300.0]
    >>> np.degrees(inertial_alignment_standard_deviation(latitude, times, walk)).round(4)
    array([0.2023, 0.1011])
    """
    place, time = finite_arrays(latitude=(latitude,), duration=(duration,))
    checked_latitude(place)
    positive_array(time, "duration")
    walk = nonnegative_number(angle_random_walk, "angle_random_walk")
    sway = nonnegative_number(velocity_noise, "velocity_noise")
    pull = normal_gravity(place) if gravity is None else one_pull(gravity)
    _, by_velocity, _, by_walk = _DENSITIES
    with np.errstate(over="ignore"):  # of hardly any time nothing is known
        variance = by_walk * walk**2 / time + by_velocity * (sway / pull) ** 2 / time**5
    return np.minimum(np.sqrt(variance) / (EARTH_RATE * np.cos(place)), NOTHING_KNOWN)


def _level_rate(
    left: FloatArray, cone: FloatArray, part: FloatArray, weights: FloatArray, place: FloatArray
) -> FloatArray:
    """Rate of gravity across the level, from what the cone has left of the velocities, in s."""
    parabola = part**2 - part
    pick = weights * (parabola - weights @ parabola)
    unit = np.einsum("n,...n->...", pick, cone[..., 2])
    north, east = (np.einsum("n,...n->...", pick, left[..., i]) / unit for i in (0, 2))
    rate: FloatArray = EARTH_RATE * np.cos(place) * np.hypot(north, 1 + east)
    return rate


def _refuse_other_units(pull: FloatArray, place: FloatArray) -> None:
    ratio = pull / normal_gravity(place)
    worst = float(ratio.flat[np.argmax(np.abs(np.log(np.maximum(ratio, 1e-300))))])
    if not 0.5 < worst < 2:
        raise ValueError(
            "increments.velocity: expected integrals of the specific force over the interval, m/s, "
            f"got {worst:.3g} times what gravity makes; are they rates, or in g?"
        )


def _refuse_another_pace(rate: FloatArray, level: FloatArray, deviation: FloatArray) -> None:
    # Noise alters the rate's part of the level's by the deviation of the heading: from one to 0.2
    # that would be four of them.
    wrong = (rate > 10 * EARTH_RATE) | (rate < 0.2 * level) & (deviation < 0.2)
    if wrong.any():
        raise ValueError(
            "increments.angle: expected integrals of the rate over the interval, rad, by gyros "
            f"that feel the Earth turn; with these gravity moves {rate[wrong][0] / EARTH_RATE:.3g} "
            "times as fast as the Earth turns."
        )

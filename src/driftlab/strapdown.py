"""Strapdown navigation: attitude, velocity and position from the increments of an inertial unit.

Local axes are East, North, Up; attitude quaternions map body components to them. The computation
runs in Earth-centred inertial axes, where only gravitation has to be added to the measured specific
force. Attitudes are then one cumulative product and velocities one cumulative sum; only gravitation
needs the position, and a fixed-point iteration over half a minute of motion at once finds it in a
few rounds. So an hour of flight takes some hundred NumPy calls on long arrays.

A step is a pair of increments: the coning correction is that of `two-step-4` of chapter 07, and the
velocity is corrected for rotation and sculling in the same way.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS

from .checks import (
    checked_instance,
    common_leading_axes,
    finite_array,
    finite_arrays,
    finite_number,
    increments_of_velocity,
    shown,
    speed_of_body,
    truth_value,
    unit_quaternions,
    whole_number,
)
from .core import loops
from .core.strapdown import Navigation, final_state
from .earth import checked_latitude
from .increments import Increments, checked_increments

__all__ = ["Navigation", "checked_interval", "final_state", "navigate", "stationary_state"]

ALGORITHM = CONING_ALGORITHMS["two-step-4"].steps
"""The attitude algorithm of the navigation; its step is a pair of increments."""
_HIGHEST = 1e9  # m: past the Moon
_LONGEST = 20.0  # s: interval for which the fixed point still converges quickly


def stationary_state(
    latitude: ArrayLike, attitude: ArrayLike, longitude: ArrayLike = 0.0, altitude: ArrayLike = 0.0
) -> Navigation:
    """Navigation state of a unit at rest on the Earth.

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad, at most 89.9 degrees from the equator.
    attitude : array_like or Rotation, shape (..., 4)
        Body to East, North, Up; brought to unit norm.
    longitude : array_like, shape (...)
        rad.
    altitude : array_like, shape (...)
        Above the ellipsoid, m.

    Returns
    -------
    Navigation
        Leading axes (...) broadcast, velocity zero.

    Raises
    ------
    ValueError
        If the latitude is that of a pole, or an attitude is a zero quaternion.

    See Also
    --------
    navigate : Goes on from there.

    Examples
    --------
    >>> state = stationary_state(np.radians([30.0, 45.0]), [0, 0, 0, 2])
    >>> state.attitude
    array([[0., 0., 0., 1.],
           [0., 0., 0., 1.]])
    """
    place = finite_arrays(
        latitude=(latitude,),
        longitude=(longitude,),
        altitude=(altitude,),
        attitude=(unit_quaternions(attitude, "attitude"), 4),
    )
    checked_latitude(latitude)
    leading = np.broadcast_shapes(*(a.shape for a in place[:3]), place[3].shape[:-1])
    latitude, longitude, altitude = (np.broadcast_to(a, leading).copy()[()] for a in place[:3])
    still, body = np.zeros((*leading, 3)), np.broadcast_to(place[3], (*leading, 4)).copy()
    return Navigation(latitude, longitude, altitude, still, body)


def navigate(
    start: Navigation,
    increments: Increments,
    *,
    every: int = 2,
    hold_altitude: bool = False,
) -> Navigation:
    """Propagate a navigation state along the increments of gyros and accelerometers.

    Parameters
    ----------
    start : Navigation
        State before the first increment, leading axes (...); those of each part broadcast.
    increments : Increments
        Arrays of shape (..., n, 3), whose leading axes broadcast against those of the start, over
        intervals of at most 20 s. They must be true integrals, as from integrating sensors.
    every : int
        Number of increments between two results; even, because a step is made of two, and a divisor
        of n.
    hold_altitude : bool
        Whether to reset altitude and vertical velocity to the start's altitude and to zero every 40
        seconds, as a barometer would, and in all results. Without such aid a computed altitude
        diverges within an hour.

    Returns
    -------
    Navigation
        States (..., n // every), one after each `every` increments; `final_state` takes the last.

    Raises
    ------
    ValueError
        If shapes do not fit, n is odd or not a multiple of `every`, the start is at a pole, inside
        the Earth or past the Moon, or something is faster than light.

    Warns
    -----
    UnusualWarning
        If the increments of velocity are not such as gravity makes, 1.2 to 50 m/s^2 on the average:
        they may have been exchanged with the angles, or be accelerations. In free fall it is meant.

    See Also
    --------
    driftlab.calibration.mission_errors : How errors grow, in closed form.

    Notes
    -----
    Gravity is that of `driftlab.earth.gravity`, with its North component above the ellipsoid.

    References
    ----------
    - P. G. Savage, *Strapdown inertial navigation integration algorithm design, part 2: Velocity
      and position algorithms*, Journal of Guidance, Control, and Dynamics 21(2), 1998.
    - P. D. Groves, *Principles of GNSS, Inertial, and Multisensor Integrated Navigation Systems*,
      2nd edition, Artech House, 2013.

    Examples
    --------
    A unit that stands still for a minute, given what ideal sensors measure, stays where it is:

    >>> from driftlab.earth import earth_rate, gravity
    >>> latitude, interval = np.radians(45.0), 0.5
    >>> turned = np.tile(interval * earth_rate(latitude), (120, 1))
    >>> pushed = np.tile([0.0, 0.0, interval * float(gravity(latitude))], (120, 1))
    >>> still = Increments(interval, turned, pushed)
    >>> end = final_state(navigate(stationary_state(latitude, [0, 0, 0, 1]), still))
    >>> bool(np.abs(end.velocity).max() < 1e-5)
    True
    """
    start = _checked(start)
    interval, angle, velocity = checked_increments(increments)
    seconds = checked_interval(interval)
    speed_of_body(velocity, "increments.velocity")
    common_leading_axes(
        **{
            f"start.{name}": part.shape[: part.ndim - (name in ("velocity", "attitude"))]
            for name, part in start._asdict().items()
        },
        **{"increments.angle": angle.shape[:-2], "increments.velocity": velocity.shape[:-2]},
    )
    count = angle.shape[-2]
    if count % 2:
        raise ValueError(f"increments: expected an even number of rows, got {count}.")
    truth_value(hold_altitude, "hold_altitude")
    each = whole_number(every, "every", least=2)
    if each % 2 or count % each:
        raise ValueError(
            f"every: expected an even divisor of the number of increments, {count}, "
            f"got {shown(every)}."
        )
    increments_of_velocity(velocity, seconds, "increments.velocity")
    return loops.navigate(
        start, angle, velocity, seconds, ALGORITHM, every=each, hold_altitude=hold_altitude
    )


def checked_interval(interval: float) -> float:
    """Return the interval of increments, s, refusing one too long for the navigation to settle."""
    seconds = finite_number(interval, "interval")
    if not 0 < seconds <= _LONGEST:
        raise ValueError(
            f"increments.interval: expected a positive time of at most {_LONGEST:g} s, "
            f"got {shown(interval)}."
        )
    return seconds


def _checked(state: Navigation) -> Navigation:
    """Return the state as arrays, refusing what is not one by the name of the field."""
    checked_instance(state, Navigation, "start")
    latitude = finite_array(state.latitude, "start.latitude")
    longitude = finite_array(state.longitude, "start.longitude")
    altitude = finite_array(state.altitude, "start.altitude")
    velocity = finite_array(state.velocity, "start.velocity", 3)
    attitude = unit_quaternions(state.attitude, "start.attitude")
    if not np.abs(altitude).max() <= _HIGHEST:  # the inner Earth is refused on the way
        raise ValueError(
            f"start.altitude: expected m, at most {_HIGHEST:g} in size, got {altitude.min():g} to "
            f"{altitude.max():g}."
        )
    speed_of_body(velocity, "start.velocity")
    return Navigation(checked_latitude(latitude), longitude, altitude, velocity, attitude)

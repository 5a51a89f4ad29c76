"""Errors of an inertial unit beyond bias and matrix: size effect, time skew, g^2, g-sensitivity.

`ImuErrors` is linear in what one sensor feels at one moment. These four are what a calibration on a
table meets next; each is linear in its own constants.

- Size effect: accelerometer i sits at the inner lever arm r_i from the point that the table turns
  about, and feels
  ``(w' × r_i + w × (w × r_i))_i`` besides.
- Time skew: the accelerometers' readings are late by tau against the gyros', and the body has
  turned meanwhile: ``tau w × f``. The specific force is taken to be fixed to the local axes.
- Quadratic: ``K2 f^2``, each accelerometer by itself.
- g-sensitivity: a gyro feels ``G f``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .checks import FloatArray, checked_instance, finite_arrays
from .core.lever_arms import lever_matrices


class HigherOrderErrors(NamedTuple):
    """Errors that bias and matrix do not describe; SI units, leading axes (...).

    A triad measures ``(I + K)(true + what is felt besides) + bias``.

    Attributes
    ----------
    lever_arms : ndarray, shape (..., 3, 3)
        Row i: from the point that the unit turns about, its navigation point, to accelerometer i;
        body axes, m.
    time_skew : ndarray, shape (...)
        By how much the accelerometers' readings are late against the gyros', s. It is tGA of
        PSINS, in sign and size.
    accelerometer_quadratic : ndarray, shape (..., 3)
        K2 of each accelerometer, s^2/m.
    gyro_g_sensitivity : ndarray, shape (..., 3, 3)
        G: row i is the gyro's, (rad/s)/(m/s^2).

    Notes
    -----
    Of the nine components of the arms, a shift common to all three accelerometers is the place of
    the unit on the table. Where the table's centre stands still it counts, and shows in the
    velocity while the table turns; at rest it shows no more. In flight there is no such
    point, and only the differences of the arms matter: a common shift chooses another point of the
    vehicle to navigate. PSINS sets the arm of accelerometer z to zero and has six numbers left.

    Examples
    --------
    >>> arms = NO_HIGHER_ORDER_ERRORS._replace(lever_arms=0.03 * np.eye(3))  # each on its own axis
    >>> arms.lever_arms[0]
    array([0.03, 0.  , 0.  ])
    """

    lever_arms: FloatArray
    time_skew: FloatArray
    accelerometer_quadratic: FloatArray
    gyro_g_sensitivity: FloatArray


NO_HIGHER_ORDER_ERRORS = HigherOrderErrors(
    np.zeros((3, 3)), np.zeros(()), np.zeros(3), np.zeros((3, 3))
)
"""A unit that has biases and error matrices only."""
for _array in NO_HIGHER_ORDER_ERRORS:
    _array.setflags(write=False)


def checked_higher_order_errors(higher_order: HigherOrderErrors) -> HigherOrderErrors:
    """Return higher-order errors as arrays whose leading axes are broadcast to each other."""
    checked_instance(higher_order, HigherOrderErrors, "higher_order")
    arms, skew, quadratic, sensitivity = finite_arrays(
        lever_arms=(higher_order.lever_arms, 3, 3),
        time_skew=(higher_order.time_skew,),
        accelerometer_quadratic=(higher_order.accelerometer_quadratic, 3),
        gyro_g_sensitivity=(higher_order.gyro_g_sensitivity, 3, 3),
    )
    lead = np.broadcast_shapes(
        arms.shape[:-2], skew.shape, quadratic.shape[:-1], sensitivity.shape[:-2]
    )
    return HigherOrderErrors(
        np.broadcast_to(arms, (*lead, 3, 3)),
        np.broadcast_to(skew, lead),
        np.broadcast_to(quadratic, (*lead, 3)),
        np.broadcast_to(sensitivity, (*lead, 3, 3)),
    )


def rate_changes(interval: float, angle: FloatArray) -> FloatArray:
    """Change of the angular rate over each interval, from angle increments alone.

    Parameters
    ----------
    interval : float
        s.
    angle : ndarray, shape (..., n, 3)
        Angle increments, rad.

    Returns
    -------
    ndarray, shape (..., n, 3)
        rad/s.

    Notes
    -----
    The rate between two intervals is taken as the mean of their mean rates. In smooth motion the
    error is of second order in the interval. A table that jumps from rest to its rate divides the
    jump between the intervals on either side; none of it is lost, and the changes of a record add
    up to the difference of its last and its first mean rate.

    Examples
    --------
    >>> rate_changes(0.5, np.array([[0, 0, 0], [0, 0, 0], [0, 0, 0.1], [0, 0, 0.1]]))[:, 2]
    array([0. , 0.1, 0.1, 0. ])
    """
    mean_rate = angle / interval
    between = 0.5 * (mean_rate[..., 1:, :] + mean_rate[..., :-1, :])
    edges = np.concatenate([mean_rate[..., :1, :], between, mean_rate[..., -1:, :]], axis=-2)
    return np.diff(edges, axis=-2)


def felt_besides(
    interval: float,
    angle: FloatArray,
    velocity: FloatArray,
    higher_order: HigherOrderErrors,
    rate_change: FloatArray | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Increments that the sensors report besides the true ones.

    Parameters
    ----------
    interval : float
        s.
    angle, velocity : ndarray, shape (..., n, 3)
        True increments, rad and m/s.
    higher_order : HigherOrderErrors
        Their leading axes broadcast against those of the increments.
    rate_change : ndarray, shape (..., n, 3), optional
        `rate_changes` of the record that the increments are part of; of these increments alone if
        not given.

    Returns
    -------
    angle, velocity : ndarray, shape (..., n, 3)
        rad and m/s.

    Examples
    --------
    Accelerometers a millisecond late, on a unit that turns at 0.1 rad/s about x:

    >>> late = NO_HIGHER_ORDER_ERRORS._replace(time_skew=np.array(1e-3))
    >>> _, more = felt_besides(1.0, np.array([[0.1, 0, 0]]), np.array([[0, 0, 10.0]]), late)
    >>> more
    array([[ 0.   , -0.001,  0.   ]])
    """
    if rate_change is None:
        rate_change = rate_changes(interval, angle)
    arms, skew, quadratic, sensitivity = higher_order
    # Accelerometer i feels component i of what acts at its own place.
    more = (lever_matrices(interval, angle, rate_change) * arms[..., np.newaxis, :, :]).sum(-1)
    more += skew[..., np.newaxis, np.newaxis] * np.cross(angle, velocity) / interval
    more += quadratic[..., np.newaxis, :] * velocity**2 / interval
    return velocity @ sensitivity.swapaxes(-1, -2), more

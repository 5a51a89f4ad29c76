"""Errors of an inertial unit beyond bias and matrix: size effect, time skew, g^2, g-sensitivity.

`ImuErrors` is linear in what one sensor feels at one moment. These are what a calibration on a
table meets next; each is linear in its own constants.

- Size effect: accelerometer i sits at the inner lever arm r_i from the point that the table turns
  about, and also feels ``(w' × r_i + w × (w × r_i))_i``.
- Time skew: the accelerometers' readings are late by tau against the gyros', and the body has
  turned meanwhile: ``tau w × f``. The specific force is taken to be fixed to the local axes.
- Quadratic: ``K2 f^2``, each accelerometer by itself.
- g-sensitivity: a gyro feels ``G f``.
- Scale-factor asymmetry (IEEE Std 528): the scale factors for positive and negative input differ
  by 2 a, so a sensor also feels ``a |w|`` or ``a |f|``. The integral of ``|w|`` over an interval
  is the size of the angle, unless w changes its sign there: then the effect comes out too small, by
  2 a times the angle turned in the rarer direction. Vibration within an interval does not count.
  The components are those in body axes; along a sensor's own axis the effect differs by a times
  its installation error.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from .checks import FloatArray, checked_instance, finite_arrays, some_of
from .core.vectors import cross_matrix

_NONE = np.zeros(3)
_NONE.setflags(write=False)


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
    gyro_scale_factor_asymmetry, accelerometer_scale_factor_asymmetry : ndarray, shape (..., 3)
        a of each sensor: half of how much its scale factor for positive input exceeds that for
        negative input, without unit.

    Notes
    -----
    A shift common to all three arms is the position of the unit on the table, and shows in the
    velocity while the table turns. In flight only the differences of the arms matter: a common
    shift chooses another point of the vehicle to navigate. PSINS sets the arm of accelerometer z to
    zero and has six numbers left.

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
    gyro_scale_factor_asymmetry: FloatArray = _NONE
    accelerometer_scale_factor_asymmetry: FloatArray = _NONE


class _Term(NamedTuple):
    """One kind of error: all that names, states, priors, simulation, filter and JSON follow from.

    Three sensors have constants of their own, or share one. The effect is what a constant of one
    adds to each sensor's increment, rad or m/s: an array (..., n, 3), or (..., n, 3, 3) if each
    sensor has three constants. It takes intervals (..., n, 1), s, and increments of angle and
    velocity and changes of the rate (..., n, 3); a bias would have the effect ``times``.
    """

    field: str  # of `HigherOrderErrors`
    shape: tuple[int, ...]  # of that field: (3, 3), (3,) or ()
    unit: str
    states: str  # beginning of their names; the first word is the sensor
    prior: str  # field of `driftlab.imu.PriorStandardDeviations`
    effect: Callable[[FloatArray, FloatArray, FloatArray, FloatArray], FloatArray]

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the states."""
        ends = [""]
        for _ in self.shape:
            ends = [end + axis for end in ends for axis in "xyz"]
        return tuple(f"{self.states} {end}".rstrip() for end in ends)

    def rows(
        self, times: FloatArray, angle: FloatArray, velocity: FloatArray, change: FloatArray
    ) -> FloatArray:
        """The effect (..., n, 3, k) of k constants of each sensor."""
        rows = self.effect(times[..., np.newaxis], angle, velocity, change)
        return rows if len(self.shape) == 2 else rows[..., np.newaxis]


def _lever_matrices(times: FloatArray, angle: FloatArray, change: FloatArray) -> FloatArray:
    """Matrices (..., n, 3, 3) that give the velocity gained at an arm r: ``[w' ×] + [w ×][w ×]``.

    The rate within an interval counts as constant in the second part: an error of second order.
    """
    turned = cross_matrix(angle)
    return cross_matrix(change) + turned @ turned / times[..., np.newaxis]


TERMS = MappingProxyType({
    "lever arms": _Term(
        field="lever_arms",
        shape=(3, 3),
        unit="m",
        states="accelerometer lever arm",
        prior="lever_arm",
        effect=lambda times, angle, velocity, change: _lever_matrices(times, angle, change),
    ),
    "time skew": _Term(
        field="time_skew",
        shape=(),
        unit="s",
        states="accelerometer time skew",
        prior="time_skew",
        effect=lambda times, angle, velocity, change: np.cross(angle, velocity) / times,
    ),
    "accelerometer quadratic": _Term(
        field="accelerometer_quadratic",
        shape=(3,),
        unit="s^2/m",
        states="accelerometer quadratic",
        prior="accelerometer_quadratic",
        effect=lambda times, angle, velocity, change: velocity**2 / times,
    ),
    "gyro g-sensitivity": _Term(
        field="gyro_g_sensitivity",
        shape=(3, 3),
        unit="(rad/s)/(m/s^2)",
        states="gyro g-sensitivity",
        prior="gyro_g_sensitivity",
        effect=lambda times, angle, velocity, change: velocity[..., np.newaxis, :].repeat(3, -2),
    ),
    "gyro scale-factor asymmetry": _Term(
        field="gyro_scale_factor_asymmetry",
        shape=(3,),
        unit="1",
        states="gyro scale-factor asymmetry",
        prior="scale_factor_asymmetry",
        effect=lambda times, angle, velocity, change: np.abs(angle),
    ),
    "accelerometer scale-factor asymmetry": _Term(
        field="accelerometer_scale_factor_asymmetry",
        shape=(3,),
        unit="1",
        states="accelerometer scale-factor asymmetry",
        prior="scale_factor_asymmetry",
        effect=lambda times, angle, velocity, change: np.abs(velocity),
    ),
})  # fmt: skip
"""The errors, by the names that `driftlab.calibration.error_model.ErrorModel.with_states` knows."""

NO_HIGHER_ORDER_ERRORS = HigherOrderErrors(
    **{term.field: np.zeros(term.shape) for term in TERMS.values()}
)
"""A unit that has biases and error matrices only."""
for _array in NO_HIGHER_ORDER_ERRORS:
    _array.setflags(write=False)


def checked_terms(chosen: tuple[str, ...]) -> tuple[str, ...]:
    """Return chosen errors in the order of `TERMS`, each once, refusing unknown names."""
    some_of(chosen, TERMS, "states")
    return tuple(name for name in TERMS if name in chosen)


def checked_higher_order_errors(higher_order: HigherOrderErrors) -> HigherOrderErrors:
    """Return higher-order errors as arrays whose leading axes are broadcast to each other."""
    checked_instance(higher_order, HigherOrderErrors, "higher_order")
    terms = TERMS.values()
    arrays = finite_arrays(
        **{term.field: (getattr(higher_order, term.field), *term.shape) for term in terms}
    )
    lead = _lead(arrays)
    return HigherOrderErrors(
        **{term.field: np.broadcast_to(each, (*lead, *term.shape))
           for each, term in zip(arrays, terms, strict=True)}
    )  # fmt: skip


def _lead(errors: Iterable[FloatArray]) -> tuple[int, ...]:
    """Common leading axes of errors in the order of `TERMS`."""
    shapes = (each.shape[: each.ndim - len(term.shape)]
              for each, term in zip(errors, TERMS.values(), strict=True))  # fmt: skip
    return np.broadcast_shapes(*shapes)


def _rate_changes(interval: float, angle: FloatArray) -> FloatArray:
    """Changes (..., n, 3) of the angular rate over intervals, rad/s, from angle increments alone.

    The rate between two intervals is taken as the mean of their mean rates: in smooth motion an
    error of second order. A table that jumps from rest to its rate divides the jump between the
    intervals on either side, and none of it is lost.
    """
    mean_rate = angle / interval
    between = 0.5 * (mean_rate[..., 1:, :] + mean_rate[..., :-1, :])
    edges = np.concatenate([mean_rate[..., :1, :], between, mean_rate[..., -1:, :]], axis=-2)
    return np.diff(edges, axis=-2)


def higher_order_effects(
    interval: float,
    angle: FloatArray,
    velocity: FloatArray,
    higher_order: HigherOrderErrors,
    rate_change: FloatArray | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Increments that the sensors report in addition to the true ones.

    Parameters
    ----------
    interval : float
        s.
    angle, velocity : ndarray, shape (..., n, 3)
        True increments, rad and m/s.
    higher_order : HigherOrderErrors
        Their leading axes broadcast against those of the increments.
    rate_change : ndarray, shape (..., n, 3), optional
        Change of the angular rate over each interval, rad/s; found from `angle` if not given.

    Returns
    -------
    angle, velocity : ndarray, shape (..., n, 3)
        rad and m/s.

    Examples
    --------
    Accelerometers a millisecond late, on a unit that turns at 0.1 rad/s about x:

    >>> late = NO_HIGHER_ORDER_ERRORS._replace(time_skew=np.array(1e-3))
    >>> _, more = higher_order_effects(1.0, np.array([[0.1, 0, 0]]), np.array([[0, 0, 10.0]]), late)
    >>> more
    array([[ 0.   , -0.001,  0.   ]])
    """
    if rate_change is None:
        rate_change = _rate_changes(interval, angle)
    times = np.full(angle.shape[-2:-1], interval)
    lead = _lead(getattr(higher_order, term.field) for term in TERMS.values())
    shape = np.broadcast_shapes((*lead, 1, 1), angle.shape, velocity.shape)
    felt = {"gyro": np.zeros(shape), "accelerometer": np.zeros(shape)}
    for term in TERMS.values():
        constants = getattr(higher_order, term.field)
        if constants.any():
            own = constants.shape[: constants.ndim - len(term.shape)]
            each = constants.reshape(*own, 1, *term.shape, *[1] * (2 - len(term.shape)))
            rows = term.rows(times, angle, velocity, rate_change)
            felt[term.states.split()[0]] += (rows * each).sum(-1)
    return felt["gyro"], felt["accelerometer"]

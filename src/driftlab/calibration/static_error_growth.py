"""How the errors of an inertial navigator at rest grow: closed forms, modes and curves.

Wu (6) and the position, for a unit whose altitude is held. Seven errors and five constant sensor
biases make twelve causes. The attitude error counted from the axes of the *computed* place only
turns with the Earth; the position is a pendulum of Schuler's, on a turning Earth one of Foucault's,
which that attitude drives. So four rates occur: zero, the Earth's, and two beside Schuler's.

Signs as in `driftlab.calibration.error_model`: the computed attitude is ``(I - [phi×]) C``, an
error is computed minus true, and a bias is true minus assumed.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    checked_instance,
    finite_array,
    finite_number,
    unit_quaternions,
)
from driftlab.core.quaternion import rotate
from driftlab.earth import EARTH_RATE, checked_latitude, curvature_radii, earth_rate, gravity
from driftlab.imu import ImuErrors
from driftlab.increments import compensate, measure
from driftlab.motion.turntable import static_trajectory

from .body_axes import attitude_error
from .error_dynamics import _free_rates
from .static_navigation import StaticNavigationErrors


def checked_moments(times: ArrayLike) -> FloatArray:
    """Times (k,) in s as one row of its own, refusing anything else."""
    moments = np.array(finite_array(times, "times"))
    if moments.ndim != 1:
        raise ValueError(f"times: expected shape (k,), got shape {moments.shape}.")
    return moments


STATIC_ERROR_SOURCES = (
    *(f"attitude {axis}" for axis in ("East", "North", "Up")),
    *(f"velocity {axis}" for axis in ("East", "North")),
    *(f"position {axis}" for axis in ("East", "North")),
    *(f"gyro bias {axis}" for axis in ("East", "North", "Up")),
    *(f"accelerometer bias {axis}" for axis in ("East", "North")),
)
"""What makes a unit at rest err: seven errors at the start, in rad, m/s and m, which are also the
states; three biases of gyros in rad/s; two of accelerometers in m/s^2. All in local axes."""


class StaticErrorModes(NamedTuple):
    """Errors at rest as sums of a constant, a line and three oscillations.

    Matrices (7, 12) take causes, in the order of `STATIC_ERROR_SOURCES`, to the seven states.

    Attributes
    ----------
    rates : StaticErrorRates
        Of the oscillations.
    matrix : ndarray, shape (7, 12)
        Of the linear error equations: the states' rates from states and sensor biases.
    standing : ndarray, shape (7, 12)
    growing : ndarray, shape (7, 12)
        What is multiplied by the time.
    cosine, sine : ndarray, shape (3, 7, 12)
        Amplitudes at each of the rates.

    Examples
    --------
    >>> static_error_modes(0.7).at([0.0]).shape
    (5, 1, 7, 12)
    """

    rates: StaticErrorRates
    matrix: FloatArray
    standing: FloatArray
    growing: FloatArray
    cosine: FloatArray
    sine: FloatArray

    def at(self, times: ArrayLike) -> FloatArray:
        """Matrices (5, k, 7, 12) from causes to states at times (k,), s, for each mode.

        The modes are: standing, growing, Earth, slow Schuler, fast Schuler; their sum is the whole.
        """
        time = checked_moments(times)[:, np.newaxis, np.newaxis]
        phases = [rate * time for rate in self.rates]
        return np.stack(
            [
                np.broadcast_to(self.standing, (len(time), *self.standing.shape)),
                self.growing * time,
                *(
                    cosine * np.cos(phase) + sine * np.sin(phase)
                    for phase, cosine, sine in zip(phases, self.cosine, self.sine, strict=True)
                ),
            ]
        )


def _matrix(latitude: float) -> FloatArray:
    """Matrix (7, 12) of the linear error equations at rest: states' rates from states and biases.

    Wu (6): phi' = -w_ie × phi + dw_in - eps, dv' = f × phi - 2 w_ie × dv + nabla, and the position
    is the integral of the velocity. dw_in contains both the turn of the local axes along a wrong
    velocity and the Earth's rate at a wrong latitude.
    """
    place = float(checked_latitude(finite_number(latitude, "latitude")))
    meridian, _ = curvature_radii(place)
    matrix = np.zeros((7, 12))
    phi, velocity, position = slice(0, 3), slice(3, 5), slice(5, 7)
    matrix[:5, :5] = _free_rates(place)[:5, :5]  # without the velocity Up
    matrix[phi, 6] = np.array([0, -np.sin(place), np.cos(place)]) * EARTH_RATE / meridian
    matrix[phi, 7:10] = -np.eye(3)
    matrix[velocity, phi] = float(gravity(place)) * np.array([[0, -1, 0], [1, 0, 0]])
    matrix[velocity, 10:12] = np.eye(2)
    matrix[position, velocity] = np.eye(2)
    return matrix


def static_error_modes(latitude: float) -> StaticErrorModes:
    """Solve the error equations at rest, exactly, as a sum of modes.

    Parameters
    ----------
    latitude : float
        rad; not a pole.

    Returns
    -------
    StaticErrorModes
        With the rates of the oscillations, and the matrix of the equations, Wu (6).

    Notes
    -----
    With the biases as constant states the matrix A satisfies
    A^2 (A^2 + U^2)(A^2 + w_1^2)(A^2 + w_2^2) = 0. So the square of A has four simple
    eigenvalues, and Lagrange's product P_j projects on each; exp(A t) is P_j (cos w_j t) +
    A P_j (sin w_j t)/w_j, summed over them, and P_0 (1 + A t) for the zero.

    Examples
    --------
    The two Schuler modes of a North tilt of 1 rad move the position by a radius of the Earth to
    both sides:

    >>> modes = static_error_modes(np.radians(45.0))
    >>> tilt = STATIC_ERROR_SOURCES.index("attitude North")
    >>> radius = modes.cosine[1:, 5, tilt].sum()
    >>> f"{radius / 1e6:.2f}"
    '6.38'

    Their periods, and the Earth's, in minutes:

    >>> [round(2 * np.pi / rate / 60, 1) for rate in modes.rates]
    [1436.1, 88.0, 81.0]
    """
    rates = _rates(latitude)
    # Errors in units of their own swing: angles, Schuler's rate times the radius, the radius.
    radius = float(gravity(latitude)) / rates.schuler**2
    sizes = np.repeat(
        [1.0, rates.schuler * radius, radius, rates.schuler, rates.schuler**2 * radius],
        [3, 2, 2, 3, 2],
    )
    whole = np.zeros((12, 12))
    whole[:7] = matrix = _matrix(latitude)
    scaled = whole * (sizes / sizes[:, np.newaxis]) / rates.schuler
    square = scaled @ scaled
    eigenvalues = -((np.array([0.0, *rates]) / rates.schuler) ** 2)
    parts = []
    for j, value in enumerate(eigenvalues):
        part = np.eye(12)
        for other in np.delete(eigenvalues, j):
            part = part @ (square - other * np.eye(12)) / (value - other)
        parts.append(part)
    back = sizes[:7, np.newaxis] / sizes
    still, *swinging = (part[:7] * back for part in parts)
    growing, *moving = (rates.schuler * (scaled @ part)[:7] * back for part in parts)
    sine = [part / rate for part, rate in zip(moving, rates, strict=True)]
    return StaticErrorModes(rates, matrix, still, growing, np.stack(swinging), np.stack(sine))


class StaticErrorRates(NamedTuple):
    """Rates at which errors at rest oscillate.

    Attributes
    ----------
    earth : float
        The Earth's: a day, rad/s.
    slow, fast : float
        Schuler's pair, split by the Earth's turn under the pendulum, rad/s.
    """

    earth: float
    slow: float
    fast: float

    @property
    def schuler(self) -> float:
        """Geometric mean of the pair: Schuler's rate, sqrt(g/R), rad/s."""
        return float(np.sqrt(self.slow * self.fast))

    @property
    def foucault(self) -> float:
        """Half the difference of the pair, near U times the sine of the latitude, rad/s."""
        return (self.fast - self.slow) / 2


def _rates(latitude: float) -> StaticErrorRates:
    """Rates of the oscillations in the errors at rest.

    The characteristic equation is s (s^2 + U^2) times that of the pendulum,
    s^4 + s^2 (w_E^2 + w_N^2 + 4 U^2 sin^2 L) + w_E^2 w_N^2 = 0, with U the Earth's rate and
    w_E^2 = g/R_E, w_N^2 = g/R_N of the two radii of curvature.
    """
    place = checked_latitude(finite_number(latitude, "latitude"))
    pull = float(gravity(place))
    squares = [pull / float(radius) for radius in curvature_radii(place)]
    vertical = EARTH_RATE * float(np.sin(place))
    both = sum(squares) + 4 * vertical**2
    product = squares[0] * squares[1]
    larger = (both + np.sqrt(both**2 - 4 * product)) / 2
    return StaticErrorRates(EARTH_RATE, float(np.sqrt(product / larger)), float(np.sqrt(larger)))


def static_error_sources(
    imu_errors: ImuErrors,
    estimated: ImuErrors,
    attitude: ArrayLike,
    *,
    start: ArrayLike,
    reference: ArrayLike,
    latitude: float,
) -> FloatArray:
    """Causes of the errors at rest of a calibrated unit.

    Parameters
    ----------
    imu_errors, estimated : ImuErrors
        The true errors (...), in the axes of `attitude`, and those that are compensated (...).
    attitude : array_like or Rotation, shape (4,)
        True attitude of the unit, body to East, North, Up.
    start, reference : array_like or Rotation, shape (..., 4)
        Attitude with which the computation begins, and that from which errors count.
    latitude : float
        rad; not a pole.

    Returns
    -------
    ndarray, shape (..., 12)
        In the order of `STATIC_ERROR_SOURCES`. The biases are all that the compensated sensors show
        beside the Earth's rate and gravity in the axes of `reference`, so scale and installation
        errors are in them, and the distance of the reference from the unit's own axes.

    Examples
    --------
    An East accelerometer whose bias was found but for 10 micro-g:

    >>> from driftlab.imu import NO_ERRORS
    >>> unit = NO_ERRORS._replace(accelerometer_bias=np.array([1e-4, 0, 0]))
    >>> level = [0.0, 0.0, 0.0, 1.0]
    >>> sources = static_error_sources(
    ...     unit, NO_ERRORS, level, start=level, reference=level, latitude=0.7
    ... )
    >>> print(STATIC_ERROR_SOURCES[10], float(sources[10].round(6)))
    accelerometer bias East 0.0001
    """
    axes = unit_quaternions(reference, "reference")
    still = static_trajectory(attitude, latitude, 1.0, 2)
    checked_instance(estimated, ImuErrors, "estimated")
    believed = unit_quaternions(start, "start")
    sensed = compensate(measure(still.increments, imu_errors), estimated)
    rate, force = (rotate(axes, row.mean(axis=-2)) for row in (sensed.angle, sensed.velocity))
    push = force - np.array([0.0, 0.0, float(gravity(latitude))])
    tilt = attitude_error(believed, axes)
    lead = np.broadcast_shapes(tilt.shape, rate.shape)[:-1]
    parts = (tilt, np.zeros(4), rate - earth_rate(latitude), push[..., :2])
    return np.concatenate(
        [np.broadcast_to(part, (*lead, part.shape[-1])) for part in parts], axis=-1
    )


def static_errors(
    times: ArrayLike, latitude: float, error_sources: ArrayLike
) -> StaticNavigationErrors:
    """Errors of a navigator at rest from their sources: the exact solution of the linear equations.

    Parameters
    ----------
    times : array_like, shape (k,)
        Since the start, s.
    latitude : float
        rad; not a pole.
    error_sources : array_like, shape (..., 12)
        Errors at the start and sensor biases, in the order of `STATIC_ERROR_SOURCES`.

    Returns
    -------
    StaticNavigationErrors
        As `navigate_static` gives them, but for what is of second order.

    Examples
    --------
    Position error in km after four hours with an East gyro bias of 0.01 deg/h:

    >>> sources = np.zeros(12)
    >>> sources[STATIC_ERROR_SOURCES.index("gyro bias East")] = np.radians(0.01) / 3600
    >>> errors = static_errors([4 * 3600.0], np.radians(37.5), sources)
    >>> (errors.position[0] / 1e3).round(1)
    array([-1.4, -3.8])
    """
    given = finite_array(error_sources, "error_sources", len(STATIC_ERROR_SOURCES))
    moments = checked_moments(times)
    states = np.einsum(
        "kij,...j->...ki", static_error_modes(latitude).at(moments).sum(axis=0), given
    )
    return StaticNavigationErrors(moments, states[..., :3], states[..., 3:5], states[..., 5:7])


def schuler_position_error(
    times: ArrayLike, latitude: float, error_sources: ArrayLike
) -> FloatArray:
    """Position errors as textbooks approximate them: one pendulum, and an Earth that hardly turns.

    Parameters
    ----------
    times, latitude, error_sources : array_like, float, array_like
        As for `static_errors`; few hours.

    Returns
    -------
    ndarray, shape (..., k, 2)
        East and North, m.

    Notes
    -----
    With w Schuler's rate and R = g/w^2, a tilt gives R (1 - cos wt), a velocity sin wt / w, an
    accelerometer bias (1 - cos wt)/w^2, a level gyro bias R (t - sin wt / w). An azimuth error
    acts as a gyro bias U cos L along East, and a vertical bias as one that grows with the time.
    What is left out is of relative size U t, and Foucault's.

    Examples
    --------
    The same bias as in `static_errors`, after forty minutes and after four hours:

    >>> sources = np.zeros(12)
    >>> sources[STATIC_ERROR_SOURCES.index("gyro bias East")] = np.radians(0.01) / 3600
    >>> times, latitude = [2400.0, 14400.0], np.radians(37.5)
    >>> exact = static_errors(times, latitude, sources).position[:, 1]
    >>> (schuler_position_error(times, latitude, sources)[:, 1] / exact).round(2)
    array([1.01, 1.21])
    """
    place = float(checked_latitude(finite_number(latitude, "latitude")))
    given = finite_array(error_sources, "error_sources", len(STATIC_ERROR_SOURCES))
    time = checked_moments(times)
    rate = _rates(place).schuler
    radius = float(gravity(place)) / rate**2
    level = EARTH_RATE * np.cos(place)
    swing, lag = 1 - np.cos(rate * time), time - np.sin(rate * time) / rate
    tilt_e, tilt_n, azimuth, v_e, v_n, east, north, *biases = (
        column[..., np.newaxis] for column in np.moveaxis(given, -1, 0)
    )
    drift_e, drift_n, drift_u, push_e, push_n = biases
    turned = drift_u * level * radius * (time**2 / 2 - swing / rate**2)
    position = (
        east - radius * tilt_n * swing + v_e * np.sin(rate * time) / rate
        + push_e * swing / rate**2 + radius * drift_n * lag,
        north + radius * tilt_e * swing + v_n * np.sin(rate * time) / rate
        + push_n * swing / rate**2 - radius * (drift_e + level * azimuth) * lag + turned,
    )  # fmt: skip
    return np.stack(position, axis=-1)

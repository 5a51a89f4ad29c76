"""How the errors of an inertial navigator at rest grow: closed forms, mode by mode.

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

from driftlab.checks import FloatArray, finite_number
from driftlab.earth import EARTH_RATE, checked_latitude, curvature_radii, gravity

from ._moments import checked_moments
from .error_dynamics import free_rates
from .schuler_pair import StaticErrorRates, static_error_rates

STATIC_CAUSES = (
    *(f"attitude {axis}" for axis in ("East", "North", "Up")),
    *(f"velocity {axis}" for axis in ("East", "North")),
    *(f"position {axis}" for axis in ("East", "North")),
    *(f"gyro bias {axis}" for axis in ("East", "North", "Up")),
    *(f"accelerometer bias {axis}" for axis in ("East", "North")),
)
"""What makes a unit at rest err: seven errors at the start, in rad, m/s and m, which are also the
states; three biases of gyros in rad/s; two of accelerometers in m/s^2. All in local axes."""

STATIC_MODES = ("standing", "growing", "Earth", "slow Schuler", "fast Schuler")
"""What the errors are made of: constants, lines, and oscillations at three rates."""


class StaticErrorModes(NamedTuple):
    """Errors at rest as sums of a constant, a line and three oscillations.

    Matrices (7, 12) take causes, in the order of `STATIC_CAUSES`, to the seven states.

    Attributes
    ----------
    rates : StaticErrorRates
    standing : ndarray, shape (7, 12)
    growing : ndarray, shape (7, 12)
        What is multiplied by the time.
    cosine, sine : ndarray, shape (3, 7, 12)
        Amplitudes at each of the rates.

    Examples
    --------
    In the long run gyro biases about North and Up, here of 0.01 deg/h, lead East, in m/h:

    >>> modes = static_error_modes(np.radians(45.0))
    >>> (np.radians(0.01) * modes.growing[5, 7:10]).round() + 0.0
    array([  0., 558., 558.])
    """

    rates: StaticErrorRates
    standing: FloatArray
    growing: FloatArray
    cosine: FloatArray
    sine: FloatArray

    def at(self, times: ArrayLike) -> FloatArray:
        """Matrices from causes to states, for each mode; their sum is the whole.

        Parameters
        ----------
        times : array_like, shape (k,)
            Since the start, s.

        Returns
        -------
        ndarray, shape (5, k, 7, 12)
            In the order of `STATIC_MODES`.

        Examples
        --------
        At the beginning there is nothing but the errors of the start:

        >>> at_start = static_error_modes(0.7).at([0.0]).sum(axis=0)[0]
        >>> np.diag(at_start).round(9)
        array([1., 1., 1., 1., 1., 1., 1.])
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


def static_error_matrix(latitude: float) -> FloatArray:
    """Matrix of the linear error equations at rest: states' rates from states and sensor biases.

    Parameters
    ----------
    latitude : float
        rad; not a pole.

    Returns
    -------
    ndarray, shape (7, 12)
        Rows are the seven states, columns `STATIC_CAUSES`.

    Notes
    -----
    Wu (6): phi' = -w_ie × phi + dw_in - eps, dv' = f × phi - 2 w_ie × dv + nabla, and the position
    is the integral of the velocity. dw_in contains both the turn of the local axes along a wrong
    velocity and the Earth's rate at a wrong latitude.

    Examples
    --------
    A tilt of 1 rad about North pushes to the West with g:

    >>> matrix = static_error_matrix(np.radians(45.0))
    >>> round(float(matrix[3, STATIC_CAUSES.index("attitude North")]), 3)
    -9.806
    """
    place = float(checked_latitude(finite_number(latitude, "latitude")))
    meridian, _ = curvature_radii(place)
    matrix = np.zeros((7, 12))
    phi, velocity, position = slice(0, 3), slice(3, 5), slice(5, 7)
    matrix[:5, :5] = free_rates(place)[:5, :5]  # without the velocity Up
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
    >>> tilt = STATIC_CAUSES.index("attitude North")
    >>> radius = modes.cosine[1:, 5, tilt].sum()
    >>> f"{radius / 1e6:.2f}"
    '6.38'
    """
    rates = static_error_rates(latitude)
    # Errors in units of their own swing: angles, Schuler's rate times the radius, the radius.
    radius = float(gravity(latitude)) / rates.schuler**2
    sizes = np.repeat(
        [1.0, rates.schuler * radius, radius, rates.schuler, rates.schuler**2 * radius],
        [3, 2, 2, 3, 2],
    )
    whole = np.zeros((12, 12))
    whole[:7] = static_error_matrix(latitude)
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
    return StaticErrorModes(rates, still, growing, np.stack(swinging), np.stack(sine))

"""Which errors a calibration solves for, and how they grow; Wu (6), (45)-(52).

The state is: attitude error phi and velocity error dv (East, North, Up), gyro biases and gyro
matrix, accelerometer biases and accelerometer matrix. All 24 numbers of a unit make 30 states, of
which three directions cannot be seen. A choice of body axes takes three numbers out: 27 states.

Signs: the computed attitude is ``(E - [phi×]) C``, an error is computed minus true, and what is
left in the sensors after compensation is true minus assumed.
"""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from .checks import FloatArray, unit_quaternions
from .earth import curvature_radii, earth_rate
from .installation import BODY_FRAMES, misalignment_vector, skew_matrix
from .quaternion import rotate
from .sensors import Noise, Spread, Unit

AXES = "xyz"
LOCAL_AXES = ("East", "North", "Up")
_DIAGONAL = [(i, i) for i in range(3)]
_UPPER = [(0, 1), (0, 2), (1, 2)]
_LOWER = [(1, 0), (2, 0), (2, 1)]
_OFF_DIAGONAL = [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)]


@dataclass(frozen=True, eq=False)
class ErrorModel:
    """The states of one filter.

    Attributes
    ----------
    frame : str or None
        The choice of body axes, one of `BODY_FRAMES`; None for all 30 states.
    gyro_basis, accelerometer_basis : ndarray, shape (m, 3, 3)
        The matrices whose multiples add up to K and L.
    names : tuple of str
        What each state is.
    """

    frame: str | None
    gyro_basis: FloatArray
    accelerometer_basis: FloatArray
    names: tuple[str, ...]

    @property
    def size(self) -> int:
        """Number of states."""
        return len(self.names)

    def unit(self, state: FloatArray) -> Unit:
        """Sensor errors that a state (..., size) says."""
        middle = 9 + len(self.gyro_basis)
        return Unit(
            state[..., 6:9],
            np.tensordot(state[..., 9:middle], self.gyro_basis, 1),
            state[..., middle : middle + 3],
            np.tensordot(state[..., middle + 3 :], self.accelerometer_basis, 1),
        )

    def state(self, unit: Unit) -> FloatArray:
        """State (..., size) of sensor errors in the model's own body axes; attitude, velocity 0."""
        coefficients = [
            # The matrices of a basis have no entries in common.
            np.tensordot(matrix, basis, ([-2, -1], [1, 2])) / (basis**2).sum(axis=(1, 2))
            for matrix, basis in (
                (unit.gyro_error, self.gyro_basis),
                (unit.accelerometer_error, self.accelerometer_basis),
            )
        ]
        parts = [unit.gyro_bias, coefficients[0], unit.accelerometer_bias, coefficients[1]]
        parts = [np.zeros(6), *parts]
        leading = np.broadcast_shapes(*(part.shape[:-1] for part in parts))
        whole = [np.broadcast_to(part, (*leading, part.shape[-1])) for part in parts]
        return np.concatenate(whole, axis=-1)

    def reduction(self, attitude: ArrayLike) -> FloatArray:
        """Matrix (size, 30) from all states, in any body axes, to those of this model.

        `attitude` (4,) is that of the body at the time of the states: turning the body axes changes
        the attitude error as well. To first order.
        """
        body_to_local = attitude_matrix(unit_quaternions(attitude, "attitude"))
        states = np.eye(FULL.size)
        unit = FULL.unit(states)
        small = np.zeros((FULL.size, 3))
        if self.frame is not None:
            small = misalignment_vector(unit.gyro_error, unit.accelerometer_error, self.frame)
        turn = skew_matrix(small)
        reduced = self.state(
            unit._replace(
                gyro_error=unit.gyro_error - turn,
                accelerometer_error=unit.accelerometer_error - turn,
            )
        )
        reduced[:, :6] = states[:, :6]
        reduced[:, :3] -= small @ body_to_local.T
        return reduced.T

    def covariance(self, spread: Spread, attitude: ArrayLike) -> FloatArray:
        """Covariance (size, size) of the states before a calibration that starts in `attitude`.

        The 24 errors are independent in the axes of the table; what that means in the model's axes
        follows. So filters for different axes are told the same.
        """
        diagonal = [spread.scale] * 3 + [spread.installation] * 6
        sizes = np.concatenate(
            [
                [spread.attitude] * 3,
                [0.0] * 3,
                [spread.gyro_bias] * 3,
                diagonal,
                [spread.accelerometer_bias] * 3,
                diagonal,
            ]
        )
        half = self.reduction(attitude) * sizes
        return half @ half.T


def attitude_matrix(attitude: FloatArray) -> FloatArray:
    """Matrix (..., 3, 3) from body to local components of an attitude quaternion (..., 4)."""
    return np.swapaxes(rotate(attitude[..., np.newaxis, :], np.eye(3)), -1, -2)


def free_growth(latitude: float, duration: ArrayLike) -> FloatArray:
    """Transition (..., 6, 6) of attitude and velocity errors without sensor errors and force.

    What is left of Wu (6) on a table at rest at a `latitude` in rad, over a `duration` (...) in s
    much shorter than a day: the local axes turn with the Earth, a velocity error turns them as
    well, and there is Coriolis's force.
    """
    earth = earth_rate(latitude)
    meridian, across = curvature_radii(latitude)
    rates = np.zeros((6, 6))
    rates[:3, :3] = -skew_matrix(earth)
    rates[0, 4] = -1 / meridian
    rates[1:3, 3] = 1 / across, np.tan(latitude) / across
    rates[3:, 3:] = -2 * skew_matrix(earth)
    change = np.asarray(duration)[..., np.newaxis, np.newaxis] * rates
    square = change @ change
    return np.eye(6) + change + square / 2 + square @ change / 6


def transition(
    model: ErrorModel,
    free: FloatArray,
    attitude: FloatArray,
    times: FloatArray,
    angle: FloatArray,
    velocity: FloatArray,
    passed: FloatArray,
) -> FloatArray:
    """Transition matrix (..., size, size) of the errors over an interval; Wu (49), (50).

    What arises within the interval grows on as if it had been there from the beginning: an error
    of the order of the Earth's turn in that time.

    Parameters
    ----------
    model : ErrorModel
    free : ndarray, shape (..., 6, 6)
        `free_growth` over the interval.
    attitude : ndarray, shape (..., n, 3, 3)
        Body axes at n places in the interval, to the local axes of its *beginning*.
    times, angle, velocity : ndarray, shapes (..., n), (..., n, 3), (..., n, 3)
        Shares of the integrals over the interval that stand for the n places: of time (s), of the
        angular rate (rad) and of the specific force (m/s) in body axes.
    passed : ndarray, shape (n, n)
        How much of each share (column) has passed at each place (row).
    """
    gyro = slice(6, 9 + len(model.gyro_basis))
    accelerometer = slice(gyro.stop, model.size)
    tilts = attitude @ _effects(model.gyro_basis, times, angle)
    pushes = attitude @ _effects(model.accelerometer_basis, times, velocity)
    force = skew_matrix((attitude @ velocity[..., np.newaxis])[..., 0])
    tilted = (passed @ tilts.reshape(*tilts.shape[:-2], -1)).reshape(tilts.shape)
    moved = np.zeros((*angle.shape[:-2], 6, model.size))
    moved[..., :6] = np.eye(6)
    moved[..., 3:, :3] = force.sum(axis=-3)
    moved[..., :3, gyro] = -tilts.sum(axis=-3)
    moved[..., 3:, gyro] = -(force @ tilted).sum(axis=-3)
    moved[..., 3:, accelerometer] = pushes.sum(axis=-3)
    matrix = np.empty((*angle.shape[:-2], model.size, model.size))
    matrix[..., 6:, :] = np.eye(model.size)[6:]
    matrix[..., :6, :] = free @ moved
    return matrix


def transition_of_increments(
    model: ErrorModel,
    free: FloatArray,
    attitude: FloatArray,
    angle_increments: FloatArray,
    velocity_increments: FloatArray,
    interval: float,
) -> FloatArray:
    """Transition matrix (..., size, size) of the errors while a unit navigates for a short time.

    Parameters
    ----------
    model, free
        As in `transition`; `free` for the whole time.
    attitude : ndarray, shape (..., n + 1, 4)
        Computed attitudes before and after each pair of increments.
    angle_increments, velocity_increments : ndarray, shape (..., 2 n, 3)
        What the attitudes were computed from: increments without the errors known so far.
    interval : float
        Of one increment, s.
    """
    matrices = attitude_matrix(attitude)
    # Local axes turn by an arc second or so in a second; here they count as fixed.
    middle = 0.5 * (matrices[..., :-1, :, :] + matrices[..., 1:, :, :])
    angle = angle_increments[..., 0::2, :] + angle_increments[..., 1::2, :]
    velocity = velocity_increments[..., 0::2, :] + velocity_increments[..., 1::2, :]
    count = angle.shape[-2]
    # In the middle of a pair, half of it has passed.
    passed = np.tri(count) - 0.5 * np.eye(count)
    times = np.full(count, 2 * interval)
    return transition(model, free, middle, times, angle, velocity, passed)


def _effects(basis: FloatArray, times: FloatArray, values: FloatArray) -> FloatArray:
    """Errors (..., n, 3, 3 + m) in body axes per unit of the three biases and m coefficients."""
    effects = np.empty((*values.shape, 3 + len(basis)))
    effects[..., :3] = times[..., np.newaxis, np.newaxis] * np.eye(3)
    effects[..., 3:] = np.tensordot(values, basis, ([-1], [2])).swapaxes(-1, -2)
    return effects


def process_noise(noise: Noise, force: FloatArray, duration: FloatArray, size: int) -> FloatArray:
    """Covariance (..., size, size) that white sensor noise adds in `duration` (...) in s.

    `force` (..., 3, 3) carries an attitude error at the beginning into the velocity, m/s: a block
    of the transition matrix. It does so with the random walk of the attitude as well.
    """
    covariance = np.zeros((*force.shape[:-2], size, size))
    seconds = duration[..., np.newaxis, np.newaxis]
    tilt = noise.angle_random_walk**2 * seconds
    covariance[..., :3, :3] = tilt * np.eye(3)
    transposed = np.swapaxes(force, -1, -2)
    covariance[..., 3:6, :3] = tilt / 2 * force
    covariance[..., :3, 3:6] = tilt / 2 * transposed
    own = noise.velocity_random_walk**2 * seconds * np.eye(3)
    covariance[..., 3:6, 3:6] = own + tilt / 3 * force @ transposed
    return covariance


def _units(places: list[tuple[int, int]]) -> FloatArray:
    """Matrices (m, 3, 3) with a one at each of the places."""
    basis = np.zeros((len(places), 3, 3))
    for matrix, place in zip(basis, places, strict=True):
        matrix[place] = 1.0
    return basis


def _named(kind: str, places: list[tuple[int, int]]) -> list[str]:
    return [f"{kind} {AXES[i]}" if i == j else f"{kind} {AXES[i]}{AXES[j]}" for i, j in places]


def _model(
    frame: str | None,
    gyro: list[tuple[int, int]],
    accelerometer: list[tuple[int, int]],
    symmetric: bool = False,
) -> ErrorModel:
    basis = _units(_DIAGONAL + gyro)
    if symmetric:
        basis[3:] += np.swapaxes(basis[3:], -1, -2)
    names = [f"{kind} {axis}" for kind in ("attitude", "velocity") for axis in LOCAL_AXES]
    for sensor, places, rest in (
        ("gyro", gyro, "non-orthogonality" if symmetric else "installation"),
        ("accelerometer", accelerometer, "installation"),
    ):
        names += [f"{sensor} bias {axis}" for axis in AXES]
        names += _named(f"{sensor} scale", _DIAGONAL) + _named(f"{sensor} {rest}", places)
    other = _units(_DIAGONAL + accelerometer)
    for shared in (basis, other):
        shared.setflags(write=False)
    return ErrorModel(frame, basis, other, tuple(names))


FULL = _model(None, _OFF_DIAGONAL, _OFF_DIAGONAL)
"""All 24 sensor errors, 30 states."""

ERROR_MODELS = MappingProxyType({
    "averaged": _model("averaged", _UPPER, _OFF_DIAGONAL, symmetric=True),
    "upper triangle": _model("upper triangle", _LOWER, _OFF_DIAGONAL),
    "lower triangle": _model("lower triangle", _UPPER, _OFF_DIAGONAL),
    "accelerometers": _model("accelerometers", _OFF_DIAGONAL, _LOWER),
})  # fmt: skip
"""The four choices of body axes, 27 states each."""


def error_model(name: str) -> ErrorModel:
    """Return the error model of a choice of body axes, refusing unknown names."""
    if name not in ERROR_MODELS:
        raise ValueError(f"frame: expected one of {', '.join(BODY_FRAMES)}, got {name!r}.")
    return ERROR_MODELS[name]

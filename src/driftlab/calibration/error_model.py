"""Which errors a calibration solves for: Wu (45)-(48), and three more for what cannot be seen.

The state is: attitude error phi and velocity error dv (East, North, Up), gyro biases and gyro
matrix, accelerometer biases and accelerometer matrix. All 24 numbers of a unit make 30 states, of
which three directions cannot be seen. A choice of body axes takes three numbers out: 27 states.

Signs: the computed attitude is ``(E - [phi×]) C``, a velocity error is computed minus true, and
what is left in the sensors after compensation is true minus assumed.
"""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from driftlab.checks import FloatArray, finite_arrays, unit_quaternions
from driftlab.core.quaternion import conjugate, multiply, to_matrix, to_rotation_vector
from driftlab.core.vectors import cross_matrix
from driftlab.imu import Spread, Unit
from driftlab.triad import BODY_FRAMES, misalignment_vector

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
        body_to_local = to_matrix(unit_quaternions(attitude, "attitude"))
        states = np.eye(FULL.size)
        unit = FULL.unit(states)
        small = np.zeros((FULL.size, 3))
        if self.frame is not None:
            small = misalignment_vector(unit.gyro_error, unit.accelerometer_error, self.frame)
        turn = cross_matrix(small)
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


def error_model_for(name: str) -> ErrorModel:
    """Return the error model of a choice of body axes, refusing unknown names."""
    if not isinstance(name, str) or name not in ERROR_MODELS:
        raise ValueError(f"frame: expected one of {', '.join(BODY_FRAMES)}, got {name!r}.")
    return ERROR_MODELS[name]


def attitude_of_axes(attitude: ArrayLike, rotation: FloatArray) -> FloatArray:
    """Attitude (..., 4) of turned body axes: `rotation` (..., 3, 3) leads to their components."""
    back = np.array(np.swapaxes(rotation, -1, -2))  # a copy: SciPy 1.14 takes no read-only array
    turned = Rotation.from_matrix(back.reshape(-1, 3, 3)).as_quat().reshape(*back.shape[:-2], 4)
    return multiply(unit_quaternions(attitude, "attitude"), turned)


def attitude_error(computed: ArrayLike, true: ArrayLike) -> FloatArray:
    """Error phi of a computed attitude: the computed axes are (E - [phi×]) C.

    Parameters
    ----------
    computed, true : array_like, shape (..., 4)
        Unit quaternions, body to East, North, Up.

    Returns
    -------
    ndarray, shape (..., 3)
        rad about East, North, Up.

    Examples
    --------
    >>> attitude_error([0, 0, -0.5e-3, 1], [0, 0, 0, 1]).round(6)
    array([-0.   , -0.   ,  0.001])
    """
    computed, true = finite_arrays(computed=(computed, 4), true=(true, 4))
    return -to_rotation_vector(multiply(computed, conjugate(true)))

"""States of a calibration filter: Wu (45)-(48), and three more that are unobservable.

Attitude error phi and velocity error dv (East, North, Up), biases and matrix of the gyros, then of
the accelerometers: 30 states. A choice of body axes removes three numbers: 27 states.

Signs: the computed attitude is ``(I - [phi×]) C``, a velocity error is computed minus true, and a
sensor error that remains after compensation is true minus assumed.
"""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from driftlab.body_frames import BODY_FRAMES, misalignment_vector
from driftlab.checks import FloatArray, unit_quaternions
from driftlab.core.quaternion import to_matrix
from driftlab.core.vectors import cross_matrix
from driftlab.imu import ImuErrors, PriorDeviations

AXES = "xyz"
LOCAL_AXES = ("East", "North", "Up")
_DIAGONAL = [(i, i) for i in range(3)]
_UPPER = [(0, 1), (0, 2), (1, 2)]
_LOWER = [(1, 0), (2, 0), (2, 1)]
_OFF_DIAGONAL = [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)]


@dataclass(frozen=True, eq=False)
class ErrorModel:
    """States of a calibration filter, and the sensor errors that they describe.

    Attributes
    ----------
    frame : str or None
        The choice of body axes, one of `driftlab.body_frames.BODY_FRAMES`; None for all 30 states.
    gyro_basis, accelerometer_basis : ndarray, shape (m, 3, 3)
        Basis matrices: K (gyros) and L (accelerometers) are their linear combinations.
    names : tuple of str
        Name of each state, in order.

    Examples
    --------
    >>> model = ERROR_MODELS["averaged"]
    >>> model.size, model.names[12]
    (27, 'gyro non-orthogonality xy')
    """

    frame: str | None
    gyro_basis: FloatArray
    accelerometer_basis: FloatArray
    names: tuple[str, ...]

    @property
    def size(self) -> int:
        """Number of states.

        Returns
        -------
        int
            27, or 30 for the model of all states.

        Examples
        --------
        >>> ERROR_MODELS["upper triangle"].size, FULL.size
        (27, 30)
        """
        return len(self.names)

    def imu_errors(self, state: FloatArray) -> ImuErrors:
        """Sensor errors that a state vector describes.

        Parameters
        ----------
        state : ndarray, shape (..., size)
            Its attitude and velocity errors are ignored.

        Returns
        -------
        ImuErrors
            Biases (..., 3) in rad/s and m/s^2 and error matrices (..., 3, 3), in the model's own
            body axes.

        Examples
        --------
        The off-diagonal states of averaged axes are symmetric in the gyros' matrix:

        >>> model = ERROR_MODELS["averaged"]
        >>> model.imu_errors(np.arange(27.0)).gyro_error
        array([[ 9., 12., 13.],
               [12., 10., 14.],
               [13., 14., 11.]])
        """
        middle = 9 + len(self.gyro_basis)
        return ImuErrors(
            state[..., 6:9],
            _combined(state[..., 9:middle], self.gyro_basis),
            state[..., middle : middle + 3],
            _combined(state[..., middle + 3 :], self.accelerometer_basis),
        )

    def state(self, imu_errors: ImuErrors) -> FloatArray:
        """State vector of given sensor errors, with attitude and velocity errors zero.

        Parameters
        ----------
        imu_errors : ImuErrors
            Sensor errors (...) in the model's own body axes. Whatever part of a matrix is outside
            the span of the model's basis is dropped.

        Returns
        -------
        ndarray, shape (..., size)
            In the order of `names`; SI units.

        Examples
        --------
        >>> from driftlab.imu import TYPICAL_ERRORS
        >>> state = FULL.state(TYPICAL_ERRORS)
        >>> again = FULL.imu_errors(state)
        >>> state.shape, bool(np.allclose(again.gyro_error, TYPICAL_ERRORS.gyro_error))
        ((30,), True)
        """
        of_gyros, of_accelerometers = (
            # The matrices of a basis have no entries in common.
            np.tensordot(matrix, basis, ([-2, -1], [1, 2])) / (basis**2).sum(axis=(1, 2))
            for matrix, basis in (
                (imu_errors.gyro_error, self.gyro_basis),
                (imu_errors.accelerometer_error, self.accelerometer_basis),
            )
        )
        parts = [np.zeros(6), imu_errors.gyro_bias, of_gyros]
        parts += [imu_errors.accelerometer_bias, of_accelerometers]
        lead = np.broadcast_shapes(*(part.shape[:-1] for part in parts))
        return np.concatenate([np.broadcast_to(x, (*lead, x.shape[-1])) for x in parts], axis=-1)

    def reduction(self, attitude: ArrayLike) -> FloatArray:
        """Matrix from all 30 states, in any body axes, to the states of this model.

        Parameters
        ----------
        attitude : array_like, shape (4,)
            Of the body at the time of the states, body to East, North, Up: a rotation of the body
            axes changes the attitude error as well.

        Returns
        -------
        ndarray, shape (size, 30)
            To first order in the errors.

        Examples
        --------
        Both triads rotated together by 1 about z is, in the model's axes, an attitude error alone:

        >>> turned = np.zeros(FULL.size)
        >>> for sensor in ("gyro", "accelerometer"):
        ...     turned[FULL.names.index(f"{sensor} installation yx")] = 1.0
        ...     turned[FULL.names.index(f"{sensor} installation xy")] = -1.0
        >>> model = ERROR_MODELS["averaged"]
        >>> reduced = model.reduction([0, 0, 0, 1]) @ turned
        >>> {model.names[i]: float(reduced[i]) for i in np.flatnonzero(reduced)}
        {'attitude Up': -1.0}
        """
        body_to_local = to_matrix(unit_quaternions(attitude, "attitude"))
        states = np.eye(FULL.size)
        imu_errors = FULL.imu_errors(states)
        small = np.zeros((FULL.size, 3))
        if self.frame is not None:
            small = misalignment_vector(
                imu_errors.gyro_error, imu_errors.accelerometer_error, self.frame
            )
        turn = cross_matrix(small)
        reduced = self.state(
            imu_errors._replace(
                gyro_error=imu_errors.gyro_error - turn,
                accelerometer_error=imu_errors.accelerometer_error - turn,
            )
        )
        reduced[:, :6] = states[:, :6]
        reduced[:, :3] -= small @ body_to_local.T
        return reduced.T

    def covariance(self, prior: PriorDeviations, attitude: ArrayLike) -> FloatArray:
        """Covariance of the states before a calibration.

        The 24 sensor errors are independent in the axes of the table, and the covariance in the
        model's axes follows. So filters with different axes start from the same prior.

        Parameters
        ----------
        prior : PriorDeviations
            Standard deviations of the sensor errors and of the initial attitude.
        attitude : array_like, shape (4,)
            At the start of the calibration, body to East, North, Up.

        Returns
        -------
        ndarray, shape (size, size)
            In the units of the states, squared.

        Examples
        --------
        An off-diagonal state of averaged axes is the mean of two independent entries:

        >>> model, prior = ERROR_MODELS["averaged"], PriorDeviations(installation=1e-4)
        >>> covariance = model.covariance(prior, [0, 0, 0, 1])
        >>> f"{np.sqrt(covariance[12, 12]):.3e}"
        '7.071e-05'
        """
        matrix = [prior.scale] * 3 + [prior.installation] * 6
        sizes = [prior.attitude] * 3 + [0.0] * 3
        sizes += [prior.gyro_bias] * 3 + matrix + [prior.accelerometer_bias] * 3 + matrix
        half = self.reduction(attitude) * np.array(sizes)
        return half @ half.T


def _combined(coefficients: FloatArray, basis: FloatArray) -> FloatArray:
    """Matrices (..., 3, 3) with m coefficients (..., m) in a basis (m, 3, 3)."""
    matrices: FloatArray = coefficients @ basis.reshape(-1, 9)
    return matrices.reshape(*coefficients.shape[:-1], 3, 3)


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
    symmetric: str | None = None,
) -> ErrorModel:
    """Model with off-diagonal states at these places; a `symmetric` triad has their mirror too."""
    names = [f"{kind} {axis}" for kind in ("attitude", "velocity") for axis in LOCAL_AXES]
    bases = []
    for sensor, places in (("gyro", gyro), ("accelerometer", accelerometer)):
        basis = _units(_DIAGONAL + places)
        rest = "installation"
        if sensor == symmetric:
            basis[3:] += np.swapaxes(basis[3:], -1, -2)
            rest = "non-orthogonality"
        basis.setflags(write=False)
        bases.append(basis)
        names += [f"{sensor} bias {axis}" for axis in AXES]
        names += _named(f"{sensor} scale", _DIAGONAL) + _named(f"{sensor} {rest}", places)
    return ErrorModel(frame, bases[0], bases[1], tuple(names))


FULL = _model(None, _OFF_DIAGONAL, _OFF_DIAGONAL)
"""All 24 sensor errors, 30 states."""

ERROR_MODELS = MappingProxyType({
    "averaged": _model("averaged", _UPPER, _OFF_DIAGONAL, symmetric="gyro"),
    "upper triangle": _model("upper triangle", _LOWER, _OFF_DIAGONAL),
    "lower triangle": _model("lower triangle", _UPPER, _OFF_DIAGONAL),
    "accelerometers": _model("accelerometers", _OFF_DIAGONAL, _LOWER),
    "averaged accelerometers": _model(
        "averaged accelerometers", _OFF_DIAGONAL, _UPPER, symmetric="accelerometer"
    ),
})  # fmt: skip
"""The five choices of body axes, 27 states each."""


def error_model_for(name: str) -> ErrorModel:
    """Return the error model of a choice of body axes.

    Parameters
    ----------
    name : str
        One of `driftlab.body_frames.BODY_FRAMES`.

    Returns
    -------
    ErrorModel
        Of 27 states.

    Raises
    ------
    ValueError
        If the name is unknown.

    Examples
    --------
    >>> error_model_for("lower triangle").names[12:15]
    ('gyro installation xy', 'gyro installation xz', 'gyro installation yz')
    """
    if not isinstance(name, str) or name not in ERROR_MODELS:
        raise ValueError(f"frame: expected one of {', '.join(BODY_FRAMES)}, got {name!r}.")
    return ERROR_MODELS[name]

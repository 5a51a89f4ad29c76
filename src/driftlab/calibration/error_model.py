"""States of a calibration filter: Wu (45)-(48), three more that are unobservable, and others.

Attitude error phi and velocity error dv (East, North, Up), biases and matrix of the gyros, then of
the accelerometers: 30 states. A choice of body axes removes three numbers: 27 states. By choice
there are lever arms and others behind them (`ErrorModel.with_states`).

Signs: the computed attitude is ``(I - [phi×]) C``, a velocity error is computed minus true, and a
sensor error that remains after compensation is true minus assumed.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from threading import Lock
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from driftlab.body_frames import misalignment_vector
from driftlab.checks import (
    FloatArray,
    checked_instance,
    finite_array,
    one_quaternion,
    shown,
)
from driftlab.core.quaternion import to_matrix
from driftlab.core.vectors import cross_matrix
from driftlab.higher_order_errors import (
    NO_HIGHER_ORDER_ERRORS,
    TERMS,
    HigherOrderErrors,
    checked_higher_order_errors,
    checked_terms,
)
from driftlab.imu import ImuErrors, PriorStandardDeviations, checked_imu_errors
from driftlab.increments import Increments, _without_errors

AXES = "xyz"
DIAGONAL = [(i, i) for i in range(3)]
UPPER = [(0, 1), (0, 2), (1, 2)]
LOWER = [(1, 0), (2, 0), (2, 1)]
OFF_DIAGONAL = [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)]


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
    """Names of the entries at the places."""
    return [f"{kind} {AXES[i]}" if i == j else f"{kind} {AXES[i]}{AXES[j]}" for i, j in places]


def _unpacked(values: FloatArray, chosen: tuple[str, ...]) -> HigherOrderErrors:
    """Errors (...) of states (..., m); zero for those that are not chosen."""
    fields, begin = {}, 0
    for term in (TERMS[name] for name in chosen):
        end = begin + len(term.names)
        fields[term.field] = values[..., begin:end].reshape((*values.shape[:-1], *term.shape))
        begin = end
    return NO_HIGHER_ORDER_ERRORS._replace(**fields)


def _packed(higher_order: HigherOrderErrors, chosen: tuple[str, ...]) -> FloatArray:
    """States (..., m) of errors (...)."""
    errors = checked_higher_order_errors(higher_order)
    lead = errors.time_skew.shape
    parts = [getattr(errors, TERMS[name].field).reshape(*lead, -1) for name in chosen]
    return np.concatenate([np.zeros((*lead, 0)), *parts], axis=-1)


def _prior_standard_deviations(
    prior: PriorStandardDeviations, chosen: tuple[str, ...]
) -> FloatArray:
    """Standard deviations (m,) of the states before a calibration."""
    terms = [TERMS[name] for name in chosen]
    return np.array([getattr(prior, term.prior) for term in terms for _ in term.names])


_ONE_AT_A_TIME = Lock()
_LOCAL_AXES = ("East", "North", "Up")


@dataclass(frozen=True, eq=False)
class ErrorModel:
    """Error model of a calibration filter: its states, body axes and prior.

    Attributes
    ----------
    frame : str or None
        The choice of body axes, one of `driftlab.body_frames.BODY_FRAMES`; None for all 30 states.
    gyro_basis, accelerometer_basis : ndarray, shape (m, 3, 3)
        Basis matrices: K (gyros) and L (accelerometers) are their linear combinations.
    names : tuple of str
        Name of each state, in order.
    higher_order : tuple of str
        Errors whose states stand behind those of the triads; see `with_states`.

    Examples
    --------
    >>> model = ERROR_MODELS["averaged"].with_states("time skew")
    >>> model.size, model.names[12], model.names[27]
    (28, 'gyro non-orthogonality xy', 'accelerometer time skew')
    >>> state = np.arange(28.0)
    >>> errors, more = model.imu_errors(state), model.higher_order_errors(state)
    >>> bool((model.state(errors, more)[6:] == state[6:]).all())
    True
    >>> level = [0.0, 0.0, 0.0, 1.0]
    >>> model.reduction(level).shape, model.covariance(PriorStandardDeviations(), level).shape
    ((28, 30), (28, 28))
    """

    frame: str | None
    gyro_basis: FloatArray
    accelerometer_basis: FloatArray
    names: tuple[str, ...]
    higher_order: tuple[str, ...] = ()

    def __repr__(self) -> str:
        axes = "any body axes" if self.frame is None else f"axes {self.frame!r}"
        more = f", with {', '.join(self.higher_order)}" if self.higher_order else ""
        return f"<ErrorModel of {self.size} states, {axes}{more}>"

    @property
    def size(self) -> int:
        """Number of states: 27, or 30 for the model of all states; more with states by choice."""
        return len(self.names)

    @property
    def triad_states(self) -> int:
        """Number of states before those of higher order: 27 or 30."""
        return 12 + len(self.gyro_basis) + len(self.accelerometer_basis)

    def imu_errors(self, state: ArrayLike) -> ImuErrors:
        """Sensor errors (...) of states (..., size) in the model's own body axes, SI units."""
        return self._imu_errors(finite_array(state, "state", self.size))

    def _imu_errors(self, state: FloatArray) -> ImuErrors:
        """`imu_errors` of a state that is computed, whatever has become of it."""
        middle = 9 + len(self.gyro_basis)
        return ImuErrors(  # nothing of the state itself, which who reads it could change
            state[..., 6:9].copy(),
            _combined(state[..., 9:middle], self.gyro_basis),
            state[..., middle : middle + 3].copy(),
            _combined(state[..., middle + 3 : self.triad_states], self.accelerometer_basis),
        )

    def higher_order_errors(self, state: ArrayLike) -> HigherOrderErrors:
        """Return what states (..., size) say of the errors of higher order, SI units."""
        return self._higher_order_errors(finite_array(state, "state", self.size))

    def _higher_order_errors(self, state: FloatArray) -> HigherOrderErrors:
        return _unpacked(state[..., self.triad_states :].copy(), self.higher_order)

    def _corrected(
        self, measured: Increments, state: FloatArray, rate_change: FloatArray | None = None
    ) -> Increments:
        """Increments (..., n, 3) without the errors of a state (..., size); see
        `driftlab.increments._without_errors`."""
        more = self._higher_order_errors(state) if self.higher_order else None
        return _without_errors(measured, self._imu_errors(state), more, rate_change)

    def state(
        self, imu_errors: ImuErrors, higher_order: HigherOrderErrors | None = None
    ) -> FloatArray:
        """States (..., size) of sensor errors (...) in the model's own body axes, SI units.

        Attitude and velocity errors are zero, and what the model has no states for is dropped.
        """
        imu_errors = checked_imu_errors(imu_errors)
        of_gyros, of_accelerometers = (
            # The matrices of a basis have no entries in common.
            np.tensordot(matrix, basis, ([-2, -1], [1, 2])) / (basis**2).sum(axis=(1, 2))
            for matrix, basis in (
                (imu_errors.gyro_error_matrix, self.gyro_basis),
                (imu_errors.accelerometer_error_matrix, self.accelerometer_basis),
            )
        )
        parts = [np.zeros(6), imu_errors.gyro_bias, of_gyros]
        parts += [imu_errors.accelerometer_bias, of_accelerometers]
        more = NO_HIGHER_ORDER_ERRORS if higher_order is None else higher_order
        parts.append(_packed(more, self.higher_order))
        lead = np.broadcast_shapes(*(part.shape[:-1] for part in parts))
        return np.concatenate([np.broadcast_to(x, (*lead, x.shape[-1])) for x in parts], axis=-1)

    def with_states(self, *groups: str) -> ErrorModel:
        """Return this model with states for some of `driftlab.higher_order_errors.TERMS`."""
        chosen = checked_terms((*self.higher_order, *groups))
        if chosen == self.higher_order:
            return self
        with _ONE_AT_A_TIME:  # models are told apart as objects; two threads would make two of one
            return _with_states(self, chosen)

    def reduction(self, attitude: ArrayLike) -> FloatArray:
        """Matrix (size, 30) from all states, in any body axes, to those of this model; first order.

        A rotation of the body axes changes the attitude error as well, so it depends on the
        `attitude`.
        """
        body_to_local = to_matrix(one_quaternion(attitude, "attitude"))
        states = np.eye(FULL.size)
        imu_errors = FULL.imu_errors(states)
        small = np.zeros((FULL.size, 3))
        if self.frame is not None:
            small = misalignment_vector(
                imu_errors.gyro_error_matrix, imu_errors.accelerometer_error_matrix, self.frame
            )
        turn = cross_matrix(small)
        reduced = self.state(
            imu_errors._replace(
                gyro_error_matrix=imu_errors.gyro_error_matrix - turn,
                accelerometer_error_matrix=imu_errors.accelerometer_error_matrix - turn,
            )
        )
        reduced[:, :6] = states[:, :6]
        reduced[:, :3] -= small @ body_to_local.T
        return reduced.T

    def covariance(self, prior: PriorStandardDeviations, attitude: ArrayLike) -> FloatArray:
        """Covariance (size, size) of the states before a calibration, SI units, squared.

        The 24 sensor errors are independent in the axes of the table, and the covariance in the
        model's axes follows. So filters with different axes start from the same prior. Errors of
        higher order are independent of them.
        """
        checked_instance(prior, PriorStandardDeviations, "prior")
        matrix = [prior.scale_factor] * 3 + [prior.installation] * 6
        sizes = [prior.attitude] * 3 + [prior.velocity] * 3
        sizes += [prior.gyro_bias] * 3 + matrix + [prior.accelerometer_bias] * 3 + matrix
        half = self.reduction(attitude) * np.array(sizes)
        covariance = half @ half.T
        if self.higher_order:
            last = np.arange(self.triad_states, self.size)
            covariance[last, last] = _prior_standard_deviations(prior, self.higher_order) ** 2
        return covariance


@cache
def _with_states(model: ErrorModel, groups: tuple[str, ...]) -> ErrorModel:
    """Model with other groups of higher order; one object for each choice."""
    names = model.names[: model.triad_states]
    names += tuple(name for group in groups for name in TERMS[group].names)
    return replace(model, names=names, higher_order=groups)


def _model(
    frame: str | None,
    gyro: list[tuple[int, int]],
    accelerometer: list[tuple[int, int]],
    symmetric: str | None = None,
) -> ErrorModel:
    """Model with off-diagonal states at these places; a `symmetric` triad has their mirror too."""
    names = [f"{kind} {axis}" for kind in ("attitude", "velocity") for axis in _LOCAL_AXES]
    bases = []
    for sensor, places in (("gyro", gyro), ("accelerometer", accelerometer)):
        basis = _units(DIAGONAL + places)
        rest = "installation"
        if sensor == symmetric:
            basis[3:] += np.swapaxes(basis[3:], -1, -2)
            rest = "non-orthogonality"
        basis.setflags(write=False)
        bases.append(basis)
        names += [f"{sensor} bias {axis}" for axis in AXES]
        names += _named(f"{sensor} scale", DIAGONAL) + _named(f"{sensor} {rest}", places)
    return ErrorModel(frame, bases[0], bases[1], tuple(names))


FULL = _model(None, OFF_DIAGONAL, OFF_DIAGONAL)
"""All 24 sensor errors, 30 states."""


class _Named(dict[str, ErrorModel]):
    """Models by name, with a sentence for a name that is none."""

    def __missing__(self, name: object) -> ErrorModel:
        raise KeyError(f"expected one of {', '.join(self)}, got {shown(name)}.")


ERROR_MODELS = MappingProxyType(_Named({
    "averaged": _model("averaged", UPPER, OFF_DIAGONAL, symmetric="gyro"),
    "upper triangle": _model("upper triangle", LOWER, OFF_DIAGONAL),
    "lower triangle": _model("lower triangle", UPPER, OFF_DIAGONAL),
    "accelerometers": _model("accelerometers", OFF_DIAGONAL, LOWER),
    "averaged accelerometers": _model(
        "averaged accelerometers", OFF_DIAGONAL, UPPER, symmetric="accelerometer"
    ),
}))  # fmt: skip
"""The five choices of body axes, 27 states each."""

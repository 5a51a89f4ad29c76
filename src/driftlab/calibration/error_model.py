"""States of a calibration filter: Wu (45)-(48), three more that are unobservable, and others.

Attitude error phi and velocity error dv (East, North, Up), biases and matrix of the gyros, then of
the accelerometers: 30 states. A choice of body axes removes three numbers: 27 states. By choice
there are lever arms and others behind them (`ErrorModel.with_states`).

Signs: the computed attitude is ``(I - [phi×]) C``, a velocity error is computed minus true, and a
sensor error that remains after compensation is true minus assumed.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from threading import Lock
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from driftlab.body_frames import misalignment_vector
from driftlab.checks import FloatArray, checked_instance, one_of, one_quaternion, shown
from driftlab.core.quaternion import to_matrix
from driftlab.core.vectors import cross_matrix
from driftlab.imu import PriorDeviations

from . import _higher_order_states as higher
from ._state_layout import StateLayout
from ._triad_bases import (
    AXES as AXES,
    DIAGONAL,
    LOWER,
    OFF_DIAGONAL,
    UPPER,
    named,
    units,
)

_ONE_AT_A_TIME = Lock()
LOCAL_AXES = ("East", "North", "Up")


class ErrorModel(StateLayout):
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
        Groups of states behind those of the triads; see `with_states`.

    Examples
    --------
    >>> model = ERROR_MODELS["averaged"]
    >>> model.size, model.names[12]
    (27, 'gyro non-orthogonality xy')
    """

    def __repr__(self) -> str:
        axes = "any body axes" if self.frame is None else f"axes {self.frame!r}"
        more = f", with {', '.join(self.higher_order)}" if self.higher_order else ""
        return f"<ErrorModel of {self.size} states, {axes}{more}>"

    def with_states(self, *groups: str) -> ErrorModel:
        """Return this model with states that describe `HigherOrderErrors`.

        Parameters
        ----------
        *groups : str
            Some of "lever arms" (nine states), "time skew" (one), "accelerometer quadratic" (three)
            and "gyro g-sensitivity" (nine).

        Returns
        -------
        ErrorModel
            This very model if nothing is added; else one object for each choice of groups.

        Raises
        ------
        ValueError
            If there is no such group.

        Examples
        --------
        >>> larger = ERROR_MODELS["averaged"].with_states("time skew", "lever arms")
        >>> larger.size, larger.names[27], larger.names[-1]
        (37, 'accelerometer lever arm xx', 'accelerometer time skew')
        """
        chosen = higher.checked_groups((*self.higher_order, *groups))
        if chosen == self.higher_order:
            return self
        with _ONE_AT_A_TIME:  # models are told apart as objects; two threads would make two of one
            return _with_states(self, chosen)

    def reduction(self, attitude: ArrayLike) -> FloatArray:
        """Matrix from all 30 states, in any body axes, to the states of this model.

        Parameters
        ----------
        attitude : array_like or Rotation, shape (4,)
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
        body_to_local = to_matrix(one_quaternion(attitude, "attitude"))
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
        model's axes follows. So filters with different axes start from the same prior. Errors of
        higher order are independent of them.

        Parameters
        ----------
        prior : PriorDeviations
            Standard deviations of the sensor errors and of the initial attitude.
        attitude : array_like or Rotation, shape (4,)
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
        checked_instance(prior, PriorDeviations, "prior")
        matrix = [prior.scale] * 3 + [prior.installation] * 6
        sizes = [prior.attitude] * 3 + [0.0] * 3
        sizes += [prior.gyro_bias] * 3 + matrix + [prior.accelerometer_bias] * 3 + matrix
        half = self.reduction(attitude) * np.array(sizes)
        covariance = half @ half.T
        if self.higher_order:
            last = np.arange(self.triad_states, self.size)
            covariance[last, last] = higher.prior_deviations(prior, self.higher_order) ** 2
        return covariance


@cache
def _with_states(model: ErrorModel, groups: tuple[str, ...]) -> ErrorModel:
    """Model with other groups of higher order; one object for each choice."""
    names = model.names[: model.triad_states]
    names += tuple(name for group in groups for name in higher.GROUPS[group].names)
    return replace(model, names=names, higher_order=groups)


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
        basis = units(DIAGONAL + places)
        rest = "installation"
        if sensor == symmetric:
            basis[3:] += np.swapaxes(basis[3:], -1, -2)
            rest = "non-orthogonality"
        basis.setflags(write=False)
        bases.append(basis)
        names += [f"{sensor} bias {axis}" for axis in AXES]
        names += named(f"{sensor} scale", DIAGONAL) + named(f"{sensor} {rest}", places)
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
    one_of(name, ERROR_MODELS, "name")
    return ERROR_MODELS[name]

"""Observability along a rotation scheme: information and null directions.

It uses the filter's error model along the true motion of the table, without any data. A direction
of the state that has no effect on the velocity is a null direction of the observability Gramian.
"""

from __future__ import annotations

import warnings
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray, truth_value
from driftlab.core.quaternion import to_matrix
from driftlab.core.vectors import cross_matrix
from driftlab.imu import ImuErrors, PriorDeviations
from driftlab.motion.scheme import Scheme

from .error_model import AXES, ERROR_MODELS, FULL, ErrorModel
from .linearization import LinearizedErrors, checked_linearized, linearize_along


class UnobservableWarning(UserWarning):
    """Warning that a rotation scheme leaves some errors unobservable.

    Examples
    --------
    >>> from driftlab.calibration import linearize_along
    >>> from driftlab.motion.scheme import Scheme
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("ignore", UnobservableWarning)
    ...     warn_if_unobservable(linearize_along(Scheme(""), 0.7))
    """


def observability_matrix(linearized: LinearizedErrors) -> FloatArray:
    """Observability matrix: the velocity after each step as a function of the state at the start.

    Parameters
    ----------
    linearized : LinearizedErrors
        The error equations along the scheme.

    Returns
    -------
    ndarray, shape (3 s, size)
        East, North, Up of each step, weighted by the square root of its duration.

    Notes
    -----
    For the matrix O the Gramian is O^T O: the information on the state at the start if the velocity
    is measured continuously with noise of unit density, and no noise disturbs the sensors.

    Examples
    --------
    >>> from driftlab.calibration import linearize_along
    >>> from driftlab.motion.scheme import Scheme
    >>> observability_matrix(linearize_along(Scheme("+90Z", dwell=20.0), 0.7)).shape
    (36, 30)
    """
    checked_linearized(linearized)
    since, rows = np.eye(linearized.model.size), []
    for duration, matrix in zip(linearized.durations, linearized.transitions, strict=True):
        since = matrix @ since
        rows.append(np.sqrt(duration) * since[3:6])
    return np.concatenate(rows)


def gramian_ranks(
    scheme: Scheme | str,
    latitude: float,
    model: ErrorModel | str = FULL,
    *,
    pauses_only: bool = False,
) -> NDArray[np.int_]:
    """Rank of the observability Gramian after each position of a scheme.

    Parameters
    ----------
    scheme : Scheme or str
        Pauses and rotations.
    latitude : float
        Of the table, rad; not a pole.
    model : ErrorModel or str
        The states.
    pauses_only : bool
        The velocity is looked at in the pauses alone.

    Returns
    -------
    ndarray of int, shape (p,)
        Singular values of the observability matrix above 1e-10 of the largest, as in
        `unobservable_subspace`.

    Examples
    --------
    >>> scheme = Scheme("+90Y +90Z", ("Up", "East", "North"))
    >>> [gramian_ranks(scheme, 0.7, pauses_only=pauses).tolist() for pauses in (False, True)]
    [[9, 22, 24], [9, 18, 24]]
    """
    truth_value(pauses_only, "pauses_only")
    way = linearize_along(scheme, latitude, model)
    model = way.model
    seen = observability_matrix(way) * _typical(model, way.start)
    ranks, stack = [], np.zeros((0, model.size))
    for segment, steps in way.segments:
        if not (segment.rate and pauses_only):
            stack = np.concatenate([stack, seen[3 * steps.start : 3 * steps.stop]])
        if not segment.rate:
            ranks.append(np.linalg.matrix_rank(stack, rtol=1e-10))
    return np.array(ranks)


class UnobservableSubspace(NamedTuple):
    """Unobservable directions of the state along a rotation scheme.

    Attributes
    ----------
    eigenvalues : ndarray, shape (size,)
        Of the Gramian, ascending; each state is counted in its typical size. They are squares of
        singular values, so a zero shows as the square of a rounding error; eigenvalues computed
        of the Gramian itself show it as about 1e-17 of the largest.
    directions : ndarray, shape (m, size)
        Basis of the null space, as states.
    descriptions : list of str
        Description of the null directions in English.

    Examples
    --------
    Without a choice of body axes, three directions are unobservable whatever the rotations are:

    >>> from driftlab.calibration import linearize_along
    >>> from driftlab.motion.scheme import NINETEEN_POSITIONS
    >>> for line in unobservable_subspace(linearize_along(NINETEEN_POSITIONS, 0.7)).descriptions:
    ...     print(line)
    both triads turned together about x, the attitude with them
    both triads turned together about y, the attitude with them
    both triads turned together about z, the attitude with them
    """

    eigenvalues: FloatArray
    directions: FloatArray
    descriptions: list[str]


def unobservable_subspace(linearized: LinearizedErrors) -> UnobservableSubspace:
    """Directions of the state that no measurement of the velocity can show.

    Parameters
    ----------
    linearized : LinearizedErrors
        The error equations along the scheme.

    Returns
    -------
    UnobservableSubspace
        Eigenvalues of the Gramian, null directions, and their description.

    See Also
    --------
    covariance_analysis : How well the others are known.
    stripped_observability : The same of a row of constant pieces.

    Notes
    -----
    To make states comparable, each is counted in its standard deviation for a typical unit. A
    direction counts as unobservable if its singular value is less than 1e-10 of the largest, which
    is well above the level of rounding.

    References
    ----------
    - D. Goshen-Meskin, I. Y. Bar-Itzhack, *Observability analysis of piece-wise constant systems,
      part I: Theory*, IEEE Transactions on Aerospace and Electronic Systems 28(4), 1992.

    Examples
    --------
    A table that stands still leaves most errors unobservable; the 19 positions leave none:

    >>> from driftlab.calibration import linearize_along
    >>> from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme
    >>> for scheme in (Scheme(""), NINETEEN_POSITIONS):
    ...     along = linearize_along(scheme, 0.7, ERROR_MODELS["averaged"])
    ...     print(len(unobservable_subspace(along).directions))
    18
    0
    """
    seen, model = observability_matrix(linearized), linearized.model
    values, unobservable = _null_space(seen, model, linearized.start)
    if model.frame is not None:
        return UnobservableSubspace(
            values, unobservable, _among(model, unobservable, linearized.start)
        )
    descriptions = []
    scale = _typical(model, linearized.start)
    for axis, state in zip(AXES, _common_misalignments(model, linearized.start), strict=True):
        # Nothing of this state is left outside the null space.
        basis = unobservable / scale
        outside = state / scale - (basis @ (state / scale)) @ basis
        if np.linalg.norm(outside) < 1e-3 * np.linalg.norm(state / scale):
            descriptions.append(f"both triads turned together about {axis}, the attitude with them")
    # The other null directions are clearest in axes without a common rotation.
    averaged = ERROR_MODELS["averaged"].with_states(*model.higher_order)
    states = np.eye(averaged.size)
    embedding = model.state(averaged.imu_errors(states), averaged.higher_order_errors(states))
    embedding[:6, :6] = np.eye(6)
    _, rest = _null_space(seen @ embedding.T, averaged, linearized.start)
    return UnobservableSubspace(
        values, unobservable, descriptions + _among(averaged, rest, linearized.start)
    )


def _typical(model: ErrorModel, start: FloatArray) -> FloatArray:
    """Standard deviations (size,) of the states of a typical unit; 1 cm/s for velocity."""
    scale = np.sqrt(np.diag(model.covariance(PriorDeviations(), start)))
    scale[3:6] = 0.01
    return scale


def _null_space(
    seen: FloatArray, model: ErrorModel, start: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Eigenvalues (size,) of the Gramian, ascending, and null directions (m, size) in states."""
    scale = _typical(model, start)
    # The singular values of this matrix have twice the digits that eigenvalues of its square have.
    # Rows of zeros, so that there are never fewer rows than states.
    padded = np.concatenate([seen * scale, np.zeros((model.size, model.size))])
    _, values, vectors = np.linalg.svd(padded, full_matrices=False)
    return values[::-1] ** 2, vectors[values < 1e-10 * values[0]] * scale


def _among(model: ErrorModel, directions: FloatArray, start: FloatArray) -> list[str]:
    """Description of null directions (m, size): how many, and which states they mix."""
    if not len(directions):
        return []
    share = np.linalg.norm(directions / _typical(model, start), axis=0)
    names = [name for name, part in zip(model.names, share, strict=True) if part > 0.05]
    return [f"{len(directions)} among {', '.join(names)}"]


def _common_misalignments(model: ErrorModel, attitude: FloatArray) -> FloatArray:
    """States (3, size) of both triads rotated by 1 rad about x, y or z, with the attitude."""
    turns = cross_matrix(np.eye(3))
    none = np.zeros((3, 3))
    states = model.state(ImuErrors(none, turns, none, turns))
    states[:, :3] = to_matrix(attitude).T
    return states


def warn_if_unobservable(linearized: LinearizedErrors) -> None:
    """Warn if a scheme leaves errors unobservable, and name them.

    Parameters
    ----------
    linearized : LinearizedErrors
        The error equations along the scheme.

    Warns
    -----
    UnobservableWarning
        If there are null directions.

    Examples
    --------
    >>> from driftlab.calibration import linearize_along
    >>> from driftlab.motion.scheme import Scheme
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always")
    ...     warn_if_unobservable(linearize_along(Scheme(""), 0.7))
    >>> str(caught[0].message)[:48]
    'scheme: leaves 21 directions of 30 unobservable:'
    """
    unobservable = unobservable_subspace(linearized)
    if unobservable.descriptions:
        warnings.warn(
            f"scheme: leaves {len(unobservable.directions)} directions of "
            f"{linearized.model.size} unobservable: {'; '.join(unobservable.descriptions)}.",
            UnobservableWarning,
            stacklevel=2,
        )

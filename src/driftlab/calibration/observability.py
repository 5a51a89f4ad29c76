"""Observability along a rotation scheme: information and null directions.

It uses the filter's error model along the true motion of the table, without any data. A direction
of the state that has no effect on the velocity is a null direction of the observability Gramian.

Goshen-Meskin and Bar-Itzhack (1992) look at constant pieces: while the matrix F of the error
equations is constant, the rows H, H F, H F^2, ... say what the velocity can show. On a turntable F
is constant in a pause. In a turn it is not.
"""

from __future__ import annotations

import warnings
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import (
    FloatArray,
    one_of,
    truth_value,
)
from driftlab.core.quaternion import from_rotation_vector, multiply, to_matrix
from driftlab.core.vectors import cross_matrix
from driftlab.earth import earth_rate, gravity
from driftlab.imu import ImuErrors, PriorStandardDeviations
from driftlab.motion.scheme import Scheme
from driftlab.motion.turntable import Segment

from .error_dynamics import (
    LinearizedErrors,
    _free_rates,
    _transition,
    checked_linearized,
    linearize_along,
)
from .error_model import AXES, ERROR_MODELS, FULL, ErrorModel


class UnobservableWarning(UserWarning):
    """Warning that a rotation scheme leaves some errors unobservable."""


def observability_matrix(linearized: LinearizedErrors) -> FloatArray:
    """Observability matrix: the velocity after each step as a function of the state at the start.

    Parameters
    ----------
    linearized : LinearizedErrors
        The error equations along the scheme, as s steps.

    Returns
    -------
    ndarray, shape (3 s, size)
        East, North, Up of each step, weighted by the square root of its duration. For the matrix O
        the Gramian is O^T O: the information on the state at the start if the velocity is measured
        continuously with noise of unit density, and no noise disturbs the sensors.

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
    scheme, latitude, model : Scheme or str, float, ErrorModel or str
        As for `linearize_along`.
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
    scale = np.sqrt(np.diag(model.covariance(PriorStandardDeviations(), start)))
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


def _warn_if_unobservable(linearized: LinearizedErrors) -> None:
    """Warn if a scheme leaves errors unobservable, and name them."""
    unobservable = unobservable_subspace(linearized)
    if unobservable.descriptions:
        warnings.warn(
            f"scheme: leaves {len(unobservable.directions)} directions of "
            f"{linearized.model.size} unobservable: {'; '.join(unobservable.descriptions)}.",
            UnobservableWarning,
            stacklevel=2,
        )


ZERO = 1e-9
"""Part of the largest singular value below which another counts as zero."""


def _observable_rows(rates: FloatArray, seen: FloatArray) -> FloatArray:
    """Return an orthonormal basis (r, n) of all that H, H F, H F^2, ... show of a constant system.

    The states of F (n, n) are in comparable sizes. Powers of F would run away in size. Instead,
    each round multiplies only the new directions by F and keeps the part that is orthogonal to
    those found before, if it is above 1e-9 of the largest rate at which the round's directions
    change.
    """
    found = np.zeros((0, rates.shape[1]))
    new = seen
    while len(new):
        size = np.linalg.norm(new, 2)
        for _ in range(2):  # once more for the digits that the first subtraction loses
            new = new - (new @ found.T) @ found
        _, values, rows = np.linalg.svd(new, full_matrices=False)
        fresh = rows[values > ZERO * size]
        found = np.concatenate([found, fresh])
        new = fresh @ rates
    return found


IntArray = NDArray[np.int_]

_TURN_TREATMENTS = ("carried", "ignored", "in pieces")
"""What `stripped_observability` can do with the turns between the pauses."""

_PIECE = np.radians(15.0)  # rad: most that a piece of a turn turns


def _error_rates(
    model: ErrorModel,
    latitude: float,
    attitude: FloatArray,
    rate: FloatArray,
    *,
    body_axes: bool = False,
) -> FloatArray:
    """Matrix F (size, size) of the error equations at one moment, SI: Wu (49).

    `rate` (3,) is of the table against the Earth, in body axes; `body_axes` counts attitude and
    velocity errors in body axes instead of East, North, Up.
    """
    to_local = to_matrix(attitude)
    spin = rate + to_local.T @ earth_rate(latitude)
    force = to_local.T @ np.array([0.0, 0.0, float(gravity(latitude))])
    # One node that counts one second, and nothing that arises in it acts on: the first order.
    sensors = _transition(
        model, np.eye(6), to_local[None], np.ones(1), spin[None], force[None],
        quadrature_weights=np.zeros((1, 1)),
    )  # fmt: skip
    rates = sensors - np.eye(model.size)
    rates[:6, :6] += _free_rates(latitude)
    if body_axes:
        to_body = np.kron(np.eye(2), to_local.T)
        rates[:6] = to_body @ rates[:6]
        rates[:, :6] = rates[:, :6] @ to_body.T
        rates[:6, :6] -= np.kron(np.eye(2), cross_matrix(rate))
    return rates


class StrippedObservability(NamedTuple):
    """What the pieces of a scheme show together, position by position.

    Attributes
    ----------
    model : ErrorModel or str
        The states.
    ranks : ndarray of int, shape (p,)
        Of the stripped observability matrix up to each position and with it.
    condition : float
        Largest over smallest singular value of the whole matrix, zeros left out.
    moves : float
        How far a state can move that a piece does not show, as a part of the largest rate: zero
        but for rounding if the stripped matrix may stand for the total one.
    null_directions : ndarray, shape (size - ranks[-1], size)
        States at the start that no piece shows.
    known_after : ndarray of int, shape (size,)
        Position, counted from 1, after which a state is known by itself; 0 for never.
    """

    model: ErrorModel
    ranks: IntArray
    condition: float
    moves: float
    null_directions: FloatArray
    known_after: IntArray


def stripped_observability(
    scheme: Scheme | str, latitude: float, model: ErrorModel | str = FULL, turns: str = "carried"
) -> StrippedObservability:
    """Rank of the stripped observability matrix (SOM) after each position of a scheme.

    Parameters
    ----------
    scheme, latitude, model : Scheme or str, float, ErrorModel or str
        As for `linearize_along`.
    turns : {"carried", "ignored", "in pieces"}
        "carried": the transition matrix of a turn carries the errors over, and nobody looks at the
        velocity meanwhile. "ignored": the errors are after a turn what they were before, as in
        papers on alignment in several positions. "in pieces": each turn is cut into pieces of 15
        degrees, and in each of them F in body axes is held.

    Returns
    -------
    StrippedObservability
        Ranks, null directions, and when each state becomes known.

    Raises
    ------
    ValueError
        If `turns` is none of these, or as `linearize_along`.

    Notes
    -----
    The total observability matrix carries each local matrix Q_j back to the start, through all
    pieces before it; the stripped one leaves this out. If F_j x = 0 wherever Q_j x = 0, then what
    a piece does not show stays as it is while the piece lasts, and both have one null space.

    Each state counts in its typical size, and each Q_j by an orthonormal basis of its rows, for
    operations on rows change no null space. A singular value below 1e-9 of the largest is zero:
    those that are none stay above 1e-3 on the book's schemes, and zeros below 1e-12.

    References
    ----------
    D. Goshen-Meskin, I. Y. Bar-Itzhack, *Observability analysis of piece-wise constant systems,
    part I: Theory*, IEEE Transactions on Aerospace and Electronic Systems 28(4), 1992.

    Examples
    --------
    Of 30 states three cannot be seen. If the turns are ignored, they seem to be:

    >>> from driftlab.motion.scheme import NINETEEN_POSITIONS
    >>> for turns in ("carried", "ignored", "in pieces"):
    ...     ranks = stripped_observability(NINETEEN_POSITIONS, 0.7, turns=turns).ranks
    ...     print(f"{turns:10} {ranks[1]} after two positions, {ranks[-1]} in the end")
    carried    18 after two positions, 27 in the end
    ignored    15 after two positions, 30 in the end
    in pieces  24 after two positions, 27 in the end
    """
    one_of(turns, _TURN_TREATMENTS, "turns")
    way = linearize_along(scheme, latitude, model)
    model = way.model
    size = _typical(model, way.start)
    since, moves = np.eye(model.size), 0.0
    stack, vectors = np.zeros((0, model.size)), np.eye(model.size)
    ranks: list[int] = []
    known_after = np.zeros(model.size, int)
    for segment, steps in way.segments:
        if segment.rate and turns != "in pieces":
            for matrix in way.transitions[steps] if turns == "carried" else ():
                since = matrix * size / size[:, np.newaxis] @ since
            continue
        for attitude in _pieces(segment):
            spin = segment.rate * segment.axis
            in_body = turns == "in pieces"
            rates = _error_rates(model, latitude, attitude, spin, body_axes=in_body)
            rates = rates * size / size[:, np.newaxis]
            rows = _observable_rows(rates, np.eye(model.size)[3:6])
            hidden = rates - (rates @ rows.T) @ rows
            moves = max(moves, float(np.linalg.norm(hidden, 2) / np.linalg.norm(rates, 2)))
            seen = np.linalg.svd(rows @ since, full_matrices=False)[2] if ranks else rows
            stack = np.concatenate([stack, seen])
        _, values, vectors = np.linalg.svd(stack)
        rank = int((values > ZERO * values[0]).sum())
        stack = values[:rank, np.newaxis] * vectors[:rank]
        if not segment.rate:
            ranks.append(rank)
            alone = np.linalg.norm(vectors[rank:], axis=0) < 1e-6
            known_after[alone & (known_after == 0)] = len(ranks)
    null = vectors[rank:] * size
    if turns == "in pieces":
        null[:, :6] = null[:, :6] @ np.kron(np.eye(2), to_matrix(way.start)).T
    return StrippedObservability(
        model, np.array(ranks), float(values[0] / values[rank - 1]), moves, null, known_after
    )


def _pieces(segment: Segment) -> FloatArray:
    """Attitudes (k, 4) in the middle of the pieces of a pause or a turn."""
    angle = segment.rate * segment.duration
    count = max(1, int(np.ceil(abs(angle) / _PIECE - 1e-9)))
    turned = angle * (np.arange(count) + 0.5) / count
    return multiply(segment.attitude, from_rotation_vector(turned[:, np.newaxis] * segment.axis))

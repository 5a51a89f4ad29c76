"""Observability of a row of constant pieces: Goshen-Meskin and Bar-Itzhack (1992).

While the matrix F of the error equations is constant, its powers say what the velocity can show:
the rows of H, H F, H F^2, ... On a turntable F is constant in a pause. In a turn it is not.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from driftlab.checks import (
    FloatArray,
    finite_array,
    finite_number,
    one_of,
    truth_value,
    unit_quaternions,
)
from driftlab.core.quaternion import from_rotation_vector, multiply, to_matrix
from driftlab.core.vectors import cross_matrix
from driftlab.earth import checked_latitude, earth_rate, gravity
from driftlab.motion.scheme import Scheme
from driftlab.motion.turntable import Segment

from ._observable_rows import ZERO, observable_rows
from .error_dynamics import free_rates, transition
from .error_model import FULL, ErrorModel
from .linearization import checked_model, linearize_along
from .observability import _typical

IntArray = NDArray[np.int_]

TURN_TREATMENTS = ("carried", "ignored", "in pieces")
"""What `stripped_observability` can do with the turns between the pauses."""

_PIECE = np.radians(15.0)  # rad: most that a piece of a turn turns


def error_rates(
    model: ErrorModel,
    latitude: float,
    attitude: ArrayLike,
    rate: ArrayLike = (0.0, 0.0, 0.0),
    *,
    body_axes: bool = False,
) -> FloatArray:
    """Matrix F of the error equations at one moment: Wu (49).

    Parameters
    ----------
    model : ErrorModel or str
        The states.
    latitude : float
        Of the table, rad; not a pole.
    attitude : array_like or Rotation, shape (4,)
        Body to East, North, Up.
    rate : array_like, shape (3,)
        Of the table against the Earth, body axes, rad/s.
    body_axes : bool
        Attitude and velocity errors are counted in body axes instead of East, North, Up.

    Returns
    -------
    ndarray, shape (size, size)
        Derivatives of the states (rows) for each state (columns), SI; those of the sensor errors
        are zero.

    Raises
    ------
    ValueError
        If the model, the latitude, the attitude or the rate is none.

    Examples
    --------
    A tilt of 1 rad about North accelerates a level unit to the East by gravity:

    >>> rates = error_rates(FULL, 0.7, [0, 0, 0, 1])
    >>> east = rates[FULL.names.index("velocity East"), FULL.names.index("attitude North")]
    >>> bool(np.isclose(east, -gravity(0.7)))
    True
    """
    model = checked_model(model)
    truth_value(body_axes, "body_axes")
    place = float(checked_latitude(finite_number(latitude, "latitude")))
    to_local = to_matrix(unit_quaternions(attitude, "attitude"))
    turn = finite_array(rate, "rate")
    if turn.shape != (3,) or to_local.shape != (3, 3):
        raise ValueError(
            "attitude, rate: expected one attitude (4,) and one finite rate (3,), "
            f"got shapes {np.shape(attitude)} and {turn.shape}."
        )
    spin = turn + to_local.T @ earth_rate(place)
    force = to_local.T @ np.array([0.0, 0.0, float(gravity(place))])
    # One node that counts one second, and nothing that arises in it acts on: the first order.
    sensors = transition(
        model, np.eye(6), to_local[None], np.ones(1), spin[None], force[None], np.zeros((1, 1))
    )
    rates = sensors - np.eye(model.size)
    rates[:6, :6] += free_rates(place)
    if body_axes:
        to_body = np.kron(np.eye(2), to_local.T)
        rates[:6] = to_body @ rates[:6]
        rates[:, :6] = rates[:, :6] @ to_body.T
        rates[:6, :6] -= np.kron(np.eye(2), cross_matrix(turn))
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

    Examples
    --------
    >>> from driftlab.motion.scheme import NINETEEN_POSITIONS
    >>> stripped = stripped_observability(NINETEEN_POSITIONS, 0.7)
    >>> int(stripped.ranks[0]), int(stripped.ranks[-1]), stripped.moves < 1e-12
    (9, 27, True)
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
    scheme : Scheme or str
        Pauses and rotations.
    latitude : float
        Of the table, rad; not a pole.
    model : ErrorModel or str
        The states.
    turns : str
        One of `TURN_TREATMENTS`. "carried": the transition matrix of a turn carries the errors
        over, and nobody looks at the velocity meanwhile. "ignored": the errors are after a turn
        what they were before, as in papers on alignment in several positions. "in pieces": each
        turn is cut into pieces of 15 degrees, and in each of them F in body axes is held.

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
    >>> for turns in TURN_TREATMENTS:
    ...     ranks = stripped_observability(NINETEEN_POSITIONS, 0.7, turns=turns).ranks
    ...     print(f"{turns:10} {ranks[1]} after two positions, {ranks[-1]} in the end")
    carried    18 after two positions, 27 in the end
    ignored    15 after two positions, 30 in the end
    in pieces  24 after two positions, 27 in the end
    """
    one_of(turns, TURN_TREATMENTS, "turns")
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
            rates = error_rates(model, latitude, attitude, spin, body_axes=in_body)
            rates = rates * size / size[:, np.newaxis]
            rows = observable_rows(rates, np.eye(model.size)[3:6])
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

"""The error equations along a rotation scheme: transition matrices along the true motion."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from driftlab.checks import FloatArray, finite_number, named_or_own, shown
from driftlab.core.quaternion import from_rotation_vector, multiply, to_matrix
from driftlab.earth import checked_latitude, earth_rate, gravity
from driftlab.motion.scheme import Scheme, checked_scheme
from driftlab.motion.turntable import Segment, segments

from . import _higher_order_states as higher
from .error_dynamics import free_transition, transition
from .error_model import ERROR_MODELS, FULL, ErrorModel

_STEP = 10.0  # s: longest step of a pause; rotations are divided into shorter ones
_MOST_STEPS = 20_000
_LEAST = 4  # steps of a pause or a rotation: fewer velocities would not show all that grows in it
_TURN = np.radians(30.0)  # rad: most that a step turns
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(4)


class LinearizedErrors(NamedTuple):
    """Error equations along a rotation scheme, as s steps.

    Attributes
    ----------
    model : ErrorModel or str
        The states.
    start : ndarray, shape (4,)
        Attitude at the beginning, body to East, North, Up.
    durations : ndarray, shape (s,)
        Length of each step, s.
    transitions : ndarray, shape (s, size, size)
        Transition matrix of the errors over each step.
    segments : list of tuple
        Pauses and rotations of the table, each a `driftlab.motion.Segment`, and with it the steps
        that it is made of, as a slice.

    Examples
    --------
    >>> linearized = linearize_along(Scheme("+90Z", dwell=60.0), 0.7)
    >>> float(linearized.durations.sum()), linearized.transitions.shape
    (129.0, (16, 30, 30))
    >>> [linearized.durations[steps].sum().round(9) for _, steps in linearized.segments]
    [np.float64(60.0), np.float64(9.0), np.float64(60.0)]
    """

    model: ErrorModel
    start: FloatArray
    durations: FloatArray
    transitions: FloatArray
    segments: list[tuple[Segment, slice]]


def checked_model(model: ErrorModel | str) -> ErrorModel:
    """Return an error model, or the one that a name in `ERROR_MODELS` stands for."""
    return named_or_own(model, ErrorModel, ERROR_MODELS, "model")


def checked_linearized(linearized: LinearizedErrors) -> LinearizedErrors:
    """Return linearized errors, refusing anything else, such as a scheme."""
    if not isinstance(linearized, LinearizedErrors):
        raise ValueError(
            "linearized: expected what linearize_along(scheme, latitude) returns, "
            f"got {shown(linearized)}."
        )
    return linearized


def linearize_along(
    scheme: Scheme | str, latitude: float, model: ErrorModel | str = FULL
) -> LinearizedErrors:
    """Transition matrices of the errors along a rotation scheme.

    Parameters
    ----------
    scheme : Scheme or str
        Pauses and rotations; at most 200 000 s in all.
    latitude : float
        Of the table, rad; not a pole.
    model : ErrorModel or str
        The states.

    Returns
    -------
    LinearizedErrors
        Steps of at most 10 s and 30 degrees, at least four a pause or rotation.

    Raises
    ------
    ValueError
        If the scheme takes too long, the place is a pole, or `model` is not an error model.

    See Also
    --------
    covariance_analysis : The accuracy to be expected.
    unobservable_subspace : What no measurement shows.

    Notes
    -----
    Wu (49), (50), along the true motion. The integrals over each step are taken by a Gauss
    quadrature with four nodes.

    Examples
    --------
    A pause, a rotation by 90 degrees at 10 degrees per second, and a pause:

    >>> linearized = linearize_along(Scheme("+90Z", dwell=20.0), 0.7)
    >>> linearized.durations
    array([5.  , 5.  , 5.  , 5.  , 2.25, 2.25, 2.25, 2.25, 5.  , 5.  , 5.  ,
           5.  ])
    """
    place = float(checked_latitude(finite_number(latitude, "latitude")))
    model = checked_model(model)
    scheme = checked_scheme(scheme)
    row = segments(scheme, 1e-3)
    time = sum(segment.duration for segment in row)
    if time > _STEP * _MOST_STEPS:
        raise ValueError(
            f"scheme: expected at most {_STEP * _MOST_STEPS:g} s in all, got {time:.3g} s."
        )
    distinct, lengths, begun, alike, parts, total = [], [], [], [], [], 0
    for segment in row:
        turn = abs(segment.rate) * segment.duration
        count = max(_LEAST, int(np.ceil(max(segment.duration / _STEP, turn / _TURN) - 1e-9)))
        parts.append(slice(total, total + count))
        total += count
        # The steps of a pause are all alike: one stands for them.
        kinds = count if segment.rate else 1
        distinct += [segment] * kinds
        lengths += [segment.duration / count] * kinds
        begun += list(range(kinds))
        alike += [count // kinds] * kinds
    duration, rate = np.array(lengths), np.array([segment.rate for segment in distinct])
    axis = np.array([segment.axis for segment in distinct])
    attitude = np.array([segment.attitude for segment in distinct])
    turned = (rate * duration * np.array(begun))[:, np.newaxis] * axis
    start = multiply(attitude, from_rotation_vector(turned))
    # Nodes of the Gauss quadrature in each step, and the integrals from its beginning to them.
    place_of = 0.5 * (1 + _NODES)
    times = duration[:, np.newaxis] * 0.5 * _WEIGHTS
    turn = (rate * duration)[:, np.newaxis] * place_of
    turned = from_rotation_vector(turn[..., np.newaxis] * axis[:, np.newaxis])
    to_local = multiply(start[:, np.newaxis], turned)
    to_body = np.swapaxes(to_matrix(to_local), -1, -2)
    earth = earth_rate(place)
    spin = rate[:, np.newaxis, np.newaxis] * axis[:, np.newaxis] + to_body @ earth
    force = to_body @ np.array([0.0, 0.0, float(gravity(place))])
    # The local axes of the step's beginning do not turn on with the Earth.
    since = from_rotation_vector((duration[:, np.newaxis] * place_of)[..., np.newaxis] * earth)
    share = times[..., np.newaxis]
    changes = None
    if model.higher_order:
        # What is left of a rate that stands still against the local axes turns in body axes.
        table = rate[:, np.newaxis, np.newaxis] * axis[:, np.newaxis]
        changes = share * np.cross(to_body @ earth, table)
    matrices = transition(
        model,
        free_transition(place, duration),
        to_matrix(multiply(since, to_local)),
        times,
        share * spin,
        share * force,
        _QUADRATURE_WEIGHTS,
        changes,
    )
    matrices = np.repeat(matrices, alike, axis=0)
    if model.higher_order:
        first = [steps.start for steps in parts]
        matrices[first] = matrices[first] @ _jumps(model, row)
    return LinearizedErrors(
        model,
        row[0].attitude,
        np.repeat(duration, alike),
        matrices,
        list(zip(row, parts, strict=True)),
    )


def _jumps(model: ErrorModel, row: list[Segment]) -> FloatArray:
    """Transitions (segments, size, size) by the jump of the rate with which each one begins."""
    spin = np.array([segment.rate * segment.axis for segment in row])
    change = np.diff(spin, axis=0, prepend=spin[:1])
    attitude = to_matrix(np.array([segment.attitude for segment in row]))
    jumps = np.broadcast_to(np.eye(model.size), (len(row), model.size, model.size)).copy()
    jumps[:, 3:6, model.triad_states :] = attitude @ higher.of_a_jump(model.higher_order, change)
    return jumps


def _quadrature_weights() -> FloatArray:
    """Fraction of each term of a Gauss quadrature that has accumulated at each of its nodes."""
    powers = np.arange(len(_NODES))
    # Weights that integrate all polynomials of that degree from -1 to each node.
    integrals = (_NODES[:, np.newaxis] ** (powers + 1) - (-1.0) ** (powers + 1)) / (powers + 1)
    vandermonde = _NODES[:, np.newaxis] ** powers
    return integrals @ np.linalg.inv(vandermonde) / _WEIGHTS


_QUADRATURE_WEIGHTS = _quadrature_weights()

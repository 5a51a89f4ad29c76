"""What a rotation scheme can show: information, directions that stay in the dark, accuracy.

The same error model as the filter's, along the true motion of the table and without any data. A
direction of the state that never shows in the velocity is a null direction of the Gramian.
"""

from __future__ import annotations

import warnings
from typing import NamedTuple

import numpy as np

from driftlab.checks import FloatArray, finite_number
from driftlab.core.quaternion import from_rotation_vector, multiply, to_matrix
from driftlab.core.vectors import cross_matrix
from driftlab.earth import checked_latitude, earth_rate, gravity
from driftlab.imu import Noise, Spread, Unit
from driftlab.motion.turntable import Scheme, segments

from .error_dynamics import free_growth, process_noise, transition
from .error_model import AXES, ERROR_MODELS, FULL, ErrorModel
from .kalman import covariance_step

STEP = 10.0
"""Longest step in s of a pause; a rotation is cut finer."""
_MOST_STEPS = 20_000
_TURN = np.radians(30.0)  # rad: most that a step turns
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(4)


class UnobservableWarning(UserWarning):
    """Some errors cannot be found, however long one measures."""


class Passage(NamedTuple):
    """The error equations along a scheme, in s steps."""

    model: ErrorModel
    start: FloatArray  # (4,), attitude at the beginning
    durations: FloatArray  # (s,), s
    transitions: FloatArray  # (s, size, size)


def checked_model(model: ErrorModel) -> ErrorModel:
    """Return an error model itself; anything else is refused."""
    if not isinstance(model, ErrorModel):
        raise ValueError(f"model: expected an ErrorModel, got {model!r}.")
    return model


def passage(scheme: Scheme, latitude: float, model: ErrorModel = FULL) -> Passage:
    """Transition matrices of the errors along a scheme, at a `latitude` in rad."""
    place = float(checked_latitude(finite_number(latitude, "latitude")))
    checked_model(model)
    row = segments(scheme, 1e-3)
    time = sum(segment.duration for segment in row)
    if time > STEP * _MOST_STEPS:
        raise ValueError(
            f"scheme: expected at most {STEP * _MOST_STEPS:g} s in all, got {time:.3g} s."
        )
    distinct, lengths, begun, alike = [], [], [], []
    for segment in row:
        turn = abs(segment.rate) * segment.duration
        count = int(np.ceil(max(segment.duration / STEP, turn / _TURN) - 1e-9))
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
    # Gauss's places in each step, and the integrals from its beginning to them.
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
    matrices = transition(
        model,
        free_growth(place, duration),
        to_matrix(multiply(since, to_local)),
        times,
        share * spin,
        share * force,
        _PASSED,
    )
    return Passage(
        model, row[0].attitude, np.repeat(duration, alike), np.repeat(matrices, alike, axis=0)
    )


def _passed() -> FloatArray:
    """How much of each share of a Gauss quadrature has passed at each of its places."""
    powers = np.arange(len(_NODES))
    # Weights that integrate all polynomials of that degree from -1 to each place.
    integrals = (_NODES[:, np.newaxis] ** (powers + 1) - (-1.0) ** (powers + 1)) / (powers + 1)
    vandermonde = _NODES[:, np.newaxis] ** powers
    return integrals @ np.linalg.inv(vandermonde) / _WEIGHTS


_PASSED = _passed()


def expected_covariance(
    way: Passage, noise: Noise, spread: Spread, update: float = 1.0
) -> FloatArray:
    """Covariance (size, size) that the filter will have at the end of the scheme.

    The measurements of a step, one each `update` in s, count as one at its end. With pauses of
    minutes the deviations of the sensor errors come out about one per cent too small, those of the
    velocity about ten; with pauses of ten seconds some come out by a fifth too small.
    """
    if not (finite_number(update, "update") > 0 and noise.velocity > 0):
        raise ValueError(
            "update, velocity: expected a positive time and a positive velocity noise, "
            f"got {update!r} s and {noise.velocity!r} m/s."
        )
    covariance = way.model.covariance(spread, way.start)
    added = process_noise(noise, way.transitions[:, 3:6, :3], way.durations, way.model.size)
    variances = noise.velocity**2 * update / way.durations
    for matrix, more, variance in zip(way.transitions, added, variances, strict=True):
        covariance, _, _ = covariance_step(covariance, matrix, more, variance)
    return covariance


def observability_matrix(way: Passage) -> FloatArray:
    """What the velocity after each step shows of the state at the start: (3 s, size).

    Its square is the Gramian: the information on that state if the velocity is measured all the
    time, with a density of one, and nothing disturbs the sensors.
    """
    since, rows = np.eye(way.model.size), []
    for duration, matrix in zip(way.durations, way.transitions, strict=True):
        since = matrix @ since
        rows.append(np.sqrt(duration) * since[3:6])
    return np.concatenate(rows)


class Darkness(NamedTuple):
    """What the velocity does not show."""

    eigenvalues: FloatArray  # (size,), ascending: of the Gramian with all states in typical sizes
    directions: FloatArray  # (m, size): the null directions, in states
    words: list[str]  # what they are


def null_directions(way: Passage) -> Darkness:
    """Directions of the state that no measurement of the velocity can show.

    To be comparable, each state is counted in its standard deviation of a typical unit. A direction
    is dark if it shows less than 1e-10 of what the brightest does: rounding.
    """
    seen, model = observability_matrix(way), way.model
    values, dark = _null_space(seen, model, way.start)
    if model.frame is not None:
        return Darkness(values, dark, _among(model, dark, way.start))
    words = []
    scale = _typical(model, way.start)
    for axis, state in zip(AXES, _common_misalignments(way.start), strict=True):
        # Nothing of this state is left outside the null space.
        basis = dark / scale
        outside = state / scale - (basis @ (state / scale)) @ basis
        if np.linalg.norm(outside) < 1e-3 * np.linalg.norm(state / scale):
            words.append(f"both triads turned together about {axis}, the attitude with them")
    # What else there is can be said best in axes that leave no common turn.
    averaged = ERROR_MODELS["averaged"]
    embedding = FULL.state(averaged.unit(np.eye(averaged.size)))
    embedding[:6, :6] = np.eye(6)
    _, rest = _null_space(seen @ embedding.T, averaged, way.start)
    return Darkness(values, dark, words + _among(averaged, rest, way.start))


def _typical(model: ErrorModel, start: FloatArray) -> FloatArray:
    """Standard deviations (size,) of the states of a typical unit; 1 cm/s for velocity."""
    scale = np.sqrt(np.diag(model.covariance(Spread(), start)))
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
    """Words for null directions (m, size): how many, and which states they mix."""
    if not len(directions):
        return []
    share = np.linalg.norm(directions / _typical(model, start), axis=0)
    names = [name for name, part in zip(model.names, share, strict=True) if part > 0.05]
    return [f"{len(directions)} among {', '.join(names)}"]


def _common_misalignments(attitude: FloatArray) -> FloatArray:
    """States (3, 30) of both triads turned by 1 rad about x, y or z, the attitude with them."""
    turns = cross_matrix(np.eye(3))
    none = np.zeros((3, 3))
    states = FULL.state(Unit(none, turns, none, turns))
    states[:, :3] = to_matrix(attitude).T
    return states


def warn_if_unobservable(way: Passage) -> None:
    """Warn with `UnobservableWarning` that names what a scheme leaves in the dark."""
    dark = null_directions(way)
    if dark.words:
        warnings.warn(
            f"scheme: leaves {len(dark.directions)} directions of {way.model.size} unobservable: "
            f"{'; '.join(dark.words)}.",
            UnobservableWarning,
            stacklevel=2,
        )

"""Observability along a rotation scheme: information, null directions, expected accuracy.

It uses the filter's error model along the true motion of the table, without any data. A direction
of the state that has no effect on the velocity is a null direction of the observability Gramian.
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
"""Longest step of a pause, s; rotations are divided into shorter steps."""
_MOST_STEPS = 20_000
_TURN = np.radians(30.0)  # rad: most that a step turns
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(4)


class UnobservableWarning(UserWarning):
    """Warning that a rotation scheme leaves some errors unobservable.

    Examples
    --------
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("ignore", UnobservableWarning)
    ...     warn_if_unobservable(passage(Scheme(""), 0.7))
    """


class Passage(NamedTuple):
    """Error equations along a rotation scheme, as s steps.

    Attributes
    ----------
    model : ErrorModel
        The states.
    start : ndarray, shape (4,)
        Attitude at the beginning, body to East, North, Up.
    durations : ndarray, shape (s,)
        Length of each step, s.
    transitions : ndarray, shape (s, size, size)
        Transition matrix of the errors over each step.

    Examples
    --------
    >>> way = passage(Scheme("+90Z", dwell=60.0), 0.7)
    >>> float(way.durations.sum()), way.transitions.shape
    (129.0, (15, 30, 30))
    """

    model: ErrorModel
    start: FloatArray
    durations: FloatArray
    transitions: FloatArray


def checked_model(model: ErrorModel) -> ErrorModel:
    """Return an error model unchanged, refusing anything else.

    Parameters
    ----------
    model : ErrorModel
        What is to be checked.

    Returns
    -------
    ErrorModel
        The same object.

    Raises
    ------
    ValueError
        If it is not an `ErrorModel`.

    Examples
    --------
    >>> checked_model("averaged")
    Traceback (most recent call last):
    ValueError: model: expected an ErrorModel, got 'averaged'.
    """
    if not isinstance(model, ErrorModel):
        raise ValueError(f"model: expected an ErrorModel, got {model!r}.")
    return model


def passage(scheme: Scheme, latitude: float, model: ErrorModel = FULL) -> Passage:
    """Transition matrices of the errors along a rotation scheme.

    Parameters
    ----------
    scheme : Scheme
        Pauses and rotations; at most 200 000 s in all.
    latitude : float
        Of the table, rad; not a pole.
    model : ErrorModel
        The states.

    Returns
    -------
    Passage
        Steps of at most `STEP` seconds and 30 degrees.

    Raises
    ------
    ValueError
        If the scheme takes too long, the place is a pole, or `model` is not an error model.

    Notes
    -----
    Wu (49), (50), along the true motion. The integrals over each step are taken by a Gauss
    quadrature with four nodes.

    Examples
    --------
    A pause, a rotation by 90 degrees at 10 degrees per second, and a pause:

    >>> way = passage(Scheme("+90Z", dwell=20.0), 0.7)
    >>> way.durations
    array([10., 10.,  3.,  3.,  3., 10., 10.])
    """
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
    """Fraction of each term of a Gauss quadrature that has accumulated at each of its nodes."""
    powers = np.arange(len(_NODES))
    # Weights that integrate all polynomials of that degree from -1 to each node.
    integrals = (_NODES[:, np.newaxis] ** (powers + 1) - (-1.0) ** (powers + 1)) / (powers + 1)
    vandermonde = _NODES[:, np.newaxis] ** powers
    return integrals @ np.linalg.inv(vandermonde) / _WEIGHTS


_PASSED = _passed()


def expected_covariance(
    way: Passage, noise: Noise, spread: Spread, update: float = 1.0
) -> FloatArray:
    """Covariance of the estimation errors at the end of a scheme, without any data.

    Parameters
    ----------
    way : Passage
        The error equations along the scheme.
    noise : Noise
        Of the sensors and of the reference velocity.
    spread : Spread
        Standard deviations of the errors before the calibration.
    update : float
        Time between two measurements of the velocity, s.

    Returns
    -------
    ndarray, shape (size, size)
        In the units of the states, squared.

    Raises
    ------
    ValueError
        If `update` or the noise of the velocity is not positive.

    Notes
    -----
    All measurements within a step are taken as one at its end. With pauses of minutes the standard
    deviations of the sensor errors come out about one per cent too small, those of the velocity
    about ten; with pauses of ten seconds some are a fifth too small.

    Examples
    --------
    How well the scheme of 19 positions finds the scale factor of a gyro, in ppm:

    >>> from driftlab.motion.turntable import NINETEEN_POSITIONS
    >>> way = passage(NINETEEN_POSITIONS, 0.7, ERROR_MODELS["averaged"])
    >>> variances = np.diag(expected_covariance(way, Noise(), Spread()))
    >>> round(1e6 * float(np.sqrt(variances[way.model.names.index("gyro scale x")])), 2)
    3.56
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
    """Observability matrix: the velocity after each step as a function of the state at the start.

    Parameters
    ----------
    way : Passage
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
    >>> observability_matrix(passage(Scheme("+90Z", dwell=20.0), 0.7)).shape
    (21, 30)
    """
    since, rows = np.eye(way.model.size), []
    for duration, matrix in zip(way.durations, way.transitions, strict=True):
        since = matrix @ since
        rows.append(np.sqrt(duration) * since[3:6])
    return np.concatenate(rows)


class Darkness(NamedTuple):
    """Unobservable directions of the state along a rotation scheme.

    Attributes
    ----------
    eigenvalues : ndarray, shape (size,)
        Of the Gramian, ascending; each state is counted in its typical size.
    directions : ndarray, shape (m, size)
        Basis of the null space, as states.
    words : list of str
        Description of the null directions in English.

    Examples
    --------
    Without a choice of body axes, three directions are unobservable whatever the rotations are:

    >>> from driftlab.motion.turntable import NINETEEN_POSITIONS
    >>> for line in null_directions(passage(NINETEEN_POSITIONS, 0.7)).words:
    ...     print(line)
    both triads turned together about x, the attitude with them
    both triads turned together about y, the attitude with them
    both triads turned together about z, the attitude with them
    """

    eigenvalues: FloatArray
    directions: FloatArray
    words: list[str]


def null_directions(way: Passage) -> Darkness:
    """Directions of the state that no measurement of the velocity can show.

    Parameters
    ----------
    way : Passage
        The error equations along the scheme.

    Returns
    -------
    Darkness
        Eigenvalues of the Gramian, null directions, and their description.

    Notes
    -----
    To make states comparable, each is counted in its standard deviation for a typical unit. A
    direction counts as unobservable if its singular value is less than 1e-10 of the largest, which
    is the level of rounding.

    Examples
    --------
    A table that stands still leaves most errors unobservable; the 19 positions leave none:

    >>> from driftlab.motion.turntable import NINETEEN_POSITIONS
    >>> for scheme in (Scheme(""), NINETEEN_POSITIONS):
    ...     print(len(null_directions(passage(scheme, 0.7, ERROR_MODELS["averaged"])).directions))
    18
    0
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
    # The other null directions are clearest in axes without a common rotation.
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
    """Description of null directions (m, size): how many, and which states they mix."""
    if not len(directions):
        return []
    share = np.linalg.norm(directions / _typical(model, start), axis=0)
    names = [name for name, part in zip(model.names, share, strict=True) if part > 0.05]
    return [f"{len(directions)} among {', '.join(names)}"]


def _common_misalignments(attitude: FloatArray) -> FloatArray:
    """States (3, 30) of both triads rotated by 1 rad about x, y or z, with the attitude."""
    turns = cross_matrix(np.eye(3))
    none = np.zeros((3, 3))
    states = FULL.state(Unit(none, turns, none, turns))
    states[:, :3] = to_matrix(attitude).T
    return states


def warn_if_unobservable(way: Passage) -> None:
    """Warn if a scheme leaves errors unobservable, and name them.

    Parameters
    ----------
    way : Passage
        The error equations along the scheme.

    Warns
    -----
    UnobservableWarning
        If there are null directions.

    Examples
    --------
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always")
    ...     warn_if_unobservable(passage(Scheme(""), 0.7))
    >>> str(caught[0].message)[:48]
    'scheme: leaves 21 directions of 30 unobservable:'
    """
    dark = null_directions(way)
    if dark.words:
        warnings.warn(
            f"scheme: leaves {len(dark.directions)} directions of {way.model.size} unobservable: "
            f"{'; '.join(dark.words)}.",
            UnobservableWarning,
            stacklevel=2,
        )

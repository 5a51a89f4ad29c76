"""How the errors of `error_model` grow on a table, in one step and along a whole scheme.

Wu (6), (49), (50).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from driftlab.checks import (
    FloatArray,
    checked_instance,
    finite_array,
    finite_number,
    named_or_own,
    shown,
)
from driftlab.core.quaternion import from_rotation_vector, multiply, to_matrix
from driftlab.core.vectors import cross_matrix
from driftlab.earth import checked_latitude, curvature_radii, earth_rate, gravity
from driftlab.higher_order_errors import TERMS
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.increments import Increments
from driftlab.motion.scheme import Scheme, checked_scheme
from driftlab.motion.turntable import Segment, segments

from .error_model import ERROR_MODELS, FULL, ErrorModel

_UNIT = np.eye(6)  # made once, for the many steps of a filter


def checked_noise(noise: ImuNoise, name: str = "noise") -> ImuNoise:
    """Return the noise that a filter assumes, refusing a reference velocity without any."""
    checked_instance(noise, ImuNoise, name)
    if not noise.reference_velocity > 0:
        raise ValueError(
            f"{name}: expected a deviation of the reference velocity above 0, "
            f"got {shown(noise.reference_velocity)} m/s."
        )
    return noise


def _free_rates(latitude: float) -> FloatArray:
    """Rates (6, 6) of attitude (rad) and velocity errors (m/s) at rest, whatever the sensors do."""
    earth = earth_rate(latitude)
    meridian, across = curvature_radii(latitude)
    rates = np.zeros((6, 6))
    rates[:3, :3] = -cross_matrix(earth)
    rates[0, 4] = -1 / meridian
    rates[1:3, 3] = 1 / across, np.tan(latitude) / across
    rates[3:, 3:] = -2 * cross_matrix(earth)
    return rates


def free_transition(latitude: float, duration: ArrayLike) -> FloatArray:
    """Transition matrix of attitude and velocity errors without sensor errors and specific force.

    Parameters
    ----------
    latitude : float
        Of the table, rad; not a pole.
    duration : array_like, shape (...)
        Much shorter than a day, s.

    Returns
    -------
    ndarray, shape (..., 6, 6)
        Attitude error (rad) and velocity error (m/s), each East, North, Up, from the beginning to
        the end of the duration; to its third order.

    Notes
    -----
    The part of Wu (6) that acts on a table at rest whatever the sensors do: the local axes rotate
    with the Earth, a velocity error rotates them as well, and the Coriolis force acts.

    Examples
    --------
    A northward velocity error of 1 m/s tilts the computed axes in a minute by -60 m over the
    Earth's radius about East:

    >>> meridian, _ = curvature_radii(0.0)
    >>> round(float(free_transition(0.0, 60.0)[0, 4] * meridian), 3)
    -60.0
    """
    change = finite_array(duration, "duration")[..., np.newaxis, np.newaxis] * _free_rates(latitude)
    square = change @ change
    return np.eye(6) + change + square / 2 + square @ change / 6


def _transition(
    model: ErrorModel,
    free: FloatArray,
    attitude: FloatArray,
    times: FloatArray,
    angle: FloatArray,
    velocity: FloatArray,
    quadrature_weights: FloatArray | None,
    rate_change: FloatArray | None = None,
) -> FloatArray:
    """Transition matrix (..., size, size) of all errors over an interval; Wu (49), (50).

    Errors that arise within the interval are propagated as if they had been there from its
    beginning. This neglects terms of the order of the Earth's rotation in that time, and of the
    rotation of the local axes by the velocity error that arises in it.

    `attitude` (..., n, 3, 3) leads from body axes at the nodes to the local axes at the beginning;
    `times` (..., n), `angle`, `velocity` and `rate_change` (..., n, 3) are quadrature terms of the
    elapsed time and of the integrals of angular rate, specific force and change of the rate.
    `quadrature_weights` (n, n) say what fraction of the term of each node (column) has accumulated
    by the time of each node (row). They are None for nodes in the middles of n parts, by when half
    of the own term has accumulated; it takes no room, however many there are.
    """
    gyro = slice(6, 9 + len(model.gyro_basis))
    accelerometer = slice(gyro.stop, model.triad_states)
    force = cross_matrix((attitude @ velocity[..., np.newaxis])[..., 0])
    # A tilt that arises at a node acts through the force that is still to come.
    if quadrature_weights is None:
        still = np.cumsum(force[..., ::-1, :, :], axis=-3)[..., ::-1, :, :] - 0.5 * force
    else:
        still = (quadrature_weights.T @ force.reshape(*force.shape[:-2], 9)).reshape(force.shape)
    # What turns in body axes at all nodes come to: a tilt, and below it a velocity.
    pushed = still @ attitude
    carried = np.concatenate([np.broadcast_to(attitude, pushed.shape), pushed], axis=-2)
    carried = carried.swapaxes(-3, -2).reshape(*carried.shape[:-3], 6, -1)
    lead = np.broadcast_shapes(
        free.shape[:-2],
        attitude.shape[:-3],
        times.shape[:-1],
        angle.shape[:-2],
        velocity.shape[:-2],
    )
    moved = np.zeros((*lead, 6, model.size))
    moved[..., :6] = _UNIT
    moved[..., 3:, :3] = force.sum(axis=-3)
    moved[..., gyro] = -carried @ _effects(model.gyro_basis, times, angle)
    pushes = _effects(model.accelerometer_basis, times, velocity)
    moved[..., 3:, accelerometer] = carried[..., :3, :] @ pushes
    if model.higher_order:
        changes = np.zeros(3) if rate_change is None else rate_change
        tilts, pushes = (
            rows.reshape(*rows.shape[:-3], -1, rows.shape[-1])
            for rows in _higher_order_effects(model.higher_order, times, angle, velocity, changes)
        )
        moved[..., model.triad_states :] = -carried @ tilts
        moved[..., 3:, model.triad_states :] += carried[..., :3, :] @ pushes
    matrix = np.empty((*lead, model.size, model.size))
    matrix[..., 6:, :6] = 0.0
    matrix[..., 6:, 6:] = np.eye(model.size - 6)
    matrix[..., :6, :] = free @ moved
    return matrix


def transition_of_increments(
    model: ErrorModel,
    free: FloatArray,
    attitude: FloatArray,
    increments: Increments,
    rate_change: FloatArray | None = None,
) -> FloatArray:
    """Transition matrix of all errors while a unit navigates for a short time.

    Parameters
    ----------
    model : ErrorModel
        The states.
    free : ndarray, shape (..., 6, 6)
        `free_transition` over the whole time.
    attitude : ndarray, shape (..., n + 1, 4)
        Computed attitudes, body to East, North, Up, before and after each pair of increments.
    increments : Increments
        From which the attitudes were computed, with the known errors removed; arrays of shape
        (..., 2 n, 3).
    rate_change : ndarray, shape (..., 2 n, 3), optional
        Change of the angular rate over each interval, rad/s; zero if not given.

    Returns
    -------
    ndarray, shape (..., size, size)
        From the errors at the beginning of the whole time to those at its end; Wu (49), (50).

    Examples
    --------
    A second at rest: a gyro bias about North makes a velocity error to the East of g t²/2 for each
    rad/s.

    >>> from driftlab.calibration.error_model import FULL
    >>> level, zero = np.tile([0.0, 0.0, 0.0, 1.0], (2, 1)), np.zeros((2, 3))
    >>> up = np.tile([0.0, 0.0, 4.9], (2, 1))
    >>> found = transition_of_increments(FULL, np.eye(6), level, Increments(0.5, zero, up))
    >>> round(float(found[FULL.names.index("velocity East"), FULL.names.index("gyro bias y")]), 6)
    4.9
    """
    checked_instance(model, ErrorModel, "model")
    matrices = to_matrix(attitude)
    # Local axes turn by an arc second or so in a second; here they count as fixed.
    middle = 0.5 * (matrices[..., :-1, :, :] + matrices[..., 1:, :, :])
    angle = increments.angle[..., 0::2, :] + increments.angle[..., 1::2, :]
    velocity = increments.velocity[..., 0::2, :] + increments.velocity[..., 1::2, :]
    count = angle.shape[-2]
    times = np.full(count, 2 * increments.interval)
    if rate_change is not None:
        rate_change = rate_change[..., 0::2, :] + rate_change[..., 1::2, :]
    return _transition(
        model, free, middle, times, angle, velocity,
        quadrature_weights=None, rate_change=rate_change,
    )  # fmt: skip


def _effects(basis: FloatArray, times: FloatArray, values: FloatArray) -> FloatArray:
    """Errors (..., 3 n, 3 + m) in body axes, three rows a node, of three biases, m coefficients."""
    lead = np.broadcast_shapes(times.shape, values.shape[:-1])
    effects = np.empty((*lead, 3, 3 + len(basis)))
    effects[..., :3] = times[..., np.newaxis, np.newaxis] * _UNIT[:3, :3]
    # Entry [i, m] is the sum of basis[m, i, j] times component j of the values.
    combined = values @ basis.T.reshape(3, -1)
    effects[..., 3:] = combined.reshape(*values.shape, len(basis))
    return effects.reshape(*lead[:-1], -1, 3 + len(basis))


def _higher_order_effects(
    chosen: tuple[str, ...],
    times: FloatArray,
    angle: FloatArray,
    velocity: FloatArray,
    rate_change: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Errors of gyros and accelerometers (..., n, 3, m) at n nodes of each of m states.

    The derivatives of `driftlab.higher_order_errors.higher_order_effects`.
    """
    lead = np.broadcast_shapes(times.shape, angle.shape[:-1], velocity.shape[:-1])
    of_gyros, of_accelerometers = [np.zeros((*lead, 3, 0))], [np.zeros((*lead, 3, 0))]
    for term in (TERMS[name] for name in chosen):
        rows = term.rows(times, angle, velocity, rate_change)
        if term.shape:  # row i acts on the constants of sensor i alone
            rows = np.eye(3)[:, :, np.newaxis] * rows[..., np.newaxis, :]
            rows = rows.reshape(*rows.shape[:-2], -1)
        rows = np.broadcast_to(rows, (*lead, *rows.shape[-2:]))
        felt = term.states.startswith("gyro")
        of_gyros.append(rows if felt else np.zeros_like(rows))
        of_accelerometers.append(np.zeros_like(rows) if felt else rows)
    return np.concatenate(of_gyros, axis=-1), np.concatenate(of_accelerometers, axis=-1)


def process_noise(noise: ImuNoise, force: FloatArray, duration: FloatArray) -> FloatArray:
    r"""Covariance that white sensor noise adds to attitude and velocity over an interval.

    Parameters
    ----------
    noise : ImuNoise
        Random walks q of the gyros and r of the accelerometers.
    force : ndarray, shape (..., 3, 3)
        F, velocity error at the end for each rad of attitude error at the beginning, m/s: a block
        of the transition matrix.
    duration : ndarray, shape (...)
        Length t of the interval, s.

    Returns
    -------
    ndarray, shape (..., 6, 6)
        Attitude error (rad) and velocity error (m/s), each East, North, Up; to the sensor errors
        nothing is added:

        .. math:: Q_{\varphi\varphi} = q^2 t I, \quad Q_{v\varphi} = \tfrac{1}{2} q^2 t F, \quad
                  Q_{vv} = r^2 t I + \tfrac{1}{3} q^2 t F F^T

    Examples
    --------
    A random walk of 1e-6 rad/sqrt(s) for 100 s:

    >>> noise = ImuNoise(angle_random_walk=1e-6, velocity_random_walk=0.0)
    >>> covariance = process_noise(noise, np.zeros((3, 3)), np.array(100.0))
    >>> f"{np.sqrt(covariance[0, 0]):.1e}"  # rad
    '1.0e-05'
    """
    checked_instance(noise, ImuNoise, "noise")
    lead = np.broadcast_shapes(force.shape[:-2], duration.shape)
    covariance = np.empty((*lead, 6, 6))
    seconds = duration[..., np.newaxis, np.newaxis]
    tilt = noise.angle_random_walk**2 * seconds
    covariance[..., :3, :3] = tilt * _UNIT[:3, :3]
    transposed = np.swapaxes(force, -1, -2)
    covariance[..., 3:6, :3] = tilt / 2 * force
    covariance[..., :3, 3:6] = tilt / 2 * transposed
    own = noise.velocity_random_walk**2 * seconds * _UNIT[:3, :3]
    covariance[..., 3:6, 3:6] = own + tilt / 3 * force @ transposed
    return covariance


def _instabilities(noise: ImuNoise) -> tuple[FloatArray, FloatArray]:
    """Standard deviations (m,) of the bias instabilities, and their correlation times (m,), s.

    m is six, gyros first, or zero if all biases are constant.
    """
    sizes = np.repeat([noise.gyro_bias_instability, noise.accelerometer_bias_instability], 3)
    times = np.repeat([noise.gyro_correlation_time, noise.accelerometer_correlation_time], 3)
    moving = 6 if sizes.any() else 0
    return sizes[:moving], np.where(times > 0, times, np.inf)[:moving]


def _states_of_model(model: ErrorModel, noise: ImuNoise) -> NDArray[np.int_]:
    """Places (size,) of a model's states among all; bias instabilities are those from 6 to 11."""
    count = len(_instabilities(noise)[0])
    return np.r_[:6, 6 + count : model.size + count]


def _covariance_before(
    model: ErrorModel, prior: PriorStandardDeviations, noise: ImuNoise, attitude: FloatArray
) -> FloatArray:
    """Covariance of all states before a calibration, the bias instabilities among them."""
    sizes, _ = _instabilities(noise)
    own = _states_of_model(model, noise)
    found = np.diag(np.pad(sizes**2, (6, model.size - 6)))
    found[np.ix_(own, own)] = model.covariance(prior, attitude)
    return found


def _moving_states(
    model: ErrorModel, noise: ImuNoise, transition: FloatArray, duration: ArrayLike
) -> tuple[FloatArray, FloatArray]:
    """First k rows (..., k, size) of the transition of all states, and the noise (..., k, k) added.

    Attitude and velocity move, and after them, if there are any, six Gauss-Markov processes. Such a
    process is a bias that is held over an interval; it has its stationary variance at all times,
    and from one interval to the next the correlation exp(-duration/correlation time). The other
    states are constant. `transition` (..., size of the model, same) has the model's alone.
    """
    seconds = np.asarray(duration)
    rows = transition[..., :6, :]
    added = process_noise(noise, rows[..., 3:, :3], seconds)
    sizes, times = _instabilities(noise)
    if not sizes.size:
        return rows, added
    accelerometer = 9 + len(model.gyro_basis)
    biases = rows[..., np.r_[6:9, accelerometer : accelerometer + 3]]
    acting = np.concatenate([biases, np.broadcast_to(_UNIT, biases.shape)], axis=-2)
    kept = np.exp(-seconds[..., np.newaxis, np.newaxis] / times)
    every = np.zeros((*rows.shape[:-2], 12, rows.shape[-1] + 6))
    every[..., :6, _states_of_model(model, noise)] = rows
    every[..., 6:12] = kept * acting
    noises = (sizes**2 * (1 - kept**2) * acting) @ np.swapaxes(acting, -1, -2)
    noises[..., :6, :6] += added
    return every, noises


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
        Pauses and rotations of the table, each a `driftlab.motion.turntable.Segment`, and with it
        the steps that it is made of, as a slice.
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
        Wu (49), (50) along the true motion, in steps of at most 10 s and 30 degrees, at least four
        a pause or rotation.

    Raises
    ------
    ValueError
        If the scheme takes too long, the place is a pole, or `model` is not an error model.

    See Also
    --------
    covariance_analysis : The accuracy to be expected.
    unobservable_subspace : What no measurement shows.

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
    matrices = _transition(
        model,
        free_transition(place, duration),
        to_matrix(multiply(since, to_local)),
        times,
        share * spin,
        share * force,
        quadrature_weights=_QUADRATURE_WEIGHTS,
        rate_change=changes,
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
    # Almost no time: effects are divided by it.
    still, at_once = np.zeros_like(change), np.full(len(row), np.finfo(float).tiny)
    tilts, pushes = _higher_order_effects(model.higher_order, at_once, still, still, change)
    jumps[:, :3, model.triad_states :] = -attitude @ tilts
    jumps[:, 3:6, model.triad_states :] = attitude @ pushes
    return jumps


def _quadrature_weights() -> FloatArray:
    """Fraction of each term of a Gauss quadrature that has accumulated at each of its nodes."""
    powers = np.arange(len(_NODES))
    # Weights that integrate all polynomials of that degree from -1 to each node.
    integrals = (_NODES[:, np.newaxis] ** (powers + 1) - (-1.0) ** (powers + 1)) / (powers + 1)
    vandermonde = _NODES[:, np.newaxis] ** powers
    return integrals @ np.linalg.inv(vandermonde) / _WEIGHTS


_QUADRATURE_WEIGHTS = _quadrature_weights()

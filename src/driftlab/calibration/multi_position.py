"""Calibrating a unit by hand: rests in many poses, and the moves between them.

At rest the accelerometers must measure gravity, whatever the pose; and gravity, carried by the
gyros from one rest to the next, must be what the accelerometers find there. That is the method of
IMU-TK (Tedaldi, Pretto, Menegatti 2014). Where the unit is known to have come back to its attitude
the gyros alone must find no turn: this is Larin's test, and three components count instead of two.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import g

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS
from driftlab.checks import (
    FloatArray,
    checked_instance,
    finite_arrays,
    one_of,
    one_pull,
    truth_value,
    whole_pairs,
)
from driftlab.core import multi_position as core
from driftlab.earth import EARTH_RATE, gravity as normal_gravity
from driftlab.imu import ImuErrors, ImuNoise, PriorStandardDeviations
from driftlab.recordings.recording import Recording
from driftlab.recordings.static_detection import StaticIntervals

from .body_axes import POSE_AXES, imu_errors_in_frame
from .calibration_history import InconsistentCalibrationWarning
from .error_model import FULL

_KINDS = ("static_intervals", "moves", "rates")
"""Kinds of residuals: |force| at rest, tilt or turn after a move, gyros at rest."""
_BLOCK = 0.5
"""Means over so many seconds show the slow part of the noise."""
_LEAST = 1e-9
"""Least deviation of a mean, relative to gravity, or in rad and rad/s: records without noise."""
_GRAVITY_FACTOR = 1.25
"""More than the errors of scale and bias of any accelerometer make together."""


class Consistency(NamedTuple):
    """Do the residuals of one kind agree with the noise that the rests show?

    Attributes
    ----------
    chi_square : float
        Sum of the squared residuals, each weighted by the noise, and by the excess of the other
        kinds.
    degrees_of_freedom : float
        Number of residuals, less the share of the unknowns that they determine.
    lower, upper : float
        Bounds that `chi_square` keeps in 95 of 100 cases if noise is all there is; NaN where fewer
        than half a degree of freedom is left and nothing can be tested.
    excess : float
        Deviation that was added to that of the noise: of each component of a mean force (m/s^2), of
        the turn over a move (rad), of a mean rate (rad/s). Zero if none is missing.
    """

    chi_square: float
    degrees_of_freedom: float
    lower: float
    upper: float
    excess: float

    @property
    def holds(self) -> bool:
        """Whether noise alone explains the residuals; true also where nothing can be tested."""
        return not (self.chi_square < self.lower or self.chi_square > self.upper)

    @property
    def why(self) -> str:
        """The test in a sentence."""
        if np.isnan(self.upper):
            return "No freedom is left to test them."
        text = (
            f"Chi-square {self.chi_square:.4g}, {self.lower:.4g} to {self.upper:.4g} expected of "
            f"noise with {self.degrees_of_freedom:.0f} degrees of freedom"
        )
        if self.excess:
            return f"{text}: not noise alone, {self.excess:.3g} were added to its deviation."
        if self.holds:
            return f"{text}: noise."
        return f"{text}: {'more' if self.chi_square > self.upper else 'less'} than noise."


@dataclass(frozen=True, eq=False)
class MultiPositionCalibration:
    """Errors of a unit as its poses show them.

    Attributes
    ----------
    imu_errors : ImuErrors
        Estimates in the chosen body axes: measured = (I + K) true + bias.
    body_axes : str
        The choice, one of `POSE_AXES`.
    names : tuple of str
        Names of the 24 numbers, those of `driftlab.calibration.FULL`.
    covariance : ndarray, shape (24, 24)
        Of the numbers in that order. Those that the choice of axes sets to zero have none.
    standard_deviations : ImuErrors
        Standard deviations of `imu_errors`.
    sensitivity, sensitivity_standard_deviations : ndarray, shape (3, 3)
        What specific force adds to the gyros' bias, matrix G, rad/s for 1 m/s^2 in the same axes,
        and its deviations (those of the axes of the fit, which turn by less than a triad is bent);
        zero if it was not asked for.
    gravity : float
        That was assumed, m/s^2.
    force_residuals : ndarray, shape (n,)
        |force| - gravity at each rest, m/s^2.
    turn_residuals : ndarray, shape (m,)
        Angle between gravity as carried to the next rest and as found there, for each move but the
        closed ones; then the turns left over the closed paths; rad.
    rate_residuals : ndarray, shape (n, 3)
        Mean of the gyros at each rest less their bias, rad/s.
    consistency : dict of str to Consistency
        Do "rests", "moves" and "rates" agree with the noise of the rests?
    colour : tuple of float
        Variance of means over half a second as a multiple of what white noise would have: gyros,
        accelerometers; NaN if the noise was given.
    longest_move : float
        s.
    iterations : int
        How often the record was integrated.
    """

    imu_errors: ImuErrors
    body_axes: str
    names: tuple[str, ...]
    covariance: FloatArray
    standard_deviations: ImuErrors
    sensitivity: FloatArray
    sensitivity_standard_deviations: FloatArray
    gravity: float
    force_residuals: FloatArray
    turn_residuals: FloatArray
    rate_residuals: FloatArray
    consistency: dict[str, Consistency]
    colour: tuple[float, float]
    longest_move: float
    iterations: int

    @property
    def earth_turn(self) -> float:
        """The most that the Earth turned over a move, which is in `turn_residuals`, rad."""
        return EARTH_RATE * self.longest_move

    @property
    def why(self) -> str:
        """What the residuals are, and whether the noise of the rests explains them."""
        sizes = [self.force_residuals, np.degrees(self.turn_residuals), self.rate_residuals]
        units = ("m/s^2", "degrees", "rad/s")
        words = ("Gravity at rest", "Gravity or attitude after a move", "Gyros at rest")
        sentences = []
        for word, unit, size, test in zip(
            words, units, sizes, self.consistency.values(), strict=True
        ):
            rms = np.sqrt(np.mean(size**2))
            sentences.append(f"{word}: residuals {rms:.3g} {unit} (rms). {test.why}")
        return "\n".join(
            [
                *sentences,
                f"The Earth turns by at most {np.degrees(self.earth_turn):.2g} degrees over a "
                "move; it is in the residuals, and noise as counted here has it in it.",
            ]
        )


def calibrate_multi_position(
    recording: Recording,
    static_intervals: StaticIntervals | Sequence[tuple[int, int]],
    *,
    gravity: float | None = None,
    body_axes: str = "accelerometers",
    closed: Sequence[tuple[int, int]] = (),
    noise: ImuNoise | None = None,
    prior: PriorStandardDeviations | None = None,
    gyro_bias: ArrayLike | None = None,
    sensitivity: bool = False,
) -> MultiPositionCalibration:
    r"""Estimate the errors of a unit from rests in several poses and the moves between them.

    Parameters
    ----------
    recording : Recording
        With accelerometers; rates or increments.
    static_intervals : StaticIntervals or sequence of (int, int)
        From `driftlab.recordings.static_intervals`, or the first row of each rest and the first
        after it.
    gravity : float, optional
        m/s^2. If not given, the record's own, or normal gravity at its latitude.
    body_axes : str
        One of `POSE_AXES`: which of the numbers are zero by choice.
    closed : sequence of (int, int), optional
        Pairs of rests, counted from 0, at which the unit had the same attitude.
    noise : ImuNoise, optional
        White noise of the sensors. If not given, it is taken from the rests: from means over half a
        second, which know of slow noise what white noise hides.
    prior : PriorStandardDeviations, optional
        How large the errors may be, if that is known: for records with too few poses. Its
        `attitude` is not used.
    gyro_bias : array_like, shape (3,), optional
        rad/s, if it is known; IMU-TK takes the mean of the first rest. Else it is fitted too, to
        the moves and to all rests.
    sensitivity : bool
        Whether the gyros may feel force: measured = (I + K) true + bias + G force, nine numbers
        more. Many small ones do, by a milliradian a second for 1 g.

    Returns
    -------
    MultiPositionCalibration
        Estimates with their covariance, residuals and tests.

    Raises
    ------
    ValueError
        If the record has no accelerometers or no gravity, a rest or pair is not one of the record,
        the poses leave some numbers in the dark and no `prior` is given, or the fit does not
        settle.

    Warns
    -----
    InconsistentCalibrationWarning
        If the accelerometers show quite another gravity at rest.

    See Also
    --------
    driftlab.recordings.static_intervals : The rests of a record.
    calibrate : On a turntable.
    to_json : Keep what was found.

    Notes
    -----
    Least squares for 21 numbers at once: L (6 numbers, three being fixed by the choice of axes) and
    the accelerometers' bias from :math:`|(I + L)^{-1} (f - b)| = g` at each rest; K and the gyros'
    bias from the two components of :math:`C_{ij}^T u_i - u_j` across the gravity u for each move
    from i to j; the bias from the gyros at rest as well. The attitude C over a move is integrated
    from the compensated increments, and errors dK, db that are left turn it by the vector (in the
    axes of the beginning)

    .. math:: -\int C\,(I + K)^{-1} (dK\,\omega + db)\, dt.

    Where the residuals of one kind are larger than noise allows (0.975 quantile), a deviation is
    added to each of that kind, so that they fit (random effects, as Paule and Mandel have it);
    without this the stated deviations of real units would be many times too small. See
    `MultiPositionCalibration.consistency`.

    Over a closed path the turn itself must vanish, all three components. For k whole turns about
    one axis n the turn left over, by :math:`2 \pi k`, is the estimate of n^T Sigma n of
    `driftlab.drift.turn_estimate`, Larin (3.3).

    The Earth's rate is in all rests and moves, one vector of known size and unknown direction, and
    the covariance counts it as that. So neither the bias nor K takes it for its own; the bias is
    that of the gyros without the Earth.

    Noise is taken for white from half a second on. If it is slower, the deviations of K and L are
    too small: by some ten per cent in most simulations, L's by half in some. The biases are means
    over the session, and so are their deviations: of another session's they say nothing.

    References
    ----------
    - F. Ferraris, U. Grimaldi, M. Parvis, *Procedure for effortless in-field calibration of
      three-axis rate gyros and accelerometers*, Sensors and Materials 7, 1995.
    - D. Tedaldi, A. Pretto, E. Menegatti, *A robust and easy to implement method for IMU
      calibration without external equipments*, IEEE International Conference on Robotics and
      Automation, 2014.

    Examples
    --------
    Twelve turns by hand about random axes, with a rest of two seconds before each and at the end:

    >>> from driftlab.attitude import integrate
    >>> from driftlab.imu import TYPICAL_ERRORS
    >>> from driftlab.increments import Increments, measure
    >>> from driftlab.quaternion import rotate
    >>> rng, dt, second = np.random.default_rng(1), 0.01, np.arange(100) / 100
    >>> angle = np.zeros((3800, 3))
    >>> for begin in range(200, 3800, 300):
    ...     turn = rng.uniform(-2.5, 2.5, 3)  # rad
    ...     angle[begin : begin + 100] = dt * turn * (1 - np.cos(2 * np.pi * second))[:, np.newaxis]
    >>> attitude = integrate(angle, "memory-4")
    >>> velocity = dt * rotate(attitude * [-1, -1, -1, 1], [0, 0, 9.81])
    >>> unit = TYPICAL_ERRORS._replace(gyro_error_matrix=0.01 * rng.standard_normal((3, 3)))
    >>> _, angle, velocity = measure(Increments(dt, angle, velocity), unit, ImuNoise(), rng)
    >>> log = Recording(angle, velocity, dt, "increments")
    >>> rows = [(begin, begin + 190) for begin in range(5, 3800, 300)]
    >>> found = calibrate_multi_position(
    ...     log, rows, gravity=9.81, body_axes="averaged accelerometers"
    ... )
    >>> error = found.imu_errors.gyro_error_matrix - unit.gyro_error_matrix
    >>> bool(np.abs(error).max() < 1e-4), found.consistency["moves"].holds
    (True, True)
    """
    checked_instance(recording, Recording, "recording")
    one_of(body_axes, POSE_AXES, "body_axes")
    truth_value(sensitivity, "sensitivity")
    if recording.accelerometer is None:
        raise ValueError("recording: expected one with accelerometers, got one without.")
    rows = _checked_rows(static_intervals, len(recording))
    pairs = _checked_pairs(closed, len(rows))
    assumed = _gravity(gravity, recording.gravity, recording.latitude)
    interval = recording.interval
    moves = _moves(rows, recording.kind, interval, recording.times)
    _, angle, velocity = recording.increments()
    way, algorithm = np.concatenate([angle[move] for move in moves]), CONING_ALGORITHMS["memory-4"]
    if len(way) < algorithm.window:
        raise ValueError(
            f"static_intervals: expected moves between them, got {len(way)} rows of moves."
        )
    share = 1.0 if recording.kind == "rates" else 1 / interval
    rate, force = recording.gyro, recording.accelerometer
    poses = core.Poses(
        force=np.array([share * force[b:e].mean(axis=0) for b, e in rows]),
        rate=np.array([share * rate[b:e].mean(axis=0) for b, e in rows]),
        angle=way,
        velocity=np.concatenate([velocity[move] for move in moves]) if sensitivity else None,
        interval=interval,
        edges=np.cumsum([0, *(len(angle[move]) for move in moves)]),
        gravity=assumed,
        closed=np.array(pairs, int).reshape(-1, 2),
        open=np.setdiff1d(np.arange(len(rows) - 1), [i for i, j in pairs if j == i + 1]),
        algorithm=algorithm.steps,
    )
    _warn_of_gravity(poses.force, assumed)
    variances, colour = _variances(share * rate, share * force, rows, poses, noise)
    known = None if gyro_bias is None else finite_arrays(gyro_bias=(gyro_bias, 3))[0]
    if known is not None and known.ndim != 1:
        raise ValueError(f"gyro_bias: expected shape (3,), got shape {known.shape}.")
    fit = core.fit_poses(poses, variances, None if prior is None else _sizes(prior), known)
    state, felt = _in_axes(fit.unknowns, body_axes)
    step = 1e-6
    moved = fit.unknowns + step * np.concatenate([np.eye(core.UNKNOWNS), -np.eye(core.UNKNOWNS)])
    ahead, back = np.split(_in_axes(moved, body_axes)[0], 2)
    change = (ahead - back).T / (2 * step)
    covariance = change @ fit.covariance @ change.T
    return MultiPositionCalibration(
        imu_errors=_imu_errors(state),
        body_axes=body_axes,
        names=FULL.names[6:],
        covariance=covariance,
        standard_deviations=_imu_errors(np.sqrt(np.maximum(covariance.diagonal(), 0.0))),
        sensitivity=felt,
        sensitivity_standard_deviations=np.sqrt(
            fit.covariance.diagonal()[core.SENSITIVITY]
        ).reshape(3, 3),
        gravity=assumed,
        force_residuals=fit.force,
        turn_residuals=fit.turn,
        rate_residuals=fit.rate,
        consistency={
            kind: Consistency(*test) for kind, test in zip(_KINDS, fit.tests.tolist(), strict=True)
        },
        colour=colour,
        longest_move=float(np.diff(poses.edges).max() * interval),
        iterations=fit.iterations,
    )


def _in_axes(unknowns: FloatArray, body_axes: str) -> tuple[FloatArray, FloatArray]:
    """The 24 numbers (..., 24) of unknowns (..., 30), and G (..., 3, 3), in the chosen axes."""
    force_error, force_bias, gyro_error_matrix, gyro_bias, felt = core.matrices(unknowns)
    errors = ImuErrors(gyro_bias, gyro_error_matrix, force_bias, force_error)
    errors, turn = imu_errors_in_frame(errors, body_axes)
    return FULL.state(errors)[..., 6:], felt @ np.swapaxes(turn, -1, -2)


def _imu_errors(numbers: FloatArray) -> ImuErrors:
    return FULL.imu_errors(np.concatenate([np.zeros(6), numbers]))


def _gravity(given: float | None, own: float | None, latitude: float | None) -> float:
    if given is not None:
        return one_pull(given)
    if own is not None:
        return own
    if latitude is not None:
        return float(normal_gravity(latitude))
    raise ValueError(
        "gravity: expected m/s^2, because the record knows neither gravity nor latitude, got none."
    )


def _checked_rows(
    static_intervals: StaticIntervals | Sequence[tuple[int, int]], count: int
) -> list[tuple[int, int]]:
    given = (
        static_intervals.rows if isinstance(static_intervals, StaticIntervals) else static_intervals
    )
    rows = [(int(begin), int(end)) for begin, end in whole_pairs(given, "static_intervals")]
    if len(rows) < 2:
        raise ValueError(
            f"static_intervals: expected at least two, with a move between them, got {len(rows)}."
        )
    after = 0
    for begin, end in rows:
        if not after <= begin < end - 1 < count:
            raise ValueError(
                f"static_intervals: expected rows in order, two at least each, of the {count} of "
                f"the record, got {begin} to {end} after {after}."
            )
        after = end
    return rows


def _checked_pairs(closed: Sequence[tuple[int, int]], count: int) -> list[tuple[int, int]]:
    pairs = []
    for i, j in whole_pairs(closed, "closed").tolist():
        if not 0 <= i < j < count:
            raise ValueError(
                f"closed: expected pairs of rests 0 to {count - 1}, the earlier one first, "
                f"got ({i}, {j})."
            )
        pairs.append((i, j))
    return pairs


def _moves(
    rows: list[tuple[int, int]], kind: str, interval: float, times: FloatArray | None
) -> list[slice]:
    """Increments between the rests.

    Those of rates lie between samples, equally spaced even where the stamps are not.
    """
    begin, end = np.array(rows).T
    if kind == "rates":
        end = end - 1
        if times is not None:
            since = (times - times[0]) / interval
            begin, end = np.rint(since[begin]).astype(int), np.rint(since[end]).astype(int)
    return [slice(first, last) for first, last in zip(end[:-1], begin[1:], strict=True)]


def _sizes(prior: PriorStandardDeviations) -> FloatArray:
    """Deviations (30,) of the unknowns; one g may change a bias by its own size."""
    checked_instance(prior, PriorStandardDeviations, "prior")
    triad = np.where(np.eye(3, dtype=bool), prior.scale_factor, prior.installation)
    sizes = np.concatenate(
        [
            triad[core.LOWER],
            np.full(3, prior.accelerometer_bias),
            triad.ravel(),
            np.full(3, prior.gyro_bias),
            np.full(9, prior.gyro_bias / g),
        ]
    )
    if not sizes.all():
        raise ValueError("prior: expected deviations above zero, got 0.")
    return sizes


def _variances(
    rate: FloatArray,
    force: FloatArray,
    rows: list[tuple[int, int]],
    poses: core.Poses,
    noise: ImuNoise | None,
) -> tuple[core.Variances, tuple[float, float]]:
    """Variances of the rests' means and of the turns between them, and their colour.

    `rate` and `force` (n, 3) are the samples; `noise` is used instead of the rests' own white
    noise.
    """
    interval = poses.interval
    if noise is None:
        width = max(1, round(_BLOCK / interval))
        rate, rate_colour = core.row_variance(rate, rows, width)
        force, force_colour = core.row_variance(force, rows, width)
    else:
        checked_instance(noise, ImuNoise, "noise")
        rate = np.full(3, noise.angle_random_walk**2 / interval)
        force = np.full(3, noise.velocity_random_walk**2 / interval)
        rate_colour = force_colour = np.nan
    per_increment = float(rate.mean()) * interval**2
    lengths = np.array([e - b for b, e in rows])[:, np.newaxis]
    variances = core.Variances(
        np.maximum(force / lengths, (_LEAST * poses.gravity) ** 2),
        np.maximum(rate / lengths, _LEAST**2),
        np.maximum(per_increment * np.diff(poses.edges), _LEAST**2),
        EARTH_RATE**2 / 3,  # of known size, in any direction
    )
    return variances, (rate_colour, force_colour)


def _warn_of_gravity(force: FloatArray, gravity: float) -> None:
    """Warn if the accelerometers at rest show another gravity, and refuse such as show none.

    The median counts, for biases push up in one rest and down in another.
    """
    sizes = np.linalg.norm(force, axis=-1)
    if not sizes.all():
        raise ValueError(
            "static_intervals: expected accelerometers that feel gravity at each rest, got zeros "
            f"in rest {int(np.argmin(sizes))}."
        )
    found = float(np.median(sizes))
    if not 1 / _GRAVITY_FACTOR < found / gravity < _GRAVITY_FACTOR:
        warnings.warn(
            f"gravity: expected what the accelerometers show at rest within a factor of "
            f"{_GRAVITY_FACTOR:g}, got {gravity:g} m/s^2, and they show {found:.4g}: the "
            "scale of all three would be wrong by that. Is it another planet's, or their unit?",
            InconsistentCalibrationWarning,
            stacklevel=3,
        )

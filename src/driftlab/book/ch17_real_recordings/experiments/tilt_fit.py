"""The fit that both publishers make: gravity, carried by the gyros over each move, must fit.

At rest the accelerometers must measure gravity in any pose. Then the gyros are asked to carry its
direction from each rest to the next; the angle that is left is the residual of the move. IMU-TK
(Tedaldi, Pretto, Menegatti 2014) and imu-calib (Mikov, Reginya, Moschevikin 2020) minimise the sum
of these squares, each move with the same weight. `calibrate_multi_position` weighs them by their
noise.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.linalg import inv, norm
from scipy.spatial.transform import Rotation

from driftlab.checks import FloatArray
from driftlab.core.loops import cumulative_product
from driftlab.core.quaternion import from_rotation_vector
from driftlab.core.vectors import cross_matrix, transform
from driftlab.recordings.recording import Recording

from .force_and_gravity import force_and_gravity

_UPPER = np.triu_indices(3)
_SETTLED = 1e-10
"""Change of a matrix entry with which the fit of the gyros ends; their triads are near one."""
_MOST_STEPS = 20


class Triad(NamedTuple):
    """Sensors that measure (I + error) true + bias."""

    error: FloatArray  # (3, 3)
    bias: FloatArray  # (3,)


class TiltFit(NamedTuple):
    """Gyros as the moves show them."""

    gyros: Triad
    deviation: FloatArray  # (3, 3), of the entries of the matrix, by the scatter of the residuals
    residuals: FloatArray  # (m,), angle left after each move, rad


def fit_accelerometers(force: FloatArray, gravity: float) -> Triad:
    """Fit accelerometers to gravity at rest, in axes that leave nothing below the diagonal.

    `force` (n, 3) has samples or means.
    """

    # The unknowns are C = (I + L)^-1, upper triangular as well, and the bias.
    matrix, bias = np.eye(3), np.zeros(3)
    for _ in range(_MOST_STEPS):
        unbiased = force - bias
        true = unbiased @ matrix.T
        size = norm(true, axis=1)
        up = true / size[:, np.newaxis]
        slope = np.concatenate([up[:, _UPPER[0]] * unbiased[:, _UPPER[1]], -up @ matrix], axis=1)
        # The normal equations are good enough here: nine unknowns of like size.
        step = np.linalg.solve(slope.T @ slope, slope.T @ (gravity - size))
        matrix[_UPPER] += step[:6]
        bias = bias + step[6:]
        if np.abs(step).max() < _SETTLED:
            break
    return Triad(inv(matrix) - np.eye(3), bias)


def calibrated(rows: FloatArray, triad: Triad) -> FloatArray:
    """True values of what a triad has measured, (n, 3)."""
    return (rows - triad.bias) @ inv(np.eye(3) + triad.error).T


def fit_gyros(
    log: Recording,
    static_intervals: Sequence[tuple[int, int]],
    accelerometers: Triad,
    *,
    fixed_bias: FloatArray | None = None,
    fixed_error: FloatArray | None = None,
    leading: int | None = None,
    spline: bool = True,
) -> TiltFit:
    """Gyros that carry gravity from rest to rest, by least squares of the angles left.

    Rests are rows of the log. A bias or a matrix that is given is not sought. The first `leading`
    rows of a rest, or all, tell gravity there; the angle between two samples is the integral of a
    spline, or the interval times the first of them.
    """
    force = calibrated(force_and_gravity(log)[0], accelerometers)
    down = np.array([force[begin:end][:leading].mean(axis=0) for begin, end in static_intervals])
    down /= norm(down, axis=1, keepdims=True)
    moves = _padded(
        log.angles() if spline else log.gyro * log.interval, static_intervals, log.interval
    )
    bias = np.zeros(3) if fixed_bias is None else fixed_bias
    # The unknowns are C = (I + K)^-1 and c = C b, in which calibrated angles are linear.
    matrix = np.eye(3) if fixed_error is None else np.asarray(inv(np.eye(3) + fixed_error), float)
    shift = matrix @ bias
    for _ in range(_MOST_STEPS):
        left, slope = _residuals(moves, down, matrix, shift)
        if fixed_bias is not None:
            slope = slope[:, :9] + np.einsum("nk,l->nkl", slope[:, 9:], bias).reshape(-1, 9)
        if fixed_error is not None:
            slope = slope[:, 9:]
        step = np.linalg.lstsq(slope, -left.ravel(), rcond=None)[0]
        if np.abs(step).max(initial=0.0) < _SETTLED:
            break
        if fixed_error is None:
            matrix = matrix + step[:9].reshape(3, 3)
        shift = matrix @ bias if fixed_bias is not None else shift + step[-3:]
    triad = np.asarray(inv(matrix), float)
    return TiltFit(
        Triad(triad - np.eye(3), triad @ shift),
        _deviation(triad, left, slope) if fixed_error is None else np.zeros((3, 3)),
        norm(left, axis=1),
    )


def _padded(
    angles: FloatArray, static_intervals: Sequence[tuple[int, int]], interval: float
) -> FloatArray:
    """Angles and interval (m, n, 4) of the moves between rests, and zeros after each one's end."""
    moves = [angles[a[1] : b[0]] for a, b in pairwise(static_intervals)]
    padded = np.zeros((len(moves), max(map(len, moves)), 4))
    for row, move in zip(padded, moves, strict=True):
        row[: len(move), :3] = move
        row[: len(move), 3] = interval
    return padded


def _residuals(
    moves: FloatArray, down: FloatArray, matrix: FloatArray, shift: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Tilts left (m, 3), and their slopes (3m, 12) over the matrix and the shift."""
    steps = from_rotation_vector(moves @ np.column_stack([matrix, -shift]).T)
    attitudes = Rotation.from_quat(cumulative_product(steps).reshape(-1, 4))
    turned = attitudes.as_matrix().reshape(*moves.shape[:2], 3, 3)
    before, carried = down[:-1], transform(turned[:, -1], down[1:])
    # A small turn in step k turns all that follows, about its axis as seen at the start.
    seen = np.zeros_like(turned)
    seen[:, 0], seen[:, 1:] = np.eye(3), turned[:, :-1]
    count = len(moves)
    sums = (seen.reshape(count, -1, 9).swapaxes(1, 2) @ moves).reshape(count, 3, 3, 4)
    turns = np.concatenate([sums[..., :3].reshape(count, 3, 9), -sums[..., 3]], axis=2)
    slopes = -cross_matrix(before) @ cross_matrix(carried) @ turns
    return np.cross(before, carried), slopes.reshape(-1, 12)


def _deviation(triad: FloatArray, left: FloatArray, slope: FloatArray) -> FloatArray:
    """Deviations (3, 3) of I + K = C^-1, two independent components of tilt a move."""
    unknowns = slope.shape[1]
    variance = (left**2).sum() / (2 * len(left) - unknowns)
    covariance = variance * np.linalg.inv(slope.T @ slope)[:9, :9]
    of_triad = np.kron(triad, triad.T)
    return np.sqrt(np.diag(of_triad @ covariance @ of_triad.T)).reshape(3, 3)

"""Gravity from rest to rest: the residuals of a unit's poses, and what they depend on.

The arithmetic behind `driftlab.calibration.poses`. The unknowns are 30: the error matrix L of the
accelerometers, nothing above its diagonal, row by row; their bias; the matrix K of the gyros, row
by row; their bias; and what specific force adds to it, a matrix G, row by row.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from driftlab.checks import FloatArray

from .attitude import step_quaternions
from .coning import ConingSteps
from .loops import cumulative_product
from .quaternion import conjugate, multiply, to_matrix, to_rotation_vector
from .vectors import cross_matrix, left_jacobian, norms

LOWER = np.tril_indices(3)
FORCE, FORCE_BIAS = np.s_[0:6], np.s_[6:9]
GYRO, GYRO_BIAS = np.s_[9:18], np.s_[18:21]
SENSITIVITY = np.s_[21:30]
UNKNOWNS = 30


class Poses(NamedTuple):
    """What a recording says of n rests and of the ways between them.

    `force` and `rate` (n, 3) are means over the rests. `angle` and `velocity` (N, 3) are measured
    increments of `interval` over the moves, one after the other, the latter None for gyros that do
    not feel force; the move from rest i to the next has the rows `edges[i]` to `edges[i + 1]`.
    Between the rests of each row (i, j) of `closed` the unit has come back to its attitude; `open`
    are the rests i after which gravity counts.
    """

    force: FloatArray
    rate: FloatArray
    angle: FloatArray
    velocity: FloatArray | None
    interval: float
    edges: np.ndarray
    gravity: float
    closed: np.ndarray
    open: np.ndarray
    algorithm: ConingSteps


class Variances(NamedTuple):
    """Of the noise of each component: means of force and rate (n, 3), turns over moves (n - 1,).

    And of each component of the Earth's rate, which is one vector through all rests and moves.
    """

    force: FloatArray
    rate: FloatArray
    move: FloatArray
    earth: float


def matrices(
    unknowns: FloatArray,
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]:
    """L (..., 3, 3), its bias (..., 3), K (..., 3, 3), its bias (..., 3) and G (..., 3, 3)."""
    lead = unknowns.shape[:-1]
    lower = np.zeros((*lead, 3, 3))
    lower[..., LOWER[0], LOWER[1]] = unknowns[..., FORCE]
    gyro = unknowns[..., GYRO].reshape(*lead, 3, 3)
    sensitivity = unknowns[..., SENSITIVITY].reshape(*lead, 3, 3)
    return lower, unknowns[..., FORCE_BIAS], gyro, unknowns[..., GYRO_BIAS], sensitivity


def path_integrals(
    algorithm: ConingSteps,
    angle: FloatArray,
    inverse: FloatArray,
    sources: Sequence[FloatArray],
    begin: np.ndarray,
    end: np.ndarray,
) -> tuple[FloatArray, list[FloatArray]]:
    r"""Turns over p paths, body to the body axes at their beginning, and their derivatives.

    `angle` (N, 3) are compensated increments, `inverse` is A = (I + K)^-1. Let the measured
    increments be larger by dM s, where dM is some matrix and s a source (N, 3), the increments
    themselves for one. The turn is then smaller by the rotation vector of sum(C A dM s) in the axes
    of the beginning, C being the attitude on the way. For each source (N, m): the derivatives
    (p, 3, 3, m) by the entries of its matrix.
    """
    steps = step_quaternions(algorithm, angle)
    quaternions = np.concatenate([[[0.0, 0.0, 0.0, 1.0]], cumulative_product(steps)])
    start = quaternions[begin]
    back = to_matrix(conjugate(start))
    # The mean attitude over each step, relative to its beginning, is the left Jacobian.
    mean = to_matrix(quaternions[:-1]) @ left_jacobian(angle) @ inverse
    middle = mean.reshape(-1, 9)
    derivatives = []
    for source in sources:
        sums = [middle[b:e].T @ source[b:e] for b, e in zip(begin, end, strict=True)]
        derivatives.append(
            -np.einsum("pab,pbcm->pacm", back, np.reshape(sums, (-1, 3, 3, source.shape[1])))
        )
    return multiply(conjugate(start), quaternions[end]), derivatives


class PoseModel:
    """Residuals of poses at given unknowns, and their derivatives; the last ones are kept.

    In this order: |force| - gravity of each rest, m/s^2; the tilt that gravity shows after each
    open move, two numbers, rad; the turn left over each closed path, three, rad; the gyros' mean at
    each rest less the bias, three, rad/s.
    """

    def __init__(self, poses: Poses):
        self.poses = poses
        self._at: FloatArray | None = None
        self.face(np.zeros(UNKNOWNS))
        count = len(poses.force)
        self.rests = np.s_[:count]
        self.moves = np.s_[count : count + 2 * len(poses.open) + 3 * len(poses.closed)]
        self.rates = np.s_[self.moves.stop : self.moves.stop + 3 * count]
        self.size = self.rates.stop

    def face(self, unknowns: FloatArray) -> None:
        """Take the components across gravity as the unknowns show it: they stay till told anew."""
        error, bias, *_ = matrices(unknowns)
        inverse = np.asarray(np.linalg.inv(np.eye(3) + error), np.float64)
        force = (self.poses.force - bias) @ inverse.T
        unit = force / norms(force)[:, np.newaxis]
        self._planes, self._at = _planes(unit[self.poses.open + 1]), None

    def residuals(self, unknowns: FloatArray) -> FloatArray:
        """All residuals (m,)."""
        self._evaluate(unknowns)
        return self._residuals

    def jacobian(self, unknowns: FloatArray) -> FloatArray:
        """Their derivatives (m, 30)."""
        self._evaluate(unknowns)
        return self._jacobian

    def covariance(self, unknowns: FloatArray, variances: Variances) -> FloatArray:
        """Covariance (m, m) of the residuals that comes from the noise.

        A rest's mean counts in its own residual and in those of the moves before and after it; the
        Earth's rate in all gyros, turned into the body as the moves before have left it.
        """
        self._evaluate(unknowns)
        poses, count = self.poses, len(self.poses.force)
        by_force = np.zeros((self.size, count, 3))
        by_force[np.arange(count), np.arange(count)] = self._unit @ self._inverse
        tilt = np.eye(3) - self._unit[:, :, np.newaxis] * self._unit[:, np.newaxis]
        tilt = tilt / self._norm[:, np.newaxis, np.newaxis] @ self._inverse
        by_turn = np.zeros((self.size, max(count - 1, 0), 3))
        row = self.moves.start
        for i, plane, seen, back in zip(
            poses.open, self._planes, self._seen, self._back, strict=True
        ):
            by_force[row : row + 2, i] = plane @ back @ tilt[i]
            by_force[row : row + 2, i + 1] = -plane @ tilt[i + 1]
            by_turn[row : row + 2, i] = plane @ cross_matrix(seen) @ back
            row += 2
        noise = np.einsum("anx,nx,bnx->ab", by_force, variances.force, by_force)
        for (i, j), through in zip(poses.closed, self._through, strict=True):
            by_turn[row : row + 3, i:j] = np.moveaxis(through, 0, 1)
            row += 3
        noise += np.einsum("amx,m,bmx->ab", by_turn, variances.move, by_turn)
        at = np.arange(self.rates.start, self.rates.stop)
        noise[at, at] += variances.rate.ravel()
        into_body = np.swapaxes(self._to_first, -1, -2)
        seconds = poses.interval * np.diff(poses.edges)
        by_earth = -np.einsum("amx,m,mxy->ay", by_turn, seconds, into_body[:-1])
        by_earth[self.rates] = -(self._measured @ into_body).reshape(-1, 3)
        noise += variances.earth * by_earth @ by_earth.T
        return noise

    def _evaluate(self, unknowns: FloatArray) -> None:
        if self._at is not None and np.array_equal(unknowns, self._at):
            return
        self._at = unknowns.copy()
        poses, count = self.poses, len(self.poses.force)
        error, bias, gyro_error, gyro_bias, sensitivity = matrices(unknowns)
        self._inverse = inverse = np.linalg.inv(np.eye(3) + error)
        force = (poses.force - bias) @ inverse.T
        self._norm = norms(force)
        self._unit = unit = force / self._norm[:, np.newaxis]
        # Derivatives of the force by the entries of L, nothing above its diagonal, and the bias.
        by_entry = -inverse[:, LOWER[0]] * force[:, np.newaxis, LOWER[1]]
        by_known = np.concatenate([by_entry, np.broadcast_to(-inverse, (count, 3, 3))], axis=-1)
        tilt = np.eye(3) - unit[:, :, np.newaxis] * unit[:, np.newaxis]
        by_known_unit = tilt @ by_known / self._norm[:, np.newaxis, np.newaxis]
        jacobian = np.zeros((self.size, UNKNOWNS))
        jacobian[self.rests, :9] = np.einsum("ni,nij->nj", unit, by_known)
        i = poses.open
        first = np.concatenate([np.arange(count - 1), poses.closed[:, 0]])
        last = np.concatenate([np.arange(1, count), poses.closed[:, 1]])
        self._measured = np.eye(3) + gyro_error
        gyro_inverse = np.asarray(np.linalg.inv(self._measured), np.float64)
        dt = poses.interval
        rest = poses.angle - dt * gyro_bias
        if poses.velocity is not None:
            velocity = (poses.velocity - dt * bias) @ inverse.T
            rest = rest - velocity @ sensitivity.T
        true = rest @ gyro_inverse.T
        sources = [true, np.full((len(true), 1), dt, np.float64)]
        if poses.velocity is not None:
            sources.append(velocity)
        attitude, by_source = path_integrals(
            poses.algorithm, true, gyro_inverse, sources, poses.edges[first], poses.edges[last]
        )
        by_turn = np.zeros((len(first), 3, UNKNOWNS))
        for part, values in zip((GYRO, GYRO_BIAS, SENSITIVITY), by_source, strict=False):
            by_turn[..., part] = values.reshape(len(first), 3, -1)
        chain = cumulative_product(attitude[: count - 1])
        self._to_first = to_matrix(np.concatenate([[[0.0, 0.0, 0.0, 1.0]], chain]))
        self._back = back = to_matrix(conjugate(attitude[i]))
        self._seen = seen = np.einsum("mij,mj->mi", back, unit[i])
        planes = self._planes
        tilts = np.einsum("mij,mj->mi", planes, seen - unit[i + 1])
        by_known_tilt = planes @ (back @ by_known_unit[i] - by_known_unit[i + 1])
        by_turn_tilt = planes @ cross_matrix(seen) @ back @ by_turn[i]
        closed = slice(count - 1, None)
        left = to_rotation_vector(attitude[closed])
        end_of_open = self.moves.start + 2 * len(i)
        jacobian[self.moves.start : end_of_open, :9] = by_known_tilt.reshape(-1, 9)
        jacobian[self.moves.start : end_of_open, 9:] = by_turn_tilt[..., 9:].reshape(-1, 21)
        by_turn_left = np.linalg.solve(left_jacobian(left), by_turn[closed])
        jacobian[end_of_open : self.moves.stop] = by_turn_left.reshape(-1, UNKNOWNS)
        jacobian[self.rates, GYRO_BIAS] = -np.tile(np.eye(3), (count, 1))
        by_entry_of_g = -np.einsum("ij,nk->nijk", np.eye(3), force)
        jacobian[self.rates, SENSITIVITY] = by_entry_of_g.reshape(-1, 9)
        self._through = self._turns_through(attitude)
        self._jacobian = jacobian
        self._residuals = np.concatenate(
            [
                self._norm - poses.gravity,
                tilts.ravel(),
                left.ravel(),
                (poses.rate - gyro_bias - force @ sensitivity.T).ravel(),
            ]
        )

    def _turns_through(self, attitude: FloatArray) -> list[FloatArray]:
        """For each closed path, matrices from the axes at its moves' beginnings to its own."""
        through = []
        for i, j in self.poses.closed:
            here, rows = np.array([0.0, 0.0, 0.0, 1.0]), []
            for move in range(i, j):
                rows.append(to_matrix(here))
                here = multiply(here, attitude[move])
            through.append(np.array(rows))
        return through


def _planes(unit: FloatArray) -> FloatArray:
    """Two directions (..., 2, 3) across unit vectors (..., 3), and across each other."""
    least = np.argmin(np.abs(unit), axis=-1)
    first = np.cross(unit, np.eye(3)[least])
    first /= norms(first)[..., np.newaxis]
    return np.stack([first, np.cross(unit, first)], axis=-2)

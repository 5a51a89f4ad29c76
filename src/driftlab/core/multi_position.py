"""Gravity from rest to rest: the residuals of a unit's poses, and the least squares of them.

The arithmetic behind `driftlab.calibration.multi_position`. The unknowns are 30: the error matrix L
of the accelerometers, nothing above its diagonal, row by row; their bias; the matrix K of the
gyros, row by row; their bias; and what specific force adds to it, a matrix G, row by row.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.linalg import solve_triangular
from scipy.optimize import brentq, least_squares

from driftlab.checks import FloatArray

from .attitude import step_quaternions
from .coning import ConingSteps
from .loops import cumulative_product
from .quantiles import chi_squared_quantile
from .quaternion import conjugate, multiply, to_matrix, to_rotation_vector
from .vectors import cross_matrix, left_jacobian, norms

LOWER = np.tril_indices(3)
FORCE, FORCE_BIAS = np.s_[0:6], np.s_[6:9]
GYRO, GYRO_BIAS = np.s_[9:18], np.s_[18:21]
SENSITIVITY = np.s_[21:30]
UNKNOWNS = 30
_PASSES = 12
_MOST = 100  # steps in one of them; five are usual
_UNSETTLED = (
    "static_intervals: expected residuals that a fit can settle on, got {}: a move that is cut, "
    "another unit, or noise stated much too small?"
)
_IN_THE_DARK = np.array([0.1] * 6 + [1.0] * 3 + [0.1] * 9 + [0.1] * 3 + [0.01] * 9)
"""An unknown that poses do not show better than so is in the dark: parts, rad, m/s^2, rad/s."""


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
        self.static_intervals = np.s_[:count]
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
        error, bias, gyro_error_matrix, gyro_bias, sensitivity = matrices(unknowns)
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
        jacobian[self.static_intervals, :9] = np.einsum("ni,nij->nj", unit, by_known)
        i = poses.open
        first = np.concatenate([np.arange(count - 1), poses.closed[:, 0]])
        last = np.concatenate([np.arange(1, count), poses.closed[:, 1]])
        self._measured = np.eye(3) + gyro_error_matrix
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


def row_variance(
    samples: FloatArray, rows: list[tuple[int, int]], width: int
) -> tuple[FloatArray, float]:
    """Variance (3,) of one sample that explains the means over `width`, and its share of colour."""
    white = sum(((samples[b:e] - samples[b:e].mean(axis=0)) ** 2).sum(axis=0) for b, e in rows)
    white = np.asarray(white / sum(e - b - 1 for b, e in rows))
    total, freedom = np.zeros(3), 0
    for b, e in rows:
        count = (e - b) // width
        if count > 1:
            means = samples[b : b + count * width].reshape(count, width, 3).mean(axis=1)
            total += ((means - means.mean(axis=0)) ** 2).sum(axis=0)
            freedom += count - 1
    if not freedom or not white.any():
        return white, np.nan
    slow = width * total / freedom
    return slow, float(slow.sum() / white.sum())


class PoseFit(NamedTuple):
    """Estimates (30,) with their covariance, residuals, tests, and how often these were evaluated.

    `turn` are the angles of all moves, the open ones first. Each kind of residuals has a row of
    `tests` (3, 5): chi-square, its freedom, bounds of 95 %, and the excess of its deviation.
    """

    unknowns: FloatArray
    covariance: FloatArray
    force: FloatArray
    turn: FloatArray
    rate: FloatArray
    tests: FloatArray
    iterations: int


def fit_poses(
    poses: Poses, variances: Variances, sizes: FloatArray | None, gyro_bias: FloatArray | None
) -> PoseFit:
    """Fit the unknowns of the poses by least squares, with deviations scaled to the residuals.

    `sizes` (30,) are those of the unknowns and `gyro_bias`, rad/s, the gyro biases, where
    known. Poses that leave unknowns undetermined without sizes, and a fit that does not
    settle, are refused.
    """
    model = PoseModel(poses)
    unknowns = np.zeros(UNKNOWNS)
    unknowns[GYRO_BIAS] = poses.rate.mean(axis=0) if gyro_bias is None else gyro_bias
    free = np.ones(UNKNOWNS, bool)
    free[GYRO_BIAS] = gyro_bias is None
    free[SENSITIVITY] = poses.velocity is not None
    excess, iterations = np.zeros(3), 0
    tests = np.zeros((3, 4))
    for turn in range(_PASSES):
        weights = _Weights(model, unknowns, free, variances, excess, sizes)
        if turn == 0 and sizes is None:
            _refuse_dark(weights.jacobian(unknowns[free]), free)
        found = least_squares(
            weights.residuals, unknowns[free], weights.jacobian, method="lm", max_nfev=_MOST
        )
        if not found.success:
            raise ValueError(_UNSETTLED.format(f"none in {_MOST} steps"))
        unknowns[free], iterations = found.x, iterations + found.nfev
        if turn:  # the first one is weighted for errors that were not known yet
            tests = weights.tests(found.x)
            before = excess
            excess = weights.missing(found.x, tests[:, 0] > tests[:, 3])
            if np.allclose(excess, before, rtol=1e-3, atol=0):
                break
    # Of the triangle of a QR decomposition, because squares would lose half the digits.
    inverse = np.linalg.inv(np.linalg.qr(weights.jacobian(found.x), mode="r"))
    covariance = np.zeros((UNKNOWNS, UNKNOWNS))
    covariance[np.ix_(free, free)] = inverse @ inverse.T
    residuals = model.residuals(unknowns)
    tilts, turns = np.split(residuals[model.moves], [2 * len(poses.open)])
    return PoseFit(
        unknowns=unknowns,
        covariance=covariance,
        force=residuals[model.static_intervals],
        turn=np.concatenate([norms(tilts.reshape(-1, 2)), norms(turns.reshape(-1, 3))]),
        rate=residuals[model.rates].reshape(-1, 3),
        tests=np.column_stack([tests, excess]),
        iterations=iterations,
    )


class _Weights:
    """Residuals divided by their deviations: those of the noise, and an excess for each kind.

    The Cholesky factor takes the kinds in order, so each kind's sum of squares is that of what the
    kinds before it did not say already, and the sums add up to the whole.
    """

    def __init__(
        self,
        model: PoseModel,
        unknowns: FloatArray,
        free: np.ndarray,
        variances: Variances,
        excess: FloatArray,
        sizes: FloatArray | None,
    ):
        self.model, self.excess, self.free, self._at = model, excess, free, unknowns.copy()
        self.sizes = None if sizes is None else sizes[free]
        self.kinds = (model.static_intervals, model.moves, model.rates)
        model.face(unknowns)
        none = Variances._make(map(np.zeros_like, variances))
        self._noise = model.covariance(unknowns, variances)
        self._units = [
            model.covariance(unknowns, none._replace(force=none.force + 1)),
            model.covariance(unknowns, none._replace(move=none.move + 1)),
            model.covariance(unknowns, none._replace(rate=none.rate + 1)),
        ]
        self._factor = self._root(excess)

    def _root(self, excess: FloatArray) -> FloatArray:
        total = self._noise + sum(e**2 * unit for e, unit in zip(excess, self._units, strict=True))
        try:
            return np.linalg.cholesky(total)
        except np.linalg.LinAlgError:  # the excess of one kind drowns the noise of the others
            raise ValueError(_UNSETTLED.format("some far beyond the noise")) from None

    def _whole(self, free: FloatArray) -> FloatArray:
        self._at[self.free] = free
        return self._at

    def residuals(self, free: FloatArray) -> FloatArray:
        rows = _divided(self._factor, self.model.residuals(self._whole(free)))
        return rows if self.sizes is None else np.concatenate([rows, free / self.sizes])

    def jacobian(self, free: FloatArray) -> FloatArray:
        rows = _divided(self._factor, self.model.jacobian(self._whole(free))[:, self.free])
        return rows if self.sizes is None else np.concatenate([rows, np.diag(1 / self.sizes)])

    def freedoms(self, free: FloatArray) -> list[float]:
        """Of each kind: residuals less leverage."""
        columns, _ = np.linalg.qr(self.jacobian(free))
        leverage = (columns**2).sum(axis=1)
        return [float((1 - leverage[kind]).sum()) for kind in self.kinds]

    def tests(self, free: FloatArray) -> FloatArray:
        """Chi-square of each kind (3, 4), its freedom and bounds, by the noise alone.

        The other kinds keep their excess. Otherwise what one kind lacks would be asked of the
        others, which see the same unknowns.
        """
        residuals = self.model.residuals(self._whole(free))
        tests = np.full((3, 4), np.nan)
        for index, freedom in enumerate(self.freedoms(free)):
            excess = self.excess.copy()
            excess[index] = 0.0
            rows = _divided(self._root(excess), residuals)[self.kinds[index]]
            tests[index, :2] = (rows**2).sum(), freedom
            if freedom > 0.5:
                tests[index, 2:] = chi_squared_quantile([0.025, 0.975], freedom)
        return tests

    def missing(self, free: FloatArray, wanted: np.ndarray) -> FloatArray:
        """Excess (3,) with which the squares of each kind add up to their freedom."""
        found, freedoms = self.excess.copy(), self.freedoms(free)
        residuals = self.model.residuals(self._whole(free))
        for index, kind in enumerate(self.kinds):
            if not wanted[index]:
                found[index] = 0.0
                continue

            def surplus(size: float, index: int = index, kind: slice = kind) -> float:
                found[index] = size
                rows = _divided(self._root(found), residuals)[kind]
                return float((rows**2).sum()) - freedoms[index]

            most = 10 * float(np.abs(residuals[kind]).max())
            found[index] = brentq(surplus, 0.0, most, rtol=1e-4) if surplus(0.0) > 0 else 0.0
        return found


def _divided(factor: FloatArray, rows: FloatArray) -> FloatArray:
    return solve_triangular(factor, rows, lower=True)


def _refuse_dark(jacobian: FloatArray, free: np.ndarray) -> None:
    """Refuse poses that do not show some unknowns at all."""
    _, sizes, directions = np.linalg.svd(jacobian * _IN_THE_DARK[free])
    hidden = directions[np.count_nonzero(sizes >= 1) :]
    if len(hidden):
        count = len(directions)
        share = np.sqrt((hidden**2).sum(axis=0))
        names = np.array(_names())[free]
        dark = [name for name, part in zip(names, share, strict=True) if part > 0.3]
        raise ValueError(
            f"static_intervals: expected poses that show all {count} numbers, got such that show "
            f"{count - len(hidden)}; in the dark, alone or together: {', '.join(dark)}. "
            "More poses help, tilted ones too, with moves about all three axes; or a prior."
        )


def _names() -> list[str]:
    """Names of the unknowns."""

    def entry(triad: str, i: int, j: int) -> str:
        kind = "scale " if i == j else "installation "
        return f"{triad} {kind}{'xyz'[i]}{'' if i == j else 'xyz'[j]}"

    return [
        *(entry("accelerometer", i, j) for i in range(3) for j in range(i + 1)),
        *(f"accelerometer bias {axis}" for axis in "xyz"),
        *(entry("gyro", i, j) for i in range(3) for j in range(3)),
        *(f"gyro bias {axis}" for axis in "xyz"),
        *(f"gyro sensitivity {'xyz'[i]}{'xyz'[j]}" for i in range(3) for j in range(3)),
    ]

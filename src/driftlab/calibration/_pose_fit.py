"""The least squares behind a calibration by poses: weights from the noise, and tests of them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.constants import g
from scipy.linalg import solve_triangular
from scipy.optimize import brentq, least_squares

from driftlab.checks import FloatArray, checked_instance
from driftlab.core import poses as core
from driftlab.core.poses import PoseModel, Poses, Variances
from driftlab.core.quantiles import chi_squared_quantile
from driftlab.core.vectors import norms
from driftlab.imu import PriorDeviations

from .error_model import AXES
from .pose_results import Consistency

KINDS = ("rests", "moves", "rates")
"""Kinds of residuals: |force| at rest, tilt or turn after a move, gyros at rest."""
_PASSES = 12
_MOST = 100  # steps in one of them; five are usual
_IN_THE_DARK = np.array([0.1] * 6 + [1.0] * 3 + [0.1] * 9 + [0.1] * 3 + [0.01] * 9)
"""An unknown that poses do not show better than so is in the dark: parts, rad, m/s^2, rad/s."""


class PoseFit(NamedTuple):
    """What the least squares found, in the axes of `driftlab.core.poses`.

    Attributes
    ----------
    unknowns : ndarray, shape (30,)
        Estimates.
    covariance : ndarray, shape (30, 30)
        Of their errors.
    force, turn, rate : ndarray
        Residuals as in `driftlab.calibration.poses.PoseCalibration`.
    consistency : dict of str to Consistency
        For each of `KINDS`.
    iterations : int
        Evaluations of all residuals.

    Examples
    --------
    See `driftlab.calibration.poses.calibrate_by_poses`.
    """

    unknowns: FloatArray
    covariance: FloatArray
    force: FloatArray
    turn: FloatArray
    rate: FloatArray
    consistency: dict[str, Consistency]
    iterations: int


def fit_poses(
    poses: Poses,
    variances: Variances,
    prior: PriorDeviations | None = None,
    gyro_bias: FloatArray | None = None,
) -> PoseFit:
    """Fit the unknowns of the poses by least squares, with deviations scaled to the residuals.

    `prior` holds the sizes of the unknowns and `gyro_bias`, rad/s, the gyro biases, where
    known. Poses that leave unknowns undetermined without a prior, and a fit that does not
    settle, are refused.
    """
    model = PoseModel(poses)
    unknowns = np.zeros(core.UNKNOWNS)
    unknowns[core.GYRO_BIAS] = poses.rate.mean(axis=0) if gyro_bias is None else gyro_bias
    free = np.ones(core.UNKNOWNS, bool)
    free[core.GYRO_BIAS] = gyro_bias is None
    free[core.SENSITIVITY] = poses.velocity is not None
    sizes = None if prior is None else _sizes(prior)
    excess, iterations = np.zeros(3), 0
    tests: list[Consistency] = []
    for turn in range(_PASSES):
        weights = _Weights(model, unknowns, free, variances, excess, sizes)
        if turn == 0 and sizes is None:
            _refuse_dark(weights.jacobian(unknowns[free]), free)
        found = least_squares(
            weights.residuals, unknowns[free], weights.jacobian, method="lm", max_nfev=_MOST
        )
        if not found.success:
            raise ValueError(
                f"rests: expected residuals that a fit can settle on, got none in {_MOST} steps: "
                "a move that is cut, another unit, or noise stated much too small?"
            )
        unknowns[free], iterations = found.x, iterations + found.nfev
        if turn:  # the first one is weighted for errors that were not known yet
            tests = weights.tests(found.x)
            before = excess
            excess = weights.missing(found.x, [test.chi_square > test.upper for test in tests])
            if np.allclose(excess, before, rtol=1e-3, atol=0):
                break
    jacobian = weights.jacobian(found.x)
    # Of the triangle of a QR decomposition, because squares would lose half the digits.
    inverse = np.linalg.inv(np.linalg.qr(jacobian, mode="r"))
    covariance = np.zeros((core.UNKNOWNS, core.UNKNOWNS))
    covariance[np.ix_(free, free)] = inverse @ inverse.T
    residuals = model.residuals(unknowns)
    tilts, turns = np.split(residuals[model.moves], [2 * len(poses.open)])
    return PoseFit(
        unknowns,
        covariance,
        residuals[model.rests],
        np.concatenate([norms(tilts.reshape(-1, 2)), norms(turns.reshape(-1, 3))]),
        residuals[model.rates].reshape(-1, 3),
        {
            kind: test._replace(excess=float(e))
            for kind, test, e in zip(KINDS, tests, excess, strict=True)
        },
        iterations,
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
        self.kinds = (model.rests, model.moves, model.rates)
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
        return np.linalg.cholesky(total)

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

    def tests(self, free: FloatArray) -> list[Consistency]:
        """Of each kind by the noise alone, while the other kinds keep their excess.

        Otherwise what one kind lacks would be asked of the others, which see the same unknowns.
        """
        residuals = self.model.residuals(self._whole(free))
        tests = []
        for index, freedom in enumerate(self.freedoms(free)):
            excess = self.excess.copy()
            excess[index] = 0.0
            rows = _divided(self._root(excess), residuals)[self.kinds[index]]
            low, high = np.nan, np.nan
            if freedom > 0.5:
                low, high = chi_squared_quantile([0.025, 0.975], freedom)
            squares = float((rows**2).sum())
            tests.append(Consistency(squares, freedom, float(low), float(high), 0.0))
        return tests

    def missing(self, free: FloatArray, wanted: list[bool]) -> FloatArray:
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


def _sizes(prior: PriorDeviations) -> FloatArray:
    """Deviations (30,) of the unknowns; one g may change a bias by its own size."""
    checked_instance(prior, PriorDeviations, "prior")
    triad = np.where(np.eye(3, dtype=bool), prior.scale, prior.installation)
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
            f"rests: expected poses that show all {count} numbers, got such that show "
            f"{count - len(hidden)}; in the dark, alone or together: {', '.join(dark)}. "
            "More poses help, tilted ones too, with moves about all three axes; or a prior."
        )


def _names() -> list[str]:
    """Names of the unknowns."""

    def entry(triad: str, i: int, j: int) -> str:
        kind = "scale " if i == j else "installation "
        return f"{triad} {kind}{AXES[i]}{'' if i == j else AXES[j]}"

    return [
        *(entry("accelerometer", i, j) for i in range(3) for j in range(i + 1)),
        *(f"accelerometer bias {axis}" for axis in AXES),
        *(entry("gyro", i, j) for i in range(3) for j in range(3)),
        *(f"gyro bias {axis}" for axis in AXES),
        *(f"gyro sensitivity {AXES[i]}{AXES[j]}" for i in range(3) for j in range(3)),
    ]

"""Non-orthogonality from several turns: axes, weighings, least squares; Larin (3.4), (3.5)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    finite_array,
    nonzero_vectors,
)

PAIR_AXES: FloatArray = np.array([[1.0, 1, 0], [1, 0, 1], [0, 1, 1]]) / np.sqrt(2)
"""Larin's (3.4): turning about row s gives sigma_s itself."""
PAIR_AXES.setflags(write=False)


YATES_AXES: FloatArray = np.vstack([PAIR_AXES, np.ones(3) / np.sqrt(3)])
"""Larin's (3.4) and (3.5): the three pair axes and the space diagonal."""
YATES_AXES.setflags(write=False)


def weighing(estimates: ArrayLike) -> FloatArray:
    """Non-orthogonality from four turns by Yates's weighing design; Larin, last formulas.

    Parameters
    ----------
    estimates : array_like, shape (..., 4)
        Estimates of sigma1, sigma2, sigma3 and of their sum. The sum is **3/2** of the turn
        estimate about (1, 1, 1): the factor that (3.5) lacks in the copy.

    Returns
    -------
    ndarray, shape (..., 3)
        [sigma1, sigma2, sigma3], in the unit of the estimates.

    Notes
    -----
    Each result is half of a sum with two signs plus and two minus, so an offset common to all four
    *numbers* cancels, and independent noise of one size in all four keeps its variance. Three
    numbers less a fourth that shows the offset alone would have twice that variance.

    Examples
    --------
    The sigmas are 1, 2 and 3, and an offset of 10 is common to all four numbers:

    >>> weighing([11, 12, 13, 16])
    array([1., 2., 3.])
    """
    signs = np.array([[1, -1, -1, 1], [-1, 1, -1, 1], [-1, -1, 1, 1]])
    return 0.5 * finite_array(estimates, "estimates", 4) @ signs.T


class TurnFit(NamedTuple):
    """Least-squares solution for the non-orthogonality; the result of `fit_turns`.

    Attributes
    ----------
    sigma : ndarray, shape (..., 3)
        sigma1, sigma2, sigma3, without unit.
    scale : ndarray, shape (..., s)
        Scale-factor errors, without unit: none, one common to all gyros, or one for each gyro.
    covariance : ndarray, shape (3 + s, 3 + s)
        Covariance of (sigma, scale) when each estimate has unit variance.

    Examples
    --------
    Larin's three axes give each sigma with the variance of one estimate:

    >>> fit_turns([1e-4, 2e-4, 3e-4], PAIR_AXES).covariance.diagonal().round(9)
    array([1., 1., 1.])
    """

    sigma: FloatArray
    scale: FloatArray
    covariance: FloatArray


def fit_turns(estimates: ArrayLike, axes: ArrayLike, scale: str = "none") -> TurnFit:
    """Least squares on any set of turn axes, with or without scale-factor errors; Larin (3.4).

    Parameters
    ----------
    estimates : array_like, shape (..., m)
        Turn estimates n^T Sigma n, one for each axis.
    axes : array_like, shape (m, 3)
        Axes n; only their directions count.
    scale : {"none", "common", "each"}
        Other unknowns: none, one scale-factor error common to the three gyros (an offset common to
        all estimates: a wrong turn angle looks the same), or one for each gyro.

    Returns
    -------
    TurnFit
        The sigmas, the scale-factor errors, and their covariance for unit noise.

    Raises
    ------
    ValueError
        If the axes do not determine the unknowns.

    Examples
    --------
    With Yates's four axes a scale-factor error common to all gyros can be found as well:

    >>> from driftlab.drift.turn_calibration import TurnExperiment
    >>> triad = 1e-4 * np.array([[4, 1, 2], [1, 4, 3], [2, 3, 4]])
    >>> estimates = TurnExperiment().estimate(triad, YATES_AXES)
    >>> fit = fit_turns(estimates, YATES_AXES, scale="common")
    >>> print(fit.sigma.round(6), fit.scale.round(6))
    [0.0001 0.0002 0.0003] [0.0004]
    """
    n, _ = nonzero_vectors(axes, "axes")
    if n.ndim != 2:
        raise ValueError(f"axes: expected shape (m, 3), got shape {n.shape}.")
    estimates = finite_array(estimates, "estimates", len(n))
    squares = {"none": n[:, :0], "common": np.ones((len(n), 1)), "each": n**2}
    if scale not in squares:
        raise ValueError(f"scale: expected one of {', '.join(squares)}, got {scale!r}.")
    x, y, z = n.T
    design = np.column_stack([2 * x * y, 2 * x * z, 2 * y * z, squares[scale]])
    unknowns = design.shape[1]
    if np.linalg.matrix_rank(design) < unknowns:
        raise ValueError(
            f"axes: expected axes that determine {unknowns} unknowns, "
            f"got {len(n)} axes that determine {np.linalg.matrix_rank(design)}."
        )
    inverse = np.linalg.pinv(design)
    solution = estimates @ inverse.T
    return TurnFit(solution[..., :3], solution[..., 3:], inverse @ inverse.T)

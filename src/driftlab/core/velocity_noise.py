"""How much of what is left of a level velocity is swaying, and how much a walk of the carried axes.

Four kinds of noise stand in the velocity that is left when gravity's is taken out. A base that
sways near its place has the derivative of a displacement that forgets. The accelerometers' rounding
forgets itself. Their noise makes a velocity that walks, and so do the small jumps that are seen
where a base is shaken. And axes whose angle walks, as white gyro noise lets them, have a velocity
whose second derivative is white. The sizes come from the likelihood of the velocity without its
parabola (restricted maximum likelihood, REML), because from the parabola the heading is found.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from scipy.linalg import null_space

from driftlab.checks import FloatArray

MOST_WINDOWS, FEWEST_WINDOWS = 32, 8
STEPS_A_WINDOW = 4
"""Fewest steps from one window to the next."""
_FINE = 8  # points from one window to the next, for the covariances
_RATIOS = (np.geomspace(1e-1, 1e4, 6), np.ones(1), np.geomspace(1e-2, 1e4, 10),
           np.geomspace(1e-3, 1e6, 14))  # fmt: skip
"""Sizes of the four, in variance, beside that which forgets."""


def mean_deviation(level: FloatArray, densities: FloatArray) -> FloatArray:
    """Standard deviation (...) of an estimate, from what is left of a level velocity (..., m, 2).

    The unit of time is the length of the record. `densities` (4,) are the variances of the estimate
    when displacement, velocity, or the velocity's first or second derivative is white with density
    1. Their sizes are not known well, so the variance is the mean over many ratios of them, each
    with its likelihood for weight.
    """
    count = window_count(level.shape[-2])
    blind, inverses, log_determinants, mixtures = _mixtures(count)
    seen = blind.T @ _windows(level, count)
    squares = np.einsum("...ia,kij,...ja->...k", seen, inverses, seen, optimize=True)
    freedom = 2 * blind.shape[1]
    # Nothing left at all is no noise at all.
    size = np.maximum(squares / freedom, np.finfo(float).tiny)
    score = -0.5 * freedom * np.log(size) - log_determinants
    likelihood = np.exp(score - score.max(axis=-1, keepdims=True))
    variance = (likelihood * size) @ (mixtures @ densities) / likelihood.sum(axis=-1)
    deviation: FloatArray = np.sqrt(variance)
    return deviation


def window_count(steps: int) -> int:
    """Number of windows into which a record of so many steps is divided."""
    return min(MOST_WINDOWS, steps // STEPS_A_WINDOW - 1)


def _windows(level: FloatArray, count: int) -> FloatArray:
    """Means (..., count, 2) under raised cosines that overlap by half: they hardly see a sway whose
    period is shorter than they are. They are all alike, so less than a step is left at the end."""
    step = level.shape[-2] // (count + 1)
    bell = np.sin(np.pi * (np.arange(2 * step) + 0.5) / (2 * step)) ** 2 / step
    begins = step * np.arange(count)
    return np.stack([bell @ level[..., i : i + 2 * step, :] for i in begins], axis=-2)


@lru_cache
def _mixtures(count: int) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Mixtures of the four noises, k of them, as windows show them that are blind to a parabola.

    Returns the combinations (count, count - 3) of windows, the inverse covariances
    (k, count - 3, count - 3) and logarithms of the determinants (k,), and the densities (k, 4).
    """
    points = (count + 1) * _FINE
    times = (np.arange(points) + 0.5) / points
    bells = _windows(np.eye(points), count)
    blind = null_space(np.stack([bells @ times**power for power in range(3)]))
    bells = blind.T @ bells
    early, late = np.minimum(times[:, np.newaxis], times), np.maximum(times[:, np.newaxis], times)
    slopes = np.diff(bells, axis=1, prepend=0.0, append=0.0) * points
    noises = np.stack(
        [
            points * slopes @ slopes.T,
            points * bells @ bells.T,
            bells @ early @ bells.T,
            bells @ (early**2 * (3 * late - early) / 6) @ bells.T,
        ]
    )
    sizes = np.trace(noises, axis1=1, axis2=2) / len(bells)
    ratios = np.stack(np.meshgrid(*_RATIOS), axis=-1).reshape(-1, len(noises))
    mixtures = ratios / sizes
    covariances = np.tensordot(mixtures, noises, 1)
    return blind, np.linalg.inv(covariances), np.linalg.slogdet(covariances)[1], mixtures

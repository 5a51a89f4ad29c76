"""What a coning correction makes of noise on the increments, while the body turns steadily.

A cross product of increments multiplies the noise of one by the turn of the other. In the corrected
sum f = gamma + c of a step, the noise n_k of the increment at place k then stands with the factor
1 + b_k θ×, where θ is the turn of one sample and b_k the sum of the weights of the products in
which the increment is the right factor, less that of those in which it is the left one.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_array

from .coning_algorithms import Algorithm, _coning_algorithm


class NoiseGrowth(NamedTuple):
    """Variance of the attitude across the axis of a steady turn, which a sample adds.

    Attributes
    ----------
    white, carried : ndarray, shape (...)
        In units of the variance of independent noise on each increment, and of that of rounding
        whose error is carried over to the next increment.
    """

    white: FloatArray
    carried: FloatArray


def correction_gains(algorithm: str | Algorithm) -> FloatArray:
    """Gains b_k of the coning correction for the noise of each increment.

    Parameters
    ----------
    algorithm : str or Algorithm
        A key of `CONING_ALGORITHMS`, or a custom algorithm.

    Returns
    -------
    ndarray, shape (window,)
        Place 0 is the oldest increment. Their sum is zero: a common error is parallel in all.

    Examples
    --------
    >>> correction_gains("rotation-vector-3").round(3)
    array([-1.125,  0.   ,  1.125])
    """
    chosen = _coning_algorithm(algorithm)
    gains = np.zeros(chosen.window)
    for (i, j), weight in chosen.coning.items():
        gains[i] -= weight
        gains[j] += weight
    return gains


def step_noise_covariance(algorithm: str | Algorithm, turn: ArrayLike) -> FloatArray:
    """Covariance of the corrected sum of one step, of the first order in the noise.

    Parameters
    ----------
    algorithm : str or Algorithm
        A key of `driftlab.attitude.CONING_ALGORITHMS`, or a custom algorithm.
    turn : array_like, shape (..., 3)
        Turn θ of the body during one sample, rad.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        In units of the variance of independent noise on each component of an increment:
        m 1 + B (|θ|² 1 - θ θ'), with m samples a step and B the sum of the squares of the gains.

    Examples
    --------
    >>> np.diag(step_noise_covariance("two-step-4", [0.0, 0.0, 0.1])).round(4)
    array([2.0089, 2.0089, 2.    ])
    """
    chosen = _coning_algorithm(algorithm)
    angle = finite_array(turn, "turn", 3)
    square = np.sum(angle**2, axis=-1)[..., np.newaxis, np.newaxis]
    across = square * np.eye(3) - angle[..., :, np.newaxis] * angle[..., np.newaxis, :]
    gains = correction_gains(chosen)
    return np.asarray(chosen.samples * np.eye(3) + gains @ gains * across)


def noise_growth(algorithm: str | Algorithm, sample_angle: ArrayLike) -> NoiseGrowth:
    """Growth of the attitude's variance with noisy increments, a sample, across a steady turn.

    Parameters
    ----------
    algorithm : str or Algorithm
        A key of `driftlab.attitude.CONING_ALGORITHMS`, or a custom algorithm.
    sample_angle : array_like, shape (...)
        Angle θ by which the body turns during one sample, rad.

    Returns
    -------
    NoiseGrowth
        `white` and `carried`.

    Notes
    -----
    Across the axis, vectors are complex numbers and θ× is i θ. An error of the step that begins
    after s samples arrives turned by e^(i s θ); one of its rotation vector m θ counts times
    j = (e^(i m θ) - 1)/(i m θ). So the noise of an increment arrives multiplied by the sum of
    e^(i s θ) j (1 + i b θ) over the steps that use it, where 1 stands for those that it belongs to.
    White noise adds up by the squares of these numbers, rounding that is carried over by the
    squares of their differences. Last stages other than the rotation vector differ by their error.

    Examples
    --------
    >>> growth = noise_growth("rotation-vector-2", 0.1)
    >>> print(f"{growth.white:.5f} {growth.carried:.5f}")
    1.00110 0.01110
    """
    chosen = _coning_algorithm(algorithm)
    theta = np.asarray(finite_array(sample_angle, "sample_angle"))[..., np.newaxis]
    gains, m = correction_gains(chosen), chosen.samples
    # e^(ix) - 1 over ix is a turn by x/2 times sin(x/2)/(x/2).
    lumped = np.exp(0.5j * m * theta) * np.sinc(m * theta / (2 * np.pi))
    if chosen.memory:
        # The increment is the last of one window, and an older one of the windows that follow.
        later = np.exp(1j * theta * np.arange(chosen.memory, -1, -1))
        arriving = lumped * (1 + 1j * theta * (gains * later).sum(axis=-1, keepdims=True))
    else:
        arriving = lumped * (1 + 1j * theta * gains)
    # That of the increment after each; after the last comes the first of the next step.
    after = np.concatenate([arriving[..., 1:], arriving[..., :1] * np.exp(1j * m * theta)], axis=-1)
    return NoiseGrowth(
        np.asarray(np.mean(np.abs(arriving) ** 2, axis=-1))[()],
        np.asarray(np.mean(np.abs(after - arriving) ** 2, axis=-1))[()],
    )

"""The noise of a gyro from its Allan deviation."""

from __future__ import annotations

import numpy as np
from scipy.optimize import least_squares, nnls

from driftlab.allan import AllanDeviation
from driftlab.checks import FloatArray, checked_instance, truth_value

from .noise import GyroNoise

_MODEL_ERROR = 0.05
"""No point counts as better known than this part of it: no gyro is quite like the model."""
_CORRELATION_TIMES = 25


def fit_gyro_noise(allan: AllanDeviation, *, quantised: bool = True) -> GyroNoise:
    """Find the noise of a gyro that has this Allan deviation, as nearly as it can have it.

    Parameters
    ----------
    allan : AllanDeviation
        Of one gyro's rate, with four averaging times or more.
    quantised : bool
        Whether a part that falls with the averaging time itself is sought as well.

    Returns
    -------
    GyroNoise
        With the interval of the record. How good it is, its `allan_deviation` shows beside the one
        found: there may be noise of another kind.

    Raises
    ------
    ValueError
        If there are several gyros, or fewer than four averaging times with a deviation above zero.

    Notes
    -----
    Least squares of the logarithms. Each point has the weight of its degrees of freedom, but none
    counts as known to better than 5 %. A part that the record does not need comes out as zero or
    far below the others.

    Examples
    --------
    >>> from driftlab.allan import allan_deviation
    >>> noise = GyroNoise(1e-6, 0.0, 60.0, 0.1, quantisation=1e-6)
    >>> rates = noise.samples(20_000, np.random.default_rng(1))
    >>> found = fit_gyro_noise(allan_deviation(rates, 0.1))
    >>> print(f"{found.white:.1e} {found.quantisation:.1e}")
    9.1e-07 1.0e-06
    """
    truth_value(quantised, "quantised")
    points = checked_instance(
        allan, AllanDeviation, "allan", "from allan_deviation(rates, interval)"
    )
    if points.deviation.ndim != 1:
        raise ValueError(
            "allan: expected that of one gyro, deviation of shape (k,), "
            f"got shape {points.deviation.shape}; take allan.row(0), say."
        )
    seen = points.deviation > 0
    if seen.sum() < 4:
        raise ValueError(
            "allan: expected four averaging times or more with a deviation above zero, "
            f"got {seen.sum()}."
        )
    times, found = points.averaging_times[seen], points.deviation[seen]
    weight = 1 / np.sqrt(1 / (2 * points.degrees_of_freedom[seen]) + _MODEL_ERROR**2)
    h = points.interval

    def curves(correlation_time: float) -> FloatArray:
        """Allan variances (k, n) of parts of size one."""
        parts = [GyroNoise(1.0, 0.0, correlation_time, h), GyroNoise(0.0, 1.0, correlation_time, h)]
        if quantised:
            parts.append(GyroNoise(0.0, 0.0, correlation_time, h, 1.0))
        return np.stack([part.allan_deviation(times) ** 2 for part in parts], axis=-1)

    def start(correlation_time: float) -> tuple[float, FloatArray]:
        """Misfit and sizes of the parts, least squares of the variances' ratios."""
        relative = curves(correlation_time) / found[:, None] ** 2 * weight[:, None]
        norms = np.linalg.norm(relative, axis=0)
        squares, misfit = nnls(relative / norms, weight)
        return float(misfit), np.sqrt(squares / norms)

    def misfits(logarithms: FloatArray) -> FloatArray:
        with np.errstate(over="ignore", invalid="ignore"):  # the search takes back such steps
            time, *sizes = np.exp(logarithms)
            variance = curves(float(time)) @ np.square(sizes)
            return weight * np.log(variance / found**2) / 2

    ends = times[0] / 2, 5 * times[-1]  # of what can be told apart from white noise or a ramp
    trials = [(*start(time), time) for time in np.geomspace(*ends, _CORRELATION_TIMES)]
    best = None
    for _, sizes, time in sorted(trials, key=lambda trial: trial[0])[:3]:
        # What is not needed begins small, so that it has a logarithm.
        small = 1e-3 * found.min() / np.sqrt(curves(time).max(axis=0))
        free = np.full(len(sizes), np.inf)
        result = least_squares(
            misfits,
            np.log([np.clip(time, 1.001 * ends[0], 0.999 * ends[1]), *np.maximum(sizes, small)]),
            bounds=([np.log(ends[0]), *-free], [np.log(ends[1]), *free]),
            jac="3-point",
            **dict.fromkeys(("ftol", "xtol", "gtol"), 1e-14),
        )
        if best is None or result.cost < best.cost:
            best = result
    assert best is not None
    time, white, gauss_markov, *rounding = map(float, np.exp(best.x))
    return GyroNoise(white, gauss_markov, time, h, *rounding)

"""Increments from sampled rates, which most logs hold; integrating instruments give increments."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import make_interp_spline

from .checks import FloatArray, finite_array, positive_number, shown, whole_number

_NEARLY_WHOLE = 1e-3
"""Part that the last interval may lack, because time stamps are rounded."""
_FEWEST = 500.0
"""Intervals to a sample that nobody wants: milliseconds taken for seconds make a thousand."""


def increments_from_rates(
    rates: ArrayLike,
    interval: float,
    *,
    times: ArrayLike | None = None,
    degree: int = 5,
    longest_gap: float = 1.5,
) -> FloatArray:
    """Angle increments over equal intervals, from sampled rates: integrals of a spline.

    Parameters
    ----------
    rates : array_like, shape (..., m, 3)
        Angular rate at m moments, body axes, rad/s: values at these moments, not means.
    interval : float
        Of the increments, s; and of the samples, if no `times` are given.
    times : array_like, shape (m,), optional
        Moments of the samples, s, or dates and times of NumPy, if they are not equally spaced or
        not those of the increments.
    degree : {5, 3, 7}
        Of the spline. The error of the integrals goes with this power of the spacing, plus one.
    longest_gap : float
        Longest time between two samples, in usual (median) spacings; more than 1. A single lost
        sample leaves a gap of 2.

    Returns
    -------
    ndarray, shape (..., n, 3)
        rad. The first begins with the first sample; what is left after the last whole interval is
        not used. Without `times` n is m - 1.

    Raises
    ------
    ValueError
        If there are not more samples than the degree, an argument is not finite, the times do not
        increase, have a gap that is too long or are no seconds, or no whole interval lies between
        the first and the last.

    See Also
    --------
    driftlab.recordings.from_dataframe : Checks units and stamps first.

    Notes
    -----
    A spline does well with ten samples and more in a period of the fastest motion. With two or
    fewer nothing helps: a faster motion leaves the same samples as a slower one. Across a gap it
    errs as if all samples were so far apart. If an instrument gives increments, use those. Specific
    force becomes increments of velocity in the same way.

    At an end the spline has samples on one side only, and magnifies their noise: white noise of
    variance 1 in the rates gives the first and last increment the variance 0.93, 2.2 and 10.3 for
    the degrees 3, 5 and 7, in units of interval², and those in the middle 0.66, 0.70 and 0.72. Sums
    of many increments grow alike for all degrees. Where the end matters, record a few more samples.

    Examples
    --------
    A tenth of a second on a cone, from rates at 100 Hz, by three degrees: errors in rad.

    >>> from driftlab.motion import Coning
    >>> cone = Coning(half_angle=0.02, frequency=5.0)
    >>> rates, true = cone.rate(np.arange(11) / 100), cone.increments(0.01, 10)
    >>> for degree in (3, 5, 7):
    ...     print(f"{np.abs(increments_from_rates(rates, 0.01, degree=degree) - true).max():.0e}")
    1e-06
    4e-08
    2e-09
    """
    rows = finite_array(rates, "rates", 3)
    if whole_number(degree, "degree") not in (3, 5, 7):
        raise ValueError(f"degree: expected 3, 5 or 7, got {shown(degree)}.")
    if rows.ndim < 2 or rows.shape[-2] <= degree:
        raise ValueError(
            f"rates: expected shape (..., m, 3) with m at least {degree + 1} for degree {degree}, "
            f"got shape {rows.shape}."
        )
    if not positive_number(longest_gap, "longest_gap") > 1:
        raise ValueError(f"longest_gap: expected more than 1, got {shown(longest_gap)}.")
    step, count = positive_number(interval, "interval"), rows.shape[-2]
    if times is None:
        moments, whole = step * np.arange(count), count - 1
    else:
        moments = _sample_times(times, count, longest_gap, step)
        # Seconds since 1970 are good to a quarter of a microsecond. An interval at the end that
        # lacks so little is whole; the spline goes on beyond the last sample.
        whole = int(moments[-1] / step + _NEARLY_WHOLE)
    if whole < 1:
        raise ValueError(
            f"interval: expected at most the time of all samples, {moments[-1]:g} s, got {step:g}."
        )
    spline = make_interp_spline(moments, rows, degree, axis=-2).antiderivative()
    return np.diff(spline(step * np.arange(whole + 1)), axis=-2)


def _sample_times(times: ArrayLike, count: int, longest_gap: float, interval: float) -> FloatArray:
    """Times (m,) of samples from the first on, s."""
    moments = finite_array(_seconds(times), "times", count)
    steps = np.diff(moments)
    if moments.ndim != 1:
        raise ValueError(f"times: expected {count} increasing times (m,), got {shown(times)}.")
    if not (steps > 0).all():
        row = int(np.argmin(steps > 0)) + 1
        raise ValueError(
            f"times: expected {count} increasing times (m,), got {moments[row]:.10g} after "
            f"{moments[row - 1]:.10g} in row {row + 1}."
        )
    usual = float(np.median(steps))
    if usual > _FEWEST * interval:
        raise ValueError(
            f"times: expected s, with steps of some {interval:g} s, the interval, got {usual:g}: "
            "are they in milliseconds, microseconds or nanoseconds? Multiply by 1e-3, 1e-6 or 1e-9."
        )
    longest = int(np.argmax(steps))
    if steps[longest] / usual > longest_gap * (1 + 1e-9):  # for all that rounding does
        raise ValueError(
            f"times: expected no gap longer than {longest_gap:g} times the usual "
            f"{usual:.6g} s (longest_gap), got {steps[longest]:.6g} s after the time "
            f"{moments[longest]:.10g}."
        )
    return moments - moments[0]


def _seconds(times: ArrayLike) -> ArrayLike:
    """Dates and times, or spans of time, as seconds since the first; others as they are."""
    kind = getattr(getattr(times, "dtype", None), "kind", "")  # of an array, or of a Series
    if kind not in ("m", "M") or np.ma.is_masked(times):
        return times
    array = np.asarray(times)
    if array.dtype.kind == "O":  # times of a zone, which NumPy knows as those of Greenwich
        array = np.asarray(times, "datetime64[ns]")
    if not array.size:
        return times
    if np.isnat(array).any():
        row = int(np.argmax(np.isnat(array)))
        raise ValueError(f"times: expected a time for each sample, got none in row {row + 1}.")
    # First the difference: of the seconds since 1970 the fractions are lost.
    return (array - array.flat[0]).astype("timedelta64[ns]").astype(float) * 1e-9

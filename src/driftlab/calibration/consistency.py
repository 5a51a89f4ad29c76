"""Are the innovations of a filter as large as it says, and without a mean?

If everything that the filter was told is true, its innovations, each divided by its deviation, are
independent normal numbers with mean zero and variance one. Then the sum of their squares (NIS) has
a chi-square distribution, and so has the square of their mean. The two tests see different slips.
Larger noise than told makes the squares too large. If the noise of the reference velocity was told
too large, the squares are too small, whatever else is wrong, and pass for good where a slip makes
up for it. The mean is not deceived: too large a noise makes it smaller, and a constant slip makes
it grow with the root of the time.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.special import chdtri, ndtri

from driftlab.checks import FloatArray, checked_instance

from .calibration_history import Calibration

CONFIDENCE = 1 - 1e-4
"""Of each bound: so many right runs keep it."""


class InconsistentWarning(UserWarning):
    """Warning that a record contradicts what the filter was told of it.

    Examples
    --------
    >>> import warnings
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("error", InconsistentWarning)  # no doubtful result passes
    """


class InnovationTest(NamedTuple):
    """Two-sided test of innovations, for each run.

    Attributes
    ----------
    squares : ndarray, shape (...)
        Mean squared innovation (NIS), divided by three: one if all is as the filter was told.
    lower, upper : float
        Bounds that `squares` keeps in all but one of 10 000 right runs. `calibrate` warns from a
        quarter above the upper one on, because no noise is known better.
    mean : ndarray, shape (...)
        Squared mean of the innovations, times their number, divided by three: one, too.
    mean_upper : float
        Bound of `mean`.
    correlation : ndarray, shape (...)
        Between one innovation and the next: zero, too.
    correlation_bound : float
        Bound of its size.

    Examples
    --------
    >>> test = InnovationTest(np.array(0.02), 0.9, 1.1, np.array(0.3), 7.0, np.array(0.8), 0.1)
    >>> str(test.verdict)
    'too cautious'
    """

    squares: FloatArray
    lower: float
    upper: float
    mean: FloatArray
    mean_upper: float
    correlation: FloatArray
    correlation_bound: float

    @property
    def verdict(self) -> np.ndarray:
        """What the test says of each run.

        Returns
        -------
        ndarray of str, shape (...)
            "wrong" if squares or mean are too large; "too cautious" if the squares are too small:
            the noise was told too large, so the deviations are as well; otherwise "consistent". In
            the last two cases nothing *of the innovations* speaks against the estimates. What the
            model explains wrongly they do not see: an interval wrong by 20 ppm is consistent, and
            gives errors of scale that are out by many stated deviations.

        Examples
        --------
        >>> right = InnovationTest(np.ones(1), 0.9, 1.1, np.ones(1), 7.0, np.zeros(1), 0.1)
        >>> print(right.verdict, right._replace(mean=np.array([20.0])).verdict)
        ['consistent'] ['wrong']
        """
        wrong = (self.squares > self.upper) | (self.mean > self.mean_upper)
        cautious = np.where(self.squares < self.lower, "too cautious", "consistent")
        return np.where(wrong, "wrong", cautious)


def innovation_test(calibration: Calibration) -> InnovationTest:
    """Test whether a calibration's innovations are those that its filter expected.

    Parameters
    ----------
    calibration : Calibration
        As `calibrate` returns it.

    Returns
    -------
    InnovationTest
        Of each run.

    Raises
    ------
    ValueError
        If the calibration has no innovations.

    See Also
    --------
    calibrate : The filter.
    nees : The test for simulations, where the errors are known.

    Notes
    -----
    Bar-Shalom, Li and Kirubarajan (2001), section 5.4. The innovations of a filter whose model is
    exact are independent. This one is linearised anew at each update; yet over 720 simulated units,
    bent by 40 to 400 arc seconds, squares and means scattered as chi-square says.

    Too large a noise of the reference velocity, as at a table that stands, makes the innovations
    small and each like the one before, for they then are the slow errors of the sensors alone.

    References
    ----------
    - Y. Bar-Shalom, X. R. Li, T. Kirubarajan, *Estimation with Applications to Tracking and
      Navigation*, Wiley, 2001.

    Examples
    --------
    >>> from driftlab.calibration import TableTrial
    >>> from driftlab.motion.scheme import Scheme
    >>> trial = TableTrial(Scheme("+90X +90X +90Y +90Z"), update_interval=10.0)
    >>> found = trial.run(np.random.default_rng(1), runs=3).calibration
    >>> innovation_test(found).verdict.tolist()
    ['consistent', 'consistent', 'consistent']
    """
    checked_instance(calibration, Calibration, "calibration")
    rows = calibration.innovations
    count = rows.shape[-2]
    if count == 0:
        raise ValueError("calibration: expected the innovations of some updates, got none.")
    tails = (1 - CONFIDENCE) / 2, (1 + CONFIDENCE) / 2
    upper, lower = (float(bound) for bound in chdtri(3 * count, tails) / (3 * count))
    squares = np.sum(rows**2, axis=(-2, -1))
    together = np.sum(rows[..., 1:, :] * rows[..., :-1, :], axis=(-2, -1))
    return InnovationTest(
        squares / (3 * count),
        lower,
        upper,
        np.sum(rows.sum(axis=-2) ** 2, axis=-1) / (3 * count),
        float(chdtri(3, 1 - CONFIDENCE)) / 3,
        np.divide(together, squares, out=np.zeros_like(squares), where=squares > 0),
        float(ndtri(tails[1])) / np.sqrt(3 * count),
    )

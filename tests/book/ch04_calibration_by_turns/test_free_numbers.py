"""What the digits pin down with the integrator's error and the factor of sigma4* left free."""

import numpy as np
import pytest

from driftlab.book.ch04_calibration_by_turns.copied_digits import digit_interval
from driftlab.book.ch04_calibration_by_turns.experiment_numbers import (
    NAMES,
    SIGN_RESTORED,
    TRIADS,
    seven_numbers,
    triad_reading,
)
from driftlab.book.ch04_calibration_by_turns.experiments import (
    FACTORS,
    OF_SIGMA1,
    factor_bounds,
    free_numbers,
)
from driftlab.drift.turn_calibration import exact_turn_estimate
from driftlab.drift.weighing_designs import YATES_AXES


def inside(values):
    """Which of seven numbers (..., 7) lie in the intervals of their digits."""
    low, high = np.array([digit_interval(text) for text in SIGN_RESTORED]).T
    return (low <= values) & (values <= high)


@pytest.mark.parametrize("triad", TRIADS)
def test_bounds_are_those_of_a_grid_of_factors(triad):
    """Every number by the formulas of the experiment, factor by factor."""
    errors = np.array([-1.36e-9, -0.4e-9, 2.1e-9])
    factors = np.linspace(*FACTORS, 1801)
    estimates = exact_turn_estimate(YATES_AXES, triad_reading(triad))
    estimates = estimates + (100 * errors / (2 * np.pi))[:, np.newaxis]
    grid = inside(seven_numbers(estimates, factors[:, np.newaxis]))
    low, high = factor_bounds(triad, errors)
    each = factors[:, np.newaxis, np.newaxis]
    expected = (each >= low.T) & (each <= high.T)
    assert expected.any()
    # The ends of the bounds may fall on the other side of a factor by rounding.
    assert (grid != expected).sum() <= 2


def test_two_numbers_tell_the_factor_and_agree():
    """The bands of sigma1*, sigma4* and sigma1** meet; two would have met anyhow."""
    bounds = factor_bounds("unit third axis", OF_SIGMA1, (0, 3))
    by_fourth, by_weighed = (bounds[:, NAMES.index(name)] for name in ("sigma4*", "sigma1**"))
    for low, high in (by_fourth, by_weighed):
        assert 1 < low.max() < np.sqrt(1.5) < high.min() < 1.5
    # Both together, as the ledger states them.
    together = (
        max(by_fourth[0].min(), by_weighed[0].min()),
        min(by_fourth[1].max(), by_weighed[1].max()),
    )
    np.testing.assert_allclose(together, (1.2234, 1.2252), rtol=0, atol=5e-5)


def test_the_reading_of_the_triad_is_one_question():
    """Four numbers come out everywhere with the unit axis, two of them nowhere without it."""
    data = free_numbers()
    extents = [dict(zip(NAMES, data.extent[i], strict=True)) for i in range(len(TRIADS))]
    unit = extents[TRIADS.index("unit third axis")]
    assert [name for name, where in unit.items() if where == "in part"] == [
        "sigma1*",
        "sigma4*",
        "sigma1**",
    ]
    assert set(unit.values()) == {"in part", "everywhere"}
    for extent in (extents[TRIADS.index("linear")], extents[TRIADS.index("symmetric part")]):
        assert extent["sigma2*"] == extent["sigma3*"] == "nowhere"

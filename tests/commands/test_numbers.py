"""No more digits than are known, and a unit of a fitting size."""

import numpy as np
import pytest

from driftlab.commands.findings import RATES, SCALES, fitting, written


@pytest.mark.parametrize(
    ("value", "deviation", "text"),
    [
        (1.23456, 0.0123, "1.235"),
        (1.23456, 0.0996, "1.23"),  # 0.0996 is 0.10
        (52345.6, 1200.0, "52300"),
        (0.0, 0.01, "0.000"),
        (-0.00001, 0.01, "0.000"),
        (1.23456, None, "1.2346"),
        (1.23456, 0.0, "1.2346"),
        (1.23456, np.nan, "1.2346"),
        (3.2e-12, 4.1e-13, "3.2e-12"),
        (0.0, None, "0"),
        (np.nan, 0.1, "-"),
    ],
)
def test_a_number_has_two_digits_of_its_deviation(value, deviation, text):
    assert written(value, deviation) == text


def test_units_fit_the_largest_value():
    assert fitting([0.02, -0.5], SCALES).name == "%"
    assert fitting([3e-4], SCALES).name == "ppm"
    assert fitting([np.nan, 0.0], RATES).name == "deg/h"
    assert RATES[0].pair(np.radians(1.5), np.radians(0.02)) == "1.500 ± 0.020"

"""What a recording refuses, and which of its rows lie in a time, by stamps or by the interval."""

import re

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from driftlab.recordings import Recording
from driftlab.recordings._time_stamps import seconds_since_first

ROWS = np.arange(15.0).reshape(5, 3)
EVEN, UNEVEN = 0.25 * np.arange(5), np.array([0.0, 0.25, 0.375, 0.75, 1.0])


@pytest.mark.parametrize("again", [0.0, 0.125])
@pytest.mark.parametrize("row", [1, 2, 3, 4])
def test_stamps_that_do_not_increase_are_refused_with_both_of_them_and_the_row(row, again):
    times = EVEN.copy()
    times[row] = times[row - 1] - again
    words = f"got {times[row]:g} s after {times[row - 1]:g} s in row {row + 1}."
    with pytest.raises(ValueError, match=rf"^times: .* increase, {re.escape(words)}$"):
        Recording(ROWS, None, 0.25, "rates", times)


@pytest.mark.parametrize("start", [0.0, 5.0, -0.25])
@pytest.mark.parametrize("stamps", [EVEN, UNEVEN], ids=["even", "uneven"])
def test_the_rows_between_are_those_since_the_first_stamp_without_the_end(stamps, start):
    whole = Recording(ROWS, 2 * ROWS, 0.25, "rates", stamps + start)
    for begin, end in [(0.0, 0.75), (0.25, 1.0), (0.3, 0.8), (-1.0, 0.25), (0.75, 9.0)]:
        inside = (begin <= stamps) & (stamps < end)
        found = whole.between(begin, end)
        assert_array_equal(found.gyro, ROWS[inside])
        assert_array_equal(found.accelerometer, 2 * ROWS[inside])
        assert_array_equal(found.times, stamps[inside] + start)
        if stamps is EVEN:
            spaced = Recording(ROWS, None, 0.25, "rates").between(begin, end)
            assert_array_equal(spaced.gyro, ROWS[inside])
    for begin, end in [(0.8, 0.9), (2.0, 3.0), (-2.0, 0.0), (0.5, 0.25)]:
        with pytest.raises(ValueError, match=r"^begin, end: expected times of the record, which"):
            whole.between(begin, end)


def test_moments_count_from_the_first():
    moments = np.array(
        ["2024-05-01T12:00", "2024-05-01T12:01", "2024-05-02T12:00"], "datetime64[m]"
    )
    np.testing.assert_allclose(seconds_since_first(moments), [0.0, 60.0, 86400.0], rtol=1e-15)

"""The form of a text file: its encoding, its delimiter, its header, where its numbers stand."""

import numpy as np
import pytest

from driftlab.recordings._slips import force_slips, gyro_slips
from driftlab.recordings._text_form import (
    names_like,
    number_delimiter,
    without_mark,
)
from driftlab.recordings.readers import _read_table
from driftlab.recordings.recording import Recording


@pytest.fixture
def table(tmp_path):
    """Writes a file and finds its table."""

    def read(text, code="utf-8"):
        path = tmp_path / "log.csv"
        path.write_text(text, code)
        return _read_table(path)

    return read


@pytest.mark.parametrize(
    ("line", "delimiter"), [("0,5;1,5", ";"), ("0,5 1,5", ""), ("wx;wy", None)]
)
def test_a_delimiter_is_told_from_a_decimal_comma(line, delimiter):
    assert number_delimiter(line) == delimiter


def test_few_names_are_all_listed():
    assert names_like("wz", ("wx", "wy")) == "wx, wy, or "


@pytest.mark.parametrize(("line", "bare"), [("%time,x", "time,x"), ("// t", "t")])
def test_the_mark_of_a_comment_is_dropped(line, bare):
    assert without_mark(line) == bare


def test_cells_are_numbers_and_moments(table):
    numbers = table("1;2\n\n3;x\n")
    np.testing.assert_array_equal(numbers.numbers([0]), [[1], [3]])
    with pytest.raises(ValueError, match=r"^log.csv, line 3: expected a number in column 2, got"):
        numbers.numbers([1])
    dates = "t,x,y\n2024-05-01T12:00:00Z,5,1\n2024-05-01T12:00:00.25Z,6,1\n"
    np.testing.assert_array_equal(table(dates).moments(0), [0, 0.25])
    assert table("a,b\n\n\n\n1,2\n\n3,4").place(1) == "log.csv, line 7"


def test_a_factor_names_the_likely_mistake():
    still = Recording(np.zeros((9, 3)), np.ones((9, 3)), 0.01, "rates")
    assert force_slips(0.1, still) == ": g taken for m/s^2?"
    turning = Recording(np.zeros((9, 3)), None, 0.02, "rates")
    assert gyro_slips(0.0199, turning) == (
        ": radians taken for degrees, or increments taken for rates?"
    )
    assert gyro_slips(7.0, turning) == "."

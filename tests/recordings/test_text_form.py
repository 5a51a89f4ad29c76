"""The form of a text file: its encoding, its delimiter, its header, where its numbers stand."""

import numpy as np
import pytest

from driftlab.recordings._slips import force_slips, gyro_slips
from driftlab.recordings._text_form import (
    code_of,
    header,
    names_like,
    number_delimiter,
    refuse_cut,
    split_cells,
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


def test_latin_text_and_other_line_ends_are_read():
    assert [code_of(text) for text in (b"\xb0/s", "°/s".encode(), "°/s".encode("utf-16"))] == [
        *("latin-1", "utf-8-sig", "utf-16")
    ]


@pytest.mark.parametrize(
    ("line", "delimiter"), [("0,5;1,5", ";"), ("0,5 1,5", ""), ("wx;wy", None)]
)
def test_a_delimiter_is_told_from_a_decimal_comma(line, delimiter):
    assert number_delimiter(line) == delimiter


def test_a_comma_in_quotes_is_part_of_its_cell():
    assert split_cells('1, "2,5"', ",") == ["1", "2,5"]


def test_few_names_are_all_listed():
    assert names_like("wz", ("wx", "wy")) == "wx, wy, or "


@pytest.mark.parametrize(("line", "bare"), [("%time,x", "time,x"), ("// t", "t")])
def test_the_mark_of_a_comment_is_dropped(line, bare):
    assert without_mark(line) == bare


@pytest.mark.parametrize(
    ("lines", "units"),
    [(["# log", "t [ms],wx"], ("ms", "")), (["t,wx", "ms,deg/s"], ("ms", "deg/s"))],
)
def test_units_stand_beside_or_below_the_names(lines, units):
    assert header(lines, ",", 2) == (("t", "wx"), units)


def test_a_number_that_may_be_cut_off_is_refused():
    with pytest.raises(ValueError, match=r"^log.csv, line 21: .* or more, .* is the file cut off"):
        refuse_cut("log.csv", enumerate(["1,0.25"] * 20 + ["1,0.2"], 1), ",")
    refuse_cut("log.csv", enumerate(["1,0.25"] * 21, 1), ",")


def test_a_column_is_found_by_name_and_by_number_and_turned_by_a_minus(table):
    found = table("t,wx,wy\n1,2,3\n")
    assert [found.column(wanted) for wanted in ("-wx", 3, "-3")] == [(1, -1), (2, 1), (2, -1)]


def test_cells_are_numbers_and_moments(table):
    numbers = table("1;2\n\n3;x\n")
    np.testing.assert_array_equal(numbers.numbers([0]), [[1], [3]])
    with pytest.raises(ValueError, match=r"^log.csv, line 3: expected a number in column 2, got"):
        numbers.numbers([1])
    dates = "t,x,y\n2024-05-01T12:00:00Z,5,1\n2024-05-01T12:00:00.25Z,6,1\n"
    np.testing.assert_array_equal(table(dates).moments(0), [0, 0.25])
    assert table("a,b\n\n\n\n1,2\n\n3,4").place(1) == "log.csv, line 7"


@pytest.mark.parametrize("code", ["utf-8", "utf-16", "latin-1"])
def test_a_file_with_decimal_commas_is_read(table, code):
    found = table("# my log\nt [ms];wx [°/s]\n0;0,5\n10;0,75\n", code)
    assert (found.names, found.units) == (("t", "wx"), ("ms", "°/s"))
    np.testing.assert_array_equal(found.numbers([0, 1]), [[0, 0.5], [10, 0.75]])


def test_a_factor_names_the_likely_mistake():
    still = Recording(np.zeros((9, 3)), np.ones((9, 3)), 0.01, "rates")
    assert force_slips(0.1, still) == ": g taken for m/s^2?"
    turning = Recording(np.zeros((9, 3)), None, 0.02, "rates")
    assert gyro_slips(0.0199, turning) == (
        ": radians taken for degrees, or increments taken for rates?"
    )
    assert gyro_slips(7.0, turning) == "."

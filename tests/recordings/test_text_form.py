"""The form of a text file: its encoding, its delimiter, its header, where its numbers stand."""

from pathlib import Path

import numpy as np
import pytest

from driftlab.recordings import gyro_unit
from driftlab.recordings._slips import force_slips, gyro_slips
from driftlab.recordings._text_form import (
    decoded,
    header,
    names_like,
    number_delimiter,
    refuse_cut,
    split_cells,
    without_mark,
)
from driftlab.recordings._text_table import TextTable, read_table
from driftlab.recordings._unit_spellings import spelled
from driftlab.recordings.recording import Recording


def table(*lines, delimiter=",", names=(), begin=1):
    return TextTable(Path("log.csv"), names, ("",) * len(names), [*lines], begin, delimiter, 2)


def test_latin_text_and_other_line_ends_are_read():
    assert decoded(b"wx [\xb0/s]\r\n1\r\n") == "wx [°/s]\n1\n"


@pytest.mark.parametrize(
    ("line", "delimiter"), [("0,5;1,5", ";"), ("0,5 1,5", ""), ("wx;wy", None)]
)
def test_a_delimiter_is_told_from_a_decimal_comma(line, delimiter):
    assert number_delimiter(line) == delimiter


def test_a_comma_in_quotes_is_part_of_its_cell():
    assert split_cells('1, "2,5"', ",") == ["1", "2,5"]
    assert table().cells("1, 2") == ["1", "2"]


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
        refuse_cut(Path("log.csv"), ["1,0.25"] * 20 + ["1,0.2"], 21, ",")
    refuse_cut(Path("log.csv"), ["1,0.25"] * 21, 21, ",")


def test_a_column_is_found_by_name_and_by_number_and_turned_by_a_minus():
    found = TextTable(Path("log.csv"), ("t", "wx", "wy"), ("", "", ""), [], 2, ",", 3)
    assert [found.column(wanted) for wanted in ("-wx", 3, "-3")] == [(1, -1), (2, 1), (2, -1)]


def test_cells_are_numbers_texts_and_moments():
    numbers = table("1;2", "", "3;x", delimiter=";")
    np.testing.assert_array_equal(numbers.numbers([0]), [[1], [3]])
    with pytest.raises(ValueError, match=r"^log.csv, line 3: expected a number in column 2, got"):
        numbers.numbers([1])
    assert table("12:00:00.1,5").texts(0) == ["12:00:00.1"]
    moments = table("2024-05-01T12:00:00Z,5", "2024-05-01T12:00:00.25Z,6").moments(0)
    np.testing.assert_array_equal(moments, [0, 0.25])
    assert table("1,2", "", "3,4", begin=5).place(1) == "log.csv, line 7"


def test_a_file_with_decimal_commas_is_read(tmp_path):
    log = tmp_path / "log.csv"
    log.write_text("# my log\nt [ms];wx [deg/s]\n0;0,5\n10;0,75\n", "utf-8")
    found = read_table(log)
    assert (found.names, found.units) == (("t", "wx"), ("ms", "deg/s"))
    assert found.lines == ["0;0.5", "10;0.75"]


def test_spellings_of_a_unit_are_one():
    assert spelled("°/sec") == spelled("dps") == "deg/s"
    assert gyro_unit("dps") == gyro_unit("deg/s")


def test_a_factor_names_the_likely_mistake():
    still = Recording(np.zeros((9, 3)), np.ones((9, 3)), 0.01, "rates")
    assert force_slips(0.1, still) == ": g taken for m/s^2?"
    turning = Recording(np.zeros((9, 3)), None, 0.02, "rates")
    assert gyro_slips(0.0199, turning) == (
        ": radians taken for degrees, or increments taken for rates?"
    )
    assert gyro_slips(7.0, turning) == "."

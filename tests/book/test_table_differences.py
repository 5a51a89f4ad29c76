"""Tables are compared number by number: the same, rounded otherwise, or others."""

import math
from pathlib import Path

import pytest

from driftlab.book.__main__ import told
from driftlab.book.machinery.figure.csv_table import write_table
from driftlab.book.machinery.figure.data_table import KEPT, DataTable
from driftlab.book.machinery.figure.table_differences import folder_differences, table_differences

TABLE = {"curve": ["a", "a", "b"], "x": ["1", "2", "1.00000000001e-6"], "y": ["3", "", "inf"]}


def changed(**columns: list[str]) -> dict[str, list[str]]:
    return {**TABLE, **columns}


def test_the_same_tables_differ_in_nothing() -> None:
    assert table_differences(TABLE, changed()) == []


@pytest.mark.parametrize(
    ("column", "largest", "only_rounding"),
    [
        (["1.00000000001", "2", "1.00000000001e-6"], 1e-11 / 2, True),  # of the largest of curve a
        (["1", "2", "1.00001e-6"], 1e-5 / 1.00001, False),  # curve b is small by itself
        (["1", "2", "1.0000001e-6"], 1e-7 / 1.0000001, True),  # but what is left of it is nothing
        (["1", "2.000001", "1.00000000001e-6"], 5e-7, False),
        (["1.0", "2", "1.00000000001e-6"], 0.0, True),
    ],
)
def test_a_number_differs_in_units_of_its_curve(column, largest, only_rounding) -> None:
    (found,) = table_differences(TABLE, changed(x=column))
    assert (found.column, found.written_otherwise, found.entries) == ("x", 1, 3)
    assert math.isclose(found.largest, largest, rel_tol=1e-3, abs_tol=1e-30)
    assert found.only_rounding is only_rounding


def test_a_column_of_few_decimals_may_differ_in_the_last() -> None:
    table = {"x": ["0.12", "3.40", "5.01"]}
    (found,) = table_differences(table, {"x": ["0.13", "3.4", "5.00"]})
    assert (found.written_otherwise, found.only_rounding) == (3, True)
    (found,) = table_differences(table, {"x": ["0.14", "3.40", "5.01"]})
    assert not found.only_rounding


def test_a_residue_is_measured_by_the_largest_of_its_unit() -> None:
    """The sum of angles of a hundred, zero but for rounding, and one that is not."""
    angles = {"swing_arcmin": ["150", "-150"]}
    for left, only_rounding in (("1e-11", True), ("1e-9", False)):
        for name, allowed in (("sum_arcmin, exact", only_rounding), ("sum_m", False)):
            here, there = ({**angles, name: [text, "0"]} for text in ("0", left))
            (found,) = table_differences(here, there)
            assert found.only_rounding is allowed


def test_a_gap_may_stand_for_zero() -> None:
    table = {"error": ["1e-3", ""]}
    for least, only_rounding in (("2e-16", True), ("2e-9", False)):
        (found,) = table_differences(table, {"error": ["1e-3", least]})
        assert found.only_rounding is only_rounding


@pytest.mark.parametrize(
    "columns",
    [{"curve": ["a", "b", "b"]}, {"y": ["3", "1e-9", "inf"]}, {"y": ["3", "", "-inf"]}],
)
def test_other_words_and_gaps_are_no_rounding(columns) -> None:
    (found,) = table_differences(TABLE, changed(**columns))
    assert (found.written_otherwise, found.largest, found.only_rounding) == (1, math.inf, False)
    assert str(found) == f"{found.column}: 1 of 3 entries are others"


def test_other_columns_or_rows_are_refused() -> None:
    with pytest.raises(ValueError, match="expected the same columns and rows"):
        table_differences(TABLE, {"x": TABLE["x"]})


def test_two_folders_are_told_apart_table_by_table(tmp_path: Path) -> None:
    here, there = tmp_path / "here", tmp_path / "there"
    for folder in (here, there):
        folder.mkdir()
        write_table(folder / "same.csv", TABLE, ["a comment"])
    write_table(here / "rounded.csv", TABLE, [])
    write_table(there / "rounded.csv", changed(x=["1", "2.00000000002", "1.00000000001e-6"]), [])
    write_table(here / "other.csv", TABLE, [])
    with pytest.raises(ValueError, match=r"got other\.csv in one only"):
        folder_differences(here, there)
    write_table(there / "other.csv", changed(x=["1", "3", "1.00000000001e-6"]), [])
    assert told(folder_differences(here, there), 3).splitlines() == [
        "1 of 3 tables are the same to the last digit.",
        "other.csv: OTHER NUMBERS",
        "  x: 1 of 3 numbers, at most 3e-01 of the largest",
        "rounded.csv: last digits, by rounding",
        "  x: 1 of 3 numbers, at most 1e-11 of the largest",
    ]


def test_facts_of_a_table_that_is_read_again_are_compared(tmp_path: Path) -> None:
    for folder, left in (("here", 1e-17), ("there", 2e-17), ("other", 0.1)):
        (tmp_path / folder).mkdir()
        facts = {"gains": ([0.5, left], "", ""), "motion": ("turn", "", "")}
        table = DataTable({"time": ([0.0, 1.0, 2.0], "s")}, facts)
        columns = {"time_s": ["0", "1", "2"]}
        write_table(tmp_path / folder / "some.csv", columns, [KEPT + table.as_json()])
    for other, only_rounding in (("there", True), ("other", False)):
        ((found,),) = folder_differences(tmp_path / "here", tmp_path / other).values()
        assert (found.column, found.only_rounding) == ("fact gains", only_rounding)

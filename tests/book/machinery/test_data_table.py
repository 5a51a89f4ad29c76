"""Tables of experiments: units, headings, and a table that is read again from its CSV."""

import pickle
from pathlib import Path

import numpy as np
import pytest
from scipy.constants import arcminute, degree, hour

from driftlab.book.machinery.figure.csv_table import as_words, read_table, write_table
from driftlab.book.machinery.figure.data_table import KEPT, UNITS, DataTable

TABLE = DataTable(
    {
        "time": (np.array([0.0, 60.0, 120.0]), "min", "since the start"),
        "drift": (np.radians([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]) / 3600, "deg_per_h", "of the gyro",
                  ["picard-1", "picard-3"]),
        "error": (np.arange(12.0).reshape(2, 3, 2), "", "", [["cone", "turn"], ["a", "b", "c"]]),
        "by_scheme": ({"short": np.array([1.0]), "long": np.array([1.0, 2.0])}, "", "ragged"),
        "axis": (["x", "y"], "", "of the turn"),
        "rounded": (np.radians([1.23456, -0.00001]), "deg", "", (), 3),
    },
    {
        "per_turn": (2 * arcminute, "arcmin", "drift in one turn"),
        "runs": (40, "", "number of runs"),
        "motion": ("steady turn", "", "motion"),
        "gains": ({"damped": np.array([0.25, 2.0]), "free": [1.0, None]}, "", "of the loop"),
    },
)  # fmt: skip


def test_values_are_si_and_shown_in_their_units() -> None:
    np.testing.assert_array_equal(TABLE.time, [0, 60, 120])
    np.testing.assert_array_equal(TABLE.shown("time"), [0, 1, 2])
    np.testing.assert_allclose(TABLE.shown("drift, picard-3"), [4, 5, 6], rtol=1e-15)
    np.testing.assert_array_equal(TABLE.shown("error, turn, b"), [8, 9])
    assert TABLE.shown("axis") == ["x", "y"]
    assert TABLE.words("per_turn", ".1f") == "2.0′"
    assert TABLE.row("per_turn") == ("drift in one turn", "2′")


def test_headings_name_the_unit_before_the_name_of_one_of_several() -> None:
    assert list(TABLE.columns()) == [
        "time_min",
        *("drift_deg_per_h, picard-1", "drift_deg_per_h, picard-3"),
        *(f"error, {motion}, {name}" for motion in ("cone", "turn") for name in "abc"),
        *("by_scheme, short", "by_scheme, long"),
        *("axis", "rounded_deg"),
    ]
    np.testing.assert_array_equal(TABLE.columns()["rounded_deg"], [1.235, 0])
    assert not np.signbit(TABLE.columns()["rounded_deg"][1])


def test_notes_say_what_columns_mean_and_what_the_facts_are() -> None:
    notes = TABLE.notes()
    assert notes[:3] == [
        "columns:",
        "  time, min: since the start",
        "  drift, deg_per_h: of the gyro",
    ]
    assert notes[-3:] == ["drift in one turn: 2′", "number of runs: 40", "motion: steady turn"]


def test_a_table_is_read_again_from_its_csv() -> None:
    words = as_words(TABLE.columns())
    again = DataTable.of_csv(["made by: a test", KEPT + TABLE.as_json()], words)
    assert as_words(again.columns()) == words
    assert again.error.shape == (2, 3, 2)
    np.testing.assert_allclose(again.drift, TABLE.drift, rtol=1e-11)
    np.testing.assert_array_equal(again.by_scheme["long"], [1, 2])
    assert (again.per_turn, again.runs, again.motion) == (
        pytest.approx(2 * arcminute),
        40,
        "steady turn",
    )
    np.testing.assert_array_equal(again.gains["damped"], [0.25, 2])
    assert again.row("per_turn", ".3f") == TABLE.row("per_turn", ".3f")


@pytest.mark.parametrize(
    "values",
    [
        ([1.0, np.nan, np.nan],),
        ([np.inf, -0.0, np.nan], "deg"),
        ([[1.0, np.nan], [np.nan, np.nan]], "ppm", "", ["a", "b"]),
        ({"a": [np.nan], "b": [1.0, 2.0]},),
        ([],),
        (["1", "2"],),
        (["a, b", "", ""],),
    ],
)
def test_gaps_at_the_end_and_numbers_as_words_are_read_again(values: tuple, tmp_path: Path) -> None:
    table = DataTable({"x": values}, {"point": (np.array(3.0),)})
    write_table(tmp_path / "x.csv", as_words(table.columns()), [KEPT + table.as_json()])
    again = DataTable.of_csv(*read_table(tmp_path / "x.csv"))
    np.testing.assert_equal(again.point, 3.0)
    titles = [heading.replace("_deg", "").replace("_ppm", "") for heading in table.columns()]
    for title in titles:
        found, expected = (np.asarray(each.shown(title)) for each in (again, table))
        np.testing.assert_array_equal(found, expected)


def test_a_table_can_be_sent_to_another_process() -> None:
    again = pickle.loads(pickle.dumps(TABLE))
    assert as_words(again.columns()) == as_words(TABLE.columns())


@pytest.mark.parametrize(
    ("columns", "facts", "said"),
    [
        ({"a": ([1.0], "furlong")}, {}, "a: expected a unit of .* got 'furlong'"),
        ({"a": ([1.0],)}, {"a": (1.0,)}, "columns: expected other names than the facts', got 'a'"),
        ({"heading": ([1.0],)}, {}, "heading: expected another name; a table has a method"),
        ({"a": [1.0]}, {}, r"a: expected a tuple \(values, unit, meaning\), got list"),
        ({"a": (np.ones((2, 3)),)}, {}, "a: expected one column for a CSV, or several with names"),
        (
            {"a": (np.ones(3), "", "", ("x", "y"))},
            {},
            r"a: expected rows with the names \['x', 'y'",
        ),
        ({"a": ([1.0], "deg"), "a_deg": ([1.0],)}, {}, "columns: expected other headings for"),
        ({"a": ([[1.0], [2.0]], "", "", ["b", "b"])}, {}, "columns: expected other headings for"),
        ({"a": ({"of #1": [1.0]},)}, {}, "a, of #1: expected a name without"),
    ],
)
def test_what_no_csv_can_hold_is_refused(columns: dict, facts: dict, said: str) -> None:
    with pytest.raises(TypeError, match=said):
        DataTable(columns, facts).columns()


def test_a_name_that_is_not_there_is_answered_with_those_that_are() -> None:
    with pytest.raises(AttributeError, match=r"time, drift, .* and no heading_error"):
        _ = TABLE.heading_error
    for ask in (TABLE.shown, TABLE.words, TABLE.row, TABLE.entry):
        with pytest.raises(KeyError, match="and no heading_error"):
            ask("heading_error")
    with pytest.raises(KeyError, match=r"drift, picard-1; .* and no column drift"):
        TABLE.heading("drift")


def test_units_are_those_of_their_names() -> None:
    assert UNITS["deg_per_h"][0] == degree / hour
    for name, (size, symbol) in UNITS.items():
        assert size > 0, name
        assert symbol or not name, name

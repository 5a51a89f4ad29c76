"""The files of a report: what a gradebook takes in, and where they are written."""

import csv
import io
import os
from pathlib import Path

import pytest

from driftlab.book import class_report
from driftlab.book.instructors.report_files import defused
from hand_ins import WRONG, notebook, put

UNRUN = b'{"cells": [{"cell_type": "code", "source": "check(3.1, 1)"}]}'


@pytest.fixture
def report(tmp_path):
    put(tmp_path / "class", {
        "Ada/a.ipynb": notebook(), "Bob/a.ipynb": notebook(WRONG), "Cy/a.pdf": b"",
        "Dan/a.ipynb": UNRUN, "Eve/a.ipynb": notebook("Exercise 3.1: not answered yet."),
    })  # fmt: skip
    return class_report(tmp_path / "class")


def test_who_has_nothing_to_mark_has_blanks(report, tmp_path):
    text = (report.write(tmp_path / "out") / "gradebook.csv").read_text("utf-8-sig")
    _, *rows = csv.reader(io.StringIO(text, newline=""))
    assert {row[0]: (row[2], row[5]) for row in rows} == {
        "Ada": ("1", "1"), "Bob": ("0", "0"), "Cy": ("", ""), "Dan": ("", ""), "Eve": ("0", "0"),
    }  # fmt: skip


@pytest.mark.parametrize(
    ("cell", "safe"),
    [
        ("=1+1", "'=1+1"),
        ("x;=1+1;y", "x;'=1+1;y"),
        ('x; "=1+1"', 'x;\' "=1+1"'),
        ("x;\t@SUM(1)", "x;'\t'@SUM(1)"),
        ("3; 4", "3; 4"),
        ("a-b=c", "a-b=c"),
    ],
)
def test_a_cell_that_some_spreadsheet_would_compute_is_text(cell, safe):
    assert defused(cell) == safe


def test_a_link_leads_to_where_the_report_is(report, tmp_path):
    place, link = tmp_path / "place", tmp_path / "link"
    report.write(place)
    (place / "words.csv").unlink()
    try:
        link.symlink_to(place)
    except OSError:
        pytest.skip("no links here")
    assert report.write(link) == place.resolve()
    assert link.is_symlink()
    assert len(list(place.iterdir())) == 5
    assert {path.name for path in tmp_path.iterdir()} == {"class", "place", "link"}


def test_a_place_that_cannot_be_looked_at_is_told_in_a_sentence(report, tmp_path, monkeypatch):
    with pytest.raises(ValueError, match=r"^folder: [^\n]* cannot be written \([^\n]*\)\.$"):
        report.write(tmp_path / ("x" * 5000))
    (tmp_path / "file").write_text("")
    with pytest.raises(ValueError, match=r"^folder: .* is not a folder\.$"):
        report.write(tmp_path / "file")

    def denied(*_):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "exists", denied)
    with pytest.raises(ValueError, match=r"^folder: .* cannot be written \(Permission denied\)\.$"):
        report.write(tmp_path / "out")


@pytest.mark.skipif(os.name == "nt", reason="no folder has such a name on Windows")
def test_the_name_of_the_folder_is_fit_to_be_shown(tmp_path):
    put(tmp_path / "cl\u202eass\x07", {"Ada/a.ipynb": notebook(), "Bob/a.ipynb": notebook()})
    assert class_report(tmp_path / "cl\u202eass\x07").folder == "class"


def test_of_own_exercises_those_that_most_students_have_are_columns(tmp_path):
    jokes = "\n".join(f"Exercise {i // 100}.{100 + i % 100}: right." for i in range(300))
    own = "Exercise 90.1: right.\n"
    put(tmp_path, {
        "Ada/a.ipynb": notebook(own), "Bob/a.ipynb": notebook(jokes + "\n" + own),
        "Eve/a.ipynb": notebook(own + jokes),
    })  # fmt: skip
    report = class_report(tmp_path)
    assert len(report.exercises) == 200
    assert "90.1" in report.exercises
    assert report.notes == [
        "Not in the book, and beyond the 200 that most students have, so without a column: "
        "1.199, 2.100, 2.101, 2.102, 2.103 ...."
    ]

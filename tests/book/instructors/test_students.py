"""A student's row says what is right and what else there is to know."""

import json

from hand_ins import RIGHT, notebook, put, rows

from driftlab.book import class_report


def test_numbers_that_were_asked_in_another_name_are_told(tmp_path):
    record = {"exercise": "4.6", "word": "right", "student": "bob  BABBAGE", "attempt": 1}
    output = {"data": {"application/vnd.driftlab.exercise+json": record}}
    content = json.dumps({"cells": [{"cell_type": "code", "outputs": [output]}]}).encode()
    put(tmp_path, {"Ada Lovelace/04.ipynb": content, "Bob Babbage/04.ipynb": content})
    found = rows(tmp_path)
    assert found["Bob Babbage"].notes == []
    assert found["Ada Lovelace"].notes == ["The numbers of 4.6 were asked in the name bob BABBAGE."]


def test_a_year_behind_the_name_is_no_other_name(tmp_path):
    from driftlab.book.machinery.records import MIME

    record = {"exercise": "3.4", "right": True, "word": "right", "says": "", "attempt": 1}
    for student, notes in (
        ("Ada Lovelace 2027", []),
        ("Bob", ["The numbers of 3.4 were asked in the name Bob."]),
    ):
        output = {"output_type": "display_data", "data": {MIME: {**record, "student": student}}}
        cell = {"cell_type": "code", "source": "", "outputs": [output]}
        put(tmp_path, {"Ada Lovelace/03.ipynb": json.dumps({"cells": [cell]}).encode()})
        assert rows(tmp_path)["Ada Lovelace"].notes == notes


def test_a_teachers_exercise_is_a_column_and_a_students_joke_is_none(tmp_path):
    own = "Exercise 90.2: right.\nExercise 90.10: right."
    jokes = "\n".join(f"Exercise {i}.77: right." for i in range(100, 400))
    bobs = notebook(f"{own}\n{RIGHT}\n{jokes}")
    put(tmp_path, {"Ada/x.ipynb": notebook(own), "Bob/x.ipynb": bobs})
    report = class_report(tmp_path)
    assert report.exercises == ["3.1", "3.2", "3.3", "3.4", "3.5", "3.6", "90.2", "90.10"]
    assert report.notes[0].startswith("Not in the book, and in one notebook only")


def test_an_exercise_between_two_has_its_column(tmp_path):
    said = {"Ada": "right.", "Bob": "not yet. Close."}
    put(tmp_path, {f"{n}/a.ipynb": notebook(f"Exercise 3.3a: {w}") for n, w in said.items()})
    report = class_report(tmp_path)
    assert report.exercises == ["3.3a"]
    assert [each.status("3.3a") for each in report.students] == ["right", "wrong"]

"""A student's row says what is right and what else there is to know."""

import json

from driftlab.book import class_report
from driftlab.book.exercises import all_exercises
from driftlab.book.machinery.exercise.records import MIME
from hand_ins import RIGHT, notebook, put, rows


def test_numbers_that_were_asked_in_another_name_are_told(tmp_path):
    record = {"exercise": "4.6", "word": "right", "student": "bob  BABBAGE", "attempt": 1}
    output = {"data": {"application/vnd.driftlab.exercise+json": record}}
    content = json.dumps({"cells": [{"cell_type": "code", "outputs": [output]}]}).encode()
    put(tmp_path, {"Ada Lovelace/04.ipynb": content, "Bob Babbage/04.ipynb": content + b"\n"})
    found = rows(tmp_path)
    assert found["Bob Babbage"].notes == ["Ada Lovelace asked the numbers of 4.6 in the same name."]
    assert found["Ada Lovelace"].notes == [
        "The numbers of 4.6 were asked in the name bob BABBAGE.",
        "Bob Babbage asked the numbers of 4.6 in the same name.",
    ]


def test_a_year_behind_the_name_is_no_other_name(tmp_path):
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
    assert report.exercises == [*all_exercises("03"), "90.2", "90.10"]
    assert report.notes[0].startswith("Not in the book, and in the notebooks of one student only")


def test_an_exercise_between_two_has_its_column(tmp_path):
    said = {"Ada": "right.", "Bob": "not yet. Close."}
    put(tmp_path, {f"{n}/a.ipynb": notebook(f"Exercise 3.3a: {w}") for n, w in said.items()})
    report = class_report(tmp_path)
    assert report.exercises == ["3.3a"]
    assert [each.status("3.3a") for each in report.students] == ["right", "wrong"]


def recorded(number, student="", word="right"):
    record = {"exercise": number, "word": word, "student": student, "attempt": 1}
    return code({"data": {MIME: record}})


def code(*outputs):
    return json.dumps({"cells": [{"cell_type": "code", "outputs": list(outputs)}]}).encode()


def test_who_has_the_books_numbers_where_others_have_their_own_is_told(tmp_path):
    put(tmp_path, {
        "Ada/a.ipynb": recorded("3.4", "Ada"), "Bob/a.ipynb": recorded("3.4", "Bob"),
        "Eve/a.ipynb": recorded("3.4"), "Eve/b.ipynb": recorded("3.1"),
        "Ida/a.ipynb": recorded("3.4", word="not answered yet"),
        "Old/a.ipynb": code({"text": "Exercise 3.4: right."}),
    })  # fmt: skip
    notes = {name: each.notes for name, each in rows(tmp_path).items()}
    said = notes.pop("Eve")
    assert said == ["3.4 with the book's numbers, where others have their own."]
    assert not any(notes.values())


def test_where_most_have_the_books_numbers_nobody_is_told(tmp_path):
    put(tmp_path, {
        "Ada/a.ipynb": recorded("3.4", "Ada"),
        "Bob/a.ipynb": recorded("3.4"), "Eve/a.ipynb": recorded("3.4") + b"\n",
        "Zoe/a.ipynb": recorded("3.1", "Zoe"),  # where all have the same numbers
    })  # fmt: skip
    assert not any(each.notes for each in rows(tmp_path).values())


def test_a_name_that_was_left_as_it_stood_is_shared_by_nobody(tmp_path):
    put(
        tmp_path,
        {
            "Ada/a.ipynb": recorded("3.4", "Your name"),
            "Bob/a.ipynb": recorded("3.4", "Your name") + b"\n",
        },
    )
    for each in rows(tmp_path).values():
        assert each.notes == ["The numbers of 3.4 were asked in the name Your name."]

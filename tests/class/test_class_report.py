"""Answers are read and judged again; nothing of a student's is run, believed or shown as it is."""

import csv
import json
import os
import subprocess
import sys

import pytest

import driftlab.book
from driftlab.book import all_exercises, class_report, given
from driftlab.book.instructors.handed_in import LARGEST
from driftlab.book.instructors.typed_answers import UNREAD, Reader
from driftlab.book.machinery.exercise.answers import computed
from driftlab.book.machinery.exercise.records import MIME
from hostile import MARK, MARKUP, TEXTS, Elements, all_that_runs

ELEMENTS = {
    "html", "head", "meta", "title", "style", "body", "main", "div", "h1", "p", "ul", "li", "bdi",
    "table", "thead", "tbody", "tr", "th", "td", "details", "summary",
}  # fmt: skip
NESTED = "[" * 3000 + "]" * 3000
BOMBS = (
    "check('3.2', 2**10**10)",
    "check('3.2', 9**9**9**9)",
    "a = 2**900\n" + "a = a * a\n" * 5000 + "check('3.2', a)",
    "b = [1]\n" + "b = [b, b]\n" * 5000 + "check('3.2', b)",
    "b = [1]\n" + "b = [b]\n" * 5000 + "check('3.2', b)",
    "b = [" + "1," * 450 + "]\n" + "c = [b]\n" * 5000 + "check('3.2', c)",
    f"check('3.2', {NESTED})",
    "check('3.2', " + "-" * 40_000 + "1)",
    "check('3.2', " + "1+" * 20_000 + "1)",
    "check('3.2', " + "a." * 20_000 + "b)",
    "check('3.2', " + "9" * 40_000 + ")",
    "check('3.2', 0x" + "f" * 40_000 + ")",
    "check('3.2', 1e400)",
    "check('3.2', 5 % 0)",
    "check('3.2', 'a' * 10**10)",
    "check('3.2', [1] * 10**10)",
    "check('3.2', '" + "a" * 60_000 + "')",
    "\0check('3.2', 1)",
)


def cell(source, *records, text=""):
    outputs = [{"output_type": "display_data", "data": {MIME: each}} for each in records]
    outputs.append({"output_type": "stream", "text": text})
    return {"cell_type": "code", "source": source, "outputs": outputs}


def record(number, answer, **more):
    said = {"word": "right", "right": True, "says": "Well done."}
    return {"exercise": number, "answer": answer, **said, **more}


def put(folder, name, *cells):
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps({"nbformat": 4, "cells": cells}), "utf-8")


def counts(report):
    return {(row.exercise, row.shows): (row.notebooks, row.recorded) for row in report.rows}


@pytest.mark.parametrize(
    ("source", "answer"),
    [
        ("check('3.2', 129.6)", 129.6),
        ("answer = -2 * 3**2 / 4\nbook.check(3.2, answer)", -4.5),
        ("half = 0.5\nanswer = [1, (1, half), 'ad']\ncheck('3.2', answer)", [1, [1, 0.5], "ad"]),
        ("%matplotlib inline\nx = 'ad'\nprint(x)\ncheck('3.2', answer=x, because=why)", "ad"),
        ("check('3.2', np.array([1, 2 * np.pi]))", [1, 6.283185307179586]),
        ("check('3.2', ...)", ...),
        ("a = [1]\na.append(2)\ncheck('3.2', a)", UNREAD),
        ("a = [1]\nb = [a]\nchange(b)\ncheck('3.2', a)", UNREAD),
        ("a = 1\nfor a in (1, 2):\n    check('3.2', a)", UNREAD),
        ("a = 1\na += 1\ncheck('3.2', a)", UNREAD),
        ("a = 1\n(a, b) = 2, 3\ncheck('3.2', a)", UNREAD),
        ("a = 1\nfrom x import a\ncheck('3.2', a)", UNREAD),
        ("a = 1\ndef a(): pass\ncheck('3.2', a)", UNREAD),
        ("if False:\n    check('3.2', 129.6)", UNREAD),
        ("check('3.2', lambda: 1)", UNREAD),
        ("check('3.2', f'{1}')", UNREAD),
        ("check('3.2', answer)", UNREAD),
        ("check('3.2', 129, 6)", UNREAD),
        ("check('3.2', a, d", UNREAD),
    ],
)
def test_a_literal_is_read_and_nothing_else(source, answer):
    assert [each[:2] for each in Reader().calls(source)] == [("3.2", answer)]


@pytest.mark.parametrize("source", BOMBS, ids=range(len(BOMBS)))
def test_no_answer_takes_long_or_stops_the_report(source, tmp_path):
    put(tmp_path, "a.ipynb", *[cell(source)] * 20, cell("check('3.3', 'ad')"))
    report = class_report(tmp_path, ["03"])
    assert not any(row.shows == "right" and row.exercise == "3.2" for row in report.rows)
    if not report.notes:
        # What has taken too much leaves nothing for the rest of the same notebook.
        assert {row.exercise for row in report.rows} == {"3.2", "3.3"}


def test_answers_are_counted_by_slip_and_by_notebook(tmp_path):
    wrong = cell("answer = 'acd'\ncheck('3.3', answer, because=because)")
    put(tmp_path, "Ada Lovelace/03.ipynb", wrong, wrong, cell("check('3.3', 'a and d')"))
    put(tmp_path, "deep/er/Ada Lovelace/03.ipynb", wrong)
    put(tmp_path, "whole book.ipynb", cell("check('3.3', ...)"), cell("check('4.3', ...)"))
    put(tmp_path, ".ipynb_checkpoints/03.ipynb", wrong)
    for name, answer in (("Bo.ipynb", "a und d"), ("Cy.ipynb", "a, q")):
        put(tmp_path, name, cell(f"check('3.3', {answer!r})"))
    report = class_report(tmp_path, "3")
    reason = "(c) counts the three entries off the diagonal of Σ. Scale errors are on it."
    slip = f"Chose a, c, d. {reason}"
    assert counts(report) == {
        ("3.3", "right"): (1, 0), ("3.3", slip): (2, 0), ("3.3", "no answer"): (1, 0),
        ("3.3", "Not readable. Expected letters from a to f."): (2, 0),
    }  # fmt: skip
    assert report.rows[1].examples == [
        "acd — Ada Lovelace/03.ipynb", "acd — deep/er/Ada Lovelace/03.ipynb",
    ]  # fmt: skip
    assert {row.exercise for row in class_report(tmp_path).rows} == {"3.3", "4.3"}


def test_a_recorded_value_is_judged_again_and_no_verdict_is_believed(tmp_path):
    forged = "\n".join(f"Exercise 3.{k}: right." for k in range(1, 7))
    put(
        tmp_path,
        "a.ipynb",
        cell("check('3.1', work())", record("3.1", [1, 1, 1, 1, 1, 1]), text=forged),
        cell("check('3.2', panel)", record("3.2", {"m11": 1.0})),
        cell("answer = 5\ncheck('3.4', answer)", record("3.4", [1, 2, 3])),
        cell("check('3.5', lambda M: 0)", record("3.5", "<function answer>")),
        cell("print(1)", text=forged),
        cell("check('3.3', 'acd')\ncheck('3.3', mine)", record("3.3", "ad")),
        cell("check('3.6', letters)", record("3.6", "adf", right=False, word="not yet")),
    )
    found = counts(class_report(tmp_path, ["03"]))
    assert {number for number, shows in found if shows == "right"} == {"3.3", "3.6"}
    assert found["3.3", "right"] == found["3.6", "right"] == (1, 1)
    assert found["3.5", "not judged"] == (1, 0)
    recorded = {number: count[1] for (number, _), count in found.items()}
    assert recorded == {"3.1": 1, "3.2": 1, "3.3": 0, "3.4": 0, "3.5": 0, "3.6": 1}


def test_numbers_of_ones_own_are_judged_by_the_name(tmp_path):
    right = computed(all_exercises("03")["3.4"], "Ada")[0].tolist()
    assert str(given("3.4", student="Ada")) != str(given("3.4"))
    calls = [f"check('3.4', {right}, student={who})" for who in ("'Ada'", "name", "'Bo'")]
    put(tmp_path, "1.ipynb", cell(calls[0]))
    put(tmp_path, "2.ipynb", cell(calls[1], record("3.4", [0], student="Ada")))
    put(tmp_path, "3.ipynb", cell(calls[1]))
    put(tmp_path, "4.ipynb", cell(calls[2]))
    found = counts(class_report(tmp_path))
    assert (found["3.4", "right"], found["3.4", "not judged"]) == ((2, 0), (1, 0))
    assert sum(count for count, _ in found.values()) == 4


@pytest.mark.parametrize(
    "answer",
    [None, True, "x", [], {}, {"m11": MARKUP}, {"m11": None, "azimuth": {}}, [[1], [2, 3]],
     float("nan"), float("inf"), 10**4000, [1] * 100_000, {"m11": [1e308] * 9}, [{}],
     json.loads(NESTED[2900:3100])],
)  # fmt: skip
def test_any_recorded_value_is_survived(answer, tmp_path):
    numbers = ("3.1", "3.2", "3.3", "3.4", "3.5", "11.5", "17.3", "99.9", "x", "3.2" * 9999)
    for student in ("", "x" * 10_000, None, 7, [MARKUP]):
        cells = [cell("check(n, f())", record(n, answer, student=student)) for n in numbers]
        put(tmp_path, f"{type(student).__name__}{student}"[:9] + ".ipynb", *cells)
    assert not any(row.shows == "right" for row in class_report(tmp_path).rows)


def test_what_cannot_be_read_is_told(tmp_path):
    damaged = {
        "empty.ipynb": b"",
        "text.ipynb": b"PK\3\4",
        "list.ipynb": b"[]",
        "cells.ipynb": b'{"cells": 1}',
        "deep.ipynb": b'{"cells": ' + b"[" * 400_000,
        "large.ipynb": b" " * (LARGEST + 1),
        "conflict.ipynb": b'<<<<<<< HEAD\n{"cells": []}',
        "wide.ipynb": '{"cells": []}'.encode("utf-16"),
    }
    for name, content in damaged.items():
        (tmp_path / name).write_bytes(content)
    (tmp_path / "work.zip").write_bytes(b"PK")
    if os.name != "nt":
        os.mkfifo(tmp_path / "pipe.ipynb")
        (tmp_path / "link.ipynb").symlink_to("/etc/passwd")
        (tmp_path / "round").symlink_to(tmp_path)
    report = class_report(tmp_path)
    named = [note.split(":")[0] for note in report.notes]
    links = [] if os.name == "nt" else ["pipe.ipynb", "link.ipynb", "round"]
    others = "Other files, not read (unpack archives first)"
    assert sorted(named) == sorted([*(damaged.keys()), *links, others])
    assert f"{others}: work.zip." in report.notes
    assert "wide.ipynb: It has none of these exercises." in report.notes
    assert report.notebooks == 1


def test_nothing_is_run_and_nothing_becomes_a_part_of_the_report(tmp_path):
    folder = tmp_path / "class"
    for number, text in enumerate(TEXTS):
        records = [record("3.4", text, says=text, student=text), record(text, text), {text: text}]
        cells = [
            cell(f"{text}\ncheck('3.5', {text!r})", *records, text=text),
            cell(f"check('3.3', {text!r})\ncheck('11.5', {text!r})\ncheck('3.4', {text!r})"),
            cell(f"answer = {text}\ncheck('3.2', answer)", text),
            {"cell_type": text, "source": text, "metadata": {text: text}},
        ]
        name = f"{number}.ipynb" if os.name == "nt" else text.replace("/", "|") + ".ipynb"
        put(folder, name, *cells)
    (folder / "\u202e\x07.ipynb").write_bytes(b"")
    with all_that_runs() as seen:
        report = class_report(folder)
        written = report.write(tmp_path / "report")
        pages = [(written / "class.html").read_text("utf-8"), report._repr_html_()]
    assert [each for each in seen if not each.startswith("compile")] == []  # for the tree alone
    for page in pages:
        elements = Elements(page)
        assert elements.names <= ELEMENTS
        assert elements.acts == []
        assert MARK in page  # it is there to be read
    table = (written / "class.csv").read_text("utf-8-sig")
    written = [each for row in csv.reader(table.splitlines()) for each in row]
    written += [each.strip() for cells in written for each in cells.split(";")]
    assert not any(each.startswith(("=", "+", "-", "@")) for each in written)
    assert not {"\x07", "\u202e", "\x1b"} & {*str(report), *pages[0], *table}
    assert sorted(path.name for path in tmp_path.iterdir()) == ["class", "report"]


def test_the_command_writes_next_to_the_folder(tmp_path):
    put(tmp_path / "class", "a.ipynb", cell("check('3.2', 86.4)"), cell("check('4.3', 'x')"))
    call = [sys.executable, "-m", "driftlab.book", "class", str(tmp_path / "class")]

    def run(*more):
        return subprocess.run([*call, *more], capture_output=True, encoding="utf-8", timeout=120)

    done = run("--chapters", "03,06")
    assert done.returncode == 0, done.stderr
    written = sorted(path.name for path in (tmp_path / "class-report").iterdir())
    assert written == ["class.csv", "class.html"]
    table = (tmp_path / "class-report/class.csv").read_text("utf-8-sig")
    rows = list(csv.reader(table.splitlines()))
    assert rows[0] == [
        *("exercise", "notebooks", "of", "what the answers show", "recorded", "examples"),
    ]
    assert [row[0] for row in rows[1:]] == ["3.2"]
    assert run("--chapters", "3,77").stderr.startswith("chapters: expected some of 01, 02")


def test_a_folder_is_expected(tmp_path):
    with pytest.raises(ValueError, match=r"^folder: expected a folder with notebooks, got "):
        class_report(tmp_path / "nowhere")
    report = class_report(tmp_path)
    assert (report.rows, report.notebooks, report.notes) == ([], 0, [])


def test_a_students_copy_has_no_report(monkeypatch):
    for name in [name for name in sys.modules if name.startswith("driftlab.book.instructors")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setattr(driftlab.book, "__path__", [])
    with pytest.raises(ImportError, match=r"^class_report is for who teaches, and this is a stud"):
        driftlab.book.class_report  # noqa: B018

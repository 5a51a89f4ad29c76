"""Nothing that a class hands in is run by who reads it, or becomes a part of the report."""

import csv
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from driftlab.book import class_report
from driftlab.book.machinery.exercise.records import MIME
from hand_ins import put, zipped
from hostile import CODE, MARK, MARKUP, TEXTS, Elements, all_that_runs

ELEMENTS = {
    "html", "head", "meta", "title", "style", "body", "main", "div", "h1", "h2", "h3", "p", "span",
    "table", "thead", "tbody", "tfoot", "tr", "th", "td", "svg", "rect", "details", "summary",
    "bdi", "i", "dl", "dt", "dd", "ul", "li",
}  # fmt: skip


def hostile_notebook(text: str) -> bytes:
    """A notebook that has been answered, with one text wherever a text can be."""
    record = {"exercise": "3.4", "word": "not yet", "attempt": 1, "right": False}
    record |= dict.fromkeys(("says", "answer", "because", "student"), text)
    odd = {"exercise": text, "word": text, "attempt": text, "right": text}
    said = f"Exercise 3.1: not yet. {text}\nExercise 3.2: right.\nYour words: {text}"
    outputs = [
        {"output_type": "stream", "name": text, "text": said},
        *(
            {"output_type": "display_data", "metadata": {text: text}, "data": {MIME: told}}
            for told in (record, odd, text, [text])
        ),
        {
            "output_type": "execute_result",
            "data": {"text/plain": said, "text/html": text, text: text},
            "execution_count": text,
        },
        {"output_type": "error", "ename": text, "evalue": text, "traceback": [text]},
        {"output_type": text},
    ]
    kernel = {"name": text, "display_name": text, "language": text}
    cells = [
        {"cell_type": "markdown", "source": [f"# {text}"], "attachments": {text: {text: text}}},
        {"cell_type": "code", "source": [f"{text}\ncheck('3.5', {text!r})"], "outputs": outputs},
        {"cell_type": "code", "source": f"%%bash\ntouch {MARK}", "outputs": [], "id": text},
        {"cell_type": "raw", "source": text, "metadata": {"tags": [text]}},
        {"cell_type": text, "source": text},
    ]
    metadata = {"kernelspec": kernel, "title": text, "authors": [{"name": text}], text: text}
    return json.dumps({"nbformat": 4, "metadata": metadata, "cells": cells}).encode()


@pytest.fixture
def handed_in(tmp_path: Path) -> Path:
    """A folder with notebooks as several platforms give them, and names that are hostile, too."""
    folder = tmp_path / "class"
    names = [text.replace("/", "|") for text in TEXTS]
    for number, text in enumerate(TEXTS):
        notebook = hostile_notebook(text)
        put(folder, {f"Student {number}_{number}_assignsubmission_file_/03.ipynb": notebook})
        if os.name != "nt":  # where such names cannot be
            put(folder, {f"{names[number]}_9{number}_assignsubmission_file_/03.ipynb": notebook})
        packed = {f"../{MARK}.ipynb": notebook, f"{names[number]}.ipynb": notebook}
        put(folder, {f"Zip {number}_8{number}_assignsubmission_file_/all.zip": zipped(packed)})
    put(folder, {"Page_77_assignsubmission_onlinetext_/onlinetext.html": MARKUP.encode()})
    roster = tmp_path / "names.csv"
    with roster.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows([["name", "id"], *([text, text] for text in TEXTS)])
    return folder


def test_nothing_is_run_and_nothing_becomes_a_part_of_the_report(
    handed_in: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    with all_that_runs() as seen:
        report = class_report(handed_in, tmp_path / "names.csv")
        written = report.write(tmp_path / "report")
        pages = [(written / "report.html").read_text("utf-8"), report._repr_html_()]
    assert seen == []
    assert len(report.students) >= 2 * len(TEXTS)
    assert "3.4" in report.exercises
    for page in pages:
        elements = Elements(page)
        assert elements.names <= ELEMENTS
        assert elements.acts == []
        assert MARK in page  # it is there to be read
    assert [*(tmp_path / "here").iterdir()] == []
    assert not [*tmp_path.rglob(MARK), *tmp_path.rglob(f"{MARK}.ipynb")]


def test_the_command_runs_nothing_either(handed_in: Path, tmp_path: Path) -> None:
    """As `lab.py class` starts it, with the folder of the caller where it is."""
    here = tmp_path / "here"
    here.mkdir()
    call = [sys.executable, "-m", "driftlab.book", "class", str(handed_in)]
    done = subprocess.run(call, cwd=here, capture_output=True, encoding="utf-8", timeout=120)
    assert done.returncode == 0, done.stderr
    assert "\x1b" not in done.stdout
    assert [*here.iterdir()] == []
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "class", "class-report", "here", "names.csv",
    ]  # fmt: skip


def test_the_folder_has_what_could_run() -> None:
    """The tests here can fail: each text is code, markup, a command or a formula."""
    cells = json.loads(hostile_notebook(CODE))["cells"]
    with all_that_runs() as seen:
        compile(cells[1]["source"][0], "cell", "exec")
    assert len(seen) == 1
    assert Elements(json.loads(hostile_notebook(MARKUP))["cells"][3]["source"]).acts

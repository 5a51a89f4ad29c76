"""What is read out of a saved notebook is what `check` had said in it."""

import json
from contextlib import redirect_stdout
from io import StringIO

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output

from driftlab.book.exercises import check, verdict
from driftlab.book.machinery.card import Card
from driftlab.book.machinery.hints import Help
from driftlab.book.machinery.submissions import class_summary, saved_verdicts


def said(number, answer):
    with redirect_stdout(StringIO()) as out:
        check(number, answer)
    return new_code_cell(outputs=[new_output("stream", name="stdout", text=out.getvalue())])


def shown(number, answer):
    """The same as a card in a notebook."""
    card = Card(number, verdict(number, answer), Help("", "", ""))
    data = {"text/plain": repr(card), "text/html": card._repr_html_()}
    return new_code_cell(outputs=[new_output("display_data", data)])


def test_each_kind_of_verdict_is_read(tmp_path):
    cells = [
        new_markdown_cell("Exercise 1.9: right."),
        said("1.1", [180, 0, 0]),
        said("1.2", 7.5),
        said("1.3", ...),
        said("1.4", [1, 2]),
        shown("1.5", [0, 0, 0]),
        shown("2.1", "ace"),
    ]
    path = tmp_path / "mine.ipynb"
    nbformat.write(new_notebook(cells=cells), path)
    verdicts = {"1.1": True, "1.2": False, "1.3": None, "1.4": False, "1.5": False, "2.1": True}
    assert saved_verdicts(path) == verdicts


@pytest.mark.parametrize("content", ["", "{}", "[]", "[1]", json.dumps({"cells": [3]}), "é"])
def test_what_is_not_a_notebook_is_refused_in_words(tmp_path, content):
    path = tmp_path / "other.txt"
    path.write_bytes(content.encode("latin-1"))
    with pytest.raises(ValueError, match=r"^path: expected a notebook, got '.*other\.txt'\.$"):
        saved_verdicts(path)


def test_class_is_counted_once_each_and_a_broken_file_does_not_stop_it(tmp_path):
    first = new_notebook(cells=[said("1.3", "bce"), said("1.1", ...)])
    second = new_notebook(cells=[said("1.1", [180, 0, 0]), said("10.2", "a"), said("1.3", "a")])
    for name, notebook in (("ann", first), ("bob", second), ("ann/.ipynb_checkpoints", first)):
        (tmp_path / name).mkdir()
        nbformat.write(notebook, tmp_path / name / "01.ipynb")
    broken = tmp_path / "bob" / "empty.ipynb"
    broken.write_text("")
    summary = class_summary(tmp_path)
    assert (summary.notebooks, summary.unreadable) == (2, [broken])
    assert list(summary.counts) == ["1.1", "1.3", "10.2"]
    assert summary.counts["1.1"] == {"open": 1, "right": 1}
    assert summary.counts["1.3"] == {"right": 1, "wrong": 1}


def test_folder_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"^folder: expected a folder, got '.*nowhere'\.$"):
        class_summary(tmp_path / "nowhere")

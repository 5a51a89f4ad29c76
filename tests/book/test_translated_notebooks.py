"""Translated chapters: cell by cell beside the English ones, and told when they are behind."""

import json
import sys

import pytest

import driftlab.book.__main__ as command
from driftlab.book import languages, translated_notebooks
from driftlab.book.translated_notebooks import MARK, begin, digest, done, standings
from support import ROOT

NOTEBOOKS = ROOT / "notebooks"
TRANSLATED = [
    path for code in languages()[1:] for path in sorted((NOTEBOOKS / code).glob("*.ipynb"))
]


def cells(path):
    return json.loads(path.read_text("utf-8"))["cells"]


@pytest.mark.parametrize("path", TRANSLATED, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_a_translated_notebook_has_the_code_of_the_english_one(path):
    code = path.parent.name
    english = {cell["id"]: cell for cell in cells(NOTEBOOKS / path.name)}
    own = {cell["id"]: cell for cell in cells(path)}
    assert own.keys() - english.keys() == {f"{code}-language"}
    assert [name for name in own if name != f"{code}-language"] == list(english)
    for name, cell in english.items():
        assert own[name]["cell_type"] == cell["cell_type"]
        if cell["cell_type"] == "code":
            assert own[name]["source"] == cell["source"]
        else:
            assert MARK in own[name]["metadata"]
    assert f'language("{code}")' in "".join(own[f"{code}-language"]["source"])


def test_what_is_committed_is_up_to_date():
    for code in languages()[1:]:
        assert {str(each) for each in standings(code).values()} == {"up to date"}


def written(folder, name, *made):
    folder.mkdir(exist_ok=True)
    notebook = {"cells": made, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}
    (folder / name).write_text(json.dumps(notebook), "utf-8")


def cell(name, text, kind="markdown", **metadata):
    return {"cell_type": kind, "id": name, "metadata": metadata, "source": [text]}


def test_how_each_cell_stands_is_told(tmp_path):
    now = "Now it is so."
    english = [cell(each, now) for each in "abc"]
    written(tmp_path, "01.ipynb", *english, cell("d", "1", "code"), cell("e", "2", "code"))
    written(
        tmp_path / "ru",
        "01.ipynb",
        cell("ru-language", 'language("ru")', "code"),
        cell("a", "Было так.", **{MARK: digest("It was so.")}),
        cell("b", "Теперь так.", **{MARK: digest(now)}),
        cell("c", now),
        cell("d", "3", "code"),
        cell("f", "Ещё одна."),
    )
    (found,) = standings("ru", tmp_path).values()
    assert found == (("c",), ("a",), ("e", "f", "d"))
    assert str(found) == "not translated: c; behind: a; unlike: e, f, d"
    assert done("ru", ["a", "c", "d", "z"], tmp_path) == ["a", "c"]
    (found,) = standings("ru", tmp_path).values()
    assert found[:2] == ((), ())


def test_a_chapter_begins_as_a_copy(tmp_path):
    written(tmp_path, "02_x.ipynb", cell("a", "# Text"), cell("b", "1", "code"))
    path = begin("de", "02", tmp_path)
    assert path == tmp_path / "de/02_x.ipynb"
    assert [each["id"] for each in cells(path)] == ["a", "de-language", "b"]
    assert "".join(cells(path)[1]["source"]).endswith('language("de");')
    assert str(standings("de", tmp_path)["de/02_x.ipynb"]) == "not translated: a"
    with pytest.raises(ValueError, match=r"^begin: expected a notebook that is not begun"):
        begin("de", "02", tmp_path)
    for name in ("", "03", "x"):
        with pytest.raises(ValueError, match=r"^begin: expected how one notebook begins, as"):
            begin("de", name, tmp_path)


def test_the_command_begins_notes_and_refuses(tmp_path, monkeypatch, capsys):
    written(tmp_path, "02_x.ipynb", cell("a", "# Text"))
    monkeypatch.setattr(begin, "__defaults__", (tmp_path,))
    monkeypatch.setattr(done, "__defaults__", (tmp_path,))
    monkeypatch.setattr("driftlab.book.translation.update", lambda code: f"{code} is updated")

    def run(*options):
        monkeypatch.setattr(sys, "argv", ["driftlab.book", "translation", "de", *options])
        command.main()
        return capsys.readouterr().out

    assert run("--begin", "02").endswith("02_x.ipynb\nde is updated\n")
    assert run("--done", "a") == "de is updated\n"
    assert str(standings("de", tmp_path)["de/02_x.ipynb"]) == "up to date"
    with pytest.raises(SystemExit, match=r"^done: expected cells of de, got b\.$"):
        run("--done", "a", "b")
    with pytest.raises(SystemExit, match=r"^begin: expected how one notebook begins"):
        run("--begin", "7")
    assert translated_notebooks.HOME == NOTEBOOKS

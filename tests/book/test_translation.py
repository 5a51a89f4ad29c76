"""Other languages: what is said is translated where it is said; what is kept stays English."""

import json
import re
from io import BytesIO
from string import Formatter

import numpy as np
import pytest
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po

from driftlab.book import check, guess, language, languages
from driftlab.book.exercises import all_exercises, judged
from driftlab.book.machinery import language as machinery
from driftlab.book.machinery.exercise import Said
from driftlab.book.machinery.language import FOLDER, speaking, tr, tr_number
from driftlab.book.machinery.progress import Progress
from driftlab.book.panels import EXPLORERS
from driftlab.book.translation import MARK, behind, digest, gathered, update
from support import ROOT

OTHERS = languages()[1:]
NOTEBOOKS = ROOT / "notebooks"
RUSSIAN = sorted((NOTEBOOKS / "ru").glob("*.ipynb"))


@pytest.fixture(autouse=True)
def english_again():
    yield
    language("en")


def cells(path):
    return json.loads(path.read_text("utf-8"))["cells"]


def catalogue(code):
    path = FOLDER / code / "LC_MESSAGES/driftlab.po"
    return read_po(BytesIO(path.read_bytes()), locale=code, charset="utf-8")


def filled(text):
    return {name for _, name, _, _ in Formatter().parse(text) if name is not None}


def test_russian_is_there_and_another_language_is_refused():
    assert languages() == ("en", "ru")
    with pytest.raises(ValueError, match=r"code: expected one of en, ru, got 'tlh'"):
        language("tlh")
    assert language() == "en"


def test_the_environment_says_the_language_until_somebody_does(monkeypatch):
    monkeypatch.setattr(machinery, "_spoken", {})
    monkeypatch.setenv("DRIFTLAB_LANGUAGE", "ru")
    assert tr("not yet") == "пока нет"
    assert language("en") == language() == "en"


def test_a_text_that_the_catalogue_lacks_stays_english():
    with speaking("ru"):
        assert tr("No catalogue has this, {name}.", name="Ada") == "No catalogue has this, Ada."
    assert language() == "en"


@pytest.mark.parametrize(
    ("count", "noun"), [(1, "число"), (3, "числа"), (5, "чисел"), (21, "число")]
)
def test_numbers_take_the_form_of_the_language(count, noun):
    with speaking("ru"):
        said = tr_number("{count} number in a list", "{count} numbers in a list", count)
    assert said == f"{count} {noun} в списке"


@pytest.mark.parametrize("number", all_exercises("01"))
@pytest.mark.parametrize("answer", [..., "?!", 1.0, [1.0, 2.0, 3.0], "ab", "zz"])
def test_a_translated_answer_leaves_the_record_of_an_english_one(number, answer):
    said = Said("since it must be so", "")
    english = judged(number, answer, Progress(), said)
    with speaking("ru"):
        russian = judged(number, answer, Progress(), said)
        shown = repr(russian), russian.boxed()
    assert russian.record == english.record
    assert (russian.verdict.right, russian.verdict.parts) == (
        english.verdict.right,
        english.verdict.parts,
    )
    for text in shown:
        assert "Упражнение" in text
        assert not re.search(r"not yet|Right|readable|Expected|attempt|chapter", text), text


def test_the_hints_of_a_translated_chapter_lead_to_its_own_headings():
    headings = {
        line.lstrip("# ")
        for path in RUSSIAN
        for cell in cells(path)
        if cell["cell_type"] == "markdown"
        for line in "".join(cell["source"]).splitlines()
        if line.startswith("#")
    }
    with speaking("ru"):
        for number in all_exercises("01"):
            card = judged(number, "?!", Progress())
            section = tr(card.help.section)
            assert section in headings
            assert section.replace(" ", "-") in card.boxed()


def test_puzzle_and_panel_speak_russian_and_keep_the_names_of_their_values(capsys):
    panel = next(each for each in EXPLORERS if each.__name__ == "ErrorMotionExplorer")
    with speaking("ru"):
        asked = repr(guess("00"))
        shown = panel()
        check("1.1", ...)
    assert asked.startswith("Сначала догадка: Гироскоп наклонён")
    assert shown.preset.value == "Gross error"
    assert "Грубая погрешность" in [label for label, _ in shown.preset.options]
    assert shown.values.keys() == panel().values.keys()
    assert capsys.readouterr().out.startswith("Упражнение 1.1: ответа ещё нет.")


@pytest.mark.parametrize("code", OTHERS)
def test_translations_name_the_places_of_the_english_text(code):
    for message in catalogue(code):
        if not message.id:
            continue
        english = message.id if isinstance(message.id, tuple) else (message.id,)
        places = {"count"}.union(*map(filled, english))
        if places == {"count"}:
            continue
        others = message.string if isinstance(message.string, tuple) else (message.string,)
        for text in filter(None, others):
            assert filled(text) <= places, message.id


@pytest.mark.parametrize("code", OTHERS)
def test_the_catalogue_holds_all_texts_and_is_compiled(code, tmp_path, monkeypatch):
    kept = FOLDER / code / "LC_MESSAGES"
    target = tmp_path / code / "LC_MESSAGES"
    target.mkdir(parents=True)
    for suffix in (".po", ".mo"):
        (target / f"driftlab{suffix}").write_bytes((kept / f"driftlab{suffix}").read_bytes())
    monkeypatch.setattr("driftlab.book.translation.FOLDER", tmp_path)
    coverage = update(code)
    for suffix in (".po", ".mo"):
        new, old = (folder / f"driftlab{suffix}" for folder in (target, kept))
        assert new.read_bytes() == old.read_bytes(), "run: python -m driftlab.book translation ru"
    assert 0 < coverage.translated < coverage.total == len(gathered())
    made = BytesIO()
    write_mo(made, catalogue(code))
    assert made.getvalue() == (kept / "driftlab.mo").read_bytes()


@pytest.mark.parametrize("path", RUSSIAN, ids=lambda path: path.stem)
def test_a_translated_notebook_has_the_code_of_the_english_one(path):
    english = {cell["id"]: cell for cell in cells(NOTEBOOKS / path.name)}
    own = {cell["id"]: cell for cell in cells(path)}
    assert own.keys() - english.keys() == {"ru-language"}
    assert [name for name in own if name != "ru-language"] == list(english)
    for name, cell in english.items():
        assert own[name]["cell_type"] == cell["cell_type"]
        if cell["cell_type"] == "code":
            assert own[name]["source"] == cell["source"]
        else:
            assert MARK in own[name]["metadata"]
    assert 'language("ru")' in "".join(own["ru-language"]["source"])


def test_a_cell_whose_english_text_has_changed_is_behind(tmp_path):
    (tmp_path / "ru").mkdir()
    new = {"cell_type": "markdown", "id": "a", "metadata": {}, "source": ["Now it is so."]}
    then = {**new, "metadata": {MARK: digest("It was so.")}, "source": ["Было так."]}
    now = {**then, "id": "b", "metadata": {MARK: digest("Now it is so.")}}
    (tmp_path / "01.ipynb").write_text(json.dumps({"cells": [new, {**new, "id": "b"}]}), "utf-8")
    (tmp_path / "ru/01.ipynb").write_text(json.dumps({"cells": [then, now]}), "utf-8")
    assert behind("ru", tmp_path) == {"ru/01.ipynb": ("a",)}


def test_numbers_are_judged_alike_in_every_language():
    right = np.array([0.0, 0.0, 0.0])
    for exercise in all_exercises("01").values():
        with speaking("ru"):
            russian = exercise.verdict(right)
        assert russian.word == exercise.verdict(right).word

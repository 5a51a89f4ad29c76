"""Other languages: what is said is translated where it is said; what is kept stays English."""

import gettext
import json
import re
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from io import BytesIO
from string import Formatter
from types import SimpleNamespace

import numpy as np
import pytest
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po
from matplotlib.text import Text

from driftlab.book import check, guess, language, languages, verdict
from driftlab.book.__main__ import write_translation
from driftlab.book.exercises import all_exercises, hints_of, judged
from driftlab.book.machinery import language as machinery
from driftlab.book.machinery.exercise import NotRightError, Said
from driftlab.book.machinery.language import (
    DOMAIN,
    FOLDER,
    MODELS,
    speaking,
    tr,
    tr_number,
)
from driftlab.book.machinery.progress import Progress
from driftlab.book.panels import EXPLORERS, SCENES
from driftlab.book.translation import gathered, is_word, misplaced, update
from support import ROOT

OTHERS = languages()[1:]


@pytest.fixture(autouse=True)
def english_again():
    yield
    language("en")


def cells(path):
    return json.loads(path.read_text("utf-8"))["cells"]


def catalogue(code, domain=DOMAIN):
    path = FOLDER / code / f"LC_MESSAGES/{domain}.po"
    return read_po(BytesIO(path.read_bytes()), locale=code, charset="utf-8")


def test_russian_is_there_and_another_language_is_refused():
    assert languages()[0] == "en"
    assert "ru" in languages()
    with pytest.raises(ValueError, match=r"code: expected one of en, .*ru.*, got 'tlh'"):
        language("tlh")
    assert language() == "en"


def test_the_environment_says_the_language_until_somebody_does(monkeypatch):
    monkeypatch.setattr(machinery, "_chosen", [])
    monkeypatch.setenv("DRIFTLAB_LANGUAGE", "ru")
    assert tr("not yet.") == "пока нет."
    assert language("en") == language() == "en"


@pytest.mark.parametrize("said", ["ru_RU.UTF-8", "RU", " ru", "ru@x", "ru-RU"])
def test_the_environment_may_say_the_language_as_systems_do(said, monkeypatch):
    monkeypatch.setattr(machinery, "_chosen", [])
    monkeypatch.setenv("DRIFTLAB_LANGUAGE", said)
    assert language() == "ru"


def test_a_language_of_the_environment_that_is_not_there_is_said_once(monkeypatch):
    monkeypatch.setattr(machinery, "_chosen", [])
    monkeypatch.setenv("DRIFTLAB_LANGUAGE", "tlh_KL")
    with pytest.warns(UserWarning, match="^DRIFTLAB_LANGUAGE=tlh_KL: expected one of en, ru"):
        assert tr("not yet.") == "not yet."
    assert language() == "en"  # a second warning would be an error


@pytest.mark.parametrize("kept", [0, 4, 200, 5000])
def test_a_broken_catalogue_is_one_sentence_that_says_what_to_do(kept, tmp_path, monkeypatch):
    whole = (FOLDER / "ru/LC_MESSAGES/driftlab.mo").read_bytes()
    broken = tmp_path / "ru/LC_MESSAGES/driftlab.mo"
    broken.parent.mkdir(parents=True)
    broken.write_bytes(whole[:kept])
    monkeypatch.setattr(machinery, "FOLDER", tmp_path)
    with pytest.raises(ValueError, match=r"ru cannot be read; .* driftlab\.book translation ru\."):
        language("ru")
    assert language() == "en"


def test_threads_speak_the_chosen_language_and_keep_english_records():
    language("ru")
    with ThreadPoolExecutor(8) as threads:
        cards = list(threads.map(lambda n: judged("1.1", [n, n, n], Progress()), range(200)))
    assert language() == "ru"
    assert all(repr(card).startswith("Упражнение 1.1: пока нет") for card in cards)
    assert all(card.record["says"].isascii() for card in cards)


def test_another_thread_does_not_hear_what_is_spoken_in_a_block():
    with speaking("ru"), ThreadPoolExecutor(1) as threads:
        assert threads.submit(language).result() == "en"


@pytest.mark.parametrize(("code", "least"), [("en", 7), ("ru", 7)])
def test_a_function_is_called_once_for_card_and_record(code, least):
    seen = []

    def answer(w, m, t):
        seen.append(w)
        return [m * w * t, 0, 0] if len(seen) <= least else 1 / 0

    with speaking(code):
        card = judged("1.5", answer, Progress())
    assert len(seen) == least
    assert card.record["word"] == card.verdict.word == "not yet"
    assert card.record["says"].startswith("That is the false rate times the time.")


def test_a_function_that_fails_is_called_once_too():
    seen = []

    def answer(w, m, t):
        seen.append(w)
        raise RuntimeError(f"call {len(seen)}")

    with speaking("ru"):
        card = judged("1.5", answer, Progress())
    assert len(seen) == 1
    assert card.record["says"] == "Your answer raised RuntimeError: call 1"


def test_letters_that_come_one_by_one_are_read_once():
    with speaking("ru"):
        card = judged("1.3", iter("bce"), Progress())
    assert card.verdict.right
    assert card.record["right"]


def test_the_error_of_a_strict_check_is_english_throughout():
    with speaking("ru"), pytest.raises(NotRightError) as wrong:
        check("1.3", "a", strict=True)
    assert str(wrong.value).startswith("Exercise 1.3: not yet. At least one statement")


@pytest.mark.parametrize("broken", ["{that}", "{}", "{form", "{form.x}", "{form:d}"])
def test_a_translators_slip_leaves_the_english_text(broken, monkeypatch):
    words = gettext.NullTranslations()
    monkeypatch.setattr(words, "gettext", lambda text: broken)
    monkeypatch.setattr(machinery, "_chosen", [machinery.Spoken("ru", words)])
    assert tr("Expected numbers, got {form}.", form="a str") == "Expected numbers, got a str."


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
        for path in (ROOT / "notebooks/ru").glob("*.ipynb")
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


@pytest.mark.slow
@pytest.mark.usefixtures("no_pixels")
@pytest.mark.parametrize("panel", [*EXPLORERS[:4], *SCENES], ids=lambda panel: panel.__name__)
def test_all_that_a_panel_says_is_in_the_catalogue(panel, monkeypatch):
    asked = set()
    words = gettext.NullTranslations()
    monkeypatch.setattr(words, "gettext", lambda text: asked.add(text) or text)
    monkeypatch.setattr(machinery, "_chosen", [machinery.Spoken("ru", words)])
    for preset in panel.presets:
        panel(preset)
    known = {message.id for message in catalogue("ru")}
    assert panel.title in asked
    assert {text for text in asked if is_word(text)} <= known


def test_the_scene_of_chapter_1_is_russian_and_its_handle_keeps_its_name():
    (scene,) = (each for each in SCENES if each.__name__ == "FalseRate")
    with speaking("ru"):
        message = scene().view.widget.stage
    parts = [part for view in message["views"] for part in view["parts"]]
    assert message["words"]["play"] == "Пуск"
    assert {part["text"] for part in parts} >= {"ложная скорость", "истинная скорость"}
    (handle,) = (part for part in parts if part["handle"])
    assert (handle["handle"], handle["says"]) == ("false rate", "ложная скорость")


@pytest.mark.parametrize("code", ["en", "EN", "RU", "en_US", "xx_", "../ru"])
def test_a_catalogue_is_made_for_a_code_of_another_language_only(code):
    with pytest.raises(SystemExit, match=r"^language: expected the code of one other than English"):
        write_translation(code, None, [])


def test_letters_that_look_alike_are_read_as_they_look():
    assert verdict("1.3", "b\u0441\u0435").right  # as a Russian keyboard has c and e
    assert not verdict("1.3", "\u0449").right


@pytest.mark.parametrize("code", OTHERS)
def test_translations_have_the_places_of_the_english_text(code):
    both = (*catalogue(code), *catalogue(code, MODELS))
    assert list(misplaced(both)) == []
    for message in both:  # a conversion or a format would be the code's, not the text's
        for text in message.id if isinstance(message.id, tuple) else (message.id,):
            for _, name, form, turn in Formatter().parse(text if message.id else ""):
                assert name is None or re.fullmatch(r"[a-z]+|[0-9]", name), text
                assert not form, text
                assert not turn, text


@pytest.mark.parametrize(
    ("english", "translated", "is_right"),
    [
        ("at {place}", "{place}", True),
        ("at {place}", "в {plase}", False),
        ("at {place}", "в месте", False),
        ("at {place}", "в {place", False),
        ("at {place}", "в {place:d}", False),
        ("nothing", "{place}", False),
        (("{count} step", "{count} steps"), ("шаг", "{count} шага", "{count} шагов"), True),
        (("{count} step", "{count} steps"), ("шаг", "{number} шага", "{count} шагов"), False),
        ("at {place}", "", True),
    ],
)
def test_a_translation_with_other_places_is_told(english, translated, is_right):
    message = SimpleNamespace(id=english, string=translated)
    assert bool(list(misplaced([message]))) != is_right


@pytest.mark.slow
@pytest.mark.parametrize("code", OTHERS)
def test_the_catalogue_holds_all_texts_and_is_compiled(code, tmp_path, monkeypatch):
    kept = FOLDER / code / "LC_MESSAGES"
    target = tmp_path / code / "LC_MESSAGES"
    target.mkdir(parents=True)
    names = sorted(path.name for path in kept.iterdir())
    assert names == ["driftlab.mo", "driftlab.po", "model_answers.mo", "model_answers.po"]
    for name in names:
        (target / name).write_bytes((kept / name).read_bytes())
    monkeypatch.setattr("driftlab.book.translation.FOLDER", tmp_path)
    once = cache(gathered)
    monkeypatch.setattr("driftlab.book.translation.gathered", once)
    coverage = update(code)
    for name in names:
        new, old = (folder / name for folder in (target, kept))
        assert new.read_bytes() == old.read_bytes(), "run: python -m driftlab.book translation ru"
    assert 0 < coverage.translated < coverage.total == len(once(DOMAIN)) + len(once(MODELS))
    for domain in (DOMAIN, MODELS):
        made = BytesIO()
        write_mo(made, catalogue(code, domain))
        assert made.getvalue() == (kept / f"{domain}.mo").read_bytes()


def test_the_books_own_answers_are_in_a_catalogue_of_their_own():
    (model,) = (help_.model for n, help_ in hints_of("01").items() if n == "1.2")
    assert model in {message.id for message in catalogue("ru", MODELS)}
    assert model not in {message.id for message in catalogue("ru")}
    with speaking("ru"):
        assert tr(model) != model


def test_numbers_are_judged_alike_in_every_language():
    right = np.array([0.0, 0.0, 0.0])
    for exercise in all_exercises("01").values():
        with speaking("ru"):
            russian = exercise.verdict(right)
        assert russian.word == exercise.verdict(right).word


def test_words_inside_the_picture_of_a_panel_are_translated_and_its_marks_stay():
    with speaking("ru"):
        view = EXPLORERS[0]().view
    assert "time, s" in view.words
    said = {text.get_text() for text in view.picture.figure.findobj(Text)}
    assert {"время, с", "компоненты", "$\\lambda_{1e}$"} <= said
    assert not {"time, s", "components"} & said

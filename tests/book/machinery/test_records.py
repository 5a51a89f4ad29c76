"""What an answer leaves for programs in a saved notebook."""

import json
from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sp
from IPython.core.formatters import DisplayFormatter

from driftlab.book import exercises
from driftlab.book.exercises import judged, verdict
from driftlab.book.machinery.exercise.exercise import NOTHING_SAID, Said
from driftlab.book.machinery.exercise.progress import Progress
from driftlab.book.machinery.exercise.records import LONGEST, MIME


def record(number, answer, said=NOTHING_SAID, progress=None):
    """The record as a kernel sends it, through JSON."""
    data, _ = DisplayFormatter().format(judged(number, answer, progress or Progress(), said))
    assert data["text/plain"].startswith(f"Exercise {number}: ")
    assert "text/html" in data
    return json.loads(json.dumps(data[MIME], allow_nan=False))


def test_a_saved_output_says_what_was_answered_and_what_was_said():
    assert record("3.3", "adb", Said("One number each.", "Ada Lovelace")) == {
        "exercise": "3.3",
        "right": False,
        "word": "not yet",
        "says": "(b) forgets that the axis enters the coefficient twice: with the opposite sign it "
        "gives the same. What the skew part adds is perpendicular to it.",
        "attempt": 1,
        "answer": "adb",
        "because": "One number each.",
        "student": "Ada Lovelace",
    }
    open_ = record("3.1", ...)
    assert (open_["right"], open_["word"], open_["answer"], open_["attempt"]) == (
        *(None, "not answered yet", None, 0),
    )


@pytest.mark.parametrize(
    ("answer", "kept"),
    [
        (np.float32(0.5), 0.5),
        (np.array([[1, 2], [3, 4]]), [[1.0, 2.0], [3.0, 4.0]]),
        ((1, 2.5), [1.0, 2.5]),
        (True, True),
        (float("nan"), "nan"),
        ([1.0, np.inf], "1, inf"),
        (sp.sqrt(2), float(np.sqrt(2))),
        (sp.Symbol("x") + 1, "x + 1"),
        (1j, "1j"),
        ("x" * 10_000, "x" * LONGEST),
        (
            SimpleNamespace(values={"azimuth": 45.0, "axes": np.eye(1)}),
            {"azimuth": 45.0, "axes": [[1.0]]},
        ),
        ({"a": object}, "{'a': <class 'object'>}"),
    ],
)
def test_any_answer_has_a_form_that_a_file_can_hold(answer, kept):
    assert record("3.1", answer)["answer"] == kept


def test_attempts_are_different_answers():
    progress = Progress()

    def function(factor):
        return eval(f"lambda M: {factor} * M[0, 0]")  # each time another object

    panel = SimpleNamespace(values={"azimuth": 45.0})
    tried = [
        ("3.1", [1, 1], 0),  # not readable, so no attempt
        ("3.1", [1, 1, 1, 1, 1, 1], 1),
        ("3.1", np.ones(6), 1),
        ("3.1", [2, 1, 1, 1, 1, 1], 2),
        ("3.5", function(1), 1),
        ("3.5", function(1), 1),
        ("3.5", function(2), 2),
        ("3.2", panel, 0),
        ("3.1", ..., 2),
        ("3.1", np.ones(6), 2),
    ]
    for number, answer, attempt in tried:
        assert record(number, answer, progress=progress)["attempt"] == attempt, (number, answer)


def test_card_says_with_whose_numbers_it_judges():
    assert "Judged with the numbers of Ada." in repr(judged("3.4", 1, Progress(), Said("", "Ada")))
    assert "numbers of" not in repr(judged("3.3", "a", Progress(), Said("", "Ada")))


def test_words_on_one_choice_are_no_reason_for_another():
    progress = Progress()
    words = Said("One number a mounting.")
    assert record("3.3", "abd", words, progress)["says"].startswith("(b) forgets")
    assert record("3.3", "abd", words, progress)["says"].startswith("(b) forgets")
    again = record("3.3", "acd", words, progress)
    assert again["says"].startswith("At least one statement")
    assert again["because"] == words.because
    assert "your words on another answer" in repr(judged("3.3", "acd", progress, words))
    assert record("3.3", "acd", Said("Three are enough."), progress)["says"].startswith(
        "(c) counts"
    )


def test_a_verdict_counts_as_an_attempt(monkeypatch):
    monkeypatch.setattr("driftlab.book.exercises.PROGRESS", Progress())
    for letters in ("a", "ab", "abc"):
        verdict("3.3", letters)
    card = judged("3.3", "ad", exercises.PROGRESS)
    assert card.record["attempt"] == 4

"""What is read out of a saved notebook is what `check` had said in it; nothing of it is run."""

import json
from contextlib import redirect_stdout, suppress
from io import StringIO

import pytest
from hypothesis import given, strategies as st

from driftlab.book.exercises import check, judged
from driftlab.book.instructors.saved_answers import (
    LARGEST,
    MOST_ATTEMPTS,
    MOST_BRACKETS,
    MOST_CODE,
    MOST_TOLD,
    STATUSES,
    saved_answers,
)
from driftlab.book.machinery.exercise.answers import NOT_ALL, NOT_ONE, SAY_WHY
from driftlab.book.machinery.exercise.exercise import Said
from driftlab.book.machinery.exercise.progress import Progress
from driftlab.book.machinery.exercise.records import MIME


def saved(*cells):
    return json.dumps({"nbformat": 4, "metadata": {}, "cells": cells}).encode()


def code(source="", *outputs):
    return {"cell_type": "code", "source": source, "outputs": outputs}


def recorded(**record):
    given = {"exercise": "3.4", "word": "not yet", "says": "Close.", "attempt": 1} | record
    return {"output_type": "display_data", "data": {MIME: given, "text/plain": "no matter"}}


def printed(number, answer):
    with redirect_stdout(StringIO()) as out:
        check(number, answer)
    return {"output_type": "stream", "name": "stdout", "text": out.getvalue().splitlines(True)}


def test_words_of_each_verdict_are_read():
    cells = [
        {"cell_type": "markdown", "source": "Exercise 1.9: right."},
        code("", printed("1.1", [180, 0, 0])),
        code("", printed("1.2", 0.0465)),
        code("", printed("1.3", ...)),
        code("", printed("1.4", [1, 2])),
        code("", printed("1.4", "no numbers")),
    ]
    answers = saved_answers(saved(*cells)).answers
    assert {number: each.status for number, each in answers.items()} == {
        "1.1": "right", "1.2": "wrong", "1.3": "open", "1.4": "wrong",
    }  # fmt: skip
    assert answers["1.2"].slips == ["The answer is asked in degrees per second; this is in rad/s."]
    assert [answers[n].attempts for n in ("1.1", "1.2", "1.3", "1.4")] == [1, 1, 0, 2]


def test_a_record_comes_before_words():
    cell = code("", recorded(attempt=7, because="So  it\nis.", student="Ada", answer=[1]))
    answer = saved_answers(saved(cell)).answers["3.4"]
    assert (answer.status, answer.slips, answer.attempts) == ("wrong", ["Close."], 7)
    assert (answer.because, answer.student) == ("So it is.", "Ada")


@pytest.mark.parametrize("attempt", [True, -3, 1.5, "2", None, [], MOST_ATTEMPTS + 1, 10**30])
def test_a_record_with_a_wild_count_still_counts_once(attempt):
    assert saved_answers(saved(code("", recorded(attempt=attempt)))).answers["3.4"].attempts == 1


@pytest.mark.parametrize(
    ("source", "numbers"),
    [
        ('check("3.2", answer)', {"3.2"}),
        ("book.check('3.2',\n answer, strict=True)", {"3.2"}),
        ("check(3.10, answer)", {"3.1"}),  # so Python reads it
        ('assert verdict("90.1", x).right; check(number="3.3a", answer=x)', {"3.3a"}),
        ('# check("3.2", answer)', set()),
        ('recheck("3.2", answer)', set()),
        ('check("three", answer)', set()),
    ],
)
def test_a_check_without_output_was_not_run(source, numbers):
    answers = saved_answers(saved(code(source))).answers
    assert {number: each.status for number, each in answers.items()} == dict.fromkeys(
        numbers, "not run"
    )


def test_a_strict_check_that_raised_is_wrong_and_no_error():
    error = {"output_type": "error", "ename": "NotRightError"}
    answer = saved_answers(saved(code('check("3.4", 1, strict=True)', recorded(), error))).answers
    assert (answer["3.4"].status, answer["3.4"].error) == ("wrong", "")


def test_right_anywhere_counts_as_right():
    shown = [recorded(), recorded(word="right", attempt=2), recorded(word="not answered yet")]
    answer = saved_answers(saved(*(code("", each) for each in shown))).answers["3.4"]
    assert (answer.status, answer.attempts, answer.slips) == ("right", 2, ["Close."])


def test_nothing_that_a_terminal_obeys_is_kept():
    says = "\x1b[31mred\x07\u202e back \ud800 done"
    answer = saved_answers(saved(code("", recorded(says=says)))).answers["3.4"]
    assert answer.slips == ["[31mred back done"]


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-le", "utf-32", "latin-1"])
def test_encodings_that_editors_leave(encoding):
    content = json.loads(saved(code('check("3.1", "é")')))
    text = json.dumps(content, ensure_ascii=False)
    assert set(saved_answers(text.encode(encoding)).answers) == {"3.1"}


def test_the_title_of_an_export_names_its_student():
    title = {"cell_type": "markdown", "source": ["# Answers of Zoë van \\'t Hoff\n", "\n", "..."]}
    assert saved_answers(saved(title)).whose == "Zoë van 't Hoff"


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"", "It is empty."),
        (b"\0\0\0", "It is empty."),
        (b"{}", "It is not a notebook, whatever its name says."),
        (b"[1]", "It is not a notebook, whatever its name says."),
        ("é".encode("latin-1"), "It is not a notebook, whatever its name says."),
        (b"[" * 200_000, "It is nested too deeply for a notebook."),
        (b'{"cells": 3}', "It is not a notebook, whatever its name says."),
        (b"1" * 5000, "It is not a notebook, whatever its name says."),
        (b'{"cells": [' + b"{}," * MOST_BRACKETS, "It holds more than a notebook does."),
        (b" " * (LARGEST + 1), "It is larger than 16 MB."),
    ],
    ids=["empty", "zeros", "object", "list", "text", "deep", "number", "digits", "crowd", "huge"],
)
def test_what_is_not_a_notebook_is_refused_in_a_sentence(content, sentence):
    with pytest.raises(ValueError, match=f"^{sentence}$"):
        saved_answers(content)


def read_or_refused(content):
    """The answers; none if it is refused, which is a ValueError, and never anything else."""
    with suppress(ValueError):
        return saved_answers(content).answers
    return {}


anything = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=4,
)
record = st.fixed_dictionaries(
    {},
    optional={
        "exercise": anything | st.just("3.4"),
        "word": anything | st.sampled_from(["right", "not yet", "not readable"]),
        **dict.fromkeys(["says", "attempt", "because", "student", "answer"], anything),
    },
)
output = st.fixed_dictionaries(
    {},
    optional={
        "text": anything | st.just("Exercise 3.4: not yet. Close."),
        "ename": anything,
        "data": anything | st.fixed_dictionaries({}, optional={MIME: anything | record}),
    },
)
cell = st.fixed_dictionaries(
    {},
    optional={
        "cell_type": anything | st.just("code"),
        "source": anything | st.just('check("3.4", 1)'),
        "input": anything,
        "outputs": anything | st.lists(anything | output, max_size=3),
    },
)
book = anything | st.fixed_dictionaries(
    {},
    optional={
        "cells": anything | st.lists(anything | cell, max_size=3),
        "worksheets": anything | st.lists(st.fixed_dictionaries({"cells": st.lists(cell)})),
    },
)


@given(book)
def test_whatever_a_notebook_holds_it_is_read_or_refused(content):
    for number, answer in read_or_refused(json.dumps(content).encode()).items():
        assert number.replace(".", "").isdigit()
        assert answer.status in STATUSES
        assert isinstance("".join([answer.because, answer.student, *answer.slips]), str)
        assert 0 <= answer.attempts <= MOST_ATTEMPTS


@given(st.binary(max_size=60))
def test_whatever_bytes_come_they_are_read_or_refused(content):
    read_or_refused(content)


def test_a_notebook_of_many_numbers_is_bounded_and_soon_read():
    numbers = [f"{i // 900 + 1}.{i % 900}" for i in range(8000)]
    source = "\n".join(f'check("{number}", 1)' for number in numbers)
    answers = saved_answers(saved(code(source, {"output_type": "error", "ename": "E"}))).answers
    assert len(answers) == 1000


@pytest.mark.parametrize("cells", [1, 7])
def test_replies_of_a_notebook_are_bounded(cells):
    said = {"text": "Exercise 3.1: not yet. x\n" * MOST_TOLD}
    answer = saved_answers(saved(*cells * [code("", said)])).answers["3.1"]
    assert answer.attempts == MOST_TOLD


@pytest.mark.parametrize(
    ("says", "answer", "slip"),
    [
        (f"{NOT_ALL} {SAY_WHY}", "ca", "Chose a, c."),
        (NOT_ALL, "a and с", "Chose a, c."),  # a Cyrillic one
        (NOT_ONE, "a, <b>=1;", "Chose a, b."),
        (NOT_ONE, ["a"], ""),
        (NOT_ONE, None, ""),
        ("(a) It is not.", "a", "(a) It is not."),
    ],
)
def test_what_was_chosen_is_the_slip_where_all_are_told_the_same(says, answer, slip):
    output = recorded(says=says, answer=answer)
    assert saved_answers(saved(code("", output))).answers["3.4"].slips == [slip]


def test_a_choice_as_check_judges_it_is_a_slip_of_letters():
    card = judged("3.3", "abd", Progress(), Said(""))
    output = {"output_type": "display_data", "data": card._repr_mimebundle_()}
    assert saved_answers(saved(code("", output))).answers["3.3"].slips == ["Chose a, b, d."]


def test_code_beyond_any_notebooks_is_not_searched():
    cells = [code('check("3.1", 1)'), code(" " * MOST_CODE), code('check("3.2", 1)')]
    assert set(saved_answers(saved(*cells)).answers) == {"3.1"}

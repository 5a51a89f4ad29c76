"""Every exercise of the book: its mistakes are told apart, wrong answers get the right reason."""

import json
import re
import subprocess
import sys
from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from itertools import chain, combinations, permutations, product
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from driftlab import book
from driftlab.book import exercises
from driftlab.book.chapters import CHAPTERS, chapters_with
from driftlab.book.exercises import (
    KINDS,
    add_exercise,
    all_exercises,
    by_kind,
    check,
    given,
    hint,
    hints_of,
    verdict,
)
from driftlab.book.machinery.exercise.answers import Choice, Value, computed
from driftlab.book.machinery.exercise.exercise import Exercise, NotRightError, in_order, key_of
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.exercise.hints import Help
from driftlab.book.machinery.exercise.reading import numbers
from wrong_answers import WRONG

NOTEBOOKS = Path(__file__).parents[2] / "notebooks"
EXERCISES = all_exercises()
VALUES = {n: e for n, e in EXERCISES.items() if isinstance(e, Value)}
CHOICES = {n: e for n, e in EXERCISES.items() if isinstance(e, Choice)}


def words_on(answer):
    """Why; without, a choice is told no more than that it is not right, and each has its own."""
    return f"Because it looks so: {answer!r}."


def test_chapters_have_three_or_more_in_order():
    chapters = {number.split(".")[0] for number in EXERCISES}
    assert chapters == {str(chapter) for chapter in range(1, 19)}
    for chapter in chapters:
        numbers_of = [n for n in EXERCISES if n.split(".")[0] == chapter]
        assert numbers_of == sorted(numbers_of, key=in_order)
        whole = [n for n in numbers_of if not n[-1].isalpha()]  # 3.3a may follow 3.3
        assert whole == [f"{chapter}.{i}" for i in range(1, len(whole) + 1)]
        assert len(numbers_of) >= 3
        assert len({EXERCISES[n].kind for n in numbers_of}) >= 2


@cache
def text_of(path):
    cells = json.loads(path.read_text("utf-8"))["cells"]
    return "\n\n".join("".join(cell["source"]) for cell in cells)


def test_an_exercise_has_all_its_parts():
    missing = []
    for number, exercise in EXERCISES.items():
        chapter, kind = number.split(".")[0].zfill(2), exercise.kind.capitalize()
        (path,) = NOTEBOOKS.glob(f"{chapter}_*.ipynb")
        help_ = hints_of(chapter).get(number)
        text, solution = text_of(path), text_of(NOTEBOOKS / "solutions" / path.name)
        parts = {
            f'a heading "### {number} {kind}" in {path.name}': f"### {number} {kind}\n" in text,
            f'a cell that ends in check("{number}", ...)': f'check("{number}", answer' in text,
            f'["{number}"] in the chapter\'s hints.toml': help_ is not None,
            "a model in its hints, which shows how to answer in words": (
                kind != "Explain" or bool(help_ and help_.model)
            ),
            f'a heading "## {number} {kind}" in solutions/{path.name}': (
                f"## {number} {kind}\n" in solution
            ),
            f"wrong answers in tests/book/wrong_answers/ch{chapter}.py": bool(WRONG.get(number)),
        }
        missing += [f"exercise {number} lacks {what}" for what, there in parts.items() if not there]
    assert not missing, "; ".join(missing)


def test_what_is_not_answered_is_neither_right_nor_wrong():
    for number in EXERCISES:
        for answer in (..., None, "", "?", "...", [1.0, ...]):
            assert verdict(number, answer)[:2] == (None, "not answered yet."), (number, answer)


def test_right_answer_passes_and_each_mistake_is_told_apart():
    for number, exercise in EXERCISES.items():
        if isinstance(exercise, Value):
            right, mistakes = computed(exercise)
        elif isinstance(exercise, Formula):
            right, mistakes = key_of(exercise).right, key_of(exercise).mistakes.items()
        else:
            continue  # choices are below
        assert verdict(number, right).right, number
        for says, slip in mistakes:
            assert verdict(number, slip)[:2] == (False, f"not yet. {says}"), number


def numbers_in(texts):
    return set(re.findall(r"\d+\.?\d*", " ".join(texts)))


def entries(number, above):
    """The entries of the right value, as a reply might name them, without those that are small."""
    right = np.abs(computed(EXERCISES[number])[0])
    return {f"{entry:.3g}" for entry in right.flat if entry > above}


def test_wrong_answer_is_refused_with_its_reason_and_not_told_the_right_one():
    for number, wrong in WRONG.items():
        replies = [verdict(number, answer, because=words_on(answer)) for answer, _ in wrong]
        for (answer, words), reply in zip(wrong, replies, strict=True):
            assert reply.right is False, (number, answer)
            assert re.search(words, reply.says), (number, answer, reply.says)
        if number in VALUES:
            assert not entries(number, 0.1) & numbers_in(reply.says for reply in replies), number


def of_numbers(right: np.ndarray) -> Iterator[np.ndarray]:
    """Wrong answers made of the right one without knowing what it means."""
    yield from (-right, 2 * right, right / 2, 0 * right, 3.7 * right, 0.3 * right)
    yield from (1e3 * right, 1e-6 * right, np.degrees(right), np.radians(right))
    yield from (right + 1, right - 1, 90 - right, 180 - right, 360 - right, 1 - right)
    with np.errstate(divide="ignore"):
        yield 1 / right
    if right.ndim == 0:
        return
    yield from (right[::-1], np.roll(right, 1), right.T)
    for part in range(right.size):
        for factor in (-1, 2, 1.3):
            wrong = np.array(right)
            wrong.flat[part] = factor * wrong.flat[part] + 0.3 * np.abs(right).max()
            yield wrong


def of_formula(right):
    """The same for a formula; the functions take its arguments."""
    yield from (lambda *a: -numbers(right(*a)), lambda *a: 2 * numbers(right(*a)))
    yield from (lambda *a: numbers(right(*a)) ** 2, lambda *a: numbers(right(*a)) + 1)
    yield lambda *a: right(*(np.asarray(x) * 2 for x in a))
    yield lambda *a: right(*a[::-1])
    yield lambda *a: np.sin(numbers(right(*a)))


def replies_to_slips(exercise: Exercise) -> list[str]:
    if isinstance(exercise, Choice):
        letters = exercise.letters
        answers = ["".join(each) for n in (1, 2) for each in permutations(letters, n)]
    elif isinstance(exercise, Value):
        answers = [a for a in of_numbers(computed(exercise)[0]) if np.isfinite(a).all()]
    elif isinstance(exercise, Formula):
        answers = list(of_formula(key_of(exercise).right))
    else:
        answers = ["", "+90X"]
    found = [exercise.verdict(answer) for answer in answers]
    return [each.says for each in found if each.right is False]


def test_natural_slip_is_told_more_than_that_it_is_wrong():
    """What anyone does wrong anywhere: whatever the exercise, none gets a bare "not yet"."""
    for number, exercise in EXERCISES.items():
        says = replies_to_slips(exercise)
        assert says, number
        for each in says:
            kind, _, reason = each.partition(". ")
            assert kind in ("not yet", "not readable"), (number, each)
            assert len(reason) > 8, (number, each)
        if isinstance(exercise, Value):
            own = {f"not yet. {slip}" for slip in key_of(exercise).mistakes}
            told = (each for each in says if each not in own)
            assert not entries(number, 0.1) & numbers_in(told), number


def test_no_hint_gives_the_answer():
    for number in VALUES:
        rungs = hints_of(number.split(".")[0].zfill(2))[number].rungs
        assert not entries(number, 2) & numbers_in(rungs), number


def test_choice_names_what_is_wrong_with_every_other_statement():
    for number, exercise in CHOICES.items():
        key = key_of(exercise)
        right = "".join(sorted(key.right))
        assert exercise.letters == "abcdefgh"[: len(exercise.letters)]
        assert not key.right & set(key.mistakes)
        assert verdict(number, right).right, number
        for letter, reason in key.mistakes.items():
            more = right + letter
            says = f"not yet. ({letter}) {reason}"
            assert verdict(number, more, because=words_on(more))[:2] == (False, says), number
        less = verdict(number, right[1:], because=words_on(right[1:]))
        assert less[:2] == (False, "not yet. What you chose is true, and something else is too.")


def test_choice_tells_who_gives_no_reason_nothing_to_find_it_by():
    """So that whoever tries has to try all: with one reply to all, no order of trials is better."""
    for number, exercise in CHOICES.items():
        tries = (combinations(exercise.letters, n) for n in range(1, 7))
        found = [verdict(number, "".join(each)) for each in chain(*tries)]
        assert sum(each.right for each in found) == 1, number
        assert len({each.says for each in found if not each.right}) == 1, number


JUDGED = """
import sys
from driftlab.book.exercises import all_exercises, verdict
verdict("3.1", [1, 1, -1, 0, 0, 0]), verdict("3.3", "ad"), verdict("3.5", len)
print("sympy" in sys.modules)
all_exercises()
print("matplotlib" in sys.modules)
"""


def test_importing_the_exercises_loads_no_plotting_and_judging_no_sympy():
    command = [sys.executable, "-c", JUDGED]
    answer = subprocess.run(command, capture_output=True, text=True, check=True)
    assert answer.stdout.split() == ["False", "False"]


def test_check_prints_what_it_says_and_refuses_an_unknown_number(capsys):
    check("1.3", "bce")
    assert capsys.readouterr().out.startswith("Exercise 1.3: right. ")
    check(1.3, "bce")
    assert capsys.readouterr().out.startswith("Exercise 1.3: right. ")
    with pytest.raises(ValueError, match=r'^number: expected "1\.1" to "18\.\d", got \'x\''):
        check("x", 1)
    with pytest.raises(ValueError, match=r'^number: expected "1\.1" to "18\.\d", got 3'):
        check(3, 1)
    last = re.escape([*all_exercises("01")][-1])
    with pytest.raises(ValueError, match=rf'^number: expected "1\.1" to "{last}", got '):
        check("1.99", 1)


def test_exercises_of_a_kind_are_listed():
    assert sorted(n for kind in KINDS for n in by_kind(kind)) == sorted(EXERCISES)
    with pytest.raises(ValueError, match=r"^kind: expected one of predict, .*, got 'guess'"):
        by_kind("guess")


def test_no_public_attribute_leads_to_what_is_right():
    for exercise in EXERCISES.values():
        public = {each: getattr(exercise, each) for each in dir(exercise) if each[0] != "_"}
        assert not {"right", "wrong", "expected", "feedback"} & public.keys()
        assert public.pop("mistakes", {}) == {}  # the default of an argument
        assert repr(key_of(exercise).right) not in repr(exercise)


GIVING = [n for n, e in EXERCISES.items() if getattr(e, "given", None)]


@pytest.mark.slow
@pytest.mark.parametrize("count", [8, pytest.param(30, marks=pytest.mark.long)])
@pytest.mark.parametrize("number", GIVING)
def test_students_have_numbers_of_their_own_and_mistakes_told_apart(number, count):
    exercise, answers = EXERCISES[number], []
    for student in (f"student {i}" for i in range(count)):
        right, mistakes = computed(exercise, student)
        answers.append(right)
        assert verdict(number, right, student=f" {student.upper()}").right
        for says, value in mistakes:
            reply = verdict(number, value, student=student)
            assert reply[:2] == (False, f"not yet. {says}"), student
    assert len({right.tobytes() for right in answers}) > count / 2
    others = sum(verdict(number, right).right for right in answers)
    # Nearly nobody's else: of 30 it is two at most; at that chance more than two of 8 were one case
    # in seventy (binomial).
    assert others <= 2


def test_given_numbers_are_shown_as_code_that_makes_them():
    for number, student in product(GIVING, ("", "Ada Lovelace")):
        numbers = given(number, student=student)
        assert len(numbers) == len(list(numbers))
        names = {}
        exec(repr(numbers), {"np": np}, names)
        assert names.keys() == numbers.keys()
        for name, value in numbers.items():
            np.testing.assert_array_equal(names[name], value, number)


def test_words_on_one_choice_say_nothing_of_another_for_a_program_either():
    first, second = (
        verdict("3.3", letters, because="The same words for each choice.").says
        for letters in ("adb", "adc")
    )
    assert first.startswith("not yet. (b) forgets")
    assert second.endswith("and the reply goes into it.")
    assert verdict("3.3", "adb", because="The same words for each choice.").says == first


class Unwilling:
    def __array__(self, *_, **__):
        raise RuntimeError("not today")

    __str__ = __repr__ = __array__


def deep(levels):
    return [deep(levels - 1)] if levels else 1.0


ENDLESS = []
ENDLESS.append(ENDLESS)


def test_whatever_is_handed_in_is_judged_and_recorded():
    large = 10**400
    answers = large, [large], Fraction(large), Unwilling(), [Unwilling()], deep(900), ENDLESS
    for number, (i, answer) in product(("1.1", "3.2", "3.3", "1.5"), enumerate(answers)):
        card = exercises.judged(number, answer, exercises.Progress())
        assert card.verdict.word == "not readable", (number, i)
        assert json.loads(json.dumps(card.record))["word"] == "not readable", (number, i)
        assert "not readable" in repr(card), (number, i)


def test_letters_that_come_one_by_one_are_read_once():
    card = exercises.judged("1.3", iter("bce"), exercises.Progress())
    assert card.verdict.right
    assert card.record["right"]


def test_letters_that_look_alike_are_read_as_they_look():
    assert verdict("1.3", "b\u0441\u0435").right  # as a Russian keyboard has c and e
    assert not verdict("1.3", "\u0449").right


def test_a_function_that_ends_the_program_ends_nothing(capsys):
    with pytest.raises(NotRightError, match="Your answer raised SystemExit"):
        check("1.5", lambda w, m, t: sys.exit(0), strict=True)


def test_a_rotation_of_scipy_is_a_quaternion():
    right, _ = computed(EXERCISES["1.4"])
    assert verdict("1.4", Rotation.from_quat(right)).right


def test_a_name_is_the_same_however_a_keyboard_has_it():
    for name, same in (
        ("Ταΐς", "Ταΐς".upper()),
        ("Ada Lovelace", " ada\u200b  LOVELACE"),
        ("D’Arcy", "d'arcy"),
        ("Jean‑Luc", "jean-luc"),
        ("ｋｉｍ", "Kim"),
    ):
        mine, again = (given("3.4", student=each) for each in (name, same))
        assert repr(mine).split("\n")[1:] == repr(again).split("\n")[1:], name
    assert given("3.4", student="\ud800")  # half a sign, which no file can hold


def test_an_exercise_that_can_never_be_judged_is_refused_at_once():
    with pytest.raises(ValueError, match=r"^kind: expected one of predict, .*, got 'sums'\.$"):
        Value(kind="sums", right=lambda: 1.0)
    with pytest.raises(ValueError, match=r"^right: expected a function that computes .* got 1\.0"):
        Value(kind="compute", right=1.0)


def test_given_refuses_what_has_no_numbers_of_ones_own():
    with pytest.raises(ValueError, match=r"^number: expected one of .*3\.4, .*, got '3\.3'"):
        given("3.3", student="Ada")
    with pytest.raises(ValueError, match=r"^student: expected text, got int"):
        given("3.4", student=7)
    with pytest.raises(ValueError, match=r"^because: expected text, got list"):
        check("3.3", "ad", because=[1])


@pytest.fixture
def own():
    """Exercises of one's own, which no other test sees."""
    yield exercises._OWN
    exercises._OWN.clear()


def test_a_tenth_exercise_is_asked_for_as_text(own, capsys):
    half = Value(kind="compute", right=lambda: 2.0, mistakes={"That is a half.": lambda: 0.5})
    for number in ("90.1", "90.10"):
        add_exercise(number, half)
    check(90.1, ...)
    assert 'write "90.10", as text' in capsys.readouterr().out


def test_an_exercise_of_ones_own_answers_like_the_books(own, capsys):
    half = Value(kind="compute", right=lambda: 2.0, mistakes={"That is a half.": lambda: 0.5})
    add_exercise("90.1", half)
    check("90.1", 0.5)
    add_exercise("3.3x", half, Help(section="", nudge="Look again.", idea="It is two."))
    check("3.3x", 2)
    hint("3.3x")
    hint("3.3x")
    hint("3.3x")
    assert capsys.readouterr().out.split("\n") == [
        "Exercise 90.1: not yet. That is a half.",
        "Exercise 3.3x: right.",
        *("Exercise 3.3x", "Hint 1: Look again."),
        *2 * ("Exercise 3.3x", "Hint 1: Look again.", "Hint 2: It is two."),
        "",
    ]
    add_exercise("90.1", Choice(kind="explain", right="a", wrong={"b": "is not."}))
    assert verdict("90.1", "a").right
    numbers_known = list(all_exercises())
    assert numbers_known[-2:] == ["90.1", "3.3x"]
    assert sorted(numbers_known, key=in_order)[-1] == "90.1"
    assert "Exercise 90.1" in exercises.judged("90.1", "b", exercises.Progress())._repr_html_()
    with pytest.raises(ValueError, match=r"^number: expected an exercise with hints; 90\.1 has no"):
        hint("90.1")
    with pytest.raises(ValueError, match=r'^number: expected "90\.1" to "90\.1", got \'90\.2\''):
        check("90.2", 1)


def test_an_exercise_of_ones_own_takes_no_place_of_the_books(own):
    half = Value(kind="compute", right=lambda: 0.5)
    with pytest.raises(
        ValueError, match=r"^number: expected one that the book has not, got '3\.3'"
    ):
        add_exercise("3.3", half)
    with pytest.raises(ValueError, match=r"^number: expected one like .*3\.3a.*, got 3\.7"):
        add_exercise(3.7, half)
    with pytest.raises(ValueError, match=r"^exercise: expected an Exercise, got float"):
        add_exercise("3.7", 0.5)
    assert own == {}


def test_strict_check_raises_unless_the_answer_is_right(capsys):
    check("3.3", "ad", strict=True)
    with pytest.raises(AssertionError, match=r"^Exercise 3\.3: not yet\. "):
        check("3.3", "a", strict=True)
    with pytest.raises(AssertionError, match=r"^Exercise 3\.3: not answered yet\."):
        check("3.3", ..., strict=True)
    assert capsys.readouterr().out.count("Exercise 3.3: ") == 3


def test_every_exercise_has_a_ladder_that_ends_in_a_section_of_its_chapter():
    for chapter in CHAPTERS:
        ladders = hints_of(chapter) if chapter in chapters_with("exercises") else {}
        assert list(ladders) == [n for n in EXERCISES if n.split(".")[0].zfill(2) == chapter]
        (path,) = NOTEBOOKS.glob(f"{chapter}_*.ipynb")
        headings = {
            line.lstrip("#").strip()
            for cell in json.loads(path.read_text("utf-8"))["cells"]
            for line in cell["source"]
            if line.startswith("##")
        }
        for number, each in ladders.items():
            assert each.section in headings, number
            assert all(len(rung) > 30 for rung in each.rungs), number
            assert each.model or EXERCISES[number].kind != "explain", number


ALL_AT_THEIR_ENDS = {f"m{i}{j}": 2.0 for i in (1, 2, 3) for j in (1, 2, 3)}
TURNED = {"kxy": -40.0, "kyx": 40.0, "kxz": 40.0, "kzx": -40.0, "kyz": -40.0, "kzy": 40.0}
SETTINGS = {
    "1.2": (book.ErrorMotionExplorer, "Error along the rate", {"error3": -0.3, "error1": 2.65}),
    "3.2": (book.DriftExplorer, "Larin's triad", {"azimuth": 45.0, "elevation": 35.0}),
    "4.2": (book.TurnCalibrationExplorer, "Larin's triad, axes as in (2.4)", {}),
    "6.2": (book.CayleyMapExplorer, "Both finite", {"angle": 219.0}),
    "7.2": (book.AlgorithmLaboratoryExplorer, "Swaying ship", {"rate": 24}),
    "10.2": (book.SplitExplorer, "No error", TURNED),
    "13.4": (book.AlignmentBudgetExplorer, "No errors, level, to the North", {"acc_right": 1.5}),
    "14.5": (book.GyrocompassExplorer, "Small drifts, a turn", {"tuning": 0.95}),
    "15.5": (book.TypeTestExplorer, "Damped without a log", {}),
    "16.4": (book.CapstoneExplorer, "Bent and turned", {}),
    "17.3": (book.AllanExplorer, "Puzzle: two that fall", {}),
}
"""The panel of an exercise, its preset, and what the reader sets besides."""
FOUND = {
    "3.2": ALL_AT_THEIR_ENDS,
    "4.2": {"steps": round(float(computed(EXERCISES["4.2"])[0]))},
    "13.4": {"pitch": round(float(computed(EXERCISES["13.4"])[0]))},
    "15.5": {"damping": 0.15},
    "16.4": {"turn_right": round(float(computed(EXERCISES["16.4"])[0]))},
    "17.3": {"quantisation": 100.0},
}
"""What more a reader sets who has found the answer."""


def panel_at(panel_class, preset, settings):
    """All that an exercise sees of a panel."""
    values = {control.name: control.start for control in panel_class.controls}
    return SimpleNamespace(values={**values, **panel_class.presets[preset], **settings})


def test_panel_is_read_as_an_answer():
    for number, (panel_class, preset, settings) in SETTINGS.items():
        assert verdict(number, panel_at(panel_class, preset, {})).right is False, number
        found = panel_at(panel_class, preset, {**settings, **FOUND.get(number, {})})
        assert verdict(number, found).right, number
        other = book.SplitExplorer if number != "10.2" else book.DriftExplorer
        stranger = panel_at(other, next(iter(other.presets)), {})
        assert verdict(number, stranger).says.startswith("not readable. Expected the panel of this")


def test_panel_that_is_set_otherwise_is_told_so():
    wrong = panel_at(*SETTINGS["1.2"][:2], {"error1": 2.65})
    assert "Begin with the preset" in verdict("1.2", wrong).says
    roots = (book.RootsExplorer, "Across the error")
    assert "not yet. At this azimuth" in verdict("2.2", panel_at(*roots, {})).says
    assert "the other azimuth too" in verdict("2.2", panel_at(*roots, {"azimuth": 0.0})).says
    several = panel_at(book.ObservabilityExplorer, "19 positions, 27 states", {})
    assert "No one setting of a panel" in verdict("11.2", several).says


def test_every_slide_exercise_reads_its_panel_or_says_that_it_cannot():
    slides = {n for n, each in by_kind("slide").items() if each.from_panel}
    assert slides == {*SETTINGS, "2.2"}
    assert {*by_kind("slide")} - slides == {"7.3", "9.2", "11.2", "12.2"}

"""No answer is run, and none becomes a part of the page that shows what `check` thinks of it."""

from itertools import product

from driftlab.book.exercises import all_exercises, judged
from driftlab.book.machinery.exercise.card import Card
from driftlab.book.machinery.exercise.exercise import Said
from driftlab.book.machinery.exercise.progress import Progress
from driftlab.core.loops import by_numpy_alone
from hostile import CODE, MARKUP, TEXTS, Elements, Hostile, all_that_runs

ANSWERS = (*TEXTS, list(TEXTS), {text: text for text in TEXTS}, Hostile(), [1.0, Hostile()])
ELEMENTS = {"div", "span", "b", "code", "details", "summary", "a"}


def test_an_answer_is_neither_run_nor_shown_as_markup() -> None:
    for number, (i, answer) in product(all_exercises(), enumerate(ANSWERS)):
        # Numba would read what it compiled, which looks like an answer that is unpickled.
        with by_numpy_alone(), all_that_runs() as seen:
            card = judged(number, answer, Progress(), Said(because=MARKUP, student=CODE))
            assert_harmless(card)
        assert seen == [], (number, i)
        assert card.verdict.right is not True, (number, i)


def assert_harmless(card: Card) -> None:
    elements = Elements(card._repr_html_())
    assert elements.names <= ELEMENTS, card
    assert elements.acts == [], card

"""text2qti reads the quiz that is written for it: right answers, tolerances, statements."""

import pytest

from driftlab.book.instructors.questions import questions
from driftlab.book.instructors.quiz_text import fits, quiz_text
from support import ROOT

package = pytest.importorskip("text2qti.quiz", reason='"python3 lab.py peers" fetches it.')


def test_text2qti_reads_the_quiz_of_a_class():
    from text2qti.config import Config

    plain = [each for each in questions(ROOT / "notebooks", students=30)[0] if fits(each)]
    quiz = package.Quiz(quiz_text(plain), config=Config(), source_name="quiz")
    parts = quiz.questions_and_delims
    read = {part.title_raw: part for part in parts if isinstance(part, package.Question)}
    for each in plain:
        count = len(each.numbers)
        for which, number in enumerate(each.numbers, start=1):
            one = read[each.title + (f", number {which} of {count}" if count > 1 else "")]
            low, high = float(one.numerical_min_html_xml), float(one.numerical_max_html_xml)
            assert low <= number.right <= high
            assert high - low == pytest.approx(2 * number.tolerance, rel=0.1)
        if each.statements:
            choices = [one.correct for one in read[each.title].choices]
            assert choices == [one.true for one in each.statements]

"""The exercises as questions: right answers are taken, slips have replies, and texts read well."""

import re
import subprocess
import sys
import zipfile
from html.parser import HTMLParser
from xml.etree import ElementTree as ET

import pytest

from driftlab.book import given, verdict
from driftlab.book.exercises import all_exercises
from driftlab.book.instructors import question_bank
from driftlab.book.instructors.moodle_xml import in_html, moodle_xml
from driftlab.book.instructors.question_bank import NO_TEXT2QTI, NOTEBOOKS, write_question_bank
from driftlab.book.instructors.questions import exercise_texts, questions
from support import ROOT

NUMBER = r"-?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?"
GAP = re.compile(r"\{1:NUMERICAL:((?:[^\\}]|\\.)*)\}")
"""A number among text, as Moodle writes and reads it."""
ALTERNATIVE = re.compile(rf"(=|%0%)({NUMBER}):({NUMBER})(?:#((?:[^~}}\\]|\\.)*))?")


@pytest.fixture(scope="module")
def bank():
    return questions(NOTEBOOKS, students=3)


@pytest.fixture(scope="module")
def moodle(bank):
    root = ET.fromstring(moodle_xml(bank[0]))
    return {each.findtext("name/text"): each for each in root.iterfind("question[name]")}


def alternatives(question):
    """Numbers, tolerances and replies of each number that a question of Moodle asks."""
    if question.get("type") == "cloze":
        gaps = GAP.findall(question.findtext("questiontext/text"))
        return [
            [(mark == "=", float(v), float(t), says) for mark, v, t, says in each]
            for each in map(ALTERNATIVE.findall, gaps)
        ]
    return [
        [
            (
                each.get("fraction") == "100",
                float(each.findtext("text")),
                float(each.findtext("tolerance")),
                each.findtext("feedback/text"),
            )
            for each in question.iterfind("answer")
        ]
    ]


def test_a_question_speaks_to_who_sits_before_a_platform(bank):
    """There are boxes to tick in place of letters, numbers are drawn, and there is no card."""
    texts = exercise_texts(NOTEBOOKS)
    asked = bank[0]
    assert any("letters" in texts[each.exercise] for each in asked if each.statements)
    assert any("given(" in texts[each.exercise] for each in asked if each.variant)
    assert any("the card says" in texts[each.exercise] for each in asked)
    for each in asked:
        assert "given(" not in each.text, each.title
        assert "the card says" not in each.text, each.title
        assert not re.search(r"[Gg]ive (all|the) (their )?letters", each.text), each.title
        assert not each.text.startswith("\n"), each.title


def test_every_exercise_is_asked_or_left_out_for_a_reason(bank):
    asked, left_out = bank
    assert {each.exercise for each in asked} | set(left_out) == set(all_exercises())
    assert not {each.exercise for each in asked} & set(left_out)
    assert left_out["3.2"] == "it needs its panel"
    assert sum(each.exercise == "5.1" for each in asked) == 3


def test_what_is_right_is_right_to_the_exercise_and_the_slips_are_not(bank):
    for each in bank[0]:
        if each.numbers:
            student = f"variant {each.variant}" if each.variant else ""
            right = [number.right for number in each.numbers]
            answer = right if len(right) > 1 else right[0]
            assert verdict(each.exercise, answer, student=student).right, each.title
        for number in each.numbers:
            off = [abs(slip.value - number.right) for slip in number.slips]
            assert min(off, default=1) > number.tolerance > 0, each.title
        if each.statements:
            letters = [one.text[1] for one in each.statements if one.true]
            assert verdict(each.exercise, letters).right
            assert (
                "".join(one.text[1] for one in each.statements)
                == all_exercises()[each.exercise].letters
            )
            assert all(one.true != bool(one.says) for one in each.statements)


def test_moodle_finds_the_right_answer_first_and_the_slip_by_its_reply(bank, moodle):
    assert len(moodle) == len(bank[0])
    for each in bank[0]:
        if each.statements:
            continue
        found = alternatives(moodle[each.title])
        assert len(found) == len(each.numbers), each.title
        for number, options in zip(each.numbers, found, strict=True):
            assert [right for right, *_ in options] == [True] + [False] * len(number.slips)
            _, value, tolerance, _ = options[0]
            assert value == pytest.approx(number.right, abs=number.tolerance / 100)
            assert tolerance == pytest.approx(number.tolerance)
            for slip, (_, wrong, _, says) in zip(number.slips, options[1:], strict=True):
                assert abs(wrong - value) > tolerance
                assert in_html(slip.says, block=False) in says.replace("\\", "")


def test_marks_of_statements_add_up(bank, moodle):
    for each in bank[0]:
        if each.statements:
            worth = [float(one.get("fraction")) for one in moodle[each.title].iterfind("answer")]
            assert sum(one for one in worth if one > 0) == pytest.approx(100, abs=1e-3)
            assert sum(one for one in worth if one < 0) == pytest.approx(-100, abs=1e-3)


def test_texts_are_sound_html_without_left_over_markdown(bank, moodle):
    for title, question in moodle.items():
        for element in question.iter("text"):
            text = element.text or ""
            if element in question.iterfind("name/text"):
                continue
            Balanced().check(text)
            outside = re.sub(r"\\\(.*?\\\)|\\\[.*?\\\]|<code>.*?</code>", "", text, flags=re.S)
            assert not re.search(r"[$`\0]|\*|^- ", GAP.sub("", outside)), (title, outside)


def test_formulas_and_signs_survive():
    text = "If *a* < b & $a_1 < b_*$, then `x * y`:\n\n$$c^2$$\n\n- one\n- **two**"
    assert in_html(text) == (
        "<p>If <em>a</em> &lt; b &amp; \\(a_1 &lt; b_*\\), then <code>x * y</code>:</p>"
        "<p>\\[c^2\\]</p><ul><li>one</li><li><strong>two</strong></li></ul>"
    )


def test_variants_show_their_numbers(bank, moodle):
    numbers = given("5.1", student="variant 2")
    text = moodle["Exercise 5.1, variant 2"].findtext("questiontext/text")
    assert "The unit is arc seconds." in text
    for name, value in numbers.items():
        assert f"<code>{name}</code>: <code>{value}</code>" in text


@pytest.mark.slow
def test_no_two_variants_are_the_same():
    variants = [each for each in questions(NOTEBOOKS, students=60)[0] if each.variant]
    assert len({each.text for each in variants}) == len(variants)
    assert [each.variant for each in variants[:60]] == list(range(1, 61)), "those of 3.4"
    assert 20 < sum(each.exercise == "5.1" for each in variants) < 60


@pytest.mark.slow
def test_files_of_the_command(tmp_path):
    command = [sys.executable, "-m", "driftlab.book", "questions", tmp_path / "bank"]
    done = subprocess.run(
        [*command, "--students", "2"], cwd=ROOT, capture_output=True, encoding="utf-8", check=True
    )
    assert "3.2 is left out: it needs its panel." in done.stdout
    names = {path.name for path in (tmp_path / "bank").iterdir()}
    if NO_TEXT2QTI in done.stdout:
        assert names == {"drift-lab-moodle.xml", "drift-lab.txt"}
    else:
        with zipfile.ZipFile(tmp_path / "bank/drift-lab-qti.zip") as archive:
            for name in archive.namelist():
                if name.endswith(".xml"):
                    ET.fromstring(archive.read(name))


def test_without_text2qti_a_sentence_says_so(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(question_bank, "find_spec", lambda name: None)
    write_question_bank(tmp_path, students=1)
    assert NO_TEXT2QTI in capsys.readouterr().out
    assert not list(tmp_path.glob("*.zip"))


def test_a_folder_without_chapters_is_refused(tmp_path):
    with pytest.raises(ValueError, match="notebooks: expected the folder of the chapters"):
        write_question_bank(tmp_path, notebooks=tmp_path)
    with pytest.raises(ValueError, match="students: expected 1 or more, got 0"):
        write_question_bank(tmp_path, students=0)


class Balanced(HTMLParser):
    """Complains of a tag that is not closed in its turn."""

    def check(self, text):
        self.open = []
        self.feed(text)
        self.close()
        assert not self.open, text

    def handle_starttag(self, tag, attrs):
        self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

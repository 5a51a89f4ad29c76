"""Learning outcomes and hours are those of the chapters."""

import re
from pathlib import Path

import pytest

from driftlab.book.course import LADDER, hours_table, outcomes_table, promises, rung_of, times

FOLDER = Path(__file__).parents[2] / "notebooks"
CHAPTERS = promises(FOLDER)


def text_of(number):
    (path,) = FOLDER.glob(f"{number}_*.ipynb")
    return path.read_text("utf-8")


def test_each_chapter_with_outcomes_is_read_and_no_line_is_lost():
    told = [path for path in FOLDER.glob("*.ipynb") if '"## What you will be able to do' in
            path.read_text("utf-8")]  # fmt: skip
    assert sorted(path.name[:2] for path in told) == list(CHAPTERS)
    for number, chapter in CHAPTERS.items():
        section = re.search(r'"## What you will be able to do.*?You need', text_of(number), re.S)[0]
        lines = re.findall(r'"- (\w+)', section)
        assert len(chapter.outcomes) == len(lines) - lines.count("see"), number
        assert f"About {chapter.minutes} minutes" in text_of(number)


def test_a_module_description_gets_two_to_four_of_each():
    _, *rows = outcomes_table(CHAPTERS).rows
    for number, chapter in CHAPTERS.items():
        mine = [row for row in rows if row[0] == number]
        assert 2 <= len(mine) <= 4
        assert mine[0][1] == chapter.outcomes[0].text
        lowest = min(LADDER.index(rung) for _, _, rung in mine[1:])
        left_out = [each for each in chapter.outcomes if all(each.text != row[1] for row in mine)]
        assert all(LADDER.index(each.rung) <= lowest for each in left_out)
    assert not {row[1].split()[0] for row in rows} & {"say", "see", "tell"}
    assert not any(re.search(r"\byou", row[1]) for row in rows)


def test_a_new_verb_says_what_to_do():
    with pytest.raises(ValueError, match=r"'juggle' is not on the ladder; enter it in VERBS"):
        rung_of("juggle")


def test_a_folder_without_chapters_is_refused(tmp_path):
    with pytest.raises(ValueError, match="expected the book's notebooks"):
        promises(tmp_path)


def test_hours_are_those_of_the_chapters():
    minutes = times(FOLDER)
    assert {n: alone for n, (alone, _, _) in minutes.items() if n in CHAPTERS} == {
        number: chapter.minutes for number, chapter in CHAPTERS.items()
    }
    _, row = hours_table({"two": ["03", "01"]}, 10, FOLDER).rows
    hours = sum(minutes["01"] + minutes["03"]) / 60 + 10
    name, chapters, *parts, total, credits = row
    assert (name, chapters) == ("two", "01, 03")
    assert [float(part) for part in parts] == pytest.approx(
        [sum(pair) / 60 for pair in zip(minutes["01"], minutes["03"], strict=True)], abs=0.5
    )
    assert float(total) == pytest.approx(hours, abs=0.5)
    low, high = map(float, credits.split(" to "))
    assert (low * 30, high * 25) == pytest.approx((hours, hours), abs=1.5)

"""The report of a made-up class of thirty, half of it awkward: every one of them is there."""

import csv
import io
import subprocess
import sys
from html.parser import HTMLParser

import pytest

import driftlab.book
from driftlab.book import class_report
from driftlab.book.__main__ import write_class_report
from driftlab.book.instructors.made_up_class import PLAIN, write_made_up_class
from driftlab.book.instructors.plain_text import width

THIRD = ["3.1", "3.2", "3.3", "3.4", "3.5", "3.6"]


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    return write_made_up_class(tmp_path_factory.mktemp("course"))


@pytest.fixture(scope="module")
def report(place):
    return class_report(place, roster=place.with_name("roster.csv"))


@pytest.fixture(scope="module")
def by_name(report):
    return {student.name: student for student in report.students}


@pytest.fixture(scope="module")
def written(report, tmp_path_factory):
    return report.write(tmp_path_factory.mktemp("out") / "report")


def table(path):
    return list(csv.reader(io.StringIO(path.read_text("utf-8-sig"), newline="")))


def statuses(student):
    return {student.status(number) for number in THIRD}


def test_thirty_handed_in_and_each_has_a_row(place, report, by_name):
    there = {path.name.partition("_")[0] for path in place.iterdir() if path.is_dir()}
    eve = "<script>alert(1)</script> & <b>Eve</b>"
    assert len(there) + 1 == 30
    assert set(by_name) == there | {eve, "Nobody Knows"}
    assert len(report.students) == 31
    assert {student.name for student in report.students if not student.is_listed} == {
        eve,
        "Not On The List",
    }


def test_the_columns_are_the_chapters_that_somebody_touched(report):
    assert report.exercises == ["1.1", "1.2", "1.3", "1.4", "1.5", *THIRD]


@pytest.mark.parametrize("name", PLAIN)
def test_who_did_all_as_one_should_is_counted(by_name, name):
    student = by_name[name]
    assert statuses(student) <= {"right", "wrong", "open"}
    assert student.notes == []
    assert student.right(THIRD) <= student.attempts(THIRD) <= 6


def test_two_chapters_of_a_student_are_joined(by_name):
    assert by_name["Ada Lovelace"].files == ["01.ipynb", "03.ipynb"]
    assert by_name["Ada Lovelace"].status("1.1") != "absent"
    assert by_name["Jean-Luc Moreau"].status("1.1") == "absent"


@pytest.mark.parametrize(
    "name",
    ["Bo Mark", "Wide Letters", "Zip Zimmer", "Wanda Webb", "Old Format", "=2+5 Formula"],
)
def test_awkward_files_are_read_whole(by_name, name):
    assert statuses(by_name[name]) <= {"right", "wrong", "open"}
    assert by_name[name].notes == []


@pytest.mark.parametrize(
    ("name", "note"),
    [
        ("Empty Folder", "Nothing was handed in."),
        ("Nobody Knows", "Nothing was handed in under this name."),
        ("Doc Word", "03_systematic_drift.ipynb: It is not a notebook, whatever its name says."),
        ("Paper Only", "Not read, since no notebook: answers.pdf."),
    ],
)
def test_who_has_no_notebook_has_a_row_and_a_reason(by_name, name, note):
    assert statuses(by_name[name]) == {"absent"}
    assert by_name[name].notes == [note]


def test_a_notebook_that_was_not_run_says_so(by_name):
    assert statuses(by_name["Una Unrun"]) == {"not run"}


def test_an_error_stands_where_it_was_raised(by_name):
    student = by_name["Ernst Error"]
    assert [n for n in THIRD if student.status(n) == "error"] == ["3.3"]
    assert student.answers["3.3"].error == "NameError"


def test_of_two_downloads_the_later_counts_and_the_report_says_so(by_name):
    student = by_name["Rae Submitted"]
    assert student.notes == [
        "03_systematic_drift (1).ipynb came after 03_systematic_drift.ipynb, and counts."
    ]
    assert student.right(THIRD) > 3


def test_right_anywhere_counts_and_the_tries_are_counted(by_name):
    answer = by_name["Tom Twice"].answers["3.1"]
    assert answer.status == "right"
    assert answer.slips == [
        "An axis is a unit vector: the last two have to be divided by their lengths."
    ]


def test_a_damaged_archive_harms_nothing_else(by_name):
    student = by_name["Not On The List"]
    assert statuses(student) <= {"right", "wrong", "open"}
    assert student.notes[0].startswith("broken.zip: The archive is damaged")


def test_slips_are_counted_by_students(report, by_name):
    counts = [len(slip.students) for slip in report.slips]
    assert counts == sorted(counts, reverse=True)
    for slip in report.slips:
        assert len(set(slip.students)) == len(slip.students)
        for name in slip.students:
            assert slip.says in by_name[name].answers[slip.exercise].slips
    assert any("unit vector" in slip.says and len(slip.students) > 1 for slip in report.slips)


def test_the_text_has_a_line_for_everybody_and_columns_that_stand(report):
    lines = str(report).splitlines()
    assert lines[0] == f"class: 31 students, {len(report.exercises)} exercises"
    table = lines[3 : 3 + len(report.students)]
    assert {width(line.rpartition("  ")[0]) for line in table} == {width(table[0]) - 8}
    assert all(line.isprintable() for line in lines)


def test_the_gradebook_has_everybody_once_and_computes_nothing(written, report):
    head, *rows = table(written / "gradebook.csv")
    assert head == ["student", "id", "right", "of", "attempts", *report.exercises]
    assert [row[0].removeprefix("'") for row in rows] == [s.name for s in report.students]
    assert "'=2+5 Formula" in {row[0] for row in rows}
    for row, student in zip(rows, report.students, strict=True):
        right = str(student.right(report.exercises)) if any(row[5:]) else ""
        assert row[2:4] == [right, str(len(report.exercises))]
        assert row[5:].count("1") == student.right(report.exercises)
        assert set(row[5:]) <= {"0", "1", ""}
    for name in ("gradebook", "statuses", "slips", "words"):
        content = (written / f"{name}.csv").read_bytes()
        assert content.startswith(b"\xef\xbb\xbf")
        for row in table(written / f"{name}.csv"):
            assert not any(cell.startswith(("=", "+", "-", "@", "\t")) for cell in row)


def test_words_are_kept(written):
    rows = table(written / "words.csv")
    assert ["3.6", "Tag Typer"] in [row[:2] for row in rows]
    assert "<img src=x onerror=alert(1)> =1+1" in {row[-1] for row in rows}


class Tags(HTMLParser):
    def __init__(self):
        super().__init__()
        self.tags, self.attributes, self.text = set(), set(), []

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        self.attributes |= {name for name, _ in attrs}

    def handle_data(self, data):
        self.text.append(data)


OURS = {
    "html", "head", "meta", "title", "style", "body", "main", "div", "h1", "h2", "h3", "p", "span",
    "table", "thead", "tbody", "tfoot", "tr", "th", "td", "svg", "rect", "details", "summary",
    "bdi", "i", "dl", "dt", "dd", "ul", "li",
}  # fmt: skip
ATTRIBUTES = {
    "lang", "charset", "http-equiv", "content", "name", "class", "tabindex", "role", "aria-label",
    "aria-hidden", "scope", "width", "height", "rx", "dir",
}  # fmt: skip


def test_no_tag_of_the_page_is_a_students(written, report):
    for markup in ((written / "report.html").read_text("utf-8"), report._repr_html_()):
        tags = Tags()
        tags.feed(markup)
        assert tags.tags <= OURS
        assert tags.attributes <= ATTRIBUTES
        text = "".join(tags.text)
        assert "<script>alert(1)</script> & <b>Eve</b>" in text
        assert "<img src=x onerror=alert(1)> =1+1" in text


def test_a_later_report_takes_the_place_of_an_earlier_one(report, tmp_path):
    folder = tmp_path / "mine"
    report.write(folder)
    (folder / "words.csv").unlink()
    (folder / "gradebook.csv").write_text("old")
    report.write(folder)
    assert len(list(folder.iterdir())) == 5
    assert (folder / "gradebook.csv").read_bytes() != b"old"
    assert list(tmp_path.iterdir()) == [folder]
    (folder / "thesis.txt").write_text("mine")
    with pytest.raises(ValueError, match=r"^folder: .* holds other files than a report \('thesis"):
        report.write(folder)
    assert (folder / "thesis.txt").exists()


@pytest.mark.slow
def test_the_command_writes_beside_the_folder(place):
    command = [sys.executable, "-m", "driftlab.book", "class"]
    done = subprocess.run(
        [*command, str(place), "--roster", str(place.with_name("roster.csv"))],
        capture_output=True, check=False, timeout=60,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert b"Slips, the most frequent first:" in done.stdout
    assert (place.with_name("class-report") / "report.html").exists()


def test_a_students_copy_says_that_it_is_one(monkeypatch):
    for name in [name for name in sys.modules if name.startswith("driftlab.book.instructors")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setattr(driftlab.book, "__path__", [])
    with pytest.raises(ImportError, match=r"^class_report is for who teaches, and this is a stud"):
        driftlab.book.class_report  # noqa: B018


def test_the_command_says_in_a_sentence_what_it_cannot_read(place):
    with pytest.raises(SystemExit, match=r"^folder: expected a folder with what students[^\n]*$"):
        write_class_report(place / "nowhere", None, None)

"""Files come with their students, whatever a platform, or a stranger, calls them."""

import os

import pytest

from driftlab.book import class_report
from driftlab.book.instructors.found_files import Found
from driftlab.book.instructors.handed_in import handed_in
from hand_ins import WRONG, notebook, put, rows, zipped


@pytest.mark.parametrize(
    ("path", "name", "id_", "file"),
    [
        ("Ada L_1234567_assignsubmission_file_/03.ipynb", "Ada L", "1234567", "03.ipynb"),
        ("Ada Lovelace_12_assignsubmission_file/sheet/03.ipynb", "Ada Lovelace", "12", "03.ipynb"),
        ("Ada Lovelace_12_assignsubmission_file_03_x.ipynb", "Ada Lovelace", "12", "03_x.ipynb"),
        ("Participant_77_assignsubmission_file_/a.ipynb", "Participant", "77", "a.ipynb"),
        ("王小明_12_assignsubmission_onlinetext/on.html", "王小明", "12", "on.html"),
        ("lovelaceada_12345_67890_03_x-1.ipynb", "lovelaceada", "12345", "03_x-1.ipynb"),
        ("lovelaceada_LATE_12345_67890_03.ipynb", "lovelaceada", "12345", "03.ipynb"),
        ("anon_x9Ab2_67890_03.ipynb", "Anonymous", "x9Ab2", "03.ipynb"),
        ("all.zip/Ada L_12_assignsubmission_file_/03.ipynb", "Ada L", "12", "03.ipynb"),
        ("canvas.zip/lovelaceada_12345_67890_03.ipynb", "lovelaceada", "12345", "03.ipynb"),
        ("course/submitted/alovelace/ps1/03.ipynb", "alovelace", "", "03.ipynb"),
        ("Ada/report_11_2026_final.ipynb", "Ada", "", "report_11_2026_final.ipynb"),
        ("Ada.zip/deep/er/03.ipynb", "Ada", "", "03.ipynb"),
        ("ada (2).ipynb", "ada", "", "ada (2).ipynb"),
        ("03 (2).ipynb", "03 (2).ipynb", "", "03 (2).ipynb"),
    ],
)  # fmt: skip
def test_names_as_platforms_give_them(path, name, id_, file):
    other = "Other/x.ipynb"
    if path.startswith(("all.zip", "canvas.zip")):  # what a platform packs has several students
        other = path.replace("_12", "_13")
    elif "submitted" in path:
        other = "course/source/x.ipynb"
    files, _ = handed_in([Found(tuple(each.split("/"))) for each in (path, other)])
    if "submitted" not in path:
        assert len(files) == 2
    assert (files[0].person.name, files[0].person.id, files[0].file) == (name, id_, file)


def test_a_group_is_told_from_a_hyphen():
    names = ["Group A-Ada Lovelace", "Group A-Jean-Luc Moreau", "Lab 2-王小明", "Lab 2-山田"]
    names += ["Anne-Marie Curie", "Anne-Lise Meitner"]
    found = [
        Found((f"{name}_{i}_assignsubmission_file_", "x.ipynb")) for i, name in enumerate(names)
    ]
    assert [file.person.name for file in handed_in(found)[0]] == [
        *("Ada Lovelace", "Jean-Luc Moreau", "王小明", "山田"),
        *("Anne-Marie Curie", "Anne-Lise Meitner"),
    ]


def test_one_archive_stands_for_a_folder(tmp_path):
    path = tmp_path / "class.zip"
    inside = {"Ada/03.ipynb": notebook(), "Bob/": b"", "Bob/x/03.ipynb": notebook(WRONG)}
    path.write_bytes(zipped({f"all/{name}": content for name, content in inside.items()}))
    found = rows(path)
    assert {name: each.status("3.1") for name, each in found.items()} == {
        "Ada": "right",
        "Bob": "wrong",
    }


def test_nbgrader_is_read_where_students_hand_in_and_by_its_timestamps(tmp_path):
    put(tmp_path, {
        "source/ps1/03.ipynb": notebook(),
        "submitted/ada/ps1/03.ipynb": notebook(),
        "submitted/ada/ps1/timestamp.txt": b"2026-01-30 15:30:10.5 UTC\n",
        "submitted/ada/ps1again/03.ipynb": notebook(WRONG),
        "submitted/ada/ps1again/timestamp.txt": b"2025-01-30 15:30:10 Europe/London",
    })  # fmt: skip
    os.utime(tmp_path / "submitted/ada/ps1/03.ipynb", (0, 0))
    report = class_report(tmp_path)
    assert [(each.name, each.status("3.1")) for each in report.students] == [("ada", "right")]
    assert report.notes == ['Only the folder "submitted" is read; 1 files lie elsewhere.']


def test_without_a_timestamp_the_later_file_counts(tmp_path):
    put(tmp_path, {"Ada/a.ipynb": notebook(WRONG), "Ada/b.ipynb": notebook()})
    os.utime(tmp_path / "Ada/a.ipynb", (2e9, 2e9))
    ada = rows(tmp_path)["Ada"]
    assert (ada.status("3.1"), ada.notes) == ("wrong", ["a.ipynb came after b.ipynb, and counts."])


def test_canvas_counts_the_later_upload(tmp_path):
    put(tmp_path, {
        "lovelaceada_12345_999_03.ipynb": notebook(WRONG),
        "lovelaceada_12345_1001_03.ipynb": notebook(),
        "babbagecharles_12_777_03-2.ipynb": notebook(WRONG),
        "babbagecharles_12_778_03-1.ipynb": notebook(),
    })  # fmt: skip
    found = rows(tmp_path)
    assert {name: each.status("3.1") for name, each in found.items()} == {
        "lovelaceada": "right",
        "babbagecharles": "wrong",
    }


def test_an_export_belongs_to_the_name_in_its_title(tmp_path):
    title = "# Answers of Zoë van \\'t Hoff\n\nExported."
    put(tmp_path, {
        "drift-lab-answers-zoe-van-t-hoff.ipynb": notebook(title=title),
        "drift-lab-answers.ipynb": notebook(title="# My answers"),
        "drift-lab-answers (1).ipynb": notebook(WRONG, title="# My answers"),
    })  # fmt: skip
    assert set(rows(tmp_path)) == {
        "Zoë van 't Hoff", "drift-lab-answers.ipynb", "drift-lab-answers (1).ipynb",
    }  # fmt: skip


def test_a_folder_called_submitted_is_a_students_own_unless_it_holds_the_class(tmp_path):
    inside = {"submitted/hw/hw.ipynb": notebook(WRONG)}
    put(tmp_path, {
        **{f"Ada L{i}_{i}_assignsubmission_file_/03.ipynb": notebook() for i in range(4)},
        "Eve X_9_assignsubmission_file_/hw.zip": zipped(inside),
    })  # fmt: skip
    assert set(rows(tmp_path)) == {"Ada L0", "Ada L1", "Ada L2", "Ada L3", "Eve X"}
    put(tmp_path / "plain", {
        "Ada/03.ipynb": notebook(), "Eve/submitted/hw/hw.ipynb": notebook(),
    })  # fmt: skip
    assert set(rows(tmp_path / "plain")) == {"Ada", "Eve"}


def test_names_that_differ_in_an_accent_a_point_or_a_vowel_are_several_students(tmp_path):
    names = ["राम", "रमा", "Jan Müller", "Jan Muller", "jo.hann", "johann", "1-1", "11"]
    put(tmp_path, {f"{name}/03.ipynb": notebook() for name in names})
    assert set(rows(tmp_path)) == set(names)


def test_who_handed_in_nothing_but_a_moment_has_a_row(tmp_path):
    put(tmp_path, {
        "submitted/ann/ps1/hw.ipynb": notebook(),
        "submitted/bob/ps1/timestamp.txt": b"2026-01-30 15:30:10 UTC",
    })  # fmt: skip
    found = rows(tmp_path)
    assert set(found) == {"ann", "bob"}
    assert found["bob"].notes == ["Nothing was handed in."]


def test_nobody_takes_the_row_of_another(tmp_path):
    put(tmp_path, {
        "bob.ipynb": notebook(WRONG),
        "eve.ipynb": notebook(title="# Answers of bob"),
        "mallory.zip": zipped({"Bob Smith_12_assignsubmission_file_/x.ipynb": notebook()}),
    })  # fmt: skip
    found = rows(tmp_path)
    assert set(found) == {"bob", "eve", "mallory"}
    assert found["bob"].status("3.1") == "wrong"


def test_the_later_file_counts_whatever_number_stands_behind_its_name(tmp_path):
    put(tmp_path, {"Ada/03.ipynb": notebook(), "Ada/03 (2).ipynb": notebook(WRONG)})
    os.utime(tmp_path / "Ada/03 (2).ipynb", (0, 0))
    assert rows(tmp_path)["Ada"].status("3.1") == "right"


@pytest.mark.parametrize("name", ["...", "?", "-", "your name", "<Your Name>", "Name"])
def test_a_placeholder_is_no_name(tmp_path, name):
    files = ["drift-lab-answers-name.ipynb", "drift-lab-answers (1).ipynb"]
    put(tmp_path, {file: notebook(title=f"# Answers of {name}") for file in files})
    assert set(rows(tmp_path)) == set(files)


def test_one_student_alone_with_a_folder_for_each_chapter_is_one(tmp_path):
    put(tmp_path, {
        "Ada/chapter 01/a.ipynb": notebook("Exercise 1.1: right."),
        "Ada/chapter 03/a.ipynb": notebook(),
    })  # fmt: skip
    report = class_report(tmp_path)
    assert [each.name for each in report.students] == ["Ada"]
    assert report.notes == [
        'All lies in the folder "Ada", which is taken for one student\'s. '
        "With a list of the class there is no doubt."
    ]
    # Students may be numbered, too: who hands in the same exercise is another.
    put(tmp_path, {"Ada/chapter 01/b.ipynb": notebook()})
    assert {each.name for each in class_report(tmp_path).students} == {"chapter 01", "chapter 03"}


@pytest.mark.parametrize(
    ("listed", "names"), [("Ada", ["Ada"]), ("draft\nfinal", ["draft", "final"])]
)
def test_a_list_decides_whether_a_folder_around_all_is_a_students(tmp_path, listed, names):
    put(tmp_path, {
        "roster.csv": listed.encode(),
        "class/Ada/draft/a.ipynb": notebook(WRONG),
        "class/Ada/final/a.ipynb": notebook(),
    })  # fmt: skip
    report = class_report(tmp_path / "class", roster=tmp_path / "roster.csv")
    assert [each.name for each in report.students] == names
    assert report.notes == []
    (unclear,) = class_report(tmp_path / "class").notes
    assert "taken for that of a class of 2" in unclear

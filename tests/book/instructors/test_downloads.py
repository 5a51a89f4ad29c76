"""Students' folders and downloads of platforms are told apart, and nobody is in another's name."""

import os

from driftlab.book import class_report
from driftlab.book.instructors.wrapping import stem_of
from hand_ins import WRONG, notebook, put, rows, zipped

ADA = "Ada Lovelace"


def test_a_name_within_a_students_folder_takes_nobodys_row(tmp_path):
    put(tmp_path, {
        f"{ADA}/03.ipynb": notebook(), "Bob/03.ipynb": notebook(),
        f"Mallory/{ADA}_1_assignsubmission_file_x.ipynb": notebook(WRONG),
        f"Nina/{ADA}_1_assignsubmission_file_/x.ipynb": notebook(WRONG),
        f"Nina/{ADA}_2_assignsubmission_file_/x.ipynb": notebook(WRONG),
        f"Oscar/a.zip/{ADA}_1_assignsubmission_file_x.ipynb": notebook(WRONG),
    })  # fmt: skip
    found = rows(tmp_path)
    right = {name for name, each in found.items() if each.status("3.1") == "right"}
    assert set(found) == {ADA, "Bob", "Mallory", "Nina", "Oscar"}
    assert right == {ADA, "Bob"}


def test_an_archive_in_others_names_is_its_owners_among_archives_and_told_among_folders(tmp_path):
    names = [f"{ADA}_1_assignsubmission_file_x.ipynb", "Bob_2_assignsubmission_file_x.ipynb"]
    hers = zipped({name: notebook(WRONG) for name in names})
    put(tmp_path / "zips", {"Ada.zip": zipped({"x.ipynb": notebook()}), "Mallory.zip": hers})
    assert set(rows(tmp_path / "zips")) == {"Ada", "Mallory"}
    put(tmp_path / "folders", {f"{ADA}/x.ipynb": notebook(), "Mallory.zip": hers})
    report = class_report(tmp_path / "folders")
    assert [(s.name, s.id, s.status("3.1")) for s in report.students] == [
        (ADA, "", "right"), (ADA, "1", "wrong"), ("Bob", "2", "wrong"),
    ]  # fmt: skip
    assert report.notes == [
        '"Mallory.zip" lies beside folders of students, and was taken for a platform\'s download '
        "of several."
    ]


def test_a_title_is_believed_less_than_a_folder(tmp_path):
    title = f"# Answers of {ADA}"
    put(tmp_path, {
        f"{ADA}/03.ipynb": notebook(),
        "Mallory/x.ipynb": notebook(WRONG + "\n", title=title),
        "drift-lab-answers-eve.ipynb": notebook(WRONG, title=title),
        "drift-lab-answers-ada-lovelace-2.ipynb": notebook(WRONG, title=f"{title}\n"),
        "drift-lab-answers.ipynb": notebook("Exercise 3.2: right.", title=title),
    })  # fmt: skip
    for file in tmp_path.glob("*.ipynb"):
        os.utime(file, (2e9, 2e9))
    found = rows(tmp_path)
    assert set(found) == {ADA, "Mallory", "eve"}
    assert [found[ADA].status(number) for number in ("3.1", "3.2")] == ["right", "right"]
    assert found[ADA].notes == [
        "03.ipynb counts, and not drift-lab-answers-ada-lovelace-2.ipynb, which only names the "
        "student."
    ]
    said = f"x.ipynb is an export with the answers of {ADA}, as its title says."
    assert found["Mallory"].notes == [said]
    assert f"drift-lab-answers-eve.ipynb: The title inside says {ADA}." in found["eve"].notes


def test_folders_that_differ_in_anything_are_several_students(tmp_path):
    names = ["ada", "ADA", "L" * 200, "L" * 200 + "M", "\u202e", "\u200f", "Jose\u0301", "José"]
    inside = {f"{name}/{i}.ipynb": notebook() for i, name in enumerate(names)}
    (tmp_path / "class.zip").write_bytes(zipped(inside))  # a disk may not tell capitals apart
    report = class_report(tmp_path / "class.zip")
    assert len(report.students) == len(names)
    assert sum(each.name == "?" for each in report.students) == 2


def test_moodle_canvas_and_nbgrader_may_lie_side_by_side(tmp_path):
    put(tmp_path, {
        "Ada L_12_assignsubmission_file_/a.ipynb": notebook(),
        "babbagecharles_12_777_a.ipynb": notebook(),
        "submitted/cy/ps1/a.ipynb": notebook(), "gradebook.db": b"",
        "moodle/Eve L_14_assignsubmission_file_/a.ipynb": notebook(),
        "moodle/Fay L_15_assignsubmission_file_/a.pdf": b"",
        "canvas.zip": zipped({"ghaliamina_16_1234_a.ipynb": b"", "hopper_17_1235_a.ipynb": b""}),
    })  # fmt: skip
    names = {"Ada L", "babbagecharles", "cy", "Eve L", "Fay L", "ghaliamina", "hopper"}
    assert set(rows(tmp_path)) == names


def test_a_folder_called_submitted_hides_nobody(tmp_path):
    put(tmp_path, {f"{name}/a.ipynb": notebook() for name in ("Ann", "Bob", "submitted/x")})
    assert set(rows(tmp_path)) == {"Ann", "Bob", "x"}


def test_an_earlier_report_in_the_folder_is_no_student(tmp_path):
    put(tmp_path, {"Ann/a.ipynb": notebook(), "Bob/a.ipynb": notebook(WRONG)})
    report = class_report(tmp_path)
    report.write(tmp_path / "report")
    again = class_report(tmp_path)
    assert [each.name for each in again.students] == ["Ann", "Bob"]
    assert again.notes == ['The folder "report" is an earlier report.']


def test_endings_are_taken_off_one_by_one():
    assert stem_of("ada.ipynb.ZIP.txt") == "ada"
    assert stem_of(".zip" * 20_000 + "x") == ".zip" * 20_000 + "x"
    assert stem_of("ada.zipper") == "ada.zipper"

"""Files and archives come with their students, whatever a platform, or a stranger, calls them."""

import io
import json
import os
import zipfile

import pytest

from driftlab.book import class_report
from driftlab.book.instructors import found_files
from driftlab.book.instructors.found_files import Found
from driftlab.book.instructors.handed_in import handed_in

RIGHT, WRONG = "Exercise 3.1: right.", "Exercise 3.1: not yet. Close."


def notebook(said=RIGHT, title=""):
    cells = [
        {"cell_type": "markdown", "source": title},
        {"cell_type": "code", "source": "", "outputs": [{"text": said}]},
    ]
    return json.dumps({"cells": cells}).encode()


def zipped(files, **options):
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED, **options) as opened:
        for name, content in files.items():
            opened.writestr(name, content)
    return archive.getvalue()


def put(folder, files):
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def rows(folder, **options):
    report = class_report(folder, **options)
    return {student.name: student for student in report.students}


@pytest.mark.parametrize(
    ("path", "name", "id_", "file"),
    [
        ("Ada L_1234567_assignsubmission_file_/03.ipynb", "Ada L", "1234567", "03.ipynb"),
        ("Ada Lovelace_12_assignsubmission_file/work/03.ipynb", "Ada Lovelace", "12", "03.ipynb"),
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


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"PK\3\4 nothing", "archive is damaged"),
        (zipped({"03.ipynb": notebook()})[:-30], "archive is damaged"),
        (zipped({}), "archive is empty"),
        (zipped({"/etc/03.ipynb": b""}), "leads out of it"),
        (zipped({"../../03.ipynb": b""}), "leads out of it"),
        (zipped({"C:\\03.ipynb": b""}), "leads out of it"),
        (zipped({"03.ipynb": b" " * (found_files.LARGEST + 1)}), "more than 64 MB"),
    ],
    ids=["torn", "cut", "empty", "absolute", "upward", "drive", "bomb"],
)  # fmt: skip
def test_archives_that_harm_get_a_sentence_and_a_row(tmp_path, content, sentence):
    put(tmp_path, {"Ada/work.zip": content, "Bob/03.ipynb": notebook()})
    found = rows(tmp_path)
    assert sentence in found["Ada"].notes[0]
    assert found["Bob"].status("3.1") == "right"
    there = {path.name for path in tmp_path.rglob("*")}
    assert there == {"03.ipynb", "Ada", "Bob", "work.zip"}


def test_archives_in_archives_are_bounded(tmp_path, monkeypatch):
    inner = zipped({"03.ipynb": notebook()})
    for _ in range(2):
        inner = zipped({"in.zip": inner})
    put(tmp_path, {"Ada/a.zip": inner, "Bob/b.zip": zipped({"in.zip": inner})})
    monkeypatch.setattr(found_files, "MOST_FILES", 3)
    many = zipped({f"{i}.ipynb": notebook() for i in range(5)})
    put(tmp_path, {"Eve/many.zip": many})
    found = rows(tmp_path)
    assert found["Ada"].status("3.1") == "right"
    assert found["Bob"].notes == ["in.zip: Too many archives lie in each other."]
    assert "more than is unpacked" in " ".join(found["Eve"].notes)


def test_an_archive_with_a_password_is_told(tmp_path):
    content = bytearray(zipped({"03.ipynb": notebook()}))
    content[6] |= 1  # in the head of the file
    content[content.index(b"PK\1\2") + 8] |= 1  # and in the list
    put(tmp_path, {"Ada/work.zip": bytes(content)})
    assert rows(tmp_path)["Ada"].notes == ["03.ipynb: The archive asks for a password."]


def test_links_are_not_followed(tmp_path):
    put(tmp_path, {"out/03.ipynb": notebook(), "class/Bob/03.ipynb": notebook()})
    (tmp_path / "class" / "Ada").mkdir()
    try:
        (tmp_path / "class" / "Ada" / "03.ipynb").symlink_to(tmp_path / "out" / "03.ipynb")
        (tmp_path / "class" / "Eve").symlink_to(tmp_path / "out")
    except OSError:
        pytest.skip("no links here")
    link = zipfile.ZipInfo("03.ipynb")
    link.external_attr = 0o120777 << 16
    put(tmp_path / "class", {"Zoe/a.zip": zipped({link: b"/etc/passwd"})})
    found = rows(tmp_path / "class")
    assert found.keys() == {"Ada", "Bob", "Eve", "Zoe"}
    for name in ("Ada", "Eve", "Zoe"):
        assert found[name].status("3.1") == "absent"
        assert found[name].notes[0].endswith("a link to another place, which is not followed.")


@pytest.mark.parametrize(
    "content",
    [
        "name;id\nAda Lovelace;1\nZoë Müller;2\n".encode("latin-1"),
        "\ufeffAda Lovelace,1\r\nZoë Müller,2\r\n".encode(),
        '"Lovelace, Ada"\n"Müller, Zoë"\n'.encode(),
        "First name\tSurname\tID number\nAda\tLovelace\t1\nZoë\tMüller\t2".encode("utf-16"),
        'Student,ID\n  Points Possible,\n"Lovelace, Ada",1\n"Müller, Zoë",2\n'.encode(),
    ],
    ids=["semicolons", "mark", "turned", "moodle", "canvas"],
)  # fmt: skip
def test_rosters_as_they_come(tmp_path, content):
    put(tmp_path, {
        "roster.csv": content,
        "class/lovelaceada_99_1234_03.ipynb": notebook(),
        "class/Stranger_98_assignsubmission_file_/03.ipynb": notebook(),
    })  # fmt: skip
    report = class_report(tmp_path / "class", roster=tmp_path / "roster.csv")
    ada, zoe, stranger = report.students
    assert (set(ada.name.replace(",", "").split()), ada.status("3.1")) == (
        {"Ada", "Lovelace"},
        "right",
    )
    assert (zoe.status("3.1"), zoe.is_listed) == ("absent", True)
    assert zoe.notes == ["Nothing was handed in under this name."]
    assert (stranger.name, stranger.is_listed) == ("Stranger", False)


def test_two_of_one_name_are_told_apart_by_numbers(tmp_path):
    put(tmp_path, {
        "roster.csv": b"name,id\nAda King,12345\nAda King,54321\n",
        "class/kingada_54321_9999_03.ipynb": notebook(),
    })  # fmt: skip
    first, second = class_report(tmp_path / "class", roster=tmp_path / "roster.csv").students
    assert (first.status("3.1"), second.status("3.1")) == ("absent", "right")


def test_numbers_that_were_asked_in_another_name_are_told(tmp_path):
    record = {"exercise": "4.6", "word": "right", "student": "bob  BABBAGE", "attempt": 1}
    output = {"data": {"application/vnd.driftlab.exercise+json": record}}
    content = json.dumps({"cells": [{"cell_type": "code", "outputs": [output]}]}).encode()
    put(tmp_path, {"Ada Lovelace/04.ipynb": content, "Bob Babbage/04.ipynb": content})
    found = rows(tmp_path)
    assert found["Bob Babbage"].notes == []
    assert found["Ada Lovelace"].notes == ["The numbers of 4.6 were asked in the name bob BABBAGE."]


def test_a_teachers_exercise_is_a_column_and_a_students_joke_is_none(tmp_path):
    own = "Exercise 90.2: right.\nExercise 90.10: right."
    jokes = "\n".join(f"Exercise {i}.77: right." for i in range(100, 400))
    bobs = notebook(f"{own}\n{RIGHT}\n{jokes}")
    put(tmp_path, {"Ada/x.ipynb": notebook(own), "Bob/x.ipynb": bobs})
    report = class_report(tmp_path)
    assert report.exercises == ["3.1", "3.2", "3.3", "3.4", "3.5", "3.6", "90.2", "90.10"]
    assert report.notes[0].startswith("Not in the book, and in one notebook only")


@pytest.mark.parametrize("name", ["nowhere", "text.txt"])
def test_what_is_neither_folder_nor_archive_is_refused(tmp_path, name):
    put(tmp_path, {"text.txt": b"text"})
    with pytest.raises(ValueError, match=r"^folder: expected a folder with what students"):
        class_report(tmp_path / name)


def test_an_empty_folder_and_a_list_without_names(tmp_path):
    assert class_report(tmp_path).notes == ["Nothing was handed in."]
    put(tmp_path, {"r.csv": b"name,id\n"})
    with pytest.raises(ValueError, match=r"^roster: nobody is on the list"):
        class_report(tmp_path, roster=tmp_path / "r.csv")
    with pytest.raises(ValueError, match=r"^roster: .* cannot be read"):
        class_report(tmp_path, roster=tmp_path / "no.csv")


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


def test_an_exercise_between_two_has_its_column(tmp_path):
    said = {"Ada": "right.", "Bob": "not yet. Close."}
    put(tmp_path, {f"{n}/a.ipynb": notebook(f"Exercise 3.3a: {w}") for n, w in said.items()})
    report = class_report(tmp_path)
    assert report.exercises == ["3.3a"]
    assert [each.status("3.3a") for each in report.students] == ["right", "wrong"]


def test_a_year_behind_the_name_is_no_other_name(tmp_path):
    from driftlab.book.machinery.records import MIME

    record = {"exercise": "3.4", "right": True, "word": "right", "says": "", "attempt": 1}
    for student, notes in (
        ("Ada Lovelace 2027", []),
        ("Bob", ["The numbers of 3.4 were asked in the name Bob."]),
    ):
        output = {"output_type": "display_data", "data": {MIME: {**record, "student": student}}}
        cell = {"cell_type": "code", "source": "", "outputs": [output]}
        put(tmp_path, {"Ada Lovelace/03.ipynb": json.dumps({"cells": [cell]}).encode()})
        assert rows(tmp_path)["Ada Lovelace"].notes == notes

"""The list of a class is read as platforms and spreadsheets write it."""

import unicodedata

import pytest

from driftlab.book import class_report
from driftlab.book.instructors.found_files import Found
from driftlab.book.instructors.handed_in import handed_in
from driftlab.book.instructors.own_numbers import compare_numbers
from driftlab.book.instructors.roster import Listed, read_roster
from driftlab.book.instructors.same_work import compare_work
from driftlab.book.instructors.students import in_order, students_of
from hand_ins import notebook, put


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


def test_an_empty_folder_and_a_list_without_names(tmp_path):
    assert class_report(tmp_path).notes == ["Nothing was handed in."]
    put(tmp_path, {"r.csv": b"name,id\n"})
    with pytest.raises(ValueError, match=r"^roster: nobody is on the list"):
        class_report(tmp_path, roster=tmp_path / "r.csv")
    with pytest.raises(ValueError, match=r"^roster: .* cannot be read"):
        class_report(tmp_path, roster=tmp_path / "no.csv")


HEADINGS = [
    "\r\n \r\nname;id number\r\nAda Lovelace;12345\r\n",
    "sep=;\r\nLast name;First name;ID number\r\nLovelace;Ada;12345\r\n",
    '"sep=,"\nname,id\nAda Lovelace,12345\n',
    "Nachname;Vorname;E-Mail-Adresse;Matrikelnummer\nLovelace;Ada;ada@uni.example;12345\n",
    "Name;Vorname;Matrikelnummer\nLovelace;Ada;12345\n",
    "Prénom,Nom,Adresse de courriel,Numéro d’identification\nAda,Lovelace,a@u.example,12345\n",
    "Фамилия;Имя;Номер\nLovelace;Ada;12345\n",
    "Last name, First name;Email address, private;ID\nLovelace, Ada;a, b;12345\n",
    "Name, Vorname;Matrikelnummer\nLovelace, Ada;12345\n",
    "Lovelace, Ada;12345\nMoreau, Jean-Luc;54321\n",
]


@pytest.mark.parametrize("text", HEADINGS, ids=range(len(HEADINGS)))
def test_headings_and_delimiters_as_platforms_and_spreadsheets_write_them(tmp_path, text):
    (tmp_path / "roster.csv").write_bytes(text.encode())
    ada = read_roster(tmp_path / "roster.csv")[0]
    assert ada.has("12345")
    assert ada.is_named("Ada Lovelace")


def test_one_who_stands_twice_on_the_list_has_one_row(tmp_path):
    put(tmp_path, {
        "roster.csv": b"name,id\nAda King,1\nBob,2\nADA KING,1\n",
        "class/Ada King/03.ipynb": notebook(),
    })  # fmt: skip
    report = class_report(tmp_path / "class", roster=tmp_path / "roster.csv")
    assert [(each.name, each.status("3.1")) for each in report.students] == [
        ("Ada King", "right"),
        ("Bob", "absent"),
    ]
    assert report.notes == ["Ada King stands on the list more than once, and has one row."]


def test_time_grows_with_the_class_and_not_with_its_square(monkeypatch):
    """Counted is how often a name is looked at letter by letter."""
    looked = []
    normalize = unicodedata.normalize
    monkeypatch.setattr(unicodedata, "normalize", lambda *of: looked.append(1) or normalize(*of))
    counts = []
    for size in (100, 200):
        names = [f"Ada{i} Lovelace{i}" for i in range(size)]
        found = [Found(("class", name, "a.ipynb")) for name in names]
        listed = [Listed(name) for name in names]
        looked.clear()
        files, _ = handed_in(found, listed)
        students = in_order(students_of(files), listed)
        compare_numbers(students, listed)
        compare_work(students)
        assert [each.name for each in students] == names
        counts.append(len(looked))
    assert counts[1] < 2.5 * counts[0]

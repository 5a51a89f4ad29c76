"""Archives, links and folders of strangers are read within bounds, and nobody is lost."""

import json
import os
import struct
import tracemalloc
import zipfile

import pytest

from driftlab.book import class_report
from driftlab.book.instructors import budget
from driftlab.book.instructors.folders import MOST_OTHERS, files_in
from driftlab.book.instructors.saved_answers import LARGEST
from hand_ins import WRONG, notebook, put, rows, zipped


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"PK\3\4 nothing", "archive is damaged"),
        (zipped({"03.ipynb": notebook()})[:-30], "archive is damaged"),
        (zipped({}), "archive is empty"),
        (zipped({"/etc/03.ipynb": b""}), "leads out of it"),
        (zipped({"../../03.ipynb": b""}), "leads out of it"),
        (zipped({"C:\\03.ipynb": b""}), "leads out of it"),
        (zipped({"03.ipynb": b" " * (LARGEST + 1)}), "more than 16 MB"),
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
    monkeypatch.setattr(budget, "MOST_FILES_OF_ONE", 3)
    many = zipped({f"{i}.ipynb": notebook() for i in range(5)})
    put(tmp_path, {"Eve/many.zip": many})
    found = rows(tmp_path)
    assert found["Ada"].status("3.1") == "right"
    assert found["Bob"].notes == ["in.zip: Too many archives lie in each other."]
    bound = "no more than 1024 MB in 3 files are unpacked of an archive"
    assert bound in " ".join(found["Eve"].notes)


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


@pytest.mark.parametrize("name", ["nowhere", "text.txt"])
def test_what_is_neither_folder_nor_archive_is_refused(tmp_path, name):
    put(tmp_path, {"text.txt": b"text"})
    with pytest.raises(ValueError, match=r"^folder: expected a folder with what students"):
        class_report(tmp_path / name)


def test_all_that_is_read_in_a_run_has_one_bound(tmp_path, monkeypatch):
    content = notebook()
    archive = zipped({"03.ipynb": content})
    put(tmp_path, {"Ada/03.ipynb": content, "Bob/a.zip": archive, "Eve/03.ipynb": content})
    put(tmp_path, {"Zoe/a.zip": archive, "Zoe/paper.pdf": b"x" * 2 * len(content)})
    monkeypatch.setattr(budget, "MOST_BYTES", 2 * len(content))
    found = rows(tmp_path)
    assert [each.status("3.1") for each in found.values()] == [*2 * ["right"], *2 * ["absent"]]
    for name in ("Eve", "Zoe"):
        assert found[name].notes[0].startswith("03.ipynb: It was not read, since no more than")
        assert "are read in one run" in found[name].notes[0]


def test_contents_are_not_kept(tmp_path):
    size = 2**20
    filled = json.loads(notebook())
    filled["metadata"] = {"picture": "x" * size}
    put(tmp_path, {f"{i}/03.ipynb": json.dumps(filled).encode() for i in range(30)})
    tracemalloc.start()
    try:
        assert len(rows(tmp_path)) == 30
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert most < 15 * size


def crowded(count, told=1):
    """An archive that is nothing but a list of files which it does not hold, nor tells of."""
    entry = struct.pack("<4s4B4HL2L5H2L", b"PK\1\2", 20, 0, 20, *[0] * 8, 1, *[0] * 6) + b"a"
    start, listed = b"PK\3\4", entry * count
    wide = struct.pack("<4sQ2H2L4Q", b"PK\6\6", 44, 45, 45, 0, 0, told, told, len(listed), 4)
    where = struct.pack("<4sLQL", b"PK\6\7", 0, 4 + len(listed), 1)
    end = struct.pack("<4s4H2LH", b"PK\5\6", 0, 0, 2**16 - 1, 2**16 - 1, *[2**32 - 1] * 2, 0)
    return start + listed + wide + where + end


@pytest.mark.parametrize("wrap", [lambda bomb: bomb, lambda bomb: zipped({"in.zip": bomb})])
def test_a_list_that_is_too_long_is_not_read(tmp_path, monkeypatch, wrap):
    read = []

    class Entry(zipfile.ZipInfo):
        def __init__(self, *arguments):
            read.append(arguments)
            super().__init__(*arguments)

    put(tmp_path, {"Ada/work.zip": wrap(crowded(100_000)), "Bob/03.ipynb": notebook()})
    monkeypatch.setattr(zipfile, "ZipInfo", Entry)
    found = rows(tmp_path)
    assert "The archive has too many entries to be read." in found["Ada"].notes[0]
    assert found["Bob"].status("3.1") == "right"
    assert len(read) <= 1


def test_lists_of_many_archives_in_one_are_bounded_together(tmp_path, monkeypatch):
    inner = crowded(20)
    monkeypatch.setattr(budget, "MOST_LISTED_OF_ONE", 5000)
    put(tmp_path, {"Ada/a.zip": zipped({f"{i}.zip": inner for i in range(9)})})
    notes = " ".join(rows(tmp_path)["Ada"].notes)
    assert 4 <= notes.count("The archive has too many entries to be read.") < 9


@pytest.mark.parametrize(
    "content",
    [zipped({}), b"PK\3\4 nothing", crowded(100_000)],
    ids=["empty", "broken", "crowded"],  # or pytest would write out five megabytes as a name
)
def test_one_archive_that_cannot_be_read_is_told_in_a_sentence(tmp_path, content):
    put(tmp_path, {"class.zip": content})
    with pytest.raises(
        ValueError, match=r"^folder: .*class.zip' is not read\. The archive [^\n]*$"
    ):
        class_report(tmp_path / "class.zip")


def test_a_link_to_itself_hides_nobody(tmp_path):
    put(tmp_path, {"Bob/03.ipynb": notebook()})
    try:
        (tmp_path / "loop").symlink_to(tmp_path / "loop")
    except OSError:
        pytest.skip("no links here")
    assert rows(tmp_path)["Bob"].status("3.1") == "right"


def test_of_what_is_not_read_only_some_is_kept(tmp_path):
    put(tmp_path, {"Ada/a.zip": zipped({f"n/{i}.txt": b"" for i in range(1000)})})
    found = list(files_in(tmp_path))
    assert len(found) == MOST_OTHERS
    said = "Not read, since no notebook: 0.txt, 1.txt, 10.txt and others."
    assert rows(tmp_path)["Ada"].notes == [said]


def test_a_name_that_begins_with_a_dot_hides_nobody(tmp_path):
    put(tmp_path, {
        ".Ada/03.ipynb": notebook(), ".dan.ipynb": notebook(),
        "Bob/.ipynb": notebook(), "Cy/.03.ipynb": notebook(),
        "Eve/a.zip": zipped({".work/.03.ipynb": notebook(), ".gitignore": b""}),
        "Ida/.ipynb_checkpoints/03.ipynb": notebook(WRONG), "Ida/.DS_Store": b"",
        ".DS_Store": b"", "._dan.ipynb": b"", ".gitignore": b"", "__MACOSX/._Ada/x": b"",
    })  # fmt: skip
    found = rows(tmp_path)
    assert set(found) == {".Ada", ".dan", "Bob", "Cy", "Eve", "Ida"}
    assert {name for name, each in found.items() if each.status("3.1") == "right"} == set(found) - {
        "Ida"
    }
    assert found["Ida"].notes == ["Nothing was handed in."]


def test_a_pipe_is_refused_and_not_waited_for(tmp_path):
    if not hasattr(os, "mkfifo"):
        pytest.skip("no pipes here")
    os.mkfifo(tmp_path / "pipe")
    put(tmp_path, {"class/Ada/03.ipynb": notebook()})
    with pytest.raises(ValueError, match=r"^folder: expected a folder"):
        class_report(tmp_path / "pipe")
    with pytest.raises(ValueError, match=r"^roster: .*pipe' is not a file\.$"):
        class_report(tmp_path / "class", roster=tmp_path / "pipe")


@pytest.mark.parametrize("roster", [False, True])
def test_a_name_too_long_for_a_disk_is_told_in_a_sentence(tmp_path, roster):
    where = tmp_path / ("x" * 5000)
    with pytest.raises(ValueError, match=r"^(folder|roster): [^\n]*\.$"):
        class_report(*(tmp_path, where) if roster else (where,))

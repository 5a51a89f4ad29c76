"""The reader's own copies of the notebooks: they follow the book until somebody works in them."""

import contextlib
import errno
import json
import os
import re
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest
from tiny_project import ROOT, load

MODULES = load(ROOT)
CHAPTER = "03_drift.ipynb"
TODAY = r"\.\d{4}-\d{2}-\d{2}"


def notebook(*sources: str, output: str = "") -> str:
    """A notebook as a file has it; the first cell has the output."""
    cells = [
        {"cell_type": "code", "source": [source], "outputs": [], "metadata": {}}
        for source in sources
    ]
    if output:
        cells[0]["outputs"] = [{"output_type": "stream", "name": "stdout", "text": [output]}]
    return json.dumps({"cells": cells, "metadata": {"kernelspec": {"name": "python3"}}})


@pytest.fixture
def copies(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The module of a tiny project whose book has three notebooks, all of them copied."""
    folder = tmp_path / "Übung 3"
    (folder / "notebooks/solutions").mkdir(parents=True)
    for name in ("00_start_here.ipynb", CHAPTER, f"solutions/{CHAPTER}"):
        (folder / "notebooks" / name).write_text(notebook("2 + 2"), "utf-8")
    monkeypatch.setattr(MODULES.environment, "LOCK", folder / ".setup.lock")
    places = {"HOME": folder, "BOOK": folder / "notebooks", "COPIES": folder / "my-book"}
    for name, place in places.items():
        monkeypatch.setattr(MODULES.copies, name, place)
    assert MODULES.copies.bring_copies() == folder / "my-book"
    return MODULES.copies


def change_the_book(copies: ModuleType, *sources: str) -> None:
    (copies.BOOK / CHAPTER).write_text(notebook(*sources), "utf-8")


def touch(copies: ModuleType, source: str = "my answer", output: str = "") -> str:
    """Change a copy as JupyterLab saves it; return its text."""
    mine = json.loads((copies.COPIES / CHAPTER).read_text("utf-8"))
    mine["cells"] = json.loads(notebook(source, output=output))["cells"]
    text = json.dumps(mine)
    (copies.COPIES / CHAPTER).write_text(text, "utf-8")
    return text


def sources(path: Path) -> list[str]:
    return ["".join(cell["source"]) for cell in json.loads(path.read_text("utf-8"))["cells"]]


def put_aside(copies: ModuleType) -> list[str]:
    """Texts of what was put aside, the oldest first."""
    names = sorted(path.name for path in copies.COPIES.glob("03_drift.*"))
    dated = [name for name in names if re.fullmatch(rf"03_drift{TODAY}(-\d)?\.ipynb", name)]
    dated.sort(key=len)
    return [(copies.COPIES / name).read_text("utf-8") for name in dated]


def test_copies_are_made_of_all_notebooks_and_a_second_start_writes_nothing(
    copies: ModuleType, capsys: pytest.CaptureFixture[str]
) -> None:
    names = ["00_start_here.ipynb", CHAPTER, f"solutions/{CHAPTER}"]
    assert all((copies.COPIES / name).is_file() for name in names)
    before = [(copies.COPIES / name).stat().st_mtime_ns for name in names]
    (copies.HOME / ".setup.lock").unlink()
    capsys.readouterr()
    copies.bring_copies()
    assert capsys.readouterr().out == ""
    assert before == [(copies.COPIES / name).stat().st_mtime_ns for name in names]
    assert not (copies.HOME / ".setup.lock").exists()


def test_a_copy_says_what_the_kernel_says_of_its_language(copies: ModuleType) -> None:
    """Or JupyterLab would complete it, and ask at the end whether to save that."""
    metadata = json.loads((copies.COPIES / CHAPTER).read_text("utf-8"))["metadata"]
    from ipykernel.ipkernel import IPythonKernel

    assert metadata["language_info"] == IPythonKernel.language_info
    assert metadata["kernelspec"] == {"name": "python3"}


@pytest.mark.parametrize("saved", [False, True])
def test_a_copy_that_nobody_touched_follows_the_book(copies: ModuleType, saved: bool) -> None:
    """Also one that was run, cleared and saved; and one that is missing comes back."""
    if saved:
        touch(copies, "2 + 2")
    change_the_book(copies, "2 + 3")
    (copies.COPIES / "00_start_here.ipynb").unlink()
    copies.bring_copies()
    assert sources(copies.COPIES / CHAPTER) == ["2 + 3"]
    assert sources(copies.COPIES / "00_start_here.ipynb") == ["2 + 2"]
    assert put_aside(copies) == []


@pytest.mark.parametrize(("source", "output"), [("my answer", ""), ("2 + 2", "4")])
def test_a_touched_copy_stays_and_the_new_one_comes_on_request(
    copies: ModuleType, capsys: pytest.CaptureFixture[str], source: str, output: str
) -> None:
    """In whatever second it was touched: times of files are not asked."""
    made = (copies.COPIES / CHAPTER).stat()
    mine = touch(copies, source, output)
    os.utime(copies.COPIES / CHAPTER, ns=(made.st_atime_ns, made.st_mtime_ns))
    capsys.readouterr()
    copies.bring_copies()
    assert capsys.readouterr().out == ""
    change_the_book(copies, "2 + 3")
    copies.bring_copies()
    assert capsys.readouterr().out.startswith(
        "The book has changed since you began 03; what is yours stays. 'python3 lab.py fresh 03'"
    )
    assert (copies.COPIES / CHAPTER).read_text("utf-8") == mine

    copies.bring_clean(["3"])
    said = capsys.readouterr().out
    assert re.match(rf"03: yours is now my-book.03_drift{TODAY}\.ipynb\.\n", said)
    assert said.endswith("my-book has clean copies of 03, solutions/03.\n")
    assert sources(copies.COPIES / CHAPTER) == ["2 + 3"]
    again = touch(copies, "another answer")
    copies.bring_clean([])
    assert capsys.readouterr().out.endswith("my-book has clean copies of all notebooks.\n")
    assert put_aside(copies) == [mine, again]
    assert sources(copies.COPIES / CHAPTER) == ["2 + 3"]


def test_work_in_the_book_itself_is_work(copies: ModuleType) -> None:
    """Who saved answers there, as the first edition let him, and restored the book, has them."""
    (copies.COPIES / CHAPTER).unlink()
    (copies.BOOK / CHAPTER).write_text(notebook("2 + 2", output="4"), "utf-8")
    copies.bring_copies()
    change_the_book(copies, "2 + 2")
    copies.bring_copies()
    assert json.loads((copies.COPIES / CHAPTER).read_text("utf-8"))["cells"][0]["outputs"]


@pytest.mark.parametrize("contents", [b"", b"\xff\xfe", b"[]", b'{"metadata": {}}', b"<<<<<<<"])
def test_what_cannot_be_understood_is_the_readers(copies: ModuleType, contents: bytes) -> None:
    (copies.COPIES / CHAPTER).write_bytes(contents)
    change_the_book(copies, "2 + 3")
    copies.bring_copies()
    assert (copies.COPIES / CHAPTER).read_bytes() == contents
    copies.bring_clean(["03"])
    assert [path.read_bytes() for path in copies.COPIES.glob("03_drift.2*")] == [contents]


@pytest.mark.parametrize("target", ["there", "nowhere"])
def test_a_link_is_the_readers_and_so_is_what_it_leads_to(
    copies: ModuleType, tmp_path: Path, target: str
) -> None:
    (tmp_path / "there").write_text(notebook("2 + 2"), "utf-8")
    link = copies.COPIES / CHAPTER
    link.unlink()
    link.symlink_to(tmp_path / target)
    change_the_book(copies, "2 + 3")
    copies.bring_copies()
    assert link.readlink() == tmp_path / target
    copies.bring_clean(["03_drift"])
    assert not link.is_symlink()
    assert next(copies.COPIES.glob("03_drift.2*")).readlink() == tmp_path / target
    assert sources(tmp_path / "there") == ["2 + 2"]


def test_a_file_in_the_place_of_the_folder(copies: ModuleType) -> None:
    for path in sorted(copies.COPIES.rglob("*"), reverse=True):
        path.rmdir() if path.is_dir() else path.unlink()
    copies.COPIES.rmdir()
    copies.COPIES.write_text("mine", "utf-8")
    with pytest.raises(copies.Trouble, match="is in the way of the copies: move it away"):
        copies.bring_copies()
    assert copies.COPIES.read_text("utf-8") == "mine"


def test_a_full_disk_leaves_the_copies_as_they_are(
    copies: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(path: Path, text: str, *_: object, **__: object) -> None:
        with path.open("w", encoding="utf-8") as half:
            half.write(text[:20])
        raise OSError(errno.ENOSPC, "No space left on device", str(path))

    mine = touch(copies)
    change_the_book(copies, "2 + 3")
    with monkeypatch.context() as full:
        full.setattr(Path, "write_text", fails)
        with pytest.raises(copies.Trouble, match="The disk is full"):
            copies.bring_clean(["03"])
    assert put_aside(copies) == [mine]
    copies.bring_copies()
    assert sources(copies.COPIES / CHAPTER) == ["2 + 3"]


def test_who_is_killed_between_two_names_has_both_afterwards(
    copies: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    mine = touch(copies)
    with monkeypatch.context() as killed:
        killed.delattr(Path, "replace")
        with pytest.raises(AttributeError):
            copies.bring_clean(["03"])
    copies.bring_copies()
    assert put_aside(copies) == [mine]
    assert sources(copies.COPIES / CHAPTER) == ["2 + 2"]


def test_what_was_there_before_a_save_that_was_cut_off_is_kept(copies: ModuleType) -> None:
    """JupyterLab, killed while it saves, leaves it under another name."""
    mine, half = touch(copies), '{"cells": ['
    (copies.COPIES / f".~{CHAPTER}").write_text(mine, "utf-8")
    (copies.COPIES / CHAPTER).write_text(half, "utf-8")
    copies.bring_clean(["03"])
    assert put_aside(copies) == [mine, half]
    assert sources(copies.COPIES / CHAPTER) == ["2 + 2"]


def test_who_saves_at_the_last_moment_keeps_it(
    copies: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Between the look at the copies and their renewal the lock is awaited, maybe for minutes."""
    change_the_book(copies, "2 + 3")
    mine: list[str] = []

    @contextlib.contextmanager
    def alone() -> Iterator[None]:
        mine.append(touch(copies))
        yield

    monkeypatch.setattr(copies, "alone", alone)
    copies.bring_copies()
    assert [(copies.COPIES / CHAPTER).read_text("utf-8")] == mine


def test_chapters_that_are_not_there_or_damaged_are_named(
    copies: ModuleType, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(copies.Trouble, match=r'no chapter "33"; there are 00, 03\.'):
        copies.bring_clean(["33"])
    (copies.BOOK / CHAPTER).write_text("<<<<<<< HEAD", "utf-8")
    copies.bring_copies()
    assert re.search(r"notebooks.03_drift\.ipynb is damaged and", capsys.readouterr().out)
    assert sources(copies.COPIES / CHAPTER) == ["2 + 2"]

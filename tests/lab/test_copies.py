"""The reader's own copies of the notebooks: they follow the book until somebody works in them."""

import errno
import json
import os
import re
import sys
from pathlib import Path
from types import ModuleType

import pytest
from tiny_project import ROOT, load, make_tiny

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
    folder = make_tiny(tmp_path / "Übung 3")
    (folder / "notebooks/solutions").mkdir()
    for name in (CHAPTER, f"solutions/{CHAPTER}"):
        (folder / "notebooks" / name).write_text(notebook("2 + 2"), "utf-8")
    found = load(folder).copies
    monkeypatch.setattr(found, "PYTHON", sys.executable)
    assert found.bring_copies() == folder / "my-book"
    return found


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


def test_what_is_missing_comes_back(copies: ModuleType) -> None:
    (copies.COPIES / CHAPTER).unlink()
    copies.bring_copies()
    assert sources(copies.COPIES / CHAPTER) == ["2 + 2"]


def test_a_copy_says_what_the_kernel_says_of_its_language(copies: ModuleType) -> None:
    """Or JupyterLab would complete it, and ask at the end whether to save that."""
    metadata = json.loads((copies.COPIES / CHAPTER).read_text("utf-8"))["metadata"]
    from ipykernel.ipkernel import IPythonKernel

    assert metadata["language_info"] == IPythonKernel.language_info
    assert metadata["kernelspec"] == {"name": "python3"}


def test_a_copy_that_nobody_touched_follows_the_book(
    copies: ModuleType, capsys: pytest.CaptureFixture[str]
) -> None:
    change_the_book(copies, "2 + 3")
    copies.bring_copies()
    assert sources(copies.COPIES / CHAPTER) == ["2 + 3"]
    assert put_aside(copies) == []


def test_a_copy_that_was_run_and_cleared_again_is_not_touched(copies: ModuleType) -> None:
    touch(copies, "2 + 2")
    change_the_book(copies, "2 + 3")
    copies.bring_copies()
    assert sources(copies.COPIES / CHAPTER) == ["2 + 3"]


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


def test_the_folder_may_lie_on_another_disk(copies: ModuleType, tmp_path: Path) -> None:
    copies.COPIES.rename(tmp_path / "disk")
    copies.COPIES.symlink_to(tmp_path / "disk", target_is_directory=True)
    change_the_book(copies, "2 + 3")
    copies.bring_copies()
    assert copies.COPIES.is_symlink()
    assert sources(tmp_path / "disk" / CHAPTER) == ["2 + 3"]


def test_a_file_in_the_place_of_the_folder(copies: ModuleType) -> None:
    for path in sorted(copies.COPIES.rglob("*"), reverse=True):
        path.rmdir() if path.is_dir() else path.unlink()
    copies.COPIES.rmdir()
    copies.COPIES.write_text("mine", "utf-8")
    with pytest.raises(copies.Trouble, match="is in the way of the copies: move it away"):
        copies.bring_copies()
    assert copies.COPIES.read_text("utf-8") == "mine"


def test_a_folder_that_can_only_be_read(
    copies: ModuleType, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    change_the_book(copies, "2 + 3")
    assert copies.bring_copies() == copies.COPIES  # with the older chapter
    (copies.COPIES / CHAPTER).unlink()
    capsys.readouterr()
    assert copies.bring_copies() == copies.BOOK
    said = capsys.readouterr().out
    assert said.endswith("cannot be written: the book opens to be read, and keeps no changes.\n")


def test_a_full_disk_leaves_the_copies_as_they_are(
    copies: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(path: Path, text: str, *_: object, **__: object) -> None:
        with path.open("w", encoding="utf-8") as half:
            half.write(text[:20])
        raise OSError(errno.ENOSPC, "No space left on device", str(path))

    mine = touch(copies)
    change_the_book(copies, "2 + 3")
    monkeypatch.setattr(Path, "write_text", fails)
    with pytest.raises(copies.Trouble, match="The disk is full"):
        copies.bring_clean(["03"])
    monkeypatch.undo()
    assert put_aside(copies) == [mine]
    assert list(copies.COPIES.rglob("*.new")) == []
    monkeypatch.setattr(copies, "PYTHON", sys.executable)
    copies.bring_copies()
    assert sources(copies.COPIES / CHAPTER) == ["2 + 3"]


def test_who_is_killed_between_two_names_has_both_afterwards(
    copies: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Killed(BaseException):
        pass

    def killed(path: Path, target: Path) -> Path:
        raise Killed

    mine = touch(copies)
    monkeypatch.setattr(Path, "replace", killed)
    with pytest.raises(Killed):
        copies.bring_clean(["03"])
    monkeypatch.undo()
    monkeypatch.setattr(copies, "PYTHON", sys.executable)
    copies.bring_copies()
    assert put_aside(copies) == [mine]
    assert sources(copies.COPIES / CHAPTER) == ["2 + 2"]


def test_a_save_that_was_cut_off_is_undone_before_a_clean_copy_comes(copies: ModuleType) -> None:
    """JupyterLab, killed while it saves, leaves what was there before under another name."""
    mine = touch(copies)
    (copies.COPIES / f".~{CHAPTER}").write_text(mine, "utf-8")
    (copies.COPIES / CHAPTER).write_text('{"cells": [', "utf-8")
    copies.bring_clean(["03"])
    assert put_aside(copies) == [mine]
    assert sources(copies.COPIES / CHAPTER) == ["2 + 2"]


def test_who_saves_at_the_last_moment_keeps_it(
    copies: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Between the look at a copy and its renewal the lock is awaited, which may take minutes."""
    change_the_book(copies, "2 + 3")
    (before,) = [one for one in copies.list_copies() if one.path == copies.COPIES / CHAPTER]
    assert before.state is copies.State.UNTOUCHED
    mine = touch(copies)
    copies.place(before)
    assert before.path.read_text("utf-8") == mine


def test_fresh_knows_its_chapters(copies: ModuleType) -> None:
    with pytest.raises(copies.Trouble, match=r'no chapter "33"; there are 00, 03\.'):
        copies.bring_clean(["33"])


def test_a_damaged_notebook_of_the_book_is_named(
    copies: ModuleType, capsys: pytest.CaptureFixture[str]
) -> None:
    (copies.BOOK / CHAPTER).write_text("<<<<<<< HEAD", "utf-8")
    copies.bring_copies()
    assert re.search(r"notebooks.03_drift\.ipynb is damaged and", capsys.readouterr().out)
    assert sources(copies.COPIES / CHAPTER) == ["2 + 2"]


def test_git_ignores_the_copies() -> None:
    assert "/my-book" in (ROOT / ".gitignore").read_text("utf-8").splitlines()

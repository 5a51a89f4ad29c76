"""What a class is given: it works, every link holds, and nothing that shows an answer is in it."""

import ast
import json
import re
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path, PurePosixPath

import pytest
from bootstrap.steps import HOME, Trouble
from student import LINK, NAME, student_files, without_links, write_student_copy

from driftlab.book.chapters import chapters_with
from driftlab.book.exercises import hints_of


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("class of thirty #1")
    write_student_copy(folder / "copy.zip")
    with zipfile.ZipFile(folder / "copy.zip") as packed:
        packed.extractall(folder)
    return folder / NAME


def test_neither_solutions_nor_pages_for_teachers_are_in_it(copy: Path) -> None:
    names = {path.relative_to(copy).as_posix() for path in copy.rglob("*")}
    assert {"lab.py", "notebooks/03_systematic_drift.ipynb", "LICENSE"} <= names
    assert not [n for n in names if re.search(r"solutions|instructors|^tests|^site|\.pyc$", n)]
    # Whoever unpacks a newer one over the folder keeps all answers, and what is set up.
    assert not [n for n in names if re.search(r"^my-book|^\.venv|^\.jupyter|guesses\.json$", n)]
    written = "\n".join(
        path.read_text("utf-8") for path in copy.rglob("*") if path.suffix in (".ipynb", ".md")
    )
    for solution in (HOME / "notebooks/solutions").glob("*.ipynb"):
        for cell in json.loads(solution.read_text("utf-8"))["cells"]:
            text = json.dumps("".join(cell["source"]), ensure_ascii=False)[1:-1]
            if cell["cell_type"] == "code" and "answer =" in text:
                assert text not in written


def test_every_link_leads_to_something_in_it(copy: Path) -> None:
    for path in [*copy.rglob("*.ipynb"), *copy.glob("*.md"), *copy.glob("*/*.md")]:
        text = path.read_text("utf-8")
        for link in LINK.finditer(text):
            if ":" not in link[2] and not link[1].startswith("\\"):
                assert (path.parent / link[2]).exists(), (path.name, link[0])


def test_words_of_a_link_stay_where_its_target_is_left_out() -> None:
    text = "The [worked *ones*](solutions/03.ipynb#a), [next](04.ipynb), [site](https://a.b/c)."
    kept = without_links(text, PurePosixPath("notebooks"), {"notebooks/04.ipynb"})
    assert kept == "The worked *ones*, [next](04.ipynb), [site](https://a.b/c)."
    above = without_links("[e](../ERRATA.md)", PurePosixPath("notebooks"), {"ERRATA.md"})
    assert above == "[e](../ERRATA.md)"


def test_exercises_answer_in_it_and_no_module_asks_for_what_is_left_out(copy: Path) -> None:
    code = (
        "import driftlab, driftlab.book as book\n"
        f"assert driftlab.__file__.startswith({str(copy)!r})\n"
        "[getattr(book, name) for name in book.__all__ if name != 'class_report']\n"
        "book.check('3.3', 'ad')"
    )
    command = [
        sys.executable,
        "-c",
        f"import sys; sys.path.insert(0, {str(copy / 'src')!r})\n{code}",
    ]
    found = subprocess.run(command, capture_output=True, text=True, cwd=copy)
    assert found.stdout.startswith("Exercise 3.3: right."), found.stderr
    for path in (copy / "src").rglob("*.py"):
        for node in ast.parse(path.read_text("utf-8")).body:  # what is imported at once
            if isinstance(node, ast.ImportFrom):
                assert "instructors" not in f"{node.module}", path


@pytest.mark.parametrize("command", ["test", "site", "class", "student", "release", "slides"])
def test_its_lab_says_what_it_has_not(copy: Path, command: str) -> None:
    found = subprocess.run(
        [sys.executable, copy / "lab.py", command], capture_output=True, text=True
    )
    assert found.returncode == 1
    assert found.stderr == f'This is a student\'s copy of the book, which has no "{command}".\n'


def test_all_that_the_package_is_installed_from_is_in_it() -> None:
    names = {name for name, _ in student_files()}
    assert {
        "pyproject.toml",
        "environment.txt",
        "release/PYPI.md",
        "LICENSES/BSD-3-Clause.txt",
    } <= names


def test_a_server_can_be_set_up_from_it() -> None:
    names = {name for name, _ in student_files()}
    assert {".binder/requirements.txt", ".binder/runtime.txt"} <= names
    assert {"deployment/Dockerfile", "deployment/Dockerfile.dockerignore"} <= names


def test_it_takes_no_files_place(tmp_path: Path) -> None:
    target = tmp_path / "a.zip"
    target.write_text("mine")
    with pytest.raises(
        Trouble, match=r"a\.zip is there already: move it away, or give another name"
    ):
        write_student_copy(target)
    assert target.read_text() == "mine"
    with pytest.raises(Trouble, match=r"cannot be written: No such file"):
        write_student_copy(tmp_path / "no/where.zip")


def test_the_books_own_words_are_not_in_it_and_hints_are(copy: Path) -> None:
    models = 0
    for path in (copy / "src").rglob("hints.toml"):
        hints = tomllib.loads(path.read_text("utf-8"))
        book = tomllib.loads((HOME / path.relative_to(copy)).read_text("utf-8"))
        assert hints == {n: {k: v for k, v in e.items() if k != "model"} for n, e in book.items()}
        models += sum("model" in each for each in book.values())
    assert models


def test_no_file_of_it_has_the_books_own_words(copy: Path) -> None:
    models = [help_.model for ch in chapters_with("exercises") for help_ in hints_of(ch).values()]
    said = [*filter(None, models)]
    beginnings = {" ".join(words.split())[:60] for words in said}
    for path in copy.rglob("*"):
        if path.is_file():
            text = " ".join(path.read_text("utf-8", errors="replace").replace('"', "").split())
            found = [words for words in beginnings if words.replace('"', "") in text]
            assert not found, path
    assert len(said) > 50


def test_files_that_are_not_the_books_stay_at_home(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    for name in ("notebooks/autumn/gradebook.csv", "notebooks/marks.csv", "notebooks/03.ipynb"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text('{"cells": []}')
    (tmp_path / "release").mkdir()
    (tmp_path / "release/STUDENT.md").write_text("")
    monkeypatch.setitem(student_files.__globals__, "HOME", tmp_path)
    assert {name for name, _ in student_files()} == {"README.md", "notebooks/03.ipynb"}

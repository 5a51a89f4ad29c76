"""What is lost from the environment later, by a disk or a virus scanner, is noticed and mended."""

from pathlib import Path
from types import SimpleNamespace

import pytest
from tiny_project import ROOT, load

pytestmark = pytest.mark.xdist_group("lab")
RECORD = """\
sixth/__init__.py,sha256=ab,3
"sixth/a, b.so",sha256=ab,5
sixth/__pycache__/sixth.pyc,,
../scripts/sixth,sha256=ab,9
sixth-1.dist-info/RECORD,,
"""


@pytest.fixture
def packages(tmp_path: Path) -> Path:
    """A folder with a package as pip leaves it; its script has been given another path."""
    folder = tmp_path / "packages"
    for name, text in {
        "sixth/__init__.py": "1\n2",
        "sixth/a, b.so": "12345",
        "../scripts/sixth": "#!another",
        "sixth-1.dist-info/RECORD": RECORD,
    }.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, "utf-8", newline="\n")
    (tmp_path / "scripts/sixth").write_text("#!yet another", "utf-8")
    return folder


@pytest.mark.parametrize(
    ("name", "contents"),
    [
        ("sixth/__init__.py", None),
        ("sixth/__init__.py", b""),
        ("sixth/a, b.so", None),
        ("sixth/a, b.so", b"1234"),
        ("../scripts/sixth", None),
        ("sixth-1.dist-info/RECORD", b"\xff\xfe"),
    ],
)
def test_a_file_that_is_lost_or_cut_is_found(
    packages: Path, name: str, contents: bytes | None
) -> None:
    unlike = load(ROOT).records.unlike_records
    assert unlike(packages, packages.parent / "scripts") == []
    (packages / name).unlink()
    if contents is not None:
        (packages / name).write_bytes(contents)
    assert unlike(packages, packages.parent / "scripts") == [name]


@pytest.fixture
def damaged(modules: SimpleNamespace, copied: Path) -> Path:
    """A file that is lost from within a package."""
    assert modules.environment.reason_to_build() == ""
    (lost,) = copied.glob(".venv/**/pip/_vendor/certifi/cacert.pem")
    lost.unlink()
    return lost


def test_the_next_start_mends_it(modules: SimpleNamespace, damaged: Path) -> None:
    assert modules.environment.reason_to_build() == "The environment is damaged; making it anew."
    modules.environment.set_up()
    assert modules.environment.reason_to_build() == ""
    assert damaged.exists()


def test_the_book_opens_with_it_where_nothing_can_be_fetched(
    modules: SimpleNamespace,
    damaged: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def fails() -> None:
        raise modules.lab.NoPackages("The package index cannot be reached.")

    served: list[str] = []
    monkeypatch.setattr(modules.lab, "set_up", fails)
    monkeypatch.setattr(modules.lab, "serve", lambda path, *_, **__: served.append(path))
    assert modules.lab.main(["open"]) == 0
    assert served == ["my-book/00_start_here.ipynb"]
    assert "Meanwhile the book opens with" in capsys.readouterr().out


@pytest.mark.setup
def test_what_was_unlike_its_record_from_the_beginning_is_no_damage(
    modules: SimpleNamespace, damaged: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Or each start would make the environment anew."""
    environment = modules.environment
    make_venv = environment.make_venv

    def make_without(folder: Path) -> None:
        make_venv(folder)
        (lost,) = folder.glob("**/pip/_vendor/certifi/cacert.pem")
        lost.unlink()

    monkeypatch.setattr(environment, "make_venv", make_without)
    environment.set_up()
    assert not damaged.exists()
    assert environment.reason_to_build() == ""

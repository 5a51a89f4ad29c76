"""Environments besides ``.venv``: the site's and the one of the oldest packages."""

import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

pytestmark = pytest.mark.xdist_group("lab")


def test_the_site_is_built_in_an_environment_that_sees_the_other(
    modules: SimpleNamespace, copied: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With no packages of its own; it is made once, and anew when its list changes."""
    made = []

    def make_venv(folder: Path) -> None:  # the pip that it sees is enough here
        made.append(folder)
        subprocess.run(
            [sys.executable, "-m", "venv", "--clear", "--without-pip", folder], check=True
        )

    monkeypatch.setattr(modules.beside, "make_venv", make_venv)
    (copied / "site").mkdir()
    wanted = copied / "site/packages.txt"
    wanted.write_text("", "utf-8")
    python = modules.beside.beside(wanted)
    show = [python, "-E", "-c", "import driftlab, sys; print(*driftlab.__path__, sys.prefix)"]
    told = subprocess.run(show, capture_output=True, encoding="utf-8", check=True).stdout
    assert told == f"{copied / 'src/driftlab'} {copied / '.venv-site'}\n"
    assert modules.beside.beside(wanted) == python
    assert len(made) == 1
    wanted.write_text("# another\n", "utf-8")
    assert modules.beside.beside(wanted) == python
    assert len(made) == 2


def test_the_oldest_packages_are_an_environment_of_their_own(
    modules: SimpleNamespace, copied: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Which sees nothing of the other, has the package, and is made anew when it asks for more."""
    steps: list[list[str]] = []
    made: list[Path] = []

    def make_venv(folder: Path) -> None:
        made.append(folder)
        (folder / modules.beside.BIN).mkdir(parents=True, exist_ok=True)
        (folder / modules.beside.BIN / modules.beside.PYTHON_NAME).touch()

    monkeypatch.setattr(modules.beside, "make_venv", make_venv)
    monkeypatch.setattr(modules.beside, "run_step", steps.append)
    listed = copied / "bootstrap/lowest.txt"
    listed.write_text("", "utf-8")
    python = modules.beside.apart(listed)
    assert modules.beside.apart(listed) == python
    assert made == [copied / ".venv-lowest"]
    assert not list(made[0].rglob("*.pth"))
    assert steps[0][-3:] == ["--require-hashes", "-r", str(listed)]
    assert steps[1][-2:] == ["--editable", "."]
    with (copied / "pyproject.toml").open("a", encoding="utf-8") as file:
        file.write("# other dependencies\n")
    modules.beside.apart(listed)
    assert len(made) == 2

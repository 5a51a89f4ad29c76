"""Tiny projects in the states that tests of lab.py begin with."""

import shutil
from pathlib import Path
from types import SimpleNamespace

import pytest
from tiny_project import ROOT, load, make_tiny, run


@pytest.fixture
def tiny(tmp_path: Path) -> Path:
    """A tiny project that was never set up."""
    return make_tiny(tmp_path / "Übung 1")


@pytest.fixture(scope="session")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A tiny project that is set up; tests leave it as they found it."""
    folder = make_tiny(tmp_path_factory.mktemp("finished") / "Übung #2, лаб 漢字")
    done = run(folder, "figures")
    assert (done.code, done.complained) == (0, ""), done.said
    return folder


@pytest.fixture
def copied(finished: Path, tmp_path: Path) -> Path:
    """A copy of a tiny project that is set up."""
    return shutil.copytree(finished, tmp_path / "a copy", symlinks=True)


@pytest.fixture
def checks(monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """The project's own lab.py; what it would run is noted, and all but mypy succeed."""
    lab, ran = load(ROOT).lab, []

    def run(*arguments: str, **_: object) -> int:
        ran.append(list(arguments))
        return int("mypy" in arguments)

    monkeypatch.setattr(lab, "run", run)
    monkeypatch.setattr(lab, "set_up", lambda: None)
    return SimpleNamespace(lab=lab, ran=ran)

"""Tiny projects in the states that tests of lab.py begin with."""

import threading
from pathlib import Path
from types import SimpleNamespace

import pytest
from tiny_project import NO_INDEX, ROOT, copy_of, load, make_tiny, run


@pytest.fixture
def tiny(tmp_path: Path) -> Path:
    """A tiny project that was never set up."""
    return make_tiny(tmp_path / "Übung 1")


@pytest.fixture(scope="session")
def two_starts(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[SimpleNamespace]]:
    """A tiny project, and what its first two starts said, which were at the same time."""
    folder = make_tiny(tmp_path_factory.mktemp("finished") / "Übung #2, лаб 漢字")
    outputs = []
    threads = [
        threading.Thread(target=lambda: outputs.append(run(folder, "figures", **NO_INDEX)))
        for _ in range(2)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return folder, outputs


@pytest.fixture(scope="session")
def finished(two_starts: tuple[Path, list[SimpleNamespace]]) -> Path:
    """A tiny project that is set up; tests leave it as they found it."""
    folder, outputs = two_starts
    assert [done.code for done in outputs] == [0, 0], [done.complained for done in outputs]
    return folder


@pytest.fixture
def copied(finished: Path, tmp_path: Path) -> Path:
    """A copy of a tiny project that is set up."""
    return copy_of(finished, tmp_path / "a copy")


@pytest.fixture
def modules(copied: Path, finished: Path, monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """The modules of a tiny project that is set up; it makes another environment in no time."""
    found = load(copied)
    found.environment.set_up()  # it was moved

    def make_venv(folder: Path) -> None:
        copy_of(finished / ".venv", folder)
        (folder / "driftlab.json").unlink()

    monkeypatch.setattr(found.environment, "make_venv", make_venv)
    for name, value in NO_INDEX.items():
        monkeypatch.setenv(name, value)
    return found


@pytest.fixture
def checks(monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """The project's own lab.py; what it would run is noted, and all but mypy succeed."""
    lab, ran = load(ROOT).lab, []

    def run(*arguments: str) -> int:
        ran.append(list(arguments))
        return int("mypy" in arguments)

    monkeypatch.setattr(lab, "run", run)
    monkeypatch.setattr(lab, "set_up", lambda: None)
    return SimpleNamespace(lab=lab, ran=ran)

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
    """A tiny project that uv has set up; tests leave it as they found it."""
    folder = make_tiny(tmp_path_factory.mktemp("finished") / "Übung #2, лаб 漢字")
    done = run(folder, "figures")
    assert (done.code, done.complained) == (0, ""), done.said
    return folder


@pytest.fixture
def copied(finished: Path, tmp_path: Path) -> Path:
    """A copy of a tiny project that is set up."""
    return shutil.copytree(finished, tmp_path / "a copy", symlinks=True)


@pytest.fixture(scope="session")
def by_pip(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A tiny project that pip has set up, because there is no uv for this computer."""
    folder = make_tiny(tmp_path_factory.mktemp("pip") / "Übung 3")
    with (folder / "environment.txt").open("a", encoding="utf-8") as file:
        file.write(f"uv==99.0 \\\n    --hash=sha256:{64 * '0'}\n")
    done = run(folder, "figures", PATH="", PIP_NO_INDEX="1")
    assert (done.code, done.complained) == (0, ""), done.said
    return folder


@pytest.fixture(params=["uv", "pip"])
def either(request: pytest.FixtureRequest, tiny: Path) -> SimpleNamespace:
    """A tiny project, and the programs that are found: uv, or none. pip is there already."""
    if request.param == "uv":
        return SimpleNamespace(folder=tiny, programs={})
    made = request.getfixturevalue("by_pip")
    (tiny / ".venv-uv").symlink_to(made / ".venv-uv", target_is_directory=True)
    return SimpleNamespace(folder=tiny, programs={"PATH": ""})


@pytest.fixture
def checks(monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """The project's own lab.py; what it would run is noted, and all but mypy succeed."""
    modules, ran = load(ROOT), []

    def run(*arguments: str, **_: object) -> int:
        ran.append(list(arguments))
        return int("mypy" in arguments)

    monkeypatch.setattr(modules.lab, "run", run)
    for module in (modules.lab, modules.environment):
        monkeypatch.setattr(module, "set_up", lambda: None)
    return SimpleNamespace(lab=modules.lab, environment=modules.environment, ran=ran)

"""When the environment is made, and when it stays."""

import json
import shutil
import subprocess
from pathlib import Path
from types import SimpleNamespace

import pytest
from tiny_project import NO_INDEX, load, run

pytestmark = pytest.mark.xdist_group("lab")


def test_of_two_starts_one_sets_up_and_one_waits(
    two_starts: tuple[Path, list[SimpleNamespace]],
) -> None:
    said = "".join(done.said for done in two_starts[1])
    assert said.count("Setting up Drift Lab") == 1
    assert said.count("Another start of Drift Lab is setting up this folder") == 1
    assert said.count("figures drawn") == 2


def test_a_second_start_writes_nothing(finished: Path) -> None:
    """Neither log nor lock, so that a folder that can only be read can be used."""
    (finished / ".setup.lock").unlink()
    log = finished / ".setup.log"
    before = log.stat().st_mtime_ns
    again = run(finished, "figures", **NO_INDEX)
    assert (again.code, again.said.strip()) == (0, "figures drawn")
    assert log.stat().st_mtime_ns == before
    assert not (finished / ".setup.lock").exists()


def test_a_stale_environment_txt_is_mentioned_and_used(copied: Path) -> None:
    pyproject = copied / "pyproject.toml"
    text = pyproject.read_text("utf-8")
    pyproject.write_text(text.replace("[tool]", 'dependencies = ["numpy"]\n[tool]'), "utf-8")
    done = run(copied, "figures", **NO_INDEX)
    assert done.said.startswith("environment.txt is older than pyproject.toml; ")
    assert "figures drawn" in done.said


def test_a_moved_project_works_at_once(copied: Path) -> None:
    done = run(copied, "figures", **NO_INDEX)
    assert (done.code, done.said.strip()) == (0, "figures drawn")
    python = load(copied).steps.PYTHON
    where = "import driftlab, jupyterlab; print(jupyterlab.__path__[0])"
    found = subprocess.run([python, "-c", where], capture_output=True, encoding="utf-8")
    assert Path(found.stdout.strip()) == copied / "src/jupyterlab"
    pip = subprocess.run([python.with_name("pip"), "--version"], capture_output=True)
    assert str(copied) in pip.stdout.decode()


@pytest.mark.parametrize(
    ("stamp", "sentence"),
    [
        ({"python": "CPython 3.1"}, "Making the environment anew, for "),
        ({"environment": "older"}, "The project has changed since the last set-up"),
        ({"contents": ["lib/numpy"]}, "The environment is damaged"),
        ({"contents": None}, "The environment is damaged"),
        (None, "The environment is damaged"),
        ([], "The environment is damaged"),
        (5, "The environment is damaged"),
        ({}, ""),
    ],
)
def test_reasons_to_make_the_environment(finished: Path, stamp: object, sentence: str) -> None:
    path = finished / ".venv/driftlab.json"
    before = path.read_text("utf-8")
    changed = json.loads(before) | stamp if isinstance(stamp, dict) else stamp
    path.write_text(json.dumps(changed), "utf-8")
    try:
        reason = load(finished).environment.reason_to_build()
    finally:
        path.write_text(before, "utf-8")
    assert reason.startswith(sentence)
    assert bool(reason) == bool(sentence)


def test_an_environment_whose_python_is_gone_is_damaged(
    finished: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    environment = load(finished).environment
    monkeypatch.setattr(environment, "PYTHON", finished / "nowhere")
    assert environment.reason_to_build().startswith("The environment is damaged")


@pytest.mark.parametrize("kind", ["folder", "file"])
def test_what_lab_py_did_not_make_is_left_alone(tiny: Path, kind: str) -> None:
    mine = tiny / ".venv" if kind == "file" else tiny / ".venv/mine.txt"
    mine.parent.mkdir(exist_ok=True)
    mine.write_text("mine", "utf-8")
    other = tiny / ".venv.old/mine.txt"
    other.parent.mkdir()
    other.write_text("mine", "utf-8")
    done = run(tiny, "figures", **NO_INDEX)
    assert (done.code, done.said) == (1, "")
    assert done.complained.endswith("was not made by lab.py: move it away and run this again.")
    assert mine.read_text("utf-8") == other.read_text("utf-8") == "mine"


def test_an_environment_may_lie_on_another_disk(
    modules: SimpleNamespace, copied: Path, tmp_path: Path
) -> None:
    shutil.rmtree(copied / ".venv")
    (copied / ".venv").symlink_to(tmp_path / "disk/venv", target_is_directory=True)
    (tmp_path / "disk").mkdir()
    elsewhere = load(copied)
    elsewhere.environment.make_venv = modules.environment.make_venv
    elsewhere.environment.set_up()
    assert (copied / ".venv").is_symlink()
    assert [path.name for path in (tmp_path / "disk").iterdir()] == ["venv"]
    assert run(copied, "figures", **NO_INDEX).said.strip() == "figures drawn"

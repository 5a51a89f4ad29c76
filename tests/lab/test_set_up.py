"""When the environment is made, with uv and with pip; what is lost, old or killed is replaced."""

import json
import os
import random
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import pytest
from tiny_project import (
    NO_INDEX,
    WITH_UV,
    comes_true,
    command,
    listed,
    load,
    make_wheel,
    run,
    run_as,
    sense,
)

pytestmark = pytest.mark.xdist_group("lab")
DRAWN = (0, "", "figures drawn")


def result(done: SimpleNamespace) -> tuple[int, str, str]:
    return done.code, done.complained, done.said.strip()


@pytest.mark.setup
@pytest.mark.parametrize("path", [WITH_UV, ""], ids=["uv", "pip"])
def test_packages_come_with_their_hashes_and_no_others(
    tiny: Path, tmp_path: Path, path: str
) -> None:
    line = make_wheel(tmp_path)
    wheels = {"PIP_FIND_LINKS": tmp_path.as_uri(), "PIP_NO_INDEX": "1", "PATH": path}
    listed(tiny, line)
    listed(tiny, f"seventh==1.0 ; python_version < '3' --hash=sha256:{64 * '0'}\n")
    if not path:  # there is no uv for this computer
        listed(tiny, f"uv==99.0 \\\n    --hash=sha256:{64 * '0'}\n")
    done = run(tiny, "figures", **wheels)
    assert (done.code, done.complained) == (0, "")
    assert done.said.startswith("Setting up Drift Lab in ")
    assert sense(tiny)
    assert not list(tiny.glob(".venv/**/pip")), "only environment.txt says what is there"
    assert (tiny / ".venv-uv").exists() == (not path)
    assert result(run(tiny, "figures", **wheels)) == DRAWN

    # Another wheel of the same name is refused, and the old environment stays.
    with (tiny / "environment.txt").open("r+", encoding="utf-8") as file:
        text = file.read().replace(line[-10:-1], 9 * "0")
        file.seek(0)
        file.write(text)
    done = run(tiny, "figures", **wheels)
    assert done.code == 1
    assert done.complained.startswith("The package sixth-sense==1.0 differs from its entry")
    assert sense(tiny)
    assert load(tiny).environment.runs()
    assert not list(tiny.glob(".venv.*"))


@pytest.mark.setup
def test_of_two_first_starts_one_sets_up_and_one_waits(tiny: Path) -> None:
    outputs: list[SimpleNamespace] = []
    starts = [threading.Thread(target=lambda: outputs.append(run(tiny, "figures"))) for _ in "12"]
    for start in starts:
        start.start()
    for start in starts:
        start.join()
    said = "".join(done.said for done in outputs)
    assert [done.complained for done in outputs] == ["", ""]
    assert said.count("Setting up Drift Lab") == 1
    assert said.count("Another start of Drift Lab is setting up this folder") == 1
    assert said.count("figures drawn") == 2


def test_a_second_start_writes_nothing_and_needs_no_network(finished: Path) -> None:
    """Neither log nor lock, so that a folder that can only be read can be used."""
    (finished / ".setup.lock").unlink()
    before = (finished / ".setup.log").stat().st_mtime_ns
    assert result(run(finished, "figures")) == DRAWN
    assert (finished / ".setup.log").stat().st_mtime_ns == before
    assert not (finished / ".setup.lock").exists()


def test_a_moved_project_works_at_once(copied: Path) -> None:
    assert result(run(copied, "figures")) == DRAWN
    where = "import driftlab, jupyterlab; print(jupyterlab.__path__[0])"
    found = subprocess.check_output([load(copied).steps.PYTHON, "-c", where], encoding="utf-8")
    assert Path(found.strip()) == copied / "src/jupyterlab"


def test_a_stale_environment_txt_is_mentioned_and_used(copied: Path) -> None:
    pyproject = copied / "pyproject.toml"
    text = pyproject.read_text("utf-8")
    pyproject.write_text(text.replace("[tool]", 'dependencies = ["numpy"]\n[tool]'), "utf-8")
    done = run(copied, "figures")
    assert done.said.startswith("environment.txt is older than pyproject.toml; ")
    assert "figures drawn" in done.said


@pytest.mark.parametrize(
    ("stamp", "sentence"),
    [
        ({"python": "CPython 3.1"}, "Making the environment again, for "),
        ({"environment": "older"}, "The project has changed since the last set-up"),
        (None, "The environment is damaged"),
        ({}, ""),
    ],
)
def test_reasons_to_make_the_environment(copied: Path, stamp: object, sentence: str) -> None:
    path = copied / ".venv/driftlab.json"
    changed = json.loads(path.read_text("utf-8")) | stamp if isinstance(stamp, dict) else stamp
    path.write_text(json.dumps(changed), "utf-8")
    reason = load(copied).environment.reason_to_build()
    assert reason.startswith(sentence)
    assert bool(reason) == bool(sentence)


@pytest.mark.setup
def test_damage_is_repaired_and_the_book_opens_meanwhile_without_network(
    tiny: Path, tmp_path: Path
) -> None:
    wheels = {"PIP_FIND_LINKS": tmp_path.as_uri(), "PIP_NO_INDEX": "1"}
    listed(tiny, make_wheel(tmp_path))
    assert run(tiny, "figures", **wheels).code == 0
    (lost,) = sense(tiny)
    for harm in (lost.unlink, lambda: lost.write_text("")):
        harm()
        done = run(tiny, "--no-browser", PATH="", UV_CACHE_DIR=str(tmp_path / "empty"))
        assert (done.code, done.complained) == (0, "")
        assert "The environment is damaged; making it again.\n" in done.said
        assert "The package index cannot be reached: check the network" in done.said
        assert "Meanwhile the book opens with the packages of the last set-up.\n" in done.said
        done = run(tiny, "figures", **wheels)
        assert done.said.startswith("The environment is damaged; making it again.\n")
        assert lost.read_text("utf-8") == "sense = 6\n"


@pytest.mark.setup
def test_a_first_start_without_network_leaves_nothing(tiny: Path, tmp_path: Path) -> None:
    listed(tiny, make_wheel(tmp_path))
    for path in (WITH_UV, ""):
        done = run(tiny, "--no-browser", PATH=path)
        assert done.code == 1
        assert done.complained.startswith("The package index cannot be reached: check the network")
        assert done.complained.count("\n") == 0
        assert "Meanwhile" not in done.said
        assert not list(tiny.glob(".venv")) + list(tiny.glob(".venv.*"))


@pytest.mark.setup
@pytest.mark.skipif(os.name == "nt", reason="SIGKILL is not of Windows")
def test_the_environment_survives_kills_at_random_moments(copied: Path, tmp_path: Path) -> None:
    """The old one works, and the next start makes the new one whole."""
    listed(copied, make_wheel(tmp_path))
    wheels = {"PIP_FIND_LINKS": tmp_path.as_uri(), "PIP_NO_INDEX": "1", "PATH": WITH_UV}
    chance = random.Random()
    for number in range(3):
        listed(copied, f"# {number}\n")
        around = {**os.environ, **NO_INDEX, **wheels}
        with subprocess.Popen(
            command(copied, "figures"), env=around, stdout=subprocess.PIPE, start_new_session=True
        ) as process:
            time.sleep(chance.uniform(0.1, 2))
            os.killpg(process.pid, signal.SIGKILL)
        if (copied / ".venv").exists():
            assert load(copied).environment.runs()
        done = run(copied, "figures", **wheels)
        assert (done.code, done.complained) == (0, "")
        assert done.said.endswith("figures drawn\n")
        assert sense(copied)
        assert not list(copied.glob(".venv.*"))


def test_an_environment_that_lacks_only_its_place_gets_it(copied: Path) -> None:
    """This is what is left if lab.py is killed in the moment between two names."""
    (copied / ".venv").rename(copied / ".venv.lab7.old")
    assert result(run(copied, "figures")) == DRAWN
    assert not list(copied.glob(".venv.*"))


def test_an_environment_that_cannot_be_put_in_place_brings_the_old_one_back(
    copied: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    environment, real = load(copied).environment, Path.rename

    def rename(path: Path, target: Path) -> Path:
        if path.name.startswith(".venv.lab") and not path.name.endswith(".old"):
            raise PermissionError(13, "in use", str(path))
        return real(path, target)

    def fill(folder: Path, *_: object) -> None:
        shutil.copytree(copied / ".venv", folder, symlinks=True)

    listed(copied, "# newer\n")
    monkeypatch.setattr(environment, "fill", fill)
    monkeypatch.setattr(Path, "rename", rename)
    with pytest.raises(environment.Trouble, match="cannot be written"):
        environment.set_up()
    assert environment.runs()
    assert not list(copied.glob(".venv.*"))


@pytest.mark.parametrize("kind", ["folder", "file"])
def test_what_lab_py_did_not_make_is_left_alone(tiny: Path, kind: str) -> None:
    mine = tiny / ".venv" if kind == "file" else tiny / ".venv/mine.txt"
    mine.parent.mkdir(exist_ok=True)
    mine.write_text("mine", "utf-8")
    done = run(tiny, "figures")
    assert (done.code, done.said) == (1, "")
    assert done.complained.endswith("was not made by lab.py: move it away and run this again.")
    assert mine.read_text("utf-8") == "mine"


@pytest.mark.setup
def test_an_environment_may_lie_on_another_disk(tiny: Path, tmp_path: Path) -> None:
    (tmp_path / "disk").mkdir()
    (tiny / ".venv").symlink_to(tmp_path / "disk/venv", target_is_directory=True)
    for _ in range(2):
        assert run(tiny, "figures").code == 0
        listed(tiny, "# newer\n")
    assert (tiny / ".venv").is_symlink()
    assert [path.name for path in (tmp_path / "disk").iterdir()] == ["venv"]


@pytest.mark.setup
def test_other_environments_are_made_once_and_again_when_their_list_changes(
    copied: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The site's sees all that .venv has; the one of the oldest packages has the book's own."""
    wheels = {"PIP_FIND_LINKS": tmp_path.as_uri(), "PIP_NO_INDEX": "1", "PATH": WITH_UV}
    for name, value in {**NO_INDEX, **wheels}.items():
        monkeypatch.setenv(name, value)
    environment = load(copied).environment
    show = "import driftlab, sixth_sense, sys; print(*driftlab.__path__, sys.prefix)"
    (copied / "site").mkdir()
    line = make_wheel(tmp_path)
    for name, path, sees in (
        ("site", environment.SITE_LIST, True),
        ("lowest", environment.LOWEST_LIST, False),
    ):
        path.write_text(line, "utf-8")
        python = environment.beside(path, name, sees)
        told = subprocess.check_output([python, "-E", "-c", show], encoding="utf-8")
        assert told == f"{copied / 'src/driftlab'} {copied / f'.venv-{name}'}\n"
        made = (python.parents[1] / "driftlab.json").stat().st_mtime_ns
        assert environment.beside(path, name, sees) == python
        assert (python.parents[1] / "driftlab.json").stat().st_mtime_ns == made
        path.write_text(f"# another\n{line}", "utf-8")
        environment.beside(path, name, sees)
        assert (python.parents[1] / "driftlab.json").stat().st_mtime_ns != made


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGHUP")
@pytest.mark.parametrize("end", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_a_step_ends_with_lab_py(tiny: Path, end: str) -> None:
    step = tiny / "step.py"
    step.write_text("import time; open('begun', 'w').close(); time.sleep(60)", "utf-8")
    code = (
        f"import sys; sys.path.insert(0, {str(tiny)!r})\n"
        "from bootstrap.steps import catch_signals, run_step\ncatch_signals()\n"
        f"run_step([sys.executable, {str(step)!r}])"
    )
    begun = time.monotonic()
    with subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.PIPE) as process:
        assert comes_true((tiny / "begun").exists, 20)
        process.send_signal(getattr(signal, end))
        assert b"KeyboardInterrupt" in process.stderr.read()
    assert time.monotonic() - begun < 30


@pytest.mark.setup
def test_another_python_makes_the_environment_again(tiny: Path) -> None:
    found = (shutil.which(f"python3.{minor}") for minor in range(sys.version_info[1] + 1, 16))
    for python in filter(None, found):
        if subprocess.run([python, "-c", ""], capture_output=True).returncode == 0:
            break
    else:
        pytest.skip("there is no newer Python on this computer")
    for each in (sys.executable, python):
        done = run_as(command(tiny, "figures", python=each), **NO_INDEX, PATH=WITH_UV)
        assert (done.code, done.complained) == (0, "")
        assert done.said.endswith("figures drawn\n")
    assert done.said.startswith("Making the environment again, for CPython 3.")

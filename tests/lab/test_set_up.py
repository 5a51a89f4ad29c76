"""When the environment is made, with uv and with pip; what is lost, old or killed is replaced."""

import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import pytest
from tiny_project import around, command, listed, load, make_wheel, run, sense

DRAWN = (0, "", "figures drawn")


def result(done: SimpleNamespace) -> tuple[int, str, str]:
    return done.code, done.complained, done.said.strip()


def wheels(folder: Path) -> dict[str, str]:
    return {"PIP_FIND_LINKS": folder.as_uri(), "PIP_NO_INDEX": "1"}


def test_packages_come_with_their_hashes_and_no_others(
    either: SimpleNamespace, tmp_path: Path
) -> None:
    folder, variables = either.folder, {**either.programs, **wheels(tmp_path)}
    line = make_wheel(tmp_path)
    listed(folder, line)
    listed(folder, f"seventh==1.0 ; python_version < '3' --hash=sha256:{64 * '0'}\n")
    done = run(folder, "figures", **variables)
    assert (done.code, done.complained) == (0, "")
    assert done.said.startswith("Setting up Drift Lab in ")
    assert sense(folder)
    assert not list(folder.glob(".venv/**/pip")), "only environment.txt says what is there"
    assert (folder / ".venv-uv").exists() == bool(either.programs)
    assert result(run(folder, "figures", **variables)) == DRAWN
    # Another wheel of the same name is refused, and the old environment stays.
    text = (folder / "environment.txt").read_text("utf-8")
    (folder / "environment.txt").write_text(text.replace(line[-10:-1], 9 * "0"), "utf-8")
    done = run(folder, "figures", **variables)
    assert done.code == 1
    assert done.complained.startswith("The package sixth-sense==1.0 differs from its entry")
    assert sense(folder)
    assert load(folder).environment.runs()
    assert not list(folder.glob(".venv.*"))


def test_without_uv_pip_sets_up_with_the_pip_of_python(by_pip: Path) -> None:
    assert result(run(by_pip, "figures", PATH="")) == DRAWN
    assert not list(by_pip.glob(".venv/**/pip"))
    settings = (by_pip / ".venv/pyvenv.cfg").read_text("utf-8")
    home = dict(re.findall(r"^([\w-]+) = (.*)$", settings, re.M))["home"]
    if sys.prefix != sys.base_prefix:  # when the tests' environment goes, the book's stays
        assert not Path(home).is_relative_to(sys.prefix)


def test_a_uv_that_does_not_work_is_not_used(by_pip: Path, tiny: Path) -> None:
    (tiny / ".venv-uv").symlink_to(by_pip / ".venv-uv", target_is_directory=True)
    (tiny / "bin").mkdir()
    (tiny / "bin/uv").write_text("#!/bin/sh\nexit 2\n", "utf-8")
    (tiny / "bin/uv").chmod(0o755)
    assert run(tiny, "figures", PATH=f"{tiny}/bin{os.pathsep}/bin").said.endswith("drawn\n")


def test_a_second_start_writes_nothing_and_needs_no_network(finished: Path) -> None:
    """Neither log nor lock, so that a folder that can only be read can be used."""
    (finished / ".setup.lock").unlink()
    before = (finished / ".setup.log").stat().st_mtime_ns
    assert result(run(finished, "figures", PATH="")) == DRAWN
    assert (finished / ".setup.log").stat().st_mtime_ns == before
    assert not (finished / ".setup.lock").exists()


def test_of_two_starts_one_waits(copied: Path) -> None:
    with load(copied).environment.alone():
        call = [*command(copied, "fresh")]
        process = subprocess.Popen(call, stdout=subprocess.PIPE, encoding="utf-8")
        said = process.stdout.readline()
    assert said == "Another start of Drift Lab is setting up this folder; waiting for it.\n"
    with process:
        assert process.stdout.read() == "my-book has clean copies of all notebooks.\n"


def test_a_moved_project_works_at_once(copied: Path) -> None:
    assert result(run(copied, "figures")) == DRAWN
    where = "import driftlab, jupyterlab; print(jupyterlab.__path__)"
    found = subprocess.check_output([load(copied).steps.PYTHON, "-c", where], encoding="utf-8")
    assert str(copied / "src/jupyterlab") in found


@pytest.mark.parametrize(
    ("stamp", "sentence"),
    [
        ({"python": "CPython 3.1"}, "The project or Python has changed since the last set-up"),
        ({"environment": "older"}, "The project or Python has changed since the last set-up"),
        ({"size": 10**9}, "The environment is damaged"),
        (None, "The project or Python has changed"),
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


def test_without_a_network_the_old_environment_stays_and_damage_is_repaired_later(
    copied: Path, tmp_path: Path
) -> None:
    listed(copied, make_wheel(tmp_path))
    done = run(copied, "--no-browser", UV_CACHE_DIR=str(tmp_path / "empty"))
    assert (done.code, done.complained) == (0, "")
    assert "The package index cannot be reached: check the network" in done.said
    assert "Meanwhile the book opens with the packages of the last set-up.\n" in done.said
    assert "Drift Lab is open at" in done.said
    done = run(copied, "figures", **wheels(tmp_path))
    assert done.said.startswith("The project or Python has changed since the last set-up; ")
    (lost,) = sense(copied)
    lost.unlink()
    done = run(copied, "figures", **wheels(tmp_path))
    assert done.said.startswith("The environment is damaged; making it again.\n")
    assert lost.exists()


def test_a_first_start_without_network_leaves_nothing(
    either: SimpleNamespace, tmp_path: Path
) -> None:
    listed(either.folder, make_wheel(tmp_path))
    listed(either.folder, f"uv==99.0 \\\n    --hash=sha256:{64 * '0'}\n")
    done = run(either.folder, "--no-browser", **either.programs)
    assert done.code == 1
    assert done.complained.startswith("The package index cannot be reached: check the network")
    assert done.complained.count("\n") == 0
    assert "Meanwhile" not in done.said
    assert not list(either.folder.glob(".venv")) + list(either.folder.glob(".venv.*"))


@pytest.mark.skipif(os.name == "nt", reason="SIGKILL is not of Windows")
def test_the_environment_survives_kills_at_random_moments(copied: Path, tmp_path: Path) -> None:
    """The old one works, and the next start makes the new one whole."""
    listed(copied, make_wheel(tmp_path))
    chance = random.Random()
    for _ in range(3):
        env = around(**wheels(tmp_path))
        call = command(copied, "figures")
        with subprocess.Popen(call, env=env, stdout=-1, start_new_session=True) as process:
            time.sleep(chance.uniform(0.1, 1))
            os.killpg(process.pid, signal.SIGKILL)
        assert load(copied).environment.runs() or list(copied.glob(".venv.lab*.old"))
    done = run(copied, "figures", **wheels(tmp_path))
    assert (done.code, done.complained) == (0, "")
    assert done.said.endswith("figures drawn\n")
    assert sense(copied)
    assert not list(copied.glob(".venv.*"))


def test_an_environment_that_lacks_only_its_place_gets_it(copied: Path) -> None:
    """This is what is left if lab.py is killed in the moment between two names."""
    (copied / ".venv").rename(copied / ".venv.lab7.old")
    assert result(run(copied, "figures")) == DRAWN
    (copied / ".venv.lab7.old/bin").mkdir(parents=True)  # or in the moment after it
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
    environment = load(tiny).environment
    with pytest.raises(environment.Trouble, match=r"was not made by lab\.py: move it away"):
        environment.set_up()
    assert mine.read_text("utf-8") == "mine"


def test_an_environment_may_lie_on_another_disk(copied: Path, tmp_path: Path) -> None:
    (tmp_path / "disk").mkdir()
    (copied / ".venv").rename(tmp_path / "disk/venv")
    (copied / ".venv").symlink_to(tmp_path / "disk/venv", target_is_directory=True)
    listed(copied, "# newer\n")
    assert run(copied, "figures").said.endswith("figures drawn\n")
    assert (copied / ".venv").is_symlink()
    assert [path.name for path in (tmp_path / "disk").iterdir()] == ["venv"]


def test_other_environments(copied: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The site's sees all that .venv has and is kept; the one of the oldest has the book's own."""
    for name, value in around(**wheels(tmp_path)).items():
        monkeypatch.setenv(name, value)
    environment = load(copied).environment
    (copied / "site").mkdir()
    environment.SITE_LIST.write_text(make_wheel(tmp_path), "utf-8")
    python = environment.site_tools()
    show = "import driftlab, sixth_sense, sys; print(*driftlab.__path__, sys.prefix)"
    told = subprocess.check_output([python, "-E", "-c", show], encoding="utf-8")
    assert told == f"{copied / 'src/driftlab'} {copied / '.venv-site'}\n"
    made = (python.parents[1] / "driftlab.json").stat().st_mtime_ns
    assert environment.site_tools() == python
    assert (python.parents[1] / "driftlab.json").stat().st_mtime_ns == made

    pyproject = copied / "pyproject.toml"
    text = pyproject.read_text("utf-8")
    pyproject.write_text(text.replace("book = []", "book = ['sixth-sense >=0.5']"), "utf-8")
    python = environment.of_age("lowest")
    show = "import sixth_sense, sys; print(sys.prefix)"
    told = subprocess.check_output([python, "-E", "-c", show], encoding="utf-8")
    assert told == f"{copied / '.venv-lowest'}\n"


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGHUP")
@pytest.mark.parametrize("end", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_a_step_ends_with_lab_py(tiny: Path, end: str) -> None:
    step = tiny / "step.py"
    step.write_text(
        f"import os, signal, time; os.kill(os.getppid(), signal.{end}); time.sleep(60)", "utf-8"
    )
    code = (
        f"import sys; sys.path.insert(0, {str(tiny)!r})\n"
        "from bootstrap.steps import catch_signals, run_step\ncatch_signals()\n"
        f"run_step([sys.executable, {str(step)!r}])"
    )
    done = subprocess.run([sys.executable, "-c", code], stderr=subprocess.PIPE, timeout=30)
    assert b"KeyboardInterrupt" in done.stderr

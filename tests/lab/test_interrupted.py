"""A set-up that is interrupted or fails leaves the old environment, and the next one mends it."""

import signal
import subprocess
import time
from pathlib import Path
from types import SimpleNamespace

import pytest
from tiny_project import NO_INDEX, command, listed, load, run

pytestmark = pytest.mark.xdist_group("lab")


def test_an_interrupted_update_leaves_the_old_environment(
    modules: SimpleNamespace, copied: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = (copied / "environment.txt").read_text("utf-8")
    stamp = modules.environment.read_stamp()
    listed(copied, "# newer\n")
    monkeypatch.setattr(
        modules.environment, "run_step", lambda command: signal.raise_signal(signal.SIGINT)
    )
    with pytest.raises(KeyboardInterrupt):
        modules.environment.set_up()
    assert modules.environment.read_stamp() == stamp
    assert not list(copied.glob(".venv.*"))
    (copied / "environment.txt").write_text(before, "utf-8")
    assert run(copied, "figures", **NO_INDEX).said.strip() == "figures drawn"


@pytest.mark.setup
def test_a_killed_update_leaves_the_old_environment_and_heals(copied: Path) -> None:
    assert run(copied, "figures", **NO_INDEX).code == 0
    old = (copied / ".venv/driftlab.json").read_bytes()
    listed(copied, "# newer\n")
    with subprocess.Popen(command(copied, "figures"), stdout=subprocess.PIPE) as process:
        while not list(copied.glob(".venv.lab*/pyvenv.cfg")):
            assert process.poll() is None
            time.sleep(0.01)
        process.kill()
    assert (copied / ".venv/driftlab.json").read_bytes() == old
    assert load(copied).environment.is_whole()
    done = run(copied, "figures", **NO_INDEX)
    assert "The project has changed since the last set-up" in done.said
    assert "figures drawn" in done.said
    assert not list(copied.glob(".venv.lab*/driftlab.json"))


def test_an_environment_that_lacks_only_its_place_gets_it(copied: Path) -> None:
    """This is what is left if lab.py is killed in the moment between two names."""
    (copied / ".venv").rename(copied / ".venv.lab7.old")
    done = run(copied, "figures", **NO_INDEX)
    assert (done.code, done.said.strip()) == (0, "figures drawn")
    assert not list(copied.glob(".venv.*"))


def test_an_environment_that_cannot_be_put_in_place_brings_the_old_one_back(
    modules: SimpleNamespace, copied: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    real = Path.rename

    def rename(path: Path, target: Path) -> Path:
        if path.name.startswith(".venv.lab") and not path.name.endswith(".old"):
            raise PermissionError(13, "in use", str(path))
        return real(path, target)

    listed(copied, "# newer\n")
    monkeypatch.setattr(Path, "rename", rename)
    with pytest.raises(modules.environment.Trouble, match="cannot be written"):
        modules.environment.set_up()
    assert modules.environment.is_whole()
    assert not list(copied.glob(".venv.*"))

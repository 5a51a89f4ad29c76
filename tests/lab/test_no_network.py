"""Without a network the book opens with what there is, and says what is missing."""

import shutil
import subprocess
from functools import cache
from pathlib import Path
from types import SimpleNamespace

import pytest
from tiny_project import NO_INDEX, command, listed, make_wheel, run, run_as

pytestmark = pytest.mark.xdist_group("lab")


def test_without_network_the_old_environment_stays_and_the_book_opens(
    modules: SimpleNamespace, copied: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    before = (copied / "environment.txt").read_text("utf-8")
    listed(copied, f"sixth-sense==1.0 --hash=sha256:{64 * '0'}\n")
    with pytest.raises(modules.lab.Trouble, match="The package index cannot be reached: "):
        modules.lab.main(["figures"])
    said = capfd.readouterr().out
    assert said.startswith("The project has changed since the last set-up; updating")
    assert "figures drawn" not in said

    assert modules.lab.main(["--no-browser"]) == 0
    said = capfd.readouterr().out
    assert "\nMeanwhile the book opens with the packages of the last set-up.\n" in said
    assert "Drift Lab is open at" in said

    (copied / "environment.txt").write_text(before, "utf-8")
    assert modules.lab.main(["figures"]) == 0
    assert capfd.readouterr().out.strip() == "figures drawn"


@cache
def unplugged() -> list[str]:
    """What runs a command without any network; only Linux has it, and not for everybody."""
    call = [shutil.which("unshare") or "", "--net"]
    try:
        subprocess.run([*call, "true"], check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        return []
    return call


@pytest.mark.setup
def test_a_first_start_without_network_leaves_nothing_and_the_next_one_mends_it(
    tiny: Path, tmp_path: Path
) -> None:
    listed(tiny, make_wheel(tmp_path))
    for arguments in (["figures"], ["--no-browser"]):
        done = run_as([*unplugged(), *command(tiny, *arguments)], **NO_INDEX)
        assert done.code == 1
        assert done.complained.startswith("The package index cannot be reached: check the network")
        assert done.complained.count("\n") == 0
        assert "Meanwhile" not in done.said  # there is nothing to open it with
        assert not list(tiny.glob(".venv*"))
    done = run(tiny, "figures", **{**NO_INDEX, "PIP_FIND_LINKS": tmp_path.as_uri()})
    assert (done.code, done.complained) == (0, "")
    assert done.said.endswith("figures drawn\n")


@pytest.mark.skipif(not unplugged(), reason="the network cannot be taken away here")
def test_what_is_set_up_needs_no_network(finished: Path) -> None:
    done = run_as([*unplugged(), *command(finished, "figures")])
    assert (done.code, done.complained, done.said) == (0, "", "figures drawn\n")

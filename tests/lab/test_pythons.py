"""Which Pythons run lab.py, and which are refused: all that are found on this computer."""

import ast
import os
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path
from types import SimpleNamespace

import pytest
from killed import killed
from tiny_project import NO_INDEX, ROOT, run_as

LOWEST, TRIED = (3, 11), range(11, 15)
Version = tuple[int, int]


@cache
def pythons() -> dict[Version, str]:
    """The newest Python of each version that is in PATH or that pyenv has made."""
    made = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv")) / "versions"
    candidates = [str(path) for path in sorted(made.glob("3.*/bin/python"))]
    candidates += filter(None, [shutil.which(f"python3.{minor}") for minor in range(6, 20)])
    found = {sys.version_info[:2]: sys.executable}
    for python in candidates:
        ask = [python, "-c", "import sys; print(*sys.version_info[:2])"]
        told = subprocess.run(ask, capture_output=True, text=True)
        if told.returncode == 0:
            major, minor = map(int, told.stdout.split())
            found.setdefault((major, minor), python)
    return found


def python_of(version: Version) -> str:
    if version not in pythons():
        pytest.skip("it is not on this computer")
    return pythons()[version]


def started(version: Version, *arguments: str, folder: Path = ROOT) -> SimpleNamespace:
    return run_as([python_of(version), str(folder / "lab.py"), *arguments], **NO_INDEX)


of_all_new = pytest.mark.parametrize(
    "version", [(3, minor) for minor in TRIED], ids=lambda version: f"3.{version[1]}"
)


@of_all_new
def test_a_new_python_shows_the_help(version: Version) -> None:
    done = started(version, "--help")
    assert (done.code, done.complained) == (0, "")
    assert done.said.startswith("Drift Lab: ")


@of_all_new
@pytest.mark.skipif(os.name == "nt", reason="Windows has no fork")
def test_a_new_python_makes_an_environment_and_copies_and_mends_them(
    tiny: Path, version: Version
) -> None:
    """Packages come from nowhere here; all else that lab.py does before there are any is real."""
    told = killed(tiny, "move", python_of(version))
    assert told["mended"] == [told["whole"]] * len(told["left"])
    assert f".venv/lib/python3.{version[1]}/site-packages/driftlab.pth" in told["whole"]


@pytest.mark.parametrize("minor", range(6, LOWEST[1]))
def test_an_old_python_is_refused_in_a_sentence(minor: int) -> None:
    done = started((3, minor), "--help")
    assert (done.code, done.said) == (1, "")
    assert done.complained.startswith(f"Drift Lab needs Python 3.11 or newer; this is 3.{minor}.")
    assert done.complained.count("\n") == 0


@pytest.mark.setup
def test_another_python_makes_the_environment_anew(tiny: Path) -> None:
    """And the first one does so again: neither is in the way of the other."""
    others = [version for version in sorted(pythons()) if version > sys.version_info[:2]]
    if not others:
        pytest.skip("there is no newer Python on this computer")
    for version in (sys.version_info[:2], others[-1]):
        done = started(version, "figures", folder=tiny)
        assert (done.code, done.complained) == (0, "")
        assert done.said.endswith("figures drawn\n")
    assert done.said.startswith(f"Making the environment anew, for CPython 3.{version[1]}.")
    assert started(version, "figures", folder=tiny).said == "figures drawn\n"


def test_an_old_python_reads_lab_py_as_far_as_the_refusal() -> None:
    ast.parse((ROOT / "lab.py").read_text("utf-8"), feature_version=(3, 6))
    pretend = (
        "import platform, runpy, sys; sys.version_info = (3, 9, 18);"
        "platform.python_version = lambda: '3.9.18'; runpy.run_path(sys.argv[1])"
    )
    done = subprocess.run(
        [sys.executable, "-c", pretend, str(ROOT / "lab.py")], capture_output=True, text=True
    )
    assert done.returncode == 1
    assert done.stderr.startswith("Drift Lab needs Python 3.11 or newer; this is 3.9.18. Install")
    assert done.stderr.count("\n") == 1

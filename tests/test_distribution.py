"""Source distribution and wheel: built, looked through, installed with NumPy and SciPy, used."""

import os
import re
import shutil
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from email.message import Message
from email.parser import Parser
from importlib import metadata
from pathlib import Path
from typing import NamedTuple

import pytest
from packaging.requirements import Requirement

import driftlab
from support import ROOT

pytestmark = [pytest.mark.setup, pytest.mark.xdist_group("distribution")]

NOT_SHIPPED = (".ci/", ".gitattributes", ".gitignore")
BUILD = "import sys; from flit_core import buildapi; getattr(buildapi, sys.argv[1])(sys.argv[2])"
TESTS_NEED = ("pytest", "hypothesis", "mpmath")
NUMERIC = ("tests/drift/test_closed_motion.py", "tests/test_rotate.py")


class Built(NamedTuple):
    source: Path  # the source distribution, unpacked
    names: set[str]  # of its files
    wheel: Path


class Installed(NamedTuple):
    python: Path
    packages: Path  # its site-packages
    away: Path  # an empty folder to start it in


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Built:
    """As the release does: the source distribution, and from that the wheel. No network."""
    folder = tmp_path_factory.mktemp("dist")
    run(sys.executable, "-c", BUILD, "build_sdist", folder, cwd=ROOT)
    [archive] = folder.glob("*.tar.gz")
    with tarfile.open(archive) as tar:
        tar.extractall(folder, filter="data")
        names = {name.partition("/")[2] for name in tar.getnames()}
    assert archive.stat().st_size < 10e6  # no recording, output or screenshot slipped in
    source = folder / archive.name.removesuffix(".tar.gz")
    run(sys.executable, "-c", BUILD, "build_wheel", folder, cwd=source)
    [wheel] = folder.glob("*.whl")
    return Built(source, names, wheel)


@pytest.fixture(scope="module")
def installed(built: Built, tmp_path_factory: pytest.TempPathFactory) -> Installed:
    """The wheel in an environment of its own, with NumPy and SciPy and nothing else."""
    folder = tmp_path_factory.mktemp("alone")
    run(sys.executable, "-m", "venv", "--without-pip", folder / "venv")
    python = folder / "venv" / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    asked = "import sysconfig; print(sysconfig.get_path('purelib'))"
    packages = Path(run(python, "-c", asked).stdout.strip())
    lay(("numpy", "scipy"), packages)
    away = folder / "away"
    away.mkdir()
    uv = (sys.executable, "-m", "uv", "pip", "install", "--quiet", "--offline", "--no-deps")
    run(*uv, "--python", python, built.wheel, cwd=away)
    return Installed(python, packages, away)


def lay(names: tuple[str, ...], folder: Path) -> None:
    """Link packages of the present environment, with all that they need, into a folder."""
    waiting, done = list(names), set()
    while waiting:
        name = waiting.pop()
        if name in done:
            continue
        done.add(name)
        one = metadata.distribution(name)
        tops = {file.parts[0] for file in one.files or () if file.parts[0] not in ("..", ".")}
        for top in tops - {"__pycache__"}:
            place = Path(one.locate_file(top))
            try:
                (folder / top).symlink_to(place)
            except OSError:  # Windows allows links to few
                (shutil.copytree if place.is_dir() else shutil.copyfile)(place, folder / top)
        needs = map(Requirement, one.requires or ())
        waiting += [
            need.name for need in needs if not need.marker or need.marker.evaluate({"extra": ""})
        ]


def run(
    *command: object, cwd: Path | None = None, code: int = 0, path: object = ""
) -> subprocess.CompletedProcess[str]:
    """Run a command without this environment's paths; `path` is searched first for modules."""
    surroundings = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "PYTEST"))}
    surroundings |= {"PYTHONPATH": str(path)} if path else {}
    surroundings |= {"PYTHONDONTWRITEBYTECODE": "1", "PYTHONUTF8": "1"}
    done = subprocess.run(
        list(map(str, command)), cwd=cwd, env=surroundings, capture_output=True, encoding="utf-8"
    )
    assert done.returncode == code, done.stdout[-3000:] + done.stderr[-3000:]
    return done


def about(wheel: Path) -> Message:
    with zipfile.ZipFile(wheel) as file:
        [name] = [name for name in file.namelist() if name.endswith(".dist-info/METADATA")]
        return Parser().parsestr(file.read(name).decode("utf-8"))


def test_the_source_distribution_holds_the_whole_project(built: Built) -> None:
    for name in ("ERRATA.md", "CITATION.cff", "lab.py", "tests/support.py", "docs/using.md"):
        assert name in built.names
    if (ROOT / ".git").exists():
        listing = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
        ours = run(*listing, cwd=ROOT).stdout.split("\0")
        there = {name for name in ours if (ROOT / name).is_file()}
        shipped = {name for name in there if not name.startswith(NOT_SHIPPED)}
        assert built.names == shipped | {"PKG-INFO"}


def test_the_wheel_holds_the_package_and_its_licences(built: Built) -> None:
    with zipfile.ZipFile(built.wheel) as file:
        names = set(file.namelist())
    package = {name.removeprefix("src/") for name in built.names if name.startswith("src/")}
    assert {name for name in names if ".dist-info/" not in name} == package
    head = f"driftlab-{driftlab.__version__}.dist-info"
    licences = ("LICENSE", "LICENSES/BSD-3-Clause.txt", "LICENSES/CC-BY-4.0.txt")
    assert {f"{head}/licenses/{name}" for name in licences} < names
    assert built.wheel.stat().st_size < 5e6


def test_the_wheel_says_what_an_index_asks(built: Built) -> None:
    said = about(built.wheel)
    assert (said["Name"], said["Version"]) == ("driftlab", driftlab.__version__)
    assert said["License-Expression"] == "BSD-3-Clause AND CC-BY-4.0"
    assert said["Keywords"]
    assert "Intended Audience :: Education" in said.get_all("Classifier")
    needs = [Requirement(need) for need in said.get_all("Requires-Dist")]
    assert [need.name for need in needs if not need.marker] == ["numpy", "scipy"]
    urls = dict(line.split(", ") for line in said.get_all("Project-URL", []))
    known = tomllib.loads((ROOT / "release/release.toml").read_text("utf-8"))["urls"]
    assert urls == {name: url for name, url in known.items() if url}
    assert said.get_payload().startswith("# Drift Lab")
    assert not re.search(r"!\[|\]\((?!https://)", said.get_payload())


def test_the_package_alone_calibrates_aligns_and_integrates(installed: Installed) -> None:
    code = """
        import sys
        import numpy as np
        import driftlab as dl
        bent = np.array([[0, 2e-3, 0], [0, 0, 0], [0, 0, 0]])
        print(np.isclose(dl.drift_per_revolution([1, 1, 0], bent), 2 * np.pi * 1e-3, rtol=1e-3))
        print(dl.integrate(np.full((8, 3), 1e-3), "two-step-4").shape)
        trial, rng = dl.calibration.TurntableTrial(), np.random.default_rng(1)
        found = trial.run(rng, imu_errors=dl.imu.TYPICAL_ERRORS)
        bias = found.calibration.imu_errors.gyro_bias
        print(np.allclose(bias, dl.imu.TYPICAL_ERRORS.gyro_bias, rtol=0.2))
        print(round(float(np.degrees(dl.align([4.6e-5, 0, 5.7e-5], [0, 9.8, 0]).pitch))))
        print(dl.__file__)
        print({"IPython", "jupyterlab", "matplotlib", "sympy"} & sys.modules.keys())
    """
    code = "\n".join(line.strip() for line in code.splitlines())
    lines = run(installed.python, "-c", code, cwd=installed.away).stdout.splitlines()
    home = str(installed.packages / "driftlab" / "__init__.py")
    assert lines == ["True", "(4, 4)", "True", "0", home, "set()"]


def test_commands_of_the_package_alone(installed: Installed) -> None:
    command = (installed.python, "-m", "driftlab")
    assert "driftlab.quaternion: " in run(*command, cwd=installed.away).stdout
    assert run(*command, "--version").stdout == f"driftlab {driftlab.__version__}\n"


@pytest.mark.parametrize(
    "asked",
    [
        "import driftlab.symbolic",
        "from driftlab.symbolic import vector",
        "import driftlab; driftlab.book",
        "import driftlab; driftlab.book.figure('03-drift-map')",
        "from driftlab.book.panels import EXPLORERS",
        *["import driftlab; driftlab.figure('03-drift-map')"] * ("figure" in driftlab.__all__),
    ],
)
def test_what_needs_more_says_in_a_sentence_how_to_get_it(installed: Installed, asked: str) -> None:
    last = run(installed.python, "-c", asked, code=1, cwd=installed.away).stderr.splitlines()[-1]
    needed = r"ModuleNotFoundError: driftlab\.\w+ needs [\w, ]+, not installed here: "
    assert re.fullmatch(needed + r"pip install driftlab\[book\] brings all .*\.", last)


def test_numeric_tests_of_the_source_distribution_pass_on_the_installed_package(
    installed: Installed, built: Built, tmp_path: Path
) -> None:
    lay(TESTS_NEED, tmp_path)
    options = ("-q", "-p", "no:cacheprovider", "--hypothesis-profile=quick", *NUMERIC)
    done = run(*(installed.python, "-m", "pytest", *options), cwd=built.source, path=tmp_path)
    assert re.search(r"^\d+ passed in", done.stdout, re.MULTILINE)


def test_an_installed_book_writes_only_where_it_is_told(installed: Installed) -> None:
    """With this environment's packages around it, but `driftlab` from the wheel."""
    command = (sys.executable, "-m", "driftlab.book", "errata")
    refused = run(*command, code=2, cwd=installed.away, path=installed.packages)
    assert refused.stderr.endswith("the following arguments are required: --output/-o\n")
    run(*command, "--output", "errors.md", cwd=installed.away, path=installed.packages)
    [written] = installed.away.iterdir()
    assert written.read_bytes() == (ROOT / "ERRATA.md").read_bytes()
    written.unlink()

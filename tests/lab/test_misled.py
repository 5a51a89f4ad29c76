"""Settings and variables of the user that would mislead pip, Python or Jupyter do not."""

import re
import sys
import zipfile
from pathlib import Path
from types import SimpleNamespace

import pytest
from tiny_project import NO_INDEX, ROOT, listed, load, make_wheel, run

pytestmark = pytest.mark.xdist_group("lab")


@pytest.mark.parametrize("setting", ["target", "prefix"])
def test_pip_settings_that_lead_packages_elsewhere_are_noticed(
    modules: SimpleNamespace, copied: Path, tmp_path: Path, setting: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    listed(copied, make_wheel(tmp_path))
    settings = tmp_path / "pip.conf"
    elsewhere = tmp_path / "elsewhere"
    settings.write_text(
        f"[install]\n{setting} = {elsewhere}\n[global]\nfind-links = {tmp_path}\n", "utf-8"
    )
    monkeypatch.setenv("PIP_CONFIG_FILE", str(settings))
    with pytest.raises(modules.environment.Trouble, match=r"did not put sixth-sense==1\.0 into"):
        modules.environment.set_up()
    assert modules.environment.is_whole()  # the old one


def test_variables_that_mislead_pip_do_nothing(
    modules: SimpleNamespace, copied: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    listed(copied, make_wheel(tmp_path))
    listed(copied, f"seventh==1.0 ; python_version < '3' --hash=sha256:{64 * '0'}\n")
    (tmp_path / "constraints.txt").write_text("sixth-sense==2.0\n", "utf-8")
    for name in ("TARGET", "PREFIX", "ROOT"):
        monkeypatch.setenv(f"PIP_{name}", str(tmp_path / "elsewhere"))
    for name in ("DRY_RUN", "USER", "REQUIRE_HASHES", "QUIET"):
        monkeypatch.setenv(f"PIP_{name}", "1")
    monkeypatch.setenv("PIP_CONSTRAINT", str(tmp_path / "constraints.txt"))
    monkeypatch.setenv("PIP_PYTHON", sys.executable)
    monkeypatch.setenv("PIP_FIND_LINKS", str(tmp_path))
    modules.environment.set_up()
    assert any(copied.glob(".venv/**/sixth_sense.py"))
    assert not (tmp_path / "elsewhere").exists()


@pytest.fixture(scope="session")
def misleading(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str | None]:
    """Variables of strangers and of an environment that is active; no HOME and no programs."""
    folder = tmp_path_factory.mktemp("misleading")
    for name in ("driftlab", "jupyterlab", "pip", "zmq"):
        (folder / f"{name}.py").write_text("raise SystemExit('a stranger')\n", "utf-8")
    return {
        "PYTHONPATH": str(folder),
        "PYTHONHOME": sys.base_prefix,
        "VIRTUAL_ENV": str(folder),
        "CONDA_PREFIX": str(folder),
        "CONDA_DEFAULT_ENV": "base",
        "PIP_REQUIRE_VIRTUALENV": "1",
        "HOME": None,
        "USERPROFILE": None,
        "PATH": "",
    }


VARIABLES = ("PYTHONPATH", "PYTHONHOME", "VIRTUAL_ENV", "CONDA_PREFIX", "HOME", "PATH")


@pytest.mark.parametrize("name", VARIABLES)
def test_a_variable_misleads_no_command(
    finished: Path, misleading: dict[str, str | None], name: str
) -> None:
    """Without a PATH there is no git, either."""
    done = run(finished, "figures", **NO_INDEX, **{name: misleading[name]})
    assert (done.code, done.complained, done.said.strip()) == (0, "", "figures drawn")


def test_what_lab_py_starts_belongs_to_its_own_environment(
    tiny: Path, misleading: dict[str, str | None], monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("PYTHONPATH", "PYTHONHOME", "VIRTUAL_ENV", "PATH"):
        monkeypatch.setenv(name, str(misleading[name]))
    steps = load(tiny).steps
    around = steps.surroundings()
    assert not {"PYTHONPATH", "PYTHONHOME"} & around.keys()
    assert around["VIRTUAL_ENV"] == str(tiny / ".venv")
    assert around["PATH"] == str(tiny / ".venv" / steps.BIN)


def test_a_home_that_cannot_be_made_stops_nothing(copied: Path) -> None:
    """The book opens, from its own places, and brings clean notebooks."""
    nowhere = str(copied / "lab.py" / "home")
    for arguments in (["--no-browser"], ["fresh"]):
        done = run(copied, *arguments, **NO_INDEX, HOME=nowhere, XDG_CACHE_HOME=None)
        assert (done.code, done.complained) == (0, "")


@pytest.mark.setup
def test_a_set_up_is_not_misled(tiny: Path, misleading: dict[str, str | None]) -> None:
    done = run(tiny, "figures", **NO_INDEX, **misleading)
    assert (done.code, done.complained) == (0, "")
    assert done.said.endswith("figures drawn\n")
    assert run(tiny, "--no-browser", **NO_INDEX).code == 0


def test_inside_another_environment_it_is_made_from_the_python_below(finished: Path) -> None:
    """The tests' Python belongs to one; when that goes, the book's stays."""
    settings = dict(
        re.findall(r"^([\w-]+) = (.*)$", (finished / ".venv/pyvenv.cfg").read_text("utf-8"), re.M)
    )
    assert settings["include-system-site-packages"] == "false"
    if sys.prefix != sys.base_prefix:
        assert not Path(settings["home"]).is_relative_to(sys.prefix)


def test_python_may_keep_what_it_has_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTHONDONTWRITEBYTECODE", "1")
    assert "PYTHONDONTWRITEBYTECODE" not in load(ROOT).steps.surroundings()


def test_a_package_with_other_contents_is_not_installed(
    modules: SimpleNamespace, copied: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    listed(copied, make_wheel(tmp_path))
    with zipfile.ZipFile(tmp_path / "sixth_sense-1.0-py3-none-any.whl", "a") as wheel:
        wheel.writestr("more.py", "")
    monkeypatch.setenv("PIP_FIND_LINKS", str(tmp_path))
    with pytest.raises(modules.environment.Trouble, match=r"What came as sixth-sense==1\.0"):
        modules.environment.set_up()
    assert modules.environment.is_whole()


def test_what_jupyterlab_cannot_write_is_named(copied: Path) -> None:
    (copied / "nowhere").write_text("", "utf-8")
    done = run(copied, "open", "--no-browser", JUPYTER_RUNTIME_DIR=str(copied / "nowhere"))
    assert done.code == 1
    assert "nowhere" in done.complained
    assert len(done.complained.splitlines()) == 2

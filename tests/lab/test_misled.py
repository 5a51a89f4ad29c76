"""Settings and variables of the user that would mislead pip, Python or Jupyter do not."""

import sys
import zipfile
from pathlib import Path
from types import SimpleNamespace

import pytest
from tiny_project import ROOT, listed, load, make_wheel, run

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

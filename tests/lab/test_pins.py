"""Which packages lab.py brings: the lists agree with pyproject.toml and with each other."""

import re
from pathlib import Path
from types import SimpleNamespace

import pytest
from packaging.requirements import Requirement
from tiny_project import ROOT, load


def test_environment_txt_was_written_from_the_present_pyproject_toml() -> None:
    line = load(ROOT).environment.lock_line()
    assert line in (ROOT / "environment.txt").read_text("utf-8"), "run 'python3 lab.py lock'"


def test_environment_txt_pins_every_package_with_hashes_and_names_no_index() -> None:
    text = (ROOT / "environment.txt").read_text("utf-8")
    pin = r"[a-z0-9-]+==[^ \n]+( ; [^\\\n]+)?( \\\n    --hash=sha256:[0-9a-f]{64})+"
    assert re.fullmatch(rf"(#.*\n)*({pin}\n)+", text)
    pins = load(ROOT).environment.pins()
    assert len(pins) == text.count("==") - text.count(" == ")
    assert "ipywidgets==8.1.8" in pins  # 8.1.9 draws nothing in VS Code


def test_the_library_needs_numpy_and_scipy_only() -> None:
    needs = load(ROOT).environment.project()["project"]["dependencies"]
    assert [need.split()[0] for need in needs] == ["numpy", "scipy"]


def test_the_list_of_the_oldest_packages_begins_where_pyproject_toml_does() -> None:
    """`python3 lab.py lowest` would else try something newer than what is allowed."""
    about = load(ROOT).environment.project()["project"]
    wanted = [*about["dependencies"], *about["optional-dependencies"]["book"]]
    listed = (ROOT / "bootstrap/lowest.txt").read_text("utf-8")
    for need in map(Requirement, wanted):
        (floor,) = (one.version for one in need.specifier if one.operator == ">=")
        pinned = re.search(rf"^{need.name}==([^\s;]+)", listed, re.MULTILINE)[1]
        assert need.specifier.contains(pinned)
        assert f"{pinned}.".startswith(f"{floor}."), need


def test_binder_pins_what_environment_txt_pins_and_no_jupyter() -> None:
    """Binder's own JupyterLab and Notebook go together; another JupyterLab would part them."""
    lines = (ROOT / ".binder/requirements.txt").read_text("utf-8").splitlines()
    *pins, package = (line for line in lines if not line.startswith("#"))
    assert package == "-e .[book]"
    assert set(pins) <= set(load(ROOT).environment.pins())
    assert {pin.partition("==")[0] for pin in pins} >= {"numpy", "scipy", "matplotlib", "sympy"}
    assert "jupyter" not in "".join(pins)
    about = load(ROOT).environment.project()["project"]
    assert "jupyterlab" not in "".join(about["optional-dependencies"]["book"])
    python = (ROOT / ".binder/runtime.txt").read_text("utf-8").strip()
    tried = "Programming Language :: Python :: " + python.removeprefix("python-")
    assert tried in about["classifiers"]


def test_a_lock_that_fails_leaves_environment_txt(
    checks: SimpleNamespace, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = (ROOT / "environment.txt").read_bytes()
    monkeypatch.setattr(checks.lab, "run", lambda *words: 2)
    with pytest.raises(checks.lab.Trouble, match=r"environment\.txt stays as it is"):
        checks.lab.main(["lock"])
    assert (ROOT / "environment.txt").read_bytes() == before


def test_a_lock_writes_all_lists(tiny: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    modules = load(tiny)
    (tiny / "site").mkdir()
    with (tiny / "pyproject.toml").open("a", encoding="utf-8") as file:
        file.write('[project.optional-dependencies]\nsite = ["furo"]\nbook = ["sympy"]\n')
    pins = {"environment.new": "numpy==2.0 \\\n    --hash=sha256:ab\n"}
    pins["site/packages.new"] = (
        f"furo==1 ; sys_platform \\\n    --hash=sha256:cd\n{pins['environment.new']}"
    )

    def resolve(*words: str) -> int:
        if "lowest-direct" in words:
            pins[Path(words[-1]).as_posix()] = "sympy==1.13\n"
        (tiny / words[-1]).write_text(pins[Path(words[-1]).as_posix()], "utf-8")
        return 0

    monkeypatch.setattr(modules.lab, "run", resolve)
    monkeypatch.setattr(modules.lab, "set_up", lambda: None)
    assert modules.lab.main(["lock"]) == 0
    assert modules.environment.pins() == ["numpy==2.0"]
    written = (tiny / "environment.txt").read_text("utf-8")
    assert written.startswith(modules.environment.lock_line())
    assert (tiny / "bootstrap/lowest.txt").read_text("utf-8").endswith("\nsympy==1.13\n")
    first, *rest = (tiny / "site/packages.txt").read_text("utf-8").splitlines()
    assert first.startswith("# ")
    assert rest == ["furo==1 ; sys_platform \\", "    --hash=sha256:cd"]
    assert not list(tiny.rglob("*.new"))

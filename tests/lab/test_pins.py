"""Which packages lab.py brings: the lists agree with pyproject.toml and with each other."""

import re
from types import SimpleNamespace

from packaging.requirements import Requirement
from tiny_project import ROOT, load


def test_environment_txt_has_what_pyproject_toml_asks_for() -> None:
    environment = load(ROOT).environment
    pinned = dict(pin.split(" ")[0].split("==") for pin in environment.pins())
    extras = environment.project()["tool"]["uv"]["pip"]["extra"]
    wanted = [*environment.project()["project"]["dependencies"], *environment.needs_of(extras)]
    for need in map(Requirement, wanted):
        version = pinned[need.name.lower().replace("_", "-")]
        assert need.specifier.contains(version), f"{need}: run 'python3 lab.py lock'"


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


def test_a_lock_writes_both_lists(checks: SimpleNamespace) -> None:
    assert checks.lab.main(["lock"]) == 0
    first, site = checks.ran
    assert first[-2:] == ["--output-file", "environment.txt"]
    assert {"--upgrade", "site/packages.txt", "--no-emit-package=numpy"} <= set(site)
    checks.ran.clear()
    checks.lab.COMPILE = ("-m", "uv", "mypy")  # the run of which fails
    assert checks.lab.main(["lock"]) == 1
    assert len(checks.ran) == 1

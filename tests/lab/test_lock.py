"""``lab.py lock`` writes the lists of packages, or leaves them as they are."""

from pathlib import Path
from types import SimpleNamespace

import pytest
from tiny_project import ROOT, load


def test_a_lock_that_fails_leaves_environment_txt(
    checks: SimpleNamespace, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = (ROOT / "environment.txt").read_bytes()
    monkeypatch.setattr(checks.lab, "run", lambda *words: 2)
    with pytest.raises(checks.lab.Trouble, match=r"environment\.txt stays as it is"):
        checks.lab.main(["lock"])
    assert (ROOT / "environment.txt").read_bytes() == before


def test_a_lock_writes_packages_below_what_they_were_found_for(
    tiny: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    modules = load(tiny)
    (tiny / "environment.txt").write_text("", "utf-8")

    def resolve(*words: str) -> int:
        (tiny / words[-1]).write_text("numpy==2.0\n", "utf-8")
        return 0

    monkeypatch.setattr(modules.lab, "run", resolve)
    monkeypatch.setattr(modules.lab, "set_up", lambda: None)
    assert modules.lab.main(["lock"]) == 0
    assert modules.environment.pins() == ["numpy==2.0"]
    written = (tiny / "environment.txt").read_text("utf-8")
    assert written.startswith(modules.environment.lock_line())
    assert not (tiny / "environment.new").exists()


def test_a_lock_writes_the_oldest_packages_too(tiny: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    modules = load(tiny)
    with (tiny / "pyproject.toml").open("a", encoding="utf-8") as file:
        file.write('[project.optional-dependencies]\nbook = ["sympy >=1.13"]\n')

    def resolve(*words: str) -> int:
        found = "sympy==1.13\n" if "lowest-direct" in words else "sympy==1.14\n"
        (tiny / words[-1]).write_text(found, "utf-8")
        return 0

    monkeypatch.setattr(modules.lab, "run", resolve)
    monkeypatch.setattr(modules.lab, "set_up", lambda: None)
    assert modules.lab.main(["lock"]) == 0
    assert modules.environment.pins() == ["sympy==1.14"]
    lowest = (tiny / "bootstrap/lowest.txt").read_text("utf-8")
    assert lowest == modules.beside.LOWEST_HEAD + "sympy==1.13\n"
    assert not (tiny / "bootstrap/lowest.new").exists()


def test_a_lock_writes_what_the_site_needs_beside_that(
    tiny: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    modules = load(tiny)
    (tiny / "site").mkdir()
    with (tiny / "pyproject.toml").open("a", encoding="utf-8") as file:
        file.write('[project.optional-dependencies]\nsite = ["furo"]\n')
    pins = {"environment.new": "numpy==2.0 \\\n    --hash=sha256:ab\n"}
    pins["site/packages.new"] = (
        f"furo==1 ; sys_platform \\\n    --hash=sha256:cd\n{pins['environment.new']}"
    )

    def resolve(*words: str) -> int:
        (tiny / words[-1]).write_text(pins[Path(words[-1]).as_posix()], "utf-8")
        return 0

    monkeypatch.setattr(modules.lab, "run", resolve)
    monkeypatch.setattr(modules.lab, "set_up", lambda: None)
    assert modules.lab.main(["lock"]) == 0
    first, *rest = (tiny / "site/packages.txt").read_text("utf-8").splitlines()
    assert first.startswith("# ")
    assert rest == ["furo==1 ; sys_platform \\", "    --hash=sha256:cd"]
    assert not (tiny / "site/packages.new").exists()

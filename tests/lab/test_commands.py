"""What the commands run."""

import re
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest
from tiny_project import ROOT, load


def said(lab: ModuleType, capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    assert lab.main([*arguments]) == 0
    return capsys.readouterr().out


def test_the_first_help_is_of_six_commands_and_fits_a_screen(
    capsys: pytest.CaptureFixture[str],
) -> None:
    lab = load(ROOT).lab
    first = said(lab, capsys, "--help")
    assert said(lab, capsys, "help") == said(lab, capsys, "-h") == first
    assert re.findall(r"^  (\w+) ", first, re.MULTILINE) == [
        *("open", "fresh", "test", "figures", "print", "slides")
    ]
    for page in (first, said(lab, capsys, "help", "developers")):
        lines = page.splitlines()
        assert len(lines) <= 24
        assert max(map(len, lines)) < 80


def test_help_knows_every_command_once(capsys: pytest.CaptureFixture[str]) -> None:
    lab = load(ROOT).lab
    pages = said(lab, capsys, "help") + said(lab, capsys, "help", "developers")
    assert sorted(re.findall(r"^  (\w+) ", pages, re.MULTILINE)) == sorted(lab.COMMANDS)
    for name in lab.COMMANDS:
        first, *rest = said(lab, capsys, "help", name).splitlines()
        assert first.startswith(f"  {name} ")
        assert all(line.startswith(12 * " ") for line in rest)
    with pytest.raises(Exception, match='There is no command "nothing"; there are open, '):
        lab.main(["help", "nothing"])


def test_test_checks_everything_and_ends_with_pytest(
    checks: SimpleNamespace, capsys: pytest.CaptureFixture[str]
) -> None:
    assert checks.lab.main(["test"]) == 1
    ruff, mypy, linter, tests = checks.ran
    assert (ruff, mypy, tests[1]) == (["-m", "ruff", "check"], ["-m", "mypy"], "pytest")
    assert "importlinter" in linter[1]
    assert tests[2:6] == ["-n", "3", "--dist", "loadgroup"]
    assert re.fullmatch(r"mypy failed; \d+ min \d+ s in all\n", capsys.readouterr().out)


def test_test_quick_leaves_out_what_is_slow(checks: SimpleNamespace) -> None:
    checks.lab.main(["test", "--quick"])
    assert checks.ran[-1][-3:] == [
        "--hypothesis-profile=quick",
        "-m",
        "not browser and not kernel and not long and not setup and not slow",
    ]
    assert checks.ran[0] == ["-m", "ruff", "check"]


def test_arguments_of_test_go_to_pytest_alone(checks: SimpleNamespace) -> None:
    assert checks.lab.main(["test", "tests/test_drift.py", "-x"]) == 0
    assert checks.lab.main(["test", "--quick", "-x"]) == 0
    assert checks.lab.main(["test", "--long"]) == 0
    assert checks.ran[0] == ["-m", "pytest", "tests/test_drift.py", "-x"]
    assert checks.ran[2] == ["-m", "pytest", "-m", "long", *checks.lab.AT_ONCE]
    assert checks.ran[1][:2] == ["-m", "pytest"]
    assert checks.ran[1][2:] == [*checks.lab.QUICK, "-x"]


def test_tests_of_the_site_are_those_in_its_folder(
    checks: SimpleNamespace, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("DRIFTLAB_SITE", str(tmp_path))
    for chosen in ([], ["-x"], ["tests/site/test_pages.py"]):
        checks.lab.main(["test", "--site", *chosen])
    assert [ran[-1] for ran in checks.ran] == ["tests/site", "tests/site", chosen[0]]
    monkeypatch.setenv("DRIFTLAB_SITE", str(tmp_path / "none"))
    with pytest.raises(checks.lab.Trouble, match="There is no site to test"):
        checks.lab.main(["test", "--site"])


@pytest.mark.parametrize("works", [True, False])
def test_packages_to_compare_with_are_fetched_within_the_pins(
    checks: SimpleNamespace,
    works: bool,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    fetched: list[str] = []

    def install(folder: Path, packages: list[str]) -> None:
        fetched.extend(word.split()[0] for word in packages)
        if not works:
            raise checks.lab.NoPackages("There is no network.")

    monkeypatch.setattr(checks.environment, "install", install)
    assert checks.environment.with_extras("bench", "peers") == checks.lab.PYTHON
    assert {"python-ins", "ahrs", "navtk", "polars"} <= set(fetched)
    assert any(word.startswith("numpy==") for word in fetched)  # the pins stay
    assert capsys.readouterr().out.endswith("compare with.\n") == (not works)


def test_programs_see_paths_as_the_caller_does(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lab, ran = load(ROOT).lab, []
    monkeypatch.setattr(lab, "run", lambda *words, **options: ran.append((words, options)))
    monkeypatch.chdir(tmp_path)
    python = Path("there/bin/python")
    lab.program(lambda: python, "-m", "driftlab.book", "class")(["mine", "--output=there"])
    ((words, options),) = ran
    assert words == ("-m", "driftlab.book", "class", "mine", "--output=there")
    assert options == {"python": python, "cwd": Path.cwd()}


def test_the_quick_tests_run_with_packages_of_another_age(
    checks: SimpleNamespace, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(checks.environment, "of_age", lambda age: Path(age, "bin/python"))
    for arguments in ([], ["tests/drift"]):
        assert checks.lab.main(["newest", *arguments]) == 0
    whole, chosen = checks.ran
    assert {*checks.lab.QUICK, *checks.lab.AT_ONCE} <= set(whole)
    assert set(checks.lab.QUICK) <= set(chosen)
    assert chosen[-1] == "tests/drift"
    assert "loadgroup" not in chosen


def test_wheels_are_fetched_for_this_computer_and_for_others(
    checks: SimpleNamespace, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert checks.lab.main(["wheels", str(tmp_path)]) == 0
    assert checks.lab.main(["wheels", str(tmp_path), "--system=mac", "--python=3.12"]) == 0
    own, chosen, other = checks.ran
    assert own[-2:] == ["-r", "environment.txt"]
    assert {"aarch64-apple-darwin", "3.12", "--generate-hashes"} <= set(chosen)
    assert {"--platform", "macosx_14_0_arm64", "3.12", "wheels.new"} <= set(other)
    for ran in (own, other):
        assert {"--require-hashes", "--only-binary=:all:", str(tmp_path)} <= set(ran)
    for wrong in ([], [str(tmp_path), "--python=3.99"]):
        with pytest.raises(SystemExit):
            checks.lab.main(["wheels", *wrong])
    assert "needs --system, too" in capsys.readouterr().err

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


@pytest.mark.parametrize("configured", [True, False])
def test_test_checks_everything_and_ends_with_pytest(
    checks: SimpleNamespace,
    configured: bool,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    tool = {"importlinter": {}} if configured else {}
    monkeypatch.setattr(checks.lab, "project", lambda: {"tool": tool})
    assert checks.lab.main(["test"]) == 1
    assert [command[1] for command in checks.ran if command[0] == "-m"] == [
        "ruff",
        "mypy",
        "pytest",
    ]
    assert any("importlinter" in " ".join(command) for command in checks.ran) == configured
    assert checks.ran[-1][2:6] == ["-n", "3", "--dist", "loadgroup"]
    assert "--durations=10" in checks.ran[-1]
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


@pytest.mark.parametrize("works", [True, False])
def test_programs_to_compare_with_are_fetched_within_the_pins(
    checks: SimpleNamespace,
    works: bool,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    fetched: list[str] = []

    def run_step(command: list[str], env: dict[str, str]) -> None:
        fetched.extend(command)
        if not works:
            raise checks.lab.NoPackages("There is no network.")

    monkeypatch.setattr(checks.lab, "installers", lambda folder: iter([(["uv"], {})]))
    monkeypatch.setattr(checks.lab, "run_step", run_step)
    assert checks.lab.main(["bench", "filter", "--repeats", "5"]) == 0
    peers = {"python-ins", "ahrs", "numpy-quaternion", "filterpy", "navtk"}
    assert peers <= {word.split()[0] for word in fetched}
    assert any(word.startswith("numpy==") for word in fetched)  # the pins stay
    assert checks.ran == [["benchmarks/bench.py", "filter", "--repeats", "5"]]
    assert capsys.readouterr().out.endswith("compare with.\n") == (not works)
    assert checks.lab.main(["peers"]) == 0
    assert {"distributed", "polars"} <= {word.split()[0] for word in fetched}
    assert checks.ran[-1] == ["-m", "pytest", "benchmarks"]


@pytest.mark.parametrize("option", ["-h", "--help"])
def test_who_asks_for_help_fetches_nothing(option: str, checks: SimpleNamespace) -> None:
    assert checks.lab.main(["bench", option]) == 0
    [asked] = checks.ran
    assert asked[1:] == [option]


def test_paths_of_a_class_are_seen_from_where_the_caller_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, checks: SimpleNamespace
) -> None:
    seen: list[object] = []

    def run(*arguments: str, cwd: Path) -> int:
        seen.extend([cwd, *arguments[-3:]])
        return 0

    monkeypatch.setattr(checks.lab, "run", run)
    monkeypatch.chdir(tmp_path)
    checks.lab.main(["class", "mine", "--output=there"])
    assert seen == [Path.cwd(), "class", "mine", "--output=there"]
    with pytest.raises(checks.lab.Trouble, match="Say what to read"):
        checks.lab.main(["class"])


def test_the_quick_tests_run_with_packages_of_another_age(checks: SimpleNamespace) -> None:
    for arguments in ([], ["tests/drift"]):
        assert checks.lab.quick_tests(lambda: Path("there/bin/old"), arguments) == 0
    whole, chosen = checks.ran
    assert {*checks.lab.QUICK, *checks.lab.AT_ONCE} <= set(whole)
    assert set(checks.lab.QUICK) <= set(chosen)
    assert chosen[-1] == "tests/drift"
    assert "loadgroup" not in chosen

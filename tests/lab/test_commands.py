"""What the commands run."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
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
        first, *options = said(lab, capsys, "help", name).splitlines()
        assert first.startswith(f"  {name} ")
        assert first in pages
        assert all(line.startswith(14 * " ") for line in options)
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
        "not browser and not kernel and not setup and not slow",
    ]
    assert checks.ran[0] == ["-m", "ruff", "check"]


def test_arguments_of_test_go_to_pytest_alone(checks: SimpleNamespace) -> None:
    assert checks.lab.main(["test", "tests/test_drift.py", "-x"]) == 0
    assert checks.lab.main(["test", "--quick", "-x"]) == 0
    assert checks.ran[0] == ["-m", "pytest", "tests/test_drift.py", "-x"]
    assert checks.ran[1][:2] == ["-m", "pytest"]
    assert checks.ran[1][2:] == [*checks.lab.QUICK, "-x"]


def test_the_benchmark_fetches_its_peers_and_goes_on_without(
    checks: SimpleNamespace, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    failing = checks.lab.run
    monkeypatch.setattr(checks.lab, "run", lambda *words: failing(*words) + int("pip" in words))
    assert checks.lab.main(["bench", "filter", "--repeats", "5"]) == 0
    fetched, measured = checks.ran
    peers = {"python-ins", "ahrs", "numpy-quaternion", "filterpy", "navtk"}
    assert peers <= {word.split()[0] for word in fetched}
    assert any(word.startswith("numpy==") for word in fetched)  # the pins stay
    assert measured == ["benchmarks/bench.py", "filter", "--repeats", "5"]
    assert capsys.readouterr().out == "Going on without the packages to compare with.\n"


def test_peers_are_fetched_within_the_pins_and_asked(
    checks: SimpleNamespace, capsys: pytest.CaptureFixture[str]
) -> None:
    assert checks.lab.main(["peers"]) == 0
    *fetched, asked = checks.ran
    of_each = "python-ins", "distributed", "polars"
    for command, name in zip(fetched, of_each, strict=True):
        assert name in {word.split()[0] for word in command}
        assert any(word.startswith("numpy==") for word in command)  # the pins stay
    assert asked == ["-m", "pytest", "benchmarks"]
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize("option", ["-h", "--help"])
def test_who_asks_for_help_fetches_nothing(option: str, checks: SimpleNamespace) -> None:
    assert checks.lab.main(["bench", option]) == 0
    [asked] = checks.ran
    assert asked[1:] == [option]


def test_the_paths_of_a_class_are_seen_from_where_the_caller_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lab = load(ROOT).lab
    globals_ = lab.COMMANDS["class"].__globals__
    asked: list[list[str]] = []

    @contextmanager
    def running(command: list[str]) -> Iterator[SimpleNamespace]:
        asked.append(command)
        yield SimpleNamespace(wait=lambda: 1)

    monkeypatch.setitem(globals_, "running", running)
    monkeypatch.setitem(globals_, "set_up", lambda: None)
    monkeypatch.chdir(tmp_path)
    assert lab.main(["class", "mine", "--chapters", "03,04"]) == 1
    here = Path.cwd()
    assert asked[0][-4:] == ["class", str(here / "mine"), "--chapters", "03,04"]
    lab.main(["class", "mine", "--chapters=03", "-oout", "--output=b=c"])
    assert asked[1][-3:] == ["--chapters=03", f"-o{here / 'out'}", f"--output={here / 'b=c'}"]
    with pytest.raises(globals_["Trouble"], match="Say what to read"):
        lab.main(["class"])


def test_the_quick_tests_run_with_the_oldest_packages(
    checks: SimpleNamespace, monkeypatch: pytest.MonkeyPatch
) -> None:
    ran: list[list[str]] = []

    @contextmanager
    def running(command: list[str], env: dict[str, str]) -> Iterator[SimpleNamespace]:
        assert env["VIRTUAL_ENV"] == "there"
        assert not env["JUPYTER_PATH"].startswith(str(ROOT))
        ran.append(command)
        yield SimpleNamespace(wait=lambda: 1)

    monkeypatch.setattr(checks.lab, "apart", lambda listed: Path("there/bin/old"))
    monkeypatch.setattr(checks.lab, "running", running)
    assert checks.lab.main(["lowest"]) == 1
    assert checks.lab.main(["lowest", "tests/drift"]) == 1
    whole, chosen = ran
    assert whole[:3] == [str(Path("there/bin/old")), "-m", "pytest"]
    assert {*checks.lab.QUICK, *checks.lab.AT_ONCE} <= set(whole)
    assert chosen[-1] == "tests/drift"
    assert "loadgroup" not in chosen
    assert set(checks.lab.QUICK) <= set(chosen)

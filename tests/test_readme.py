"""What README and other pages say runs: examples, commands and their options, links."""

import re
import shlex

import numpy as np
import pytest
from tiny_project import load

from driftlab.__main__ import main
from driftlab.commands import COMMANDS
from support import ROOT, printed_numbers

lab = load(ROOT).lab  # not tests/lab, which has the same name
README = ROOT / "README.md"
# The examples of helper.md continue one another; test_helper runs them.
DOCS = sorted({*(ROOT / "docs").glob("*.md")} - {ROOT / "docs/helper.md"})
PAGES = [*ROOT.glob("*.md"), *DOCS, *ROOT.glob("deployment/*.md"), *ROOT.glob("release/**/*.md")]
WITH_EXAMPLES = [README, ROOT / "release/PYPI.md", *DOCS]
EXAMPLE = re.compile(r"^```python\n(.*?)^```$(?:\n\n^```\n(.*?)^```$)?", re.DOTALL | re.MULTILINE)
"""Python code, and what it prints if the next block shows that."""
EXAMPLES = [
    pytest.param(*found.groups(), id=f"{page.stem}-{number}")
    for page in WITH_EXAMPLES
    for number, found in enumerate(EXAMPLE.finditer(page.read_text("utf-8")), 1)
]
LINES, WORDS = 120, 1300
"""A README is read by a newcomer, in some minutes."""

every_page = pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
every_page_of_today = pytest.mark.parametrize(
    "page", [page for page in PAGES if page.stem != "CHANGELOG"], ids=lambda page: page.stem
)


def test_readme_is_short():
    text = README.read_text("utf-8")
    assert len(text.splitlines()) <= LINES
    assert len(text.split()) <= WORDS


def test_every_example_is_found():
    written = sum(page.read_text("utf-8").count("```python") for page in WITH_EXAMPLES)
    assert len(EXAMPLES) == written > 0


@pytest.mark.parametrize(("code", "output"), EXAMPLES)
def test_example_runs_alone_and_prints_what_is_shown(code, output, capsys):
    """In a namespace of its own, so that nothing comes from an example above; warnings fail."""
    exec(compile(code, "README.md", "exec"), {"__name__": "__main__"})
    printed = capsys.readouterr().out
    numbers = printed_numbers(printed)
    assert numbers
    assert np.isfinite(numbers).all(), printed
    assert output in (None, printed)


def options_in(text):
    return {*re.findall(r"--[a-z][a-z-]*", text)}


def options_of(command):
    """Options of a command of lab.py, as its help has them."""
    return {*re.findall(r"^ {14}(--[\w-]+)", lab.help_text(command), re.MULTILINE)}


@every_page_of_today
def test_commands_of_lab_py_exist_with_their_options(page):
    for arguments in re.findall(r"(?:python3|py) lab\.py( [^`#\n]+)?", page.read_text("utf-8")):
        command, *rest = shlex.split(arguments) or ["open"]
        if command.startswith("-"):
            command, rest = "open", [command, *rest]
        if command == "help":
            assert lab.help_text(*(word for word in rest if word != "COMMAND"))
        elif command != "COMMAND":
            assert command in lab.COMMANDS
            assert options_in(arguments) <= options_of(command) | {"--help"}, arguments


def help_of(command, capsys):
    """Return what ``python -m driftlab COMMAND --help`` prints."""
    with pytest.raises(SystemExit, match="0"):
        main([command, "--help"])
    return capsys.readouterr().out


@every_page_of_today
def test_commands_for_a_log_exist_with_their_options(page, capsys):
    found = re.findall(
        r"python -m driftlab(?: (\w+)([^`#\n]*))?(?=[`#\n ])", page.read_text("utf-8")
    )
    for command, rest in found:
        assert command in {"", "find", *COMMANDS}, command
        if options_in(rest):
            assert options_in(rest) <= options_in(help_of(command, capsys)), rest


def test_the_commands_for_your_own_log_run(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    text = (ROOT / "docs/own-log.md").read_text("utf-8")
    commands = re.findall(r"^python -m driftlab (.*)$", text, re.MULTILINE)
    assert len(commands) > 1
    for command in commands:
        assert main(shlex.split(command)) == 0
    assert (tmp_path / "unit.html").exists()
    assert "gyro" in capsys.readouterr().out


def rows(text):
    """Commands or options of the tables of a text, and the options that stand in their rows."""
    found = re.findall(r"^\| (`[^|]*) \|(.*)$", text, re.MULTILINE)
    return {first: options_in(first + rest) for first, rest in found}


def test_the_page_of_commands_lists_all_of_them_with_every_option(capsys):
    text = (ROOT / "docs/commands.md").read_text("utf-8")
    own, logs = text.split("\n## python -m driftlab\n")
    logs, shared = logs.split("\n### ")
    assert rows(own) == {f"`{name}`": options_of(name) for name in lab.COMMANDS}
    listed = rows(logs)
    assert listed.keys() == {f"`{name}`" for name in (*COMMANDS, "find")}
    of_all = set().union(*rows(shared).values())
    for name in COMMANDS:
        there = options_in(help_of(name, capsys)) - {"--help"}
        assert listed[f"`{name}`"] == (there if name == "example" else there - of_all)
        assert name == "example" or of_all <= there


@every_page
def test_every_link_leads_to_a_file_and_its_heading(page):
    for link in re.findall(r"\]\((?!https?:)([^)\s]+)\)", page.read_text("utf-8")):
        name, _, heading = link.partition("#")
        target = page.parent / name if name else page
        assert target.exists(), link
        if heading:
            assert heading in headings(target.read_text("utf-8")), link


def headings(text):
    """Return the ends of addresses that GitHub and the site make of headings."""
    lines = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w -]", "", line.lower()).replace(" ", "-") for line in lines}

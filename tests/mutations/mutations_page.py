"""The page of what was broken, what the tests caught, and what survived and why."""

import os
import platform
import tomllib
from collections import defaultdict
from collections.abc import Iterable
from datetime import date
from importlib.metadata import version
from pathlib import Path

from kept_breaks import HUNG, Kept, Tried, digest
from numerical_parts import numerical_parts, path_of

HERE = Path(__file__).parent
REASONS = HERE / "survivors.toml"
PAGE = HERE / "mutations.md"
SAME = ("equivalent", "speed")
"""First words of a reason: nothing that is promised changes, or only time and memory do."""
_PACKAGES = ("numpy", "scipy", "hypothesis", "pytest")
_HEAD = """# What the tests notice when the package is broken

Written by `python3 lab.py mutate`, never by hand. {machine}

Each break changes one place of one module: a sign, an operator, a constant (by one, or by 1 %), \
a comparison or its boundary, two arguments, a function for its neighbour (sine and cosine, least \
and greatest, any and all), a condition turned round, a `not` dropped. Texts, errors, annotations \
and decorators are left alone. Breaks are drawn at random with a seed, so a share is an estimate: \
of {all} breaks in {modules} modules. Against each ran the quick tests that execute the broken \
line, until one failed; which is not said here, and figures and chapters, whose tests take \
longer, did not run. A break that made a test hang counts as caught ({hung} of them).

**{caught} of {all} breaks were caught, {share}.** Of those that survived, {same} do what the \
unbroken line does, or change only time and memory, for the reason that stands beside each: \
**{caught} of the {other} others were caught, {share_other}.** {left} are left.
"""
_FOOT = """
A survivor *without a test* stands in a line that no quick test executes; against one *with more \
tests* not all tests that execute its line ran, since there are many. Reasons are kept in \
[survivors.toml](survivors.toml) and were written by hand.
"""


def write_page(folder: Path) -> None:
    """Write the page from the breaks that are kept in a folder."""
    kept = [Kept(folder, name, digest(path_of(name))) for name in numerical_parts()]
    PAGE.write_text(page(kept, reasons(REASONS)), "utf-8", newline="\n")


def reasons(path: Path) -> dict[tuple[str, str, str], str]:
    """Why a break survives, by its module, the line before and the line after."""
    found = {}
    for entry in tomllib.loads(path.read_text("utf-8")).get("survivor", ()):
        for after in entry["after"]:
            found[entry["module"], entry["before"], after] = entry["reason"]
    return found


def page(modules: Iterable[Kept], known: dict[tuple[str, str, str], str]) -> str:
    """The whole page in Markdown."""
    modules = list(modules)
    tried = [each for kept in modules for each in kept.tried]
    survived = [each for each in tried if not each.failed]
    same = [each for each in survived if is_same(each, known)]
    count, caught = len(tried), len(tried) - len(survived)
    text = [
        _HEAD.format(
            machine=machine(),
            all=count,
            modules=sum(bool(kept.tried) for kept in modules),
            hung=sum(each.failed == HUNG for each in tried),
            caught=caught,
            share=share(caught, count),
            same=len(same),
            other=count - len(same),
            share_other=share(caught, count - len(same)),
            left=len(survived) - len(same),
        ),
        _table(modules, known),
    ]
    left = [each for each in survived if not is_same(each, known)]
    text += ["## Survivors that change something\n", *_listed(left, known), _FOOT]
    text += ["## Survivors that change nothing\n", *_listed(same, known)]
    if not_tried := [kept for kept in modules if kept.broken_before or not kept.tried]:
        text += ["## Not tried\n", *(f"- `{kept.module}`: {_why_not(kept)}" for kept in not_tried)]
    return "\n".join(text).rstrip("\n") + "\n"


def is_same(each: Tried, known: dict[tuple[str, str, str], str]) -> bool:
    return reason(each, known).split(":")[0] in SAME


def reason(each: Tried, known: dict[tuple[str, str, str], str]) -> str:
    return known.get((each.module, each.before, each.after), "no reason given yet")


def share(part: int, whole: int) -> str:
    """A share that never reads 100 % where something is missing."""
    return f"{int(1000 * part / whole) / 10:.1f} %" if whole else "none"


def machine() -> str:
    versions = ", ".join(f"{name} {version(name)}" for name in _PACKAGES)
    return (
        f"{date.today().isoformat()}, {platform.system()} on {platform.machine()}, "
        f"{os.cpu_count()} cores, Python {platform.python_version()}, {versions}."
    )


def _table(modules: list[Kept], known: dict[tuple[str, str, str], str]) -> str:
    rows = [
        "| module | breaks | caught | share | survive, the same | survive | share of others |",
        "| --- | --: | --: | --: | --: | --: | --: |",
    ]
    for kept in modules:
        count, survived = len(kept.tried), kept.survived
        if not count:
            continue
        same = sum(is_same(each, known) for each in survived)
        caught = count - len(survived)
        rows.append(
            f"| `{kept.module}` | {count} | {caught} | {share(caught, count)} | {same} "
            f"| {len(survived) - same} | {share(caught, count - same)} |"
        )
    return "\n".join(rows) + "\n"


def _listed(survived: list[Tried], known: dict[tuple[str, str, str], str]) -> list[str]:
    by_module = defaultdict(list)
    for each in survived:
        by_module[each.module].append(each)
    lines = []
    for module, group in by_module.items():
        lines.append(f"### {module}\n")
        for each in group:
            told = reason(each, known)
            tests = "" if each.tests else ", without a test"
            more = "" if each.complete else ", with more tests"
            lines.append(f"- line {each.line}, {each.kind}{tests}{more}: {told}")
            lines += ["  ```diff", f"  - {each.before}", f"  + {each.after}", "  ```"]
        lines.append("")
    return lines


def _why_not(kept: Kept) -> str:
    if kept.broken_before:
        return f"{kept.broken_before} fails without a break"
    return "nothing in it could be broken, or it was left out"

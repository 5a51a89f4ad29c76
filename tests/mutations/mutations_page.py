"""The page of what was broken, what the tests caught, and what survived and why."""

import math
import os
import platform
import sys
import tomllib
from collections import defaultdict
from collections.abc import Mapping, Sequence
from datetime import date
from importlib.metadata import version
from pathlib import Path

from break_part import breaks
from kept_breaks import HUNG, Kept, Tried, digest
from numerical_parts import numerical_parts, path_of

HERE = Path(__file__).parent
REASONS = HERE / "survivors.toml"
PAGE = HERE / "mutations.md"
SAME = ("equivalent", "speed")
"""First words of a reason: nothing changes, or only time and memory do."""
IMMATERIAL = "immaterial"
"""First word of a reason: something changes of which nothing is promised."""
_PACKAGES = ("numpy", "scipy", "hypothesis", "pytest")
_HEAD = """# What the tests notice when the package is broken

Written by `python3 lab.py mutate`, never by hand. {machine}

Each break changes one place of one module: a sign, an operator, a constant (by one, or by 1 %), \
a comparison or its boundary, two arguments, a function for its neighbour (sine and cosine, least \
and greatest, any and all), a condition turned round, a `not` dropped. Texts, errors, annotations \
and decorators are left alone. In all {modules} modules {places} breaks are possible; of each \
module {least} to {most} were drawn at random (seed {seed}). Against each break run those tests of \
the package's subjects that execute its line, until one fails or their time is over; the tests of \
the book, its figures, panels and chapters, are not asked. A break that makes a test hang counts \
as caught ({hung} of them). Some tests were written for what survived with seed 0, so another seed \
is the fairer question.

| | |
| --- | --: |
| breaks, in {modules} modules | {all} |
| caught | {caught} |
| **share caught, of all** | **{share}** |
| survived and change nothing, or only time and memory | {same} |
| **share caught, of those that change something** | **{share_other}** |
| survived and change something of which nothing is promised | {immaterial} |
| survived otherwise: holes in the tests | {left} |
| **share caught, with each module counted by all that could be broken in it** | **{estimate}** |
| the same, of those that change something | {estimate_other} |

The last two rows are estimates for all {places} breaks, with two standard errors; what the \
sample says of small modules counts less there than in the rows above.
"""
_KEY = """Of a survivor *in no tested line* none of these tests executes the line; *not against \
all tests* says that those which execute it take longer together than a break is given, and the \
rest did not run. Reasons were written by hand, in [survivors.toml](survivors.toml).
"""


def write_page(folder: Path, seed: int) -> None:
    """Write the page from the breaks that are kept in a folder."""
    kept, possible = [], {}
    for name in numerical_parts():
        every = breaks(path_of(name).read_text("utf-8"))
        kept.append(Kept(folder, name, digest(path_of(name)), every))
        possible[name] = len(every)
    if not any(each.tried for each in kept):
        sys.exit(f"Nothing is kept in {folder}: there is no page to write.")
    PAGE.write_text(page(kept, reasons(REASONS), possible, seed), "utf-8", newline="\n")


def reasons(path: Path) -> dict[tuple[str, str, str], str]:
    """Why a break survives, by its module, the line before and the line after."""
    found = {}
    for entry in tomllib.loads(path.read_text("utf-8")).get("survivor", ()):
        for after in entry["after"]:
            found[entry["module"], entry["before"], after] = entry["reason"]
    return found


def page(
    kept_modules: Sequence[Kept],
    known: dict[tuple[str, str, str], str],
    possible: Mapping[str, int],
    seed: int,
) -> str:
    """The whole page in Markdown; `possible` are the numbers of breaks of which some were drawn."""
    drawn = [kept for kept in kept_modules if kept.tried]
    tried = [each for kept in drawn for each in kept.tried]
    survived = [each for each in tried if not each.failed]
    same = [each for each in survived if is_same(each, known)]
    immaterial = [each for each in survived if _first_word(each, known) == IMMATERIAL]
    left = [each for each in survived if each not in same and each not in immaterial]
    caught = len(tried) - len(survived)
    text = [
        _HEAD.format(
            machine=machine(),
            modules=len(drawn),
            places=sum(possible[kept.module] for kept in drawn),
            least=min(len(kept.tried) for kept in drawn),
            most=max(len(kept.tried) for kept in drawn),
            seed=seed,
            estimate=_estimate(drawn, possible, set()),
            estimate_other=_estimate(drawn, possible, {id(each) for each in same}),
            hung=sum(each.failed == HUNG for each in tried),
            all=len(tried),
            caught=caught,
            share=share(caught, len(tried)),
            same=len(same),
            share_other=share(caught, len(tried) - len(same)),
            immaterial=len(immaterial),
            left=len(left),
        ),
        _table(drawn, known),
    ]
    text += ["## Survivors that change something\n", _KEY, *_listed(left, known)]
    text += ["## Survivors that change what is not promised\n", *_listed(immaterial, known)]
    text += ["## Survivors that change nothing\n", *_listed(same, known)]
    if not_tried := [kept for kept in kept_modules if kept.broken_before or not kept.tried]:
        text += ["## Not tried\n", *(f"- `{kept.module}`: {_why_not(kept)}" for kept in not_tried)]
    return "\n".join(text).rstrip("\n") + "\n"


def is_same(each: Tried, known: dict[tuple[str, str, str], str]) -> bool:
    """Whether a reason says that a break changes nothing."""
    return _first_word(each, known) in SAME


def _first_word(each: Tried, known: dict[tuple[str, str, str], str]) -> str:
    return reason(each, known).split(":")[0]


def reason(each: Tried, known: dict[tuple[str, str, str], str]) -> str:
    return known.get((each.module, each.before, each.after), "no reason given yet")


def share(part: int, whole: int) -> str:
    """A share that never reads 100 % where something is missing."""
    if not whole:
        return "none"
    return f"{100.0 if part == whole else min(99.9, 100 * part / whole):.1f} %"


def _estimate(modules: list[Kept], possible: Mapping[str, int], left_out: set[int]) -> str:
    """Share caught of all that is possible: a mean over strata, with two standard errors."""
    everything = mean = variance = 0.0
    for kept in modules:
        drawn = [each for each in kept.tried if id(each) not in left_out]
        if not drawn:
            continue
        # Of what is possible, as many are left out as of what was drawn.
        places = possible[kept.module] * len(drawn) / len(kept.tried)
        caught = sum(bool(each.failed) for each in drawn) / len(drawn)
        # As if one more had been drawn that may be either: a stratum without a survivor has error.
        doubt = (caught * len(drawn) + 0.5) / (len(drawn) + 1)
        rest = max(0.0, 1 - len(drawn) / places)
        everything += places
        mean += places * caught
        variance += places**2 * doubt * (1 - doubt) / len(drawn) * rest
    error = 2 * math.sqrt(variance) / everything
    return f"{100 * mean / everything:.1f} ± {100 * error:.1f} %"


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
            tests = "" if each.tests else ", in no tested line"
            more = "" if each.complete else ", not against all tests"
            lines.append(f"- line {each.line}, {each.kind}{tests}{more}: {told}")
            lines += ["  ```diff", f"  - {each.before}", f"  + {each.after}", "  ```"]
        lines.append("")
    return lines


def _why_not(kept: Kept) -> str:
    if kept.broken_before:
        return f"{kept.broken_before} fails without a break"
    return "nothing in it could be broken, or it was left out"

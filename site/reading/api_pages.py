"""The pages of the API reference, in reStructuredText: one a module, gathered by subject."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Iterator
from functools import cache
from importlib import import_module

from driftlab.__main__ import SUBJECTS
from reading.doors import BOOK, Module, Name, book, documented, first_door, modules, thing

LONGEST_VALUE = 90
"""A constant's value is shown if its text is no longer."""
TITLES = {
    "": "Ground floor",
    "motion": "Motion",
    "drift": "Drift",
    "attitude": "Attitude",
    "recordings": "Recordings",
    "calibration": "Calibration",
    "gyrocompass": "Gyrocompass",
    "symbolic": "Symbolic",
    "book": "The book's doors",
}
GROUND = "What all subjects stand on: vectors, quaternions, the Earth, axes, triads, units."


def api_pages() -> dict[str, str]:
    """Return the text of each page by its name without ending."""
    pages = {"reference/index": _index()}
    for subject in ("", *(subject for subject in SUBJECTS if subject != "book")):
        pages[subject_page(subject)] = _subject(subject)
        pages |= {module_page(module): _module(module) for module in modules(subject)}
    return pages | {subject_page("book"): _book()}


def subject_page(subject: str) -> str:
    return f"reference/{subject or 'ground_floor'}"


def module_page(module: Module) -> str:
    # The ground floor's modules may be called like a subject's page.
    return f"reference/modules/{module.name.removeprefix('driftlab.')}"


def module_title(module: Module) -> str:
    """What a module treats, as its docstring begins, without its paper and what else follows."""
    return re.split("[;:]", module.summary.rstrip("."))[0]


def _index() -> str:
    subjects = [subject_page(subject).rpartition("/")[2] for subject in TITLES]
    return "\n".join(
        [
            *_heading("API reference", "="),
            "Every public function, class and constant, with shapes, units and errors, those of "
            "the package with an example and its output, and what became of the equation that it "
            "computes. A name stands where you import it: "
            "``from driftlab.drift import drift_per_revolution``. The search box finds names, and "
            "words of the field; :ref:`genindex` lists them all. What one wants to do with them: "
            ":doc:`/i_want_to`.",
            "",
            *_heading("The first door", "-"),
            "What ``import driftlab as dl`` has at once, as ``dl.align``; the subjects below have "
            "the rest, as ``dl.calibration.covariance_analysis``.",
            "",
            *_list(first_door()),
            *_heading("By subject", "-"),
            *_toctree(subjects[:-1], depth=2),
            *_heading("The book itself", "-"),
            "Panels, scenes and experiments of the chapters, for who goes on with them.",
            "",
            *_toctree(subjects[-1:]),
        ]
    )


def _subject(subject: str) -> str:
    found = modules(subject)
    intro = _automodule(f"driftlab.{subject}") if subject else [GROUND, ""]
    pages = [module_page(module).removeprefix("reference/") for module in found]
    return "\n".join(
        [
            *_heading(TITLES[subject], "="),
            *intro,
            *(line for module in found for line in _overview(module)),
            *_toctree(pages, hidden=True),
        ]
    )


def _overview(module: Module) -> Iterator[str]:
    """A module's line on the page of its subject, and under it a line for each name."""
    title = module_title(module)
    more = module.summary.removeprefix(title).lstrip(";: ").rstrip(".")
    (said,) = plain_bars([f"``{module.name}``{f': {more}.' if more else ''}"])
    yield from [f".. rubric:: :doc:`/{module_page(module)}`", "", said, ""]
    yield from _list(module.names)


def _list(names: tuple[Name, ...]) -> Iterator[str]:
    for name in names:
        shown = name.documented.rpartition(".")[2]
        (summary,) = plain_bars([_docstring(name).partition("\n")[0]])
        yield f"- :py:obj:`{shown} <{name.documented}>`: {summary}"
    yield ""


def _module(module: Module) -> str:
    return "\n".join(
        [
            *_heading(module_title(module), "="),
            f"``{module.name}``",
            "",
            *_automodule(module.name),
            *(line for name in module.names for line in _entry(name)),
        ]
    )


def _book() -> str:
    return "\n".join(
        [
            *_heading(TITLES["book"], "="),
            *_automodule(BOOK),
            *_automodule(f"{BOOK}.scenarios"),
            *(line for name in book() for line in _entry(name, members=False)),
        ]
    )


def _entry(name: Name, members: bool = True) -> list[str]:
    if name.kind == "data":
        return _data(name)
    options = ["   :members:"] if members and name.kind == "class" else []
    return [f".. auto{name.kind}:: {name.documented}", *options, ""]


def _data(name: Name) -> list[str]:
    """A constant or a type: autodoc would look for its text at the door, where it is not."""
    value = ast.unparse(node.value) if (node := _assignment(name.home)) and node.value else ""
    shown = [f"   :value: {value}"] if 0 < len(value) <= LONGEST_VALUE else []
    text = [f"   {line}".rstrip() for line in _docstring(name).split("\n")]
    module, _, key = name.documented.rpartition(".")
    return [f".. py:data:: {key}", f"   :module: {module}", *shown, "", *plain_bars(text), ""]


def _docstring(name: Name) -> str:
    """The docstring, of a constant the string below it."""
    if name.kind != "data":
        return inspect.getdoc(thing(name.documented)) or ""
    body = _source(name.home.rpartition(".")[0]).body
    node = _assignment(name.home)
    if node is None:
        return ""
    after = body[body.index(node) + 1 :][:1]
    match after:
        case [ast.Expr(value=ast.Constant(value=str(text)))]:
            return inspect.cleandoc(text)
    return ""


def _assignment(name: str) -> ast.Assign | ast.AnnAssign | None:
    module, _, key = name.rpartition(".")
    for node in _source(module).body:
        if isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            if key in {target.id for target in targets if isinstance(target, ast.Name)}:
                return node
    return None


@cache
def _source(module: str) -> ast.Module:
    return ast.parse(inspect.getsource(import_module(module)))


def plain_bars(lines: list[str]) -> list[str]:
    """Return lines of a docstring in which the bars of ``|w|`` stay bars.

    In reStructuredText they would call for a substitution; examples, code and set formulas have
    none.
    """
    marked, apart, formula = [], False, None
    for line in lines:
        text, depth = line.strip(), len(line) - len(line.lstrip())
        if formula is not None and text and depth <= formula:
            formula = None  # a formula goes on below a blank line while it is indented
        if text.startswith(".. math::"):
            formula = depth
        apart = bool(text) and (apart or text.startswith(">>>"))
        plain = not apart and formula is None
        marked.append(re.sub(r"(`[^`]*`)|\|", _bar, line) if plain else line)
    return marked


def _bar(match: re.Match[str]) -> str:
    return match[1] or r"\|"


def _automodule(name: str) -> list[str]:
    # A function may have the name of its module, and is what a link to the name means.
    options = ["   :no-index:"] if name in documented().values() else []
    return [f".. automodule:: {name}", *options, ""]


def _heading(text: str, line: str) -> list[str]:
    return [text, line * len(text), ""]


def _toctree(pages: list[str], depth: int = 1, hidden: bool = False) -> list[str]:
    options = ["   :hidden:"] if hidden else [f"   :maxdepth: {depth}"]
    return [".. toctree::", *options, "", *(f"   {page}" for page in pages), ""]

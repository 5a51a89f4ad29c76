"""Words of the field that lead to a function: those of the tasks for which one takes it.

They stand on its page, in the index, and in the search, which leads to the function itself and to
the task's section of *I want to ...*.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from functools import cache
from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.transforms import SphinxTransform

from driftlab.__main__ import SUBJECTS
from reading.doors import FOLDER, home, names

TASKS_PAGE = "i_want_to"


@cache
def words_of_functions() -> dict[str, tuple[str, ...]]:
    """Return the words that lead to each function, by the name of its home.

    A task names helpers of other subjects as well; its words mean its own subject only.
    """
    found: dict[str, dict[str, None]] = {}
    for task in _tasks():
        subject = _subject(task["functions"][0])
        for function in task["functions"]:
            if _subject(function) == subject:
                place = home(f"driftlab.{function}")
                found.setdefault(place, {}).update(dict.fromkeys(task["words"]))
    return {place: tuple(words) for place, words in found.items()}


def _subject(function: str) -> str:
    """The subject of a function; "" for the ground floor, whose modules are one."""
    first = function.partition(".")[0]
    return first if first in SUBJECTS else ""


def words_of_tasks() -> dict[str, tuple[str, ...]]:
    """Return the words of each task, by its title."""
    return {task["title"]: tuple(task["words"]) for task in _tasks()}


def also(place: str) -> list[str]:
    """Return lines for a docstring: words by which the function at this home is looked for."""
    words = words_of_functions().get(place, ())
    return ["", f"Also: {', '.join(words)}.", ""] if words else []


@cache
def _tasks() -> list[dict[str, Any]]:
    return tomllib.loads((FOLDER / "tasks.toml").read_text("utf-8"))["task"]


class FieldWords(SphinxTransform):
    """Enter the words in the index, before Sphinx collects it."""

    default_priority = 840

    def apply(self, **options: object) -> None:
        """Put an entry of the index in front of each function, and into each section of a task."""
        for where, words, target in [*self._entries()]:
            entries = [("single", word, target, "main", None) for word in words]
            index = addnodes.index(entries=entries, inline=False)
            if isinstance(where, nodes.section):
                where.insert(1, index)
            else:
                where.parent.insert(where.parent.index(where), index)

    def _entries(self) -> Iterator[tuple[nodes.Element, tuple[str, ...], str]]:
        homes = {name.documented: name.home for name in names()}
        for signature in self.document.findall(addnodes.desc_signature):
            name = f"{signature.get('module')}.{signature.get('fullname')}"
            words = words_of_functions().get(homes.get(name, ""), ())
            if words:
                yield signature.parent, words, name
        if self.env.docname == TASKS_PAGE:
            tasks = words_of_tasks()
            for section in self.document.findall(nodes.section):
                yield section, tasks.get(section[0].astext(), ()), section["ids"][0]

"""Help with an exercise, one step at a time: a nudge, an idea, the section of the chapter.

What helps stands in the file ``hints.toml`` of each chapter, beside its exercises.
"""

from __future__ import annotations

import tomllib
from functools import cache
from importlib.resources import files
from typing import NamedTuple

from driftlab.book.chapters import CHAPTERS


class Help(NamedTuple):
    """What helps with one exercise.

    Attributes
    ----------
    section : str
        Heading of the section of the chapter in which the matter is treated.
    nudge : str
        Where to look, or what to try first.
    idea : str
        The idea that leads to the answer, not the answer.
    model : str
        How one may answer the part that only words can answer; shown after a right answer.
    """

    section: str
    nudge: str
    idea: str
    model: str = ""

    @property
    def anchor(self) -> str:
        """Where in the page the section begins, as Jupyter names it."""
        return self.section.replace(" ", "-")

    @property
    def rungs(self) -> tuple[str, str]:
        """The steps of the ladder below the section itself."""
        return self.nudge, self.idea


@cache
def hints_of(chapter: str) -> dict[str, Help]:
    """Return the help with each exercise of a chapter, "01" to "11", by the exercise's number."""
    text = (files("driftlab.book") / CHAPTERS[chapter] / "hints.toml").read_text("utf-8")
    return {number: Help(**each) for number, each in tomllib.loads(text).items()}

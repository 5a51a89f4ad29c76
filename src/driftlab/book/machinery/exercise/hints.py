"""Help with an exercise, one step at a time: a nudge, an idea, the section of the chapter.

What helps stands in the file ``hints.toml`` of each chapter, beside its exercises.
"""

from __future__ import annotations

from typing import NamedTuple


class Help(NamedTuple):
    """What helps with one exercise."""

    section: str  # heading of the section of the chapter in which the matter is treated
    nudge: str  # where to look, or what to try first
    idea: str  # the idea that leads to the answer, not the answer
    # how one may answer the part that only words can answer; shown after a right answer
    model: str = ""

    @property
    def rungs(self) -> tuple[str, str]:
        """The steps of the ladder below the section itself."""
        return self.nudge, self.idea

    @property
    def is_there(self) -> bool:
        """Whether there is any."""
        return bool(self.nudge or self.idea)


NO_HELP = Help(section="", nudge="", idea="")
"""For an exercise that is not the book's."""

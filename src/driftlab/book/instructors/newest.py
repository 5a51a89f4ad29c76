"""Of several notebooks of a student, the answers that count."""

from __future__ import annotations

from typing import NamedTuple

from driftlab.book.exercises import all_exercises
from driftlab.book.machinery.exercise.exercise import in_order

from .saved_answers import SavedAnswer, SavedNotebook

JUDGED = ("right", "wrong")
FEWEST_IN_A_SPAN = 3


class Read(NamedTuple):
    """A notebook that was read."""

    file: str
    newness: tuple[float, float]  # the larger is the newer
    is_claimed: bool  # whether only a name in it says whose it is
    saved: SavedNotebook

    @property
    def is_judged(self) -> bool:
        """Whether anything in it was answered."""
        return any(answer.status in JUDGED for answer in self.saved.answers.values())


def joined(read: list[Read]) -> tuple[dict[str, SavedAnswer], list[str]]:
    """Return the newest answer to each exercise, and sentences on the others.

    What was judged stays where a newer copy was not run, has an error or no answer; and what lies
    in a student's own folder stays where a file has the student's name in its title alone.
    """
    answers: dict[str, SavedAnswer] = {}
    whence: dict[str, int] = {}
    notes: list[str] = []
    by_age = sorted(read, key=lambda each: (not each.is_claimed, each.newness))
    for age, new in enumerate(by_age):
        replaced: set[int] = set()
        stays: dict[int, list[str]] = {}
        for number, answer in new.saved.answers.items():
            is_less = answer.status not in JUDGED
            if number in answers and is_less and answers[number].status in JUDGED:
                stays.setdefault(whence[number], []).append(number)
                continue
            replaced |= {whence[number]} if number in answers else set()
            answers[number], whence[number] = answer, age
        for old in sorted((by_age[i] for i in replaced), key=lambda each: each.file):
            if old.is_claimed and not new.is_claimed:
                notes.append(
                    f"{new.file} counts, and not {old.file}, which only names the student."
                )
            else:
                notes.append(f"{new.file} came after {old.file}, and counts.")
        notes += [_stays(by_age[i], new, numbers) for i, numbers in stays.items()]
    return answers, notes


def _stays(old: Read, new: Read, numbers: list[str]) -> str:
    statuses = {new.saved.answers[number].status for number in numbers}
    why = {"not run": "was not run", "error": "an error came before the answer there"}.get(
        statuses.pop() if len(statuses) == 1 else "", "has no answer there"
    )
    count = "counts" if len(numbers) == 1 else "count"
    return f"{new.file} came after {old.file}, but {why}: {span(numbers)} {count} as in {old.file}."


def span(numbers: list[str]) -> str:
    """Several exercises in a few words: "3.1 to 3.6" if the book has no other between them."""
    mine = sorted(numbers, key=in_order)
    book = list(all_exercises())
    if len(mine) >= FEWEST_IN_A_SPAN and mine[0] in book:
        start = book.index(mine[0])
        if book[start : start + len(mine)] == mine and len({n.split(".")[0] for n in mine}) == 1:
            return f"{mine[0]} to {mine[-1]}"
    return ", ".join(mine)

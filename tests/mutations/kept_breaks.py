"""What became of the breaks of a module, kept as lines of JSON: an interrupted run goes on."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Container, Iterable
from dataclasses import asdict, dataclass
from pathlib import Path

from break_part import Break, line_before_and_after
from numerical_parts import path_of

HUNG = "time limit"
"""Stands for the test that failed where a break ended the process."""


@dataclass(frozen=True)
class Tried:
    """A break that was run."""

    module: str
    kind: str
    line: int
    before: str
    after: str
    place: tuple[int, int, str]
    """Where it stands in the source and what was written there: a name for it."""
    failed: str
    """The test that noticed it; empty if it survived."""
    tests: int
    """How many could have run."""
    complete: bool
    """Whether these were all that execute its lines."""
    seconds: float

    @classmethod
    def of(
        cls, module: str, change: Break, failed: str, *, tests: int, complete: bool, seconds: float
    ) -> Tried:
        source = path_of(module).read_text("utf-8")
        before, after = line_before_and_after(source, change)
        return cls(
            module, change.kind, change.line, before, after, _place(change), failed,
            tests, complete, round(seconds, 2),
        )  # fmt: skip


class Kept:
    """The breaks of a module as it stands now; of one that was run twice, the last.

    Only `possible` ones: of an older run may be some that are none any more.
    """

    def __init__(self, folder: Path, module: str, source: str, possible: Iterable[Break]) -> None:
        self._possible = {_place(each) for each in possible}
        self._path = folder / f"{module}.jsonl"
        self._source = source
        self.module = module
        self.broken_before = ""
        self._tried: dict[tuple[int, int, str], Tried] = {}
        if self._path.exists():
            for line in self._path.read_text("utf-8").splitlines():
                self._read(json.loads(line))

    @property
    def tried(self) -> list[Tried]:
        return sorted(self._tried.values(), key=lambda each: each.place)

    @property
    def survived(self) -> list[Tried]:
        return [each for each in self.tried if not each.failed]

    def _read(self, told: dict) -> None:
        if told.pop("source") != self._source:
            return
        if "not tried" in told:
            self.broken_before = told["not tried"]
            return
        told["place"] = tuple(told["place"])
        each = Tried(**told)
        if each.place in self._possible:
            self._tried[each.place] = each

    def has(self, change: Break) -> bool:
        """Whether a break has been run."""
        return _place(change) in self._tried

    def survived_unexplained(self, change: Break, known: Container[tuple[str, str, str]]) -> bool:
        """Whether a break survived, and nobody has said why."""
        each = self._tried.get(_place(change))
        told = each is not None and (each.module, each.before, each.after) in known
        return each is not None and not each.failed and not told

    def add(self, each: Tried) -> None:
        self._tried[each.place] = each
        self.broken_before = ""
        self._write(asdict(each))
        if not each.failed:
            print(f"  survived: {each.module}:{each.line} {each.before}  ->  {each.after}")

    def not_tried(self, failed: str) -> None:
        """Its tests fail without any break."""
        self.broken_before = failed
        self._write({"not tried": failed})

    def _write(self, told: dict) -> None:
        with self._path.open("a", encoding="utf-8") as file:
            file.write(json.dumps({"source": self._source, **told}) + "\n")

    def summary(self) -> str:
        count = len(self.tried)
        return f"{self.module}: {count - len(self.survived)} of {count} breaks caught"


def _place(change: Break) -> tuple[int, int, str]:
    return change.start, change.end, change.new


def digest(path: Path) -> str:
    """A name for a module as it stands."""
    return hashlib.sha256(path.read_bytes()).hexdigest()[:16]

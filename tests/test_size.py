"""How much there is, against [tool.driftlab.budget] in pyproject.toml: it may shrink, not grow.

A commit that raises a number there says in its message what it removed instead. To print today's
numbers: ``python tests/test_size.py``. The limits of README.md are in ``tests/test_readme.py``.
"""

import ast
import tomllib
from collections import Counter
from pathlib import Path

import grimp

ROOT = Path(__file__).parents[1]
LONGEST = 600
"""Lines of a file."""
MOST_BY_POSITION = 6
"""Arguments of a call that have no name."""
AREAS = {
    "src": "library",
    "src/driftlab/book": "book",
    "src/driftlab/book/instructors": "class",
    "site": "site",
    "lab.py": "set-up",
    "bootstrap": "set-up",
    "deployment": "hosts and release",
    "release": "hosts and release",
    "tests": "tests",
    "benchmarks": "benchmarks",
}
"""Whose lines a file counts among: those of the innermost folder that is named here."""
CODE = {".py", ".js", ".css"}


def counts() -> dict[str, int]:
    """Return all numbers of the budget as they are."""
    lines: Counter[str] = Counter(dict.fromkeys(AREAS.values(), 0))
    long = 0
    places = [ROOT / place for place in AREAS]
    inside = (path for place in places for path in [place, *place.glob("**/*.*")])
    for path in {path for path in inside if path.suffix in CODE}:
        count = len(path.read_text("utf-8").splitlines())
        innermost = max((each for each in AREAS if path.is_relative_to(ROOT / each)), key=len)
        lines[AREAS[innermost]] += count
        long += count > LONGEST
    # Written from the ledger: docs/papers.md.
    docs = set((ROOT / "docs").glob("**/*.md")) - {ROOT / "docs/papers.md"}
    return {
        "docs, words": sum(len(page.read_text("utf-8").split()) for page in docs),
        **{f"{area}, lines": count for area, count in lines.items()},
        f"files of more than {LONGEST} lines": long,
        f"calls with more than {MOST_BY_POSITION} positional arguments": calls_by_position(),
        "underscore modules with one importer": modules_of_one(),
    }


def calls_by_position() -> int:
    trees = (ast.parse(path.read_bytes()) for path in (ROOT / "src").glob("**/*.py"))
    nodes = (node for tree in trees for node in ast.walk(tree))
    return sum(isinstance(node, ast.Call) and len(node.args) > MOST_BY_POSITION for node in nodes)


def modules_of_one() -> int:
    """Return how many modules are private to their package, and used by one other alone."""
    graph = grimp.build_graph("driftlab", cache_dir=None)
    private = [name for name in graph.modules if name.rpartition(".")[2].startswith("_")]
    return sum(len(graph.find_modules_that_directly_import(name)) == 1 for name in private)


def test_nothing_grows_and_no_number_of_the_budget_is_larger_than_it_must_be():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    budget, found = project["tool"]["driftlab"]["budget"], counts()
    assert budget.keys() == found.keys()
    # Not every commit has to lower a number: 2 % may be free, but no more than 200.
    off = {
        name: f"{count} of {budget[name]}"
        for name, count in found.items()
        if not 0 <= budget[name] - count <= min(200, budget[name] // 50)
    }
    assert not off, "write today's numbers into pyproject.toml, or remove something"


if __name__ == "__main__":
    for name, count in counts().items():
        print(f'"{name}" = {count}')

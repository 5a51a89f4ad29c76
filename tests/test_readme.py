"""Examples of the README and of the index's page run when pasted alone; links lead to files."""

import re
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from support import printed_numbers

ROOT = Path(__file__).parents[1]
README = "".join(
    (ROOT / name).read_text(encoding="utf-8") for name in ("README.md", "release/PYPI.md")
)
EXAMPLES = re.findall(r"^```python\n(.*?)^```$", README, flags=re.DOTALL | re.MULTILINE)


def test_functions_of_the_table_are_where_it_says():
    rows = [line for line in README.splitlines() if line.startswith("| ")]
    names = re.findall(r"`(driftlab\.[\w.]+)\.(\w+)`", "\n".join(rows))
    assert names
    for module, function in names:
        assert callable(getattr(import_module(module), function))


def test_every_example_is_found():
    assert EXAMPLES
    assert len(EXAMPLES) == README.count("```python")


@pytest.mark.parametrize("example", EXAMPLES, ids=range(1, len(EXAMPLES) + 1))
def test_example_runs_alone_and_prints_finite_numbers(example, capsys):
    """In a namespace of its own, so that nothing comes from an example above; warnings fail."""
    exec(compile(example, "README.md", "exec"), {"__name__": "__main__"})
    printed = capsys.readouterr().out
    numbers = printed_numbers(printed)
    assert numbers
    assert np.isfinite(numbers).all(), printed


@pytest.mark.parametrize(
    "page", [*ROOT.glob("*.md"), *(ROOT / "release").rglob("*.md")], ids=lambda page: page.name
)
def test_every_file_that_a_page_links_to_is_there(page):
    links = re.findall(r"\]\((?!https?:)([^)#\s]+)", page.read_text("utf-8"))
    assert [link for link in links if not (page.parent / link).exists()] == []

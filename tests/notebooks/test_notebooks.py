"""Every notebook is clean in the repository, runs from a clean kernel, and hides no error."""

import re
from itertools import pairwise
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient
from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_notebook

from driftlab.explorers.panel import ERROR_CLASS

FOLDER = Path(__file__).parents[2] / "notebooks"
NOTEBOOKS = sorted(
    path for path in FOLDER.rglob("*.ipynb") if ".ipynb_checkpoints" not in path.parts
)
CHAPTERS = [path for path in NOTEBOOKS if path.parent == FOLDER and path.name[:2] != "00"]
BONES = [
    "A puzzle",
    "What you will be able to do",
    "Derive",
    "Demonstrate",
    "Explore",
    "Reproduce",
    "Exercises",
    "Sources, and what was",
]
TIMEOUT = 300
"""Seconds before a cell counts as hung."""

every_notebook = pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
# nbclient and its kernel client close their sockets when they are collected, some of them late.
pytestmark = pytest.mark.filterwarnings("ignore::ResourceWarning", "ignore::DeprecationWarning")


def execute(notebook: NotebookNode) -> NotebookNode:
    NotebookClient(notebook, timeout=TIMEOUT, resources={"metadata": {"path": FOLDER}}).execute()
    return notebook


def hidden_errors(notebook: NotebookNode) -> list[str]:
    """Errors in outputs and in the state of widgets, where nbclient does not look."""
    found = [
        output.get("text", output.get("evalue", ""))
        for cell in notebook.cells
        for output in cell.get("outputs", [])
        if output.output_type == "error" or output.get("name") == "stderr"
    ]
    widgets = notebook.metadata.get("widgets", {})
    for view in (
        widgets.get("application/vnd.jupyter.widget-state+json", {}).get("state", {}).values()
    ):
        state = view["state"]
        outputs = state.get("outputs", ())
        found += [output["evalue"] for output in outputs if output["output_type"] == "error"]
        value = state.get("value")
        if isinstance(value, str) and ERROR_CLASS in value:
            found.append(value)
    return found


@every_notebook
def test_runs_from_a_clean_kernel_without_hidden_errors(path: Path) -> None:
    notebook = execute(nbformat.read(path, as_version=4))
    assert hidden_errors(notebook) == []


@every_notebook
def test_is_committed_clean(path: Path) -> None:
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    identifiers = [cell.id for cell in notebook.cells]
    assert len(set(identifiers)) == len(identifiers)
    for cell in notebook.cells:
        if cell.cell_type == "code":
            assert not cell.outputs
            assert cell.execution_count is None
            assert len(cell.source.splitlines()) <= 25, f"{cell.id} is long; move it to the package"


@every_notebook
def test_headings_go_down_one_level_at_a_time(path: Path) -> None:
    levels = [
        len(hashes)
        for cell in nbformat.read(path, as_version=4).cells
        if cell.cell_type == "markdown"
        for hashes in re.findall(r"^(#+) ", cell.source, flags=re.MULTILINE)
    ]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(after <= before + 1 for before, after in pairwise(levels))


@every_notebook
def test_links_lead_somewhere(path: Path) -> None:
    for cell in nbformat.read(path, as_version=4).cells:
        if cell.cell_type == "markdown":
            for target in re.findall(r"\]\((?!https?:)([^)#]+)\)", cell.source):
                assert (path.parent / target).exists(), target


@pytest.mark.parametrize("path", CHAPTERS, ids=lambda path: path.stem)
def test_chapter_has_its_bones_in_order(path: Path) -> None:
    text = "\n".join(
        cell.source
        for cell in nbformat.read(path, as_version=4).cells
        if cell.cell_type == "markdown"
    )
    headings = re.findall(r"^## (.*)$", text, flags=re.MULTILINE)
    assert [
        next((bone for bone in BONES if heading.startswith(bone)), heading) for heading in headings
    ] == BONES


BROKEN_EXPLORER = """
from driftlab.explorers import RootsExplorer
class Broken(RootsExplorer):
    def compute(self, values):
        if values["size"] > 0.2:
            raise ZeroDivisionError("broken")
        return super().compute(values)
explorer = Broken()
explorer
"""
MOVE_IT = """
try:
    explorer.set(size=0.3)
except ZeroDivisionError:
    pass
"""
BROKEN_INTERACT = """
from ipywidgets import interact
@interact(x=(0, 3))
def broken(x):
    raise ZeroDivisionError("broken")
"""


@pytest.mark.parametrize("cells", [[BROKEN_EXPLORER, MOVE_IT], [BROKEN_INTERACT]])
def test_hidden_errors_are_found(cells: list[str]) -> None:
    """The test above can fail: both kinds of swallowed callback error are seen."""
    notebook = execute(new_notebook(cells=[new_code_cell(source) for source in cells]))
    assert any("broken" in error for error in hidden_errors(notebook))

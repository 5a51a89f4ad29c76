"""Every notebook is clean in the repository, runs from a clean start, and hides no error."""

import re
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import nbformat
import pytest
from interpreter import run_here
from nbclient import NotebookClient
from nbconvert import SlidesExporter
from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_notebook

from driftlab.book.exercises import exercises
from driftlab.book.machinery.panel import ERROR_CLASS

FOLDER = Path(__file__).parents[2] / "notebooks"
NOTEBOOKS = sorted(
    path for path in FOLDER.rglob("*.ipynb") if ".ipynb_checkpoints" not in path.parts
)
CHAPTERS = sorted(FOLDER.glob("0[1-9]_*.ipynb")) + sorted(FOLDER.glob("1[01]_*.ipynb"))
START = FOLDER / "00_start_here.ipynb"
LEDGER = FOLDER / "12_ledger_and_glossary.ipynb"
SOLUTIONS = [FOLDER / "solutions" / path.name for path in CHAPTERS]
PAGES = [*NOTEBOOKS, *sorted(FOLDER.rglob("*.md"))]
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
TIMEOUT = 600
"""Seconds before a cell counts as hung, on a machine that is busy with other things as well."""
HEAVY = ["08", "11", "10", "06", "04"]
"""The chapters that run longest, to begin with them."""


def name_of(path: Path) -> str:
    return path.relative_to(FOLDER).as_posix()


class Run(NamedTuple):
    """A notebook of the book with all outputs of a run from a clean start."""

    path: Path
    notebook: NotebookNode


def run_in_kernel(notebook: NotebookNode) -> NotebookNode:
    NotebookClient(notebook, timeout=TIMEOUT, resources={"metadata": {"path": FOLDER}}).execute()
    return notebook


@pytest.fixture(scope="module")
def run(request, tmp_path_factory: pytest.TempPathFactory) -> Run:
    """One run for all tests of a notebook; if it fails, it fails once, for all of them."""
    path = request.param
    notebook = nbformat.read(path, as_version=4)
    if path in [START, *CHAPTERS, LEDGER]:
        return Run(path, run_in_kernel(notebook))
    with pytest.MonkeyPatch.context() as monkeypatch:
        monkeypatch.chdir(FOLDER)
        return Run(path, run_here(notebook, tmp_path_factory.mktemp("ipython")))


def runs_of(paths: list[Path]) -> pytest.MarkDecorator:
    """Parametrize a test with runs: readers' notebooks in a kernel, all others without."""

    def param(path: Path):
        name = name_of(path)
        marks = [pytest.mark.xdist_group(f"notebook-{name}")]
        if path in [START, *CHAPTERS, LEDGER]:
            marks.append(pytest.mark.kernel)
        return pytest.param(path, id=name, marks=marks)

    heaviest_first = sorted(paths, key=lambda path: path.name[:2] not in HEAVY)
    return pytest.mark.parametrize("run", [*map(param, heaviest_first)], indirect=True)


every_run = runs_of(NOTEBOOKS)
# nbclient and its kernel client close their sockets when they are collected, some of them late.
pytestmark = pytest.mark.filterwarnings("ignore::ResourceWarning", "ignore::DeprecationWarning")


def markdown(path: Path) -> str:
    """The text of a notebook or of a page."""
    if path.suffix == ".md":
        return path.read_text(encoding="utf-8")
    cells = nbformat.read(path, as_version=4).cells
    return "\n\n".join(cell.source for cell in cells if cell.cell_type == "markdown")


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


@every_run
def test_runs_from_a_clean_start_without_hidden_errors(run: Run) -> None:
    assert hidden_errors(run.notebook) == []


@every_run
def test_every_picture_has_a_caption_and_an_alternative_text(run: Run) -> None:
    for cell in run.notebook.cells:
        for output in cell.get("outputs", ()):
            data = output.get("data", {})
            if "application/vnd.jupyter.widget-view+json" in data:
                continue  # a panel describes its picture in words of its own
            assert not [kind for kind in data if kind.startswith("image/")], cell.id
            for picture in re.findall(r"<img[^>]*>", data.get("text/html", "")):
                assert re.search(r'alt="[^"]{20,}"', picture), cell.id
                assert "<figcaption>" in data["text/html"], cell.id


@pytest.mark.parametrize("path", NOTEBOOKS, ids=name_of)
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


@pytest.mark.parametrize("path", PAGES, ids=name_of)
def test_headings_go_down_one_level_at_a_time(path: Path) -> None:
    text = re.sub(r"^```.*?^```", "", markdown(path), flags=re.MULTILINE | re.DOTALL)
    levels = [len(hashes) for hashes in re.findall(r"^(#+) ", text, flags=re.MULTILINE)]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(after <= before + 1 for before, after in pairwise(levels))


@pytest.mark.parametrize("path", PAGES, ids=name_of)
def test_links_lead_somewhere(path: Path) -> None:
    for target in re.findall(r"\]\((?!https?:)([^)#]+)\)", markdown(path)):
        # JupyterLab opens no folder from a link.
        assert (path.parent / target).is_file(), target


@pytest.mark.parametrize("path", PAGES, ids=name_of)
def test_no_text_counts_on_colours(path: Path) -> None:
    words = r"\b(red|blue|green|orange|purple|violet|yellow|gr[ae]y|pink|cyan|magenta)\b"
    assert not re.findall(words, markdown(path), flags=re.IGNORECASE)


@pytest.mark.parametrize("path", CHAPTERS, ids=name_of)
def test_chapter_has_its_bones_in_order(path: Path) -> None:
    headings = re.findall(r"^## (.*)$", markdown(path), flags=re.MULTILINE)
    assert [
        next((bone for bone in BONES if heading.startswith(bone)), heading) for heading in headings
    ] == BONES


@runs_of(CHAPTERS)
def test_chapter_asks_its_exercises_and_no_other(run: Run) -> None:
    path, notebook = run
    chapter = str(int(path.name[:2]))
    expected = [n for n in exercises() if n.split(".")[0] == chapter]
    asked = re.findall(r"^### ([\d.]+) (\w+)$", markdown(path), flags=re.MULTILINE)
    assert asked == [(number, exercises()[number].kind.capitalize()) for number in expected]
    code = "\n".join(cell.source for cell in notebook.cells if cell.cell_type == "code")
    assert (
        re.findall(r'^answer = \.\.\.\ncheck\("([\d.]+)", answer\)', code, re.MULTILINE) == expected
    )
    printed = [text for cell in notebook.cells for text in printed_by(cell)]
    assert printed.count("not answered yet.") == len(expected)


@runs_of(SOLUTIONS)
def test_every_exercise_has_a_solution_that_is_right(run: Run) -> None:
    path, notebook = run
    chapter = str(int(path.name[:2]))
    expected = [n for n in exercises() if n.split(".")[0] == chapter]
    headings = re.findall(r"^## ([\d.]+) (\w+)$", markdown(path), flags=re.MULTILINE)
    assert headings == [(number, exercises()[number].kind.capitalize()) for number in expected]
    printed = [text for cell in notebook.cells for text in printed_by(cell)]
    assert len(printed) == len(expected)
    for says in printed:
        assert says.startswith("right."), says


def printed_by(cell: NotebookNode) -> list[str]:
    """What `check` said in a cell, without the exercise's number."""
    outputs = "".join(output.get("text", "") for output in cell.get("outputs", ()))
    return re.findall(r"^Exercise [\d.]+: (.*)$", outputs, flags=re.MULTILINE)


@runs_of([START, *CHAPTERS])
def test_chapter_can_be_shown_as_slides(run: Run) -> None:
    notebook = run.notebook
    types = {cell.id: cell.metadata["slideshow"]["slide_type"] for cell in notebook.cells}
    assert set(types.values()) <= {"slide", "subslide", "fragment", "-", "skip"}
    assert types[notebook.cells[0].id] == "slide"
    for cell in notebook.cells:
        shown = types[cell.id]
        # A heading opens a slide, so it must stand at the beginning of its cell.
        headings = re.findall(r"^(#+) ", cell.source, re.MULTILINE)
        if cell.cell_type == "markdown" and headings and shown != "skip":
            assert cell.source.startswith("#"), cell.id
            assert shown == ("slide" if len(headings[0]) <= 2 else "subslide"), cell.id
        if "Explorer(" in cell.source or cell.source.startswith("answer = ..."):
            assert shown == "skip", f"{cell.id}: neither sliders nor answers live on a slide"
    html, _ = SlidesExporter(exclude_input=True).from_notebook_node(notebook)
    opened = [shown for shown in types.values() if shown in ("slide", "subslide")]
    # A row of slides is a section with a section for each slide in it.
    assert html.count("<section>") == len(opened) + opened.count("slide")


def test_minutes_are_the_same_wherever_they_stand() -> None:
    readme = (FOLDER.parent / "README.md").read_text(encoding="utf-8")
    page = markdown(FOLDER / "for_instructors.ipynb")
    for path in CHAPTERS:
        number = path.name[:2]
        (stated,) = re.findall(r"About (\d+) minutes", markdown(path))
        assert re.search(rf"^\| {number} \|.*\| {stated} \|", readme, re.MULTILINE), number
        assert re.search(rf"^\| {number} [^|]*\| {stated} \|", page, re.MULTILINE), number


def test_glossary_has_three_languages_and_names_chapters() -> None:
    text = markdown(LEDGER).split("## Glossary")[1]
    rows = [
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in text.splitlines()
        if line.startswith("| ")
    ]
    header, terms = rows[0], rows[1:]
    assert header == ["English", "Russian", "Chinese", "what it means here", "chapter"]
    assert [term[0].lower() for term in terms] == sorted(term[0].lower() for term in terms)
    for english, russian, chinese, meaning, chapter in terms:
        assert re.search(r"[a-z]", english)
        assert re.search(r"[а-яё]", russian), english
        assert re.search(r"[\u4e00-\u9fff]", chinese), english
        assert meaning.endswith("."), english
        assert len(list(FOLDER.glob(f"{chapter}_*.ipynb"))) == 1, english


BROKEN_EXPLORER = """
from driftlab.book import RootsExplorer
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


def notebook_of(*cells: str) -> NotebookNode:
    return new_notebook(cells=[new_code_cell(source) for source in cells])


@pytest.mark.kernel
@pytest.mark.parametrize("cells", [[BROKEN_EXPLORER, MOVE_IT], [BROKEN_INTERACT]])
def test_hidden_errors_are_found(cells: list[str]) -> None:
    """The test above can fail: both kinds of swallowed callback error are seen."""
    notebook = run_in_kernel(notebook_of(*cells))
    assert any("broken" in error for error in hidden_errors(notebook))


BROKEN_DISPLAY = """
class Broken:
    def _repr_html_(self):
        raise ZeroDivisionError("broken")
"""


@pytest.mark.parametrize(
    "cell",
    [f"{BROKEN_DISPLAY}Broken()", f"{BROKEN_DISPLAY}display(Broken())"],
    ids=["result", "display"],
)
def test_an_error_in_what_a_cell_shows_is_found_without_a_kernel(cell: str, tmp_path: Path) -> None:
    assert hidden_errors(run_here(notebook_of(cell), tmp_path)) == ["broken"]


@pytest.mark.parametrize(
    ("cell", "error"),
    [
        ("1 / 0", ZeroDivisionError),
        ("1 +", SyntaxError),
        ("import warnings\nwarnings.warn('old', DeprecationWarning)", DeprecationWarning),
    ],
    ids=["error", "syntax", "warning"],
)
def test_a_cell_that_fails_ends_a_run_without_a_kernel(
    cell: str, error: type[Exception], tmp_path: Path
) -> None:
    with pytest.raises(error):
        run_here(notebook_of(cell), tmp_path)


def test_a_run_without_a_kernel_keeps_outputs_and_leaves_nothing_behind(tmp_path: Path) -> None:
    leaves = (
        "from matplotlib import pyplot, rcParams\nrcParams['font.size'] = 99\npyplot.figure()\n"
    )
    run_here(notebook_of(f"{leaves}kept = 1"), tmp_path)
    lines = "import sys\nprint('said')\ndisplay(2)\nprint('badly', file=sys.stderr)\n"
    cell = f"{lines}'kept' in globals(), pyplot.get_fignums(), rcParams['font.size'] == 99"
    notebook = run_here(notebook_of("from matplotlib import pyplot, rcParams", cell), tmp_path)
    shown = [
        (output.output_type, output.get("text") or output.data["text/plain"])
        for output in notebook.cells[1].outputs
    ]
    assert shown == [
        ("display_data", "2"),
        ("execute_result", "(False, [], False)"),
        ("stream", "said\n"),
        ("stream", "badly\n"),
    ]

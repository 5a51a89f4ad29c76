"""Every notebook runs from a clean start and hides no error, and its panels live.

Chapters are run in a kernel, two of them in JupyterLab in a browser. All other notebooks are run in
the process of the tests. None has a network.
"""

import re
from pathlib import Path
from typing import NamedTuple

import nbformat
import pytest
from chromium import no_browser
from interpreter import run_here
from nbclient import NotebookClient
from nbclient.output_widget import OutputWidget
from nbformat import NotebookNode
from no_network import line_for_a_kernel
from notebook_page import SCREENS, NotebookPage
from pages import (
    CHAPTERS,
    FOLDER,
    LEDGER,
    NOTEBOOKS,
    SOLUTIONS,
    START,
    markdown,
    name_of,
)
from places import PLACES, Place
from twin import Panel

from driftlab.book.exercises import all_exercises
from driftlab.book.machinery.exercise.answers import Choice
from driftlab.book.machinery.exercise.exercise import NUMBER
from driftlab.book.machinery.panel.panel import ERROR_CLASS
from driftlab.book.panels import EXPLORERS
from executed import keep

READERS = [START, *CHAPTERS, LEDGER]
IN_BROWSER = [] if no_browser() else [START, FOLDER / "03_systematic_drift.ipynb"]
"""The panels and scenes of the others are tried in the browser without their chapter."""
TIMEOUT = 600
"""Seconds before a cell counts as hung, on a machine that is busy with other things as well."""
HEAVY = ["12", "15", "09", "13", "11"]
"""The chapters that run longest, to begin with them."""


class Run(NamedTuple):
    """A notebook of the book with all outputs of a run from a clean start, and its page if any."""

    path: Path
    notebook: NotebookNode
    page: NotebookPage | None = None


class SilentOutput(OutputWidget):
    """Keeps what is written into an Output widget and tells the kernel nothing of it.

    What is sent while the answer of a cell is awaited can cost its arrival, and the client then
    sits out its whole time (nbclient issue 312).
    """

    def send(self, *arguments: object, **options: object) -> None:
        pass


def run_in_kernel(notebook: NotebookNode) -> NotebookNode:
    client = NotebookClient(notebook, timeout=TIMEOUT, resources={"metadata": {"path": FOLDER}})
    client.widget_registry = {"@jupyter-widgets/output": {"OutputModel": SilentOutput}}
    client.extra_arguments = [f"--IPKernelApp.exec_lines={line_for_a_kernel()}"]
    client.execute()
    return notebook


def run_in_browser(page: NotebookPage, name: str, notebook: NotebookNode) -> NotebookNode:
    page.server.add_notebook(name, notebook)
    page.open(name)
    page.run_all()
    page.read_through()
    return page.saved()


@pytest.fixture(scope="module")
def run(request, tmp_path_factory: pytest.TempPathFactory) -> Run:
    """One run for all tests of a notebook; if it fails, it fails once, for all of them.

    The site, the PDF and the slides are made of the same run.
    """
    path, page = request.param, None
    notebook = nbformat.read(path, as_version=4)
    if path not in READERS:
        with pytest.MonkeyPatch.context() as monkeypatch:
            monkeypatch.chdir(FOLDER)
            notebook = run_here(notebook, tmp_path_factory.mktemp("ipython"))
    elif path not in IN_BROWSER:
        notebook = run_in_kernel(notebook)
    else:
        page = request.getfixturevalue("chapter_page")
        notebook = run_in_browser(page, path.name, notebook)
        assert page.all_trouble() == []
        assert page.cells_not_run() == []
    if not hidden_errors(notebook):
        keep(name_of(path), notebook)
    return Run(path, notebook, page)


def runs_of(paths: list[Path]) -> pytest.MarkDecorator:
    """Parametrize a test with runs, the longest first."""

    def param(path: Path):
        name = name_of(path)
        group = "browser" if path in IN_BROWSER else f"notebook-{name}"
        marks = [pytest.mark.xdist_group(group)]
        if path in READERS:
            marks += [pytest.mark.kernel, pytest.mark.filterwarnings("ignore::DeprecationWarning")]
        else:
            marks.append(pytest.mark.slow)
        if path.parent.name == "papers":  # the site is built of them, too, and needs no other run
            marks.append(pytest.mark.long)
        return pytest.param(path, id=name, marks=marks)

    heaviest_first = sorted(paths, key=lambda path: path.name[:2] not in HEAVY)
    return pytest.mark.parametrize("run", [*map(param, heaviest_first)], indirect=True)


every_run = runs_of(NOTEBOOKS)
# nbclient and its kernel client close their sockets when they are collected, some of them late.
pytestmark = pytest.mark.filterwarnings("ignore::ResourceWarning")


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


def exercises_of(path: Path) -> dict[str, str]:
    """Kinds of the exercises of a chapter, as its headings say them, by number."""
    chapter = str(int(path.name[:2]))
    return {
        number: exercise.kind.capitalize()
        for number, exercise in all_exercises().items()
        if number.split(".")[0] == chapter
    }


@runs_of(CHAPTERS)
def test_chapter_asks_its_exercises_and_no_other(run: Run) -> None:
    path, notebook = run.path, run.notebook
    expected = exercises_of(path)
    asked = re.findall(rf"^### ({NUMBER.pattern}) (\w+)$", markdown(path), flags=re.MULTILINE)
    assert asked == list(expected.items()), (
        'headings such as "### 3.1 Compute" do not agree with EXERCISES of the chapter, number '
        "and kind, in their order"
    )
    code = "\n".join(cell.source for cell in notebook.cells if cell.cell_type == "code")
    because = r"because = \.\.\.  # why, in your own words\n"
    call = rf'check\("({NUMBER.pattern})", answer(, because=because)?\)'
    checked = re.findall(rf"^answer = \.\.\.\n({because})?{call}$", code, re.MULTILINE)
    assert [number for _, number, _ in checked] == list(expected), (
        "each exercise of the chapter needs a cell that ends in the two lines\n"
        'answer = ...\ncheck("3.1", answer)\nand nothing more in them, comments neither.'
    )
    asks_why = [number for line, number, said in checked if line and said]
    exercises = all_exercises(path.name[:2])
    assert asks_why == [n for n, each in exercises.items() if isinstance(each, Choice)], (
        "where statements are chosen, and only there, the cell ends in the three lines\n"
        "answer = ...\nbecause = ...  # why, in your own words\n"
        'check("3.3", answer, because=because)'
    )
    printed = [text for cell in notebook.cells for text in printed_by(cell)]
    assert printed.count("not answered yet.") == len(expected)


@runs_of(SOLUTIONS)
def test_every_exercise_has_a_solution_that_is_right(run: Run) -> None:
    path, notebook = run.path, run.notebook
    expected = exercises_of(path)
    headings = re.findall(rf"^## ({NUMBER.pattern}) (\w+)$", markdown(path), flags=re.MULTILINE)
    assert headings == list(expected.items()), (
        f'solutions/{path.name} needs a heading such as "## 3.1 Compute" and a worked solution '
        "for each exercise of the chapter, in their order"
    )
    printed = [text for cell in notebook.cells for text in printed_by(cell)]
    assert len(printed) == len(expected), "each solution ends in one check of its answer"
    for says in printed:
        assert says.startswith("right."), says


def printed_by(cell: NotebookNode) -> list[str]:
    """What `check` said in a cell, without the exercise's number."""
    outputs = "\n".join(
        output.get("data", {}).get("text/plain", "") for output in cell.get("outputs", ())
    )
    return re.findall(rf"^Exercise {NUMBER.pattern}: (.*)$", outputs, flags=re.MULTILINE)


def test_every_explorer_is_somewhere_in_the_book() -> None:
    assert {place.explorer for place in PLACES} == {explorer.__name__ for explorer in EXPLORERS}


@pytest.mark.browser
@pytest.mark.skipif(bool(no_browser()), reason=no_browser())
@runs_of([path for path in IN_BROWSER if any(place.chapter == path.name for place in PLACES)])
def test_panels_live_in_their_chapter(run: Run) -> None:
    for place in PLACES:
        if place.chapter == run.path.name:
            look_at(run.page, place)
    assert run.page.all_trouble() == []


def look_at(chapter: NotebookPage, place: Place) -> None:
    """Fail unless a panel is right, fits into the screen, and obeys a key."""
    chapter.show_cell(place.cell)
    panel = Panel.on(chapter.page, place)
    assert panel.shown.values() == panel.start
    panel.assert_agrees()
    for screen in SCREENS:
        chapter.show_on(screen)
        chapter.show_cell(place.cell)
        assert panel.shown.cut_off() == []
    slider = next(control for control in panel.twin.controls if control.is_slider)
    before = panel.shown.values()[slider.name]
    high = slider.options[-1] if slider.options else slider.high
    panel.shown.press(slider, "End" if before != high else "Home")
    panel.shown.settle()
    assert panel.shown.values()[slider.name] != before
    panel.assert_agrees()

"""The tests of the panels can fail: each kind of fault, put in on purpose, is seen."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from broken_panels import Blinking, Growing, Nameless, Raising, Wordy
from frames import blank_frames, frames_of, sizes_during
from notebook_page import NotebookPage, new_page, wait_until
from pages import notebook_of
from panel_page import PanelPage

from driftlab.book.machinery.panel.panel import Explorer

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("browser-faults")]


def show(notebook: NotebookPage, explorer_class: type[Explorer]) -> PanelPage:
    notebook.show_on("1280x800")
    name, folder = explorer_class.__name__, str(Path(__file__).parent)
    path = f"import sys; sys.path.append({folder!r})"
    notebook.show(f"{path}\nfrom broken_panels import {name}\n{name}()")
    return PanelPage(notebook.page, explorer_class)


@pytest.fixture(scope="module")
def fresh(browser, server) -> Iterator[NotebookPage]:
    """A notebook of one cell in a page that nothing has been shown in before."""
    with new_page(browser, server) as page:
        page.open(server.add_notebook("faults.ipynb", notebook_of("")))
        yield page


def test_a_blank_moment_is_seen(notebook: NotebookPage) -> None:
    panel = show(notebook, Blinking)
    azimuth = Blinking.controls[2]
    panel.bring_into_sight(azimuth)
    for _ in range(10):  # a browser that is busy may leave a frame out
        frames = frames_of(panel.page, panel.image, *panel.sweep(azimuth))
        if blank_frames(frames):
            return
    pytest.fail("no blank frame was seen")


def test_another_size_is_seen(notebook: NotebookPage) -> None:
    panel = show(notebook, Growing)

    def sweep() -> None:
        for part in panel.sweep(Growing.controls[2]):
            part()

    sizes = sizes_during(panel.page, panel.image, sweep)
    assert len(sizes) > 1


def test_a_failing_callback_is_seen(notebook: NotebookPage) -> None:
    panel = show(notebook, Raising)
    assert notebook.all_trouble() == []
    panel.press(Raising.controls[2], "End")
    panel.settle()
    trouble = notebook.all_trouble()
    assert any("ZeroDivisionError: on purpose" in text for text in trouble)


def test_a_cut_label_is_seen(notebook: NotebookPage) -> None:
    panel = show(notebook, Wordy)
    assert Wordy.controls[3].label in panel.cut_off()


def test_a_slider_without_a_name_is_seen(fresh: NotebookPage) -> None:
    panel = show(fresh, Nameless)
    assert panel.panel.locator(".noUi-handle").count() == 3
    assert panel.element(Nameless.controls[2]).count() == 0


SCRIPTS = '''
from IPython.display import Javascript
Javascript("""
  console.error("in the console");
  setTimeout(() => { throw new Error("in a script") });
  fetch("http://127.0.0.2:9/elsewhere");
""")
'''


def test_trouble_in_the_page_is_seen(fresh: NotebookPage) -> None:
    fresh.show(SCRIPTS)
    expected = {"in the console", "in a script", "network: http://127.0.0.2:9/elsewhere"}

    def all_are_seen() -> bool:
        trouble = "\n".join(fresh.all_trouble())
        return all(words in trouble for words in expected)

    wait_until(fresh.page, all_are_seen, f"trouble: {', '.join(expected)}")


def test_trouble_in_the_kernel_is_seen(notebook: NotebookPage) -> None:
    notebook.show("import warnings; warnings.warn('a warning'); 1 / 0")
    trouble = "\n".join(notebook.all_trouble())
    for words in ("a warning", "ZeroDivisionError"):
        assert words in trouble

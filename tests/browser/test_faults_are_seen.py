"""The tests of the panels can fail: each kind of fault, put in on purpose, is seen."""

from collections.abc import Iterator
from pathlib import Path

import nbformat
import pytest
from broken_panels import Blinking, Growing, Nameless, Raising, Wordy
from frames import blank_frames, frames_of, sizes_during
from nbformat.v4 import new_code_cell, new_notebook
from notebook_page import NotebookPage
from panel_page import PanelPage

KERNEL = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}


@pytest.fixture
def show(browser, server) -> Iterator:
    """Show the output of a line of code in a notebook of its own."""
    address, token, folder = server
    path = f"import sys; sys.path.append({str(Path(__file__).parent)!r})"
    opened = []

    def run(code: str) -> NotebookPage:
        notebook = new_notebook(metadata=KERNEL, cells=[new_code_cell(f"{path}\n{code}")])
        nbformat.write(notebook, folder / "broken.ipynb")
        page = NotebookPage(
            browser.new_page(viewport={"width": 1280, "height": 800}), address, token
        )
        opened.append(page)
        page.open("broken.ipynb")
        page.run_all()
        return page

    yield run
    for page in opened:
        page.close()


def panel_of(show, explorer_class) -> tuple[NotebookPage, PanelPage]:
    name = explorer_class.__name__
    page = show(f"from broken_panels import {name}\n{name}()")
    return page, PanelPage(page.page, explorer_class)


def test_a_blank_moment_is_seen(show) -> None:
    _, panel = panel_of(show, Blinking)
    azimuth = Blinking.controls[2]
    frames = frames_of(panel.page, panel.image, lambda: panel.sweep(azimuth))
    panel.settle()
    frames += frames_of(panel.page, panel.image, lambda: panel.press(azimuth, "Home"))
    assert blank_frames(frames) > 0


def test_another_size_is_seen(show) -> None:
    _, panel = panel_of(show, Growing)
    sizes = sizes_during(panel.page, panel.image, lambda: panel.sweep(Growing.controls[2]))
    assert len(sizes) > 1


def test_a_failing_callback_is_seen(show) -> None:
    page, panel = panel_of(show, Raising)
    assert page.all_trouble() == []
    panel.press(Raising.controls[2], "End")
    panel.settle()
    trouble = page.all_trouble()
    assert any("ZeroDivisionError: on purpose" in text for text in trouble)


def test_a_cut_label_is_seen(show) -> None:
    _, panel = panel_of(show, Wordy)
    assert Wordy.controls[3].label in panel.cut_off()


def test_a_slider_without_a_name_is_seen(show) -> None:
    _, panel = panel_of(show, Nameless)
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


def test_trouble_in_the_page_is_seen(show) -> None:
    page = show(SCRIPTS)
    page.page.wait_for_timeout(500)
    trouble = "\n".join(page.all_trouble())
    for words in ("in the console", "in a script", "network: http://127.0.0.2:9/elsewhere"):
        assert words in trouble


def test_trouble_in_the_kernel_is_seen(show) -> None:
    trouble = "\n".join(show("import warnings; warnings.warn('a warning'); 1 / 0").all_trouble())
    for words in ("a warning", "ZeroDivisionError"):
        assert words in trouble

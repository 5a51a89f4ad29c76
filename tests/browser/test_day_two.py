"""A chapter that was only opened is not changed, and what has no kernel any more shows a still."""

import pytest
from nbformat.sign import NotebookNotary
from notebook_page import NotebookPage, answer
from pages import LEDGER, notebook_of

from driftlab.book.machinery.panel.still import STILL_CLASS

SHOW = """
from ipywidgets import HTML, Image, VBox
from driftlab.book.machinery.panel.still import display_with_still, still
triangle = b"<svg xmlns='http://www.w3.org/2000/svg'><path d='M9 9h72v72z'/></svg>"
picture = Image(value=triangle, format="svg+xml", width=72)
widget = VBox([HTML("alive"), picture])
words = "A triangle, half of a square."
display_with_still(widget, still(triangle, "svg+xml", words, "Triangle", {}), words)
"""
HEIGHT = f"() => document.querySelector('.{STILL_CLASS}').getBoundingClientRect().height"
DIRTY = "() => window.jupyterapp.shell.currentWidget.context.model.dirty"
# The kernel has said all that it says of itself, and JupyterLab has listened.
ANSWERED = """async () => {
  const { kernel } = window.jupyterapp.shell.currentWidget.sessionContext.session;
  await Promise.all([kernel.info, kernel.spec]);
  await new Promise(resolve => setTimeout(resolve, 100));
}"""

WIDTHS = """() => [...document.querySelectorAll(".jp-RenderedMarkdown > p")].map(
  text => text.getBoundingClientRect().width / parseFloat(getComputedStyle(text).fontSize))"""

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("browser")]


def test_a_copy_that_was_only_opened_has_nothing_to_save(chapter_page: NotebookPage) -> None:
    chapter_page.open(LEDGER.name)
    answer(chapter_page.page, ANSWERED)
    assert not chapter_page.page.evaluate(DIRTY)
    # The settings and the style that lab.py brings are there too.
    assert max(chapter_page.page.evaluate(WIDTHS)) <= 46
    chapter_page.show_files(True)
    assert chapter_page.page.locator(".jp-DirListing-headerItem:visible").count() == 1


def test_a_still_stands_where_the_widget_is_gone(chapter_page: NotebookPage) -> None:
    page, server = chapter_page.page, chapter_page.server
    chapter_page.open(server.add_notebook("day_one.ipynb", notebook_of(SHOW)))
    answer(page, ANSWERED)
    assert page.evaluate(DIRTY)  # it lacks the language; so the test above would see that
    chapter_page.run_all()
    page.locator(".widget-html").wait_for()
    assert page.evaluate(HEIGHT) == 0
    page.locator("img.widget-image").wait_for()  # seen: it is a widget, and has no parts

    saved = chapter_page.saved()
    saved.metadata.pop("widgets")  # readers have this state not saved: it makes notebooks dirty
    NotebookNotary(data_dir=str(server.folder.parents[1] / "data")).sign(saved)  # as if saved so
    chapter_page.open(server.add_notebook("day_two.ipynb", saved))
    page.get_by_text("model not found").wait_for(state="attached")
    assert not page.get_by_text("model not found").is_visible()
    assert page.locator(".widget-html").count() == 0
    assert page.evaluate(HEIGHT) > 90
    assert not page.evaluate(DIRTY)

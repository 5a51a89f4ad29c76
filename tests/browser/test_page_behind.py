"""A page behind another is read to its end, and what a page never answers has an end."""

from collections.abc import Iterator

import pytest
from notebook_page import NotebookPage, answer, new_page, wait_until
from pages import notebook_of

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("browser-faults")]

LONG = "\n\n".join(["A paragraph."] * 60)
READ = """() => {
  const place = window.jupyterapp.shell.currentWidget.content.outerNode;
  return [place.scrollTop > 0, place.scrollTop + place.clientHeight >= place.scrollHeight - 1];
}"""


@pytest.fixture
def behind(browser, server) -> Iterator[NotebookPage]:
    """A long notebook in a page, and another page in front of it."""
    with new_page(browser, server) as page:
        notebook = notebook_of("")
        notebook.cells[0].cell_type, notebook.cells[0].source = "markdown", LONG
        page.open(server.add_notebook("behind.ipynb", notebook))
        front = browser.new_page()
        front.bring_to_front()
        yield page
        front.close()


@pytest.mark.parametrize("painted", [True, False])
def test_it_is_read_through(behind: NotebookPage, painted: bool) -> None:
    """Chromium may paint such a page now and then, or never."""
    if not painted:
        behind.page.evaluate("window.requestAnimationFrame = () => 0")
    behind.read_through()
    assert behind.page.evaluate(READ) == [True, True]
    wait_until(behind.page, iter([False, True]).__next__, "the second look")


def test_what_is_never_answered_has_an_end(behind: NotebookPage) -> None:
    with pytest.raises(Exception, match="Timeout 500ms exceeded"):
        answer(behind.page, "() => new Promise(() => {})", patience=0.5)
    assert answer(behind.page, "async number => number + 1", 1) == 2

"""A reader's copies in the live book: what is written stays, what is not follows the book.

Python does not start here.
"""

import json
import shutil

import pytest
from notebook_page import answer
from served import linked, served

from live.lite import MARK, mark

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("site-live")]
LONG = 240_000  # ms, for JupyterLab to open a notebook on a busy machine
CHAPTER, OWN = "03_systematic_drift.ipynb", "solutions/03_systematic_drift.ipynb"
SAVE = """async ([path, text]) => {
  const { commands } = window.jupyterapp;
  const { context, content } = await commands.execute("docmanager:open", { path });
  await context.ready;
  const code = content.widgets.find(({ model }) => model.type === "code").model;
  if (text) code.sharedModel.setSource(text);
  await context.save();
}"""
KEPT = """async () => {
  const { kept } = await import(`${location.origin}/live/copies.js`);
  const models = await kept(document.documentElement.dataset.storage);
  return Object.fromEntries(models.map(({ path, content }) => [path, content]));
}"""


@pytest.fixture
def marks(site, tmp_path):
    """The file with the marks of the book's texts, in a site of our own."""
    file = linked(site, tmp_path / "site", without="live/texts.json") / "live/texts.json"
    shutil.copy(site / "live/texts.json", file)
    return file


@pytest.fixture
def opened(page, marks):
    """Opens a notebook, and waits until its text is there; returns what the strip says."""
    page.route("**/pyodide.mjs", lambda route: route.abort())
    page.on("dialog", lambda dialog: dialog.accept())  # "Leave the page?"
    with served(marks.parents[1]) as address:

        def opened(path: str) -> str:
            page.goto(f"{address}/live/lab/index.html?path={path}")
            page.locator(".jp-Notebook .jp-Cell").first.wait_for(timeout=LONG)
            return page.locator("#strip [role=status]").inner_text()

        yield opened


def test_a_copy_follows_the_book_until_one_writes_in_it(opened, page, marks):
    texts = json.loads(marks.read_text("utf-8"))
    opened(CHAPTER)
    answer(page, SAVE, [CHAPTER, ""])
    answer(page, SAVE, [OWN, "mine = 'Straße'"])
    kept = answer(page, KEPT)
    assert kept.keys() == {CHAPTER, OWN}
    for path, notebook in kept.items():
        assert notebook["metadata"][MARK] == texts[path], "JupyterLab keeps the mark"
        assert (mark(notebook["cells"]) == texts[path]) is (path == CHAPTER)
    assert "has changed since you began" not in opened(OWN)
    assert answer(page, KEPT).keys() == {CHAPTER, OWN}, "the book has not changed"
    marks.write_text(json.dumps(dict.fromkeys(texts, "0")), "utf-8")
    assert "has changed since you began with it. What is yours stays" in opened(OWN)
    left = answer(page, KEPT)
    assert left.keys() == {OWN}
    assert "mine = 'Straße'" in ["".join(cell["source"]) for cell in left[OWN]["cells"]]
    assert "has changed since you began" not in opened(CHAPTER)


def test_without_the_marks_every_copy_stays(opened, page, marks):
    opened(CHAPTER)
    answer(page, SAVE, [CHAPTER, ""])
    marks.unlink()
    opened(CHAPTER)
    assert answer(page, KEPT).keys() == {CHAPTER}

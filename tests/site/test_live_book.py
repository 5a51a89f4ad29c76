"""The whole book live: JupyterLite runs a chapter, and the strip above it says more.

Of the published site the page's fixture answers Pyodide's addresses with the same bytes.
"""

import re
from urllib.parse import quote

import pytest
from notebook_page import PATIENCE_WITH_A_CELL, answer

pytestmark = [pytest.mark.browser, pytest.mark.kernel, pytest.mark.xdist_group("site-live")]

LONG = 240_000  # ms, for a kernel to start on a busy machine
CHAPTER = "00_start_here.ipynb"
READY = """async (until) => {
  for (const end = Date.now() + until; Date.now() < end; ) {
    const kernel = window.jupyterapp?.shell?.currentWidget?.sessionContext?.session?.kernel;
    if (kernel && (await kernel.info) && kernel.status === "idle") return true;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  return false;
}"""
RUN = """async () => {
  const shown = window.jupyterapp.shell.currentWidget;
  await window.jupyterapp.commands.execute("notebook:run-all-cells");
  return shown.content.widgets.map((cell) => cell.model.toJSON());
}"""
CLICK = """(target) => {
  const opened = [];
  window.open = (url) => opened.push(String(url));
  const link = document.createElement("a");
  link.setAttribute("href", target);
  document.body.append(link);
  link.click();
  return opened;
}"""


def go(page, address: str, path: str, wait: bool = True) -> None:
    """Open a notebook; its text is there then."""
    page.goto(f"{address}/live/lab/index.html?path={quote(path, safe='')}")
    if wait:
        page.locator(".jp-Notebook .jp-Cell").first.wait_for(timeout=LONG)


def says(page, words: str = "") -> str:
    """Wait until the strip says some words, and return all that it says."""
    page.locator("#strip [role=status]", has_text=words).wait_for(timeout=LONG)
    return page.locator("#strip [role=status]").inner_text()


def fits(page) -> None:
    for width in (390, 683, 1366):
        page.set_viewport_size({"width": width, "height": 900})
        assert page.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0, width


def test_a_chapter_runs_to_its_end(page, address, packages):
    go(page, address, CHAPTER)
    page.wait_for_function("window.jupyterapp?.shell?.leftCollapsed === true", timeout=LONG)
    assert "MB" in says(page)
    strip, below = page.locator("#strip").bounding_box(), page.locator("#main").bounding_box()
    assert below["y"] == pytest.approx(strip["height"], abs=1)
    assert answer(page, READY, LONG, patience=LONG / 500)
    cells = answer(page, RUN, patience=PATIENCE_WITH_A_CELL)
    ran = [cell for cell in cells if cell["cell_type"] == "code"]
    for cell in ran:
        assert cell["execution_count"], cell["source"]
        for output in cell["outputs"]:
            assert output["output_type"] != "error", (cell["source"], output)
            assert output.get("name") != "stderr", (cell["source"], output)
    assert page.locator(".driftlab-panel, .driftlab-scene").count() > 0
    assert says(page).startswith("Python is ready.")
    fits(page)
    assert page.complaints == []


SOLUTION = "solutions/03_systematic_drift"


def test_the_strip_leads_to_pages_of_the_site_only(page, address):
    page.route("**/live/build/**", lambda route: route.abort())
    for path, name, leads in (
        (
            "03_systematic_drift mine, Größe.ipynb",
            "Chapter's page",
            "03_systematic_drift.html",
        ),
        (f"{SOLUTION}-Copy1.ipynb", "Chapter's page", f"{SOLUTION}.html"),
        ("javascript:alert(1)//.ipynb", "The book's pages", "index.html"),
        ("//other.example/a.ipynb", "The book's pages", "index.html"),
        ("../../other/a.ipynb", "The book's pages", "index.html"),
    ):
        go(page, address, path, wait=False)
        link = page.locator("#strip").get_by_role("link", name=name)
        assert link.evaluate("a => a.href") == f"{address}/{leads}"
    assert page.evaluate(CLICK, "#site/errata.html") == [f"{address}/errata.html"]
    for target in ("javascript:void 0", "//other.example/"):
        assert page.evaluate(CLICK, f"#site/{target}") == []


def test_where_pyodides_packages_cannot_be_reached_a_sentence_says_so(page, address):
    page.route("**/live/build/**", lambda route: route.abort())
    page.route(re.compile("^https:"), lambda route: route.abort())
    go(page, address, CHAPTER, wait=False)
    if page.evaluate("document.documentElement.dataset.probe"):  # else the site holds them itself
        trouble = says(page, "cannot be reached from here")
        assert "Python cannot start: its packages come from" in trouble


def test_without_webassembly_the_text_is_there_and_a_sentence(page, address):
    page.add_init_script("delete window.WebAssembly")
    go(page, address, CHAPTER)
    trouble = says(page, "has no WebAssembly")
    assert trouble.endswith("The chapter can still be read, here and on its page.")

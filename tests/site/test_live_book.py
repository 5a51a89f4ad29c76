"""The whole book live: chapters run to their end in JupyterLite.

Of the published site the page's fixture answers Pyodide's addresses with the same bytes.
"""

import json
from urllib.parse import quote

import pytest
from notebook_page import PATIENCE_WITH_A_CELL, answer

pytestmark = [pytest.mark.browser, pytest.mark.kernel, pytest.mark.xdist_group("site-live")]

LONG = 240_000  # ms, for a kernel to start on a busy machine
CHAPTERS = (
    "00_start_here.ipynb",
    "02_characteristic_equation.ipynb",
    "04_calibration_by_turns.ipynb",
    "06_picard_algorithms.ipynb",
)
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


SOLUTION = "solutions/03_systematic_drift.html"


@pytest.fixture
def published(site) -> str:
    """The address of a small file that readers fetch from Pyodide; empty if the site holds all."""
    lock = json.loads((site / "live/static/pyodide/pyodide-lock.json").read_text("utf-8"))
    name = lock["packages"]["cycler"]["file_name"]
    return name if name.startswith("https:") else ""


@pytest.fixture
def live(address, page, packages):
    """Opens a chapter, and waits until its text is there."""

    def opened(name: str) -> None:
        page.goto(f"{address}/live/lab/index.html?path={name}")
        page.locator(".jp-Notebook .jp-Cell").first.wait_for(timeout=LONG)

    return opened


def test_chapters_run_to_their_end(live, page):
    """One after the other in one browser, which has fetched all with the first."""
    for name in CHAPTERS:
        live(name)
        assert answer(page, READY, LONG, patience=LONG / 500), name
        cells = answer(page, RUN, patience=PATIENCE_WITH_A_CELL)
        ran = [cell for cell in cells if cell["cell_type"] == "code"]
        for cell in ran:
            for output in cell["outputs"]:
                assert output["output_type"] != "error", (name, cell["source"], output)
                assert output.get("name") != "stderr", (name, cell["source"], output)
        assert [cell["source"] for cell in ran if not cell["execution_count"]] == [], name
        assert page.locator(".driftlab-panel, .driftlab-scene").count() > 0, name
        says = page.locator("#strip [role=status]")
        assert says.inner_text().startswith("Python is ready."), name
        assert page.complaints == [], name


def test_the_strip_leads_to_the_chapters_page_and_folds_the_files(live, page):
    live("solutions/03_systematic_drift.ipynb")
    page.wait_for_function("window.jupyterapp?.shell?.leftCollapsed === true", timeout=LONG)
    strip = page.locator("#strip")
    page_of = strip.get_by_role("link", name="Chapter's page")
    assert page_of.evaluate("a => a.href").endswith("/solutions/03_systematic_drift.html")
    assert "MB" in strip.get_by_role("status").inner_text()
    below = page.locator("#main").bounding_box()["y"]
    assert below == pytest.approx(strip.bounding_box()["height"], abs=1)
    for width in (390, 768):
        page.set_viewport_size({"width": width, "height": 900})
        assert page.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0


def test_a_link_out_of_the_book_opens_a_page_of_the_site(live, page):
    live("12_ledger_and_glossary.ipynb")
    link = page.locator('a[href*="#site/errata.html"]').first
    link.wait_for(timeout=LONG)
    with page.context.expect_page() as opened:
        link.evaluate("link => link.click()")  # JupyterLab still moves the text about
    assert opened.value.url.endswith("/errata.html")
    assert "/live/" not in opened.value.url


@pytest.mark.parametrize(
    ("path", "name", "leads"),
    [
        ("03_systematic_drift.ipynb", "Chapter's page", "03_systematic_drift.html"),
        ("03_systematic_drift mine, Größe.ipynb", "Chapter's page", "03_systematic_drift.html"),
        ("solutions/03_systematic_drift-Copy1.ipynb", "Chapter's page", SOLUTION),
        ("Größe.ipynb", "The book's pages", "index.html"),
        ("javascript:alert(1)//.ipynb", "The book's pages", "index.html"),
        ("//other.example/a.ipynb", "The book's pages", "index.html"),
        ("../../other/a.ipynb", "The book's pages", "index.html"),
    ],
)
def test_the_strip_leads_to_the_page_of_a_chapter_or_to_the_index(path, name, leads, page, address):
    page.goto(f"{address}/live/lab/index.html?path={quote(path, safe='')}")
    link = page.locator("#strip").get_by_role("link", name=name)
    assert link.evaluate("a => a.href") == f"{address}/{leads}"


@pytest.mark.parametrize(
    ("target", "opens"),
    [("errata.html", True), ("javascript:void 0", False), ("//other.example/", False)],
)
def test_a_link_to_the_site_opens_nothing_else(target, opens, page, address):
    page.goto(f"{address}/live/lab/index.html")
    page.locator("#strip").wait_for()
    opened = page.evaluate(CLICK, f"#site/{target}")
    assert opened == ([f"{address}/{target}"] if opens else [])


# ------------------------------------------------------------------ bad surroundings


def said(page, words):
    """Wait until the strip says some words, and return all that it says."""
    page.locator("#strip [role=status]", has_text=words).wait_for(timeout=LONG)
    return page.locator("#strip [role=status]").inner_text()


def test_without_webassembly_the_text_is_there_and_a_sentence(live, page):
    page.add_init_script("delete window.WebAssembly")
    live("03_systematic_drift.ipynb")
    assert said(page, "has no WebAssembly").endswith(
        "The chapter can still be read, here and on its page."
    )


def test_where_pyodides_packages_cannot_be_reached_a_sentence_says_so(live, page, published):
    if not published:
        pytest.skip("this site holds all packages itself")
    page.route(published.rpartition("/")[0] + "/**", lambda route: route.abort())
    live("03_systematic_drift.ipynb")
    assert "Python cannot start: its packages come from" in said(
        page, "cannot be reached from here"
    )

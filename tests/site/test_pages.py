"""Pages of the site: all of them as they are written, and one of each kind in a browser."""

import gzip
import html
import re
from urllib.parse import unquote

import pytest
from notebook_page import answer

browser = pytest.mark.browser
pytestmark = pytest.mark.xdist_group("site")
WIDTHS = (390, 683, 1366)
KINDS = (
    "index",
    "11_kalman_calibration",
    "solutions/07_coning",
    "papers/larin",
    "ledger/larin",
    "reference/index",
    "reference/modules/calibration.filter",
    "gallery/index",
    "glossary",
    "docs/using",
    "lab_sheet",
    "licences",
)
"""A page of each kind; of chapters the longest."""
WEIGHT = 60_000
"""Bytes of a page, packed as servers send it."""
HEAVY = {"07_coning": 80_000, "11_kalman_calibration": 85_000}
"""The two longest chapters: their words, code and numbers alone are more than 40 kB."""
UNREAD = re.compile(r"<(script|style)\b([^>]*)>.*?</\1>|<!--.*?-->", re.S)
ATTRIBUTE = re.compile(r"""\s(id|href|src)=(?:"([^"]*)"|'([^']*)')""")
UNSET = """(formulas) => formulas.filter((tex) => {
  try {
    return MathJax.tex2mml(tex).includes("merror");
  } catch (error) {
    return true;
  }
})"""


@pytest.fixture(scope="module")
def texts(site) -> dict:
    """All pages, by path."""
    return {path: path.read_text("utf-8") for path in sorted(site.rglob("*.html"))}


def test_every_link_leads_somewhere_and_nothing_is_asked_of_other_places(site, texts):
    places, links, dead = {}, {}, []
    for path, text in texts.items():
        inside = UNREAD.sub(r"<\1\2>", text)
        places[path], links[path] = set(), set()
        for tag in re.findall(r"<[a-z][^>]*>", inside):
            for name, double, single in ATTRIBUTE.findall(tag):
                value = html.unescape(double or single)
                if name == "id":
                    places[path].add(value)
                elif not re.match(r"[a-z]+:|//", value):
                    links[path].add(unquote(value))
                elif not tag.startswith("<a ") and re.match(r"http|//", value):
                    dead.append(f"{path.relative_to(site)}: {tag}")
    for path, found in links.items():
        for link in found:
            file, _, place = link.partition("#")
            target = (path.parent / file.partition("?")[0]).resolve() if file else path
            there = target.exists() and (not place or place in places[target])
            if notebook := re.search(r"live/lab/index\.html\?path=(.+)$", link):
                there = there and (site / "live/files" / notebook[1]).exists()
            dead += [] if there else [f"{path.relative_to(site)}: {link}"]
    for path in site.rglob("*.css"):
        elsewhere = re.findall(r"(?:url\(|@import)\s*['\"]?(?:https?:)?//", path.read_text("utf-8"))
        dead += [f"{path.relative_to(site)}: {each}" for each in elsewhere]
    assert dead == []
    assert sum(map(len, links.values())) > 10_000


def test_pages_are_light(site, texts):
    for path, text in texts.items():
        if "<article" in text and "_modules" not in path.parts:
            assert "| --- |" not in text, path
            packed = len(gzip.compress(text.encode()))
            assert packed < HEAVY.get(path.stem, WEIGHT), path.relative_to(site)


@browser
def test_every_formula_of_every_page_can_be_set(texts, address, kept_page):
    formulas = {
        tex
        for text in texts.values()
        for math in re.findall(r'<(?:span|div) class="[^"]*\bmath\b[^>]*>([^<]*)', text)
        for pair in re.findall(r"\\\((.*?)\\\)|\\\[(.*?)\\\]", html.unescape(math), re.S)
        for tex in pair
        if tex
    }
    assert len(formulas) > 1000
    kept_page.goto(f"{address}/solutions/01_attitude_error_motion.html")
    answer(kept_page, "async () => void (await window.MathJax.startup.promise)")
    assert kept_page.evaluate(UNSET, [r"\frac{", "x"]) == [r"\frac{"]
    assert kept_page.evaluate(UNSET, sorted(formulas)) == []


@browser
def test_a_page_of_each_kind_fits_the_screen_and_sets_its_formulas(address, kept_page):
    page = kept_page
    for name in KINDS:
        page.goto(f"{address}/{name}.html")
        if page.locator(".math").count():
            page.wait_for_function("document.querySelector('mjx-container') !== null")
            answer(page, "async () => void (await window.MathJax.startup.promise)")
        for room in page.locator("div.exercise[data-exercise]").all():
            room.locator("form").first.wait_for(state="attached")  # they fetch no Python
        page.evaluate("document.querySelectorAll('details').forEach(fold => { fold.open = true; })")
        for width in WIDTHS:
            page.set_viewport_size({"width": width, "height": 900})
            beyond = page.evaluate("document.documentElement.scrollWidth - innerWidth")
            assert beyond <= 0, f"{name} at {width}"
        assert page.locator("[data-mjx-error]").count() == 0, name
        assert page.complaints == [], name


@browser
def test_a_page_from_a_disk_reads_without_complaint(site, page):
    page.goto((site / "03_systematic_drift.html").as_uri())
    page.locator("mjx-container").first.wait_for()
    page.get_by_role("link", name="Worked solution", exact=True).first.click()
    page.wait_for_url("**/solutions/03_systematic_drift.html#solution-3-1")
    assert page.complaints == []


@browser
def test_a_chapter_is_read_on_a_phone(address, page):
    page.set_viewport_size({"width": 390, "height": 844})
    page.goto(f"{address}/03_systematic_drift.html")
    following, before = (page.locator(f".{name}-page").bounding_box() for name in ("next", "prev"))
    assert before["y"] >= following["y"] + following["height"]
    assert min(before["height"], following["height"]) >= 44
    picture = page.locator(".driftlab-figure a.picture").first
    file = picture.locator("img").get_attribute("src")
    picture.click()
    page.wait_for_url(f"**/{file}")
    assert page.complaints == []

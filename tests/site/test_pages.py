"""The site as built, in a browser: nothing from elsewhere, nothing too wide, search."""

import pytest

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("site")]
WIDTHS = (390, 768, 1280)


def own_pages(site):
    """Pages of the site's own, from the folder down; the live book's are JupyterLite's."""
    left_out = {"live"}
    return [path for path in sorted(site.rglob("*.html")) if not left_out & {*path.parts}]


def test_every_page_fits_the_screen_and_sets_its_formulas(site, address, page):
    for path in own_pages(site):
        name = path.relative_to(site).as_posix()
        page.goto(f"{address}/{name}")
        if page.locator(".math").count():
            page.wait_for_function("document.querySelector('mjx-container') !== null")
            page.wait_for_function("MathJax.startup.promise.then(() => true)")
        if (site / "in_place").exists():  # forms come by themselves, and fetch no Python
            for room in page.locator("div.exercise[data-exercise]").all():
                room.locator("form").first.wait_for(state="attached")
        page.evaluate("document.querySelectorAll('details').forEach(fold => { fold.open = true; })")
        for width in WIDTHS:
            page.set_viewport_size({"width": width, "height": 900})
            beyond = page.evaluate("document.documentElement.scrollWidth - innerWidth")
            assert beyond <= 0, f"{name} at {width}"
        assert page.locator("[data-mjx-error]").count() == 0, name
        assert page.complaints == [], name


@pytest.mark.parametrize("name", ["index.html", "03_systematic_drift.html", "ledger/larin.html"])
def test_a_page_from_a_disk_reads_without_complaint(site, page, name):
    page.goto((site / name).as_uri())
    if page.locator(".math").count():
        page.wait_for_function("document.querySelector('mjx-container') !== null")
        page.wait_for_function("MathJax.startup.promise.then(() => true)")
    assert page.complaints == []


@pytest.mark.parametrize(
    ("words", "found"),
    [
        ("drift_per_revolution", "driftlab.drift.drift_per_revolution"),
        ("observability", "calibration.unobservable_subspace"),
        ("sculling", "attitude.sculling"),
        ("gyrocompassing", "gyrocompass.align"),
        ("bias instability", "noise_terms.fit_noise_terms"),
        ("attitude from rates", "sampled_rates.increments_from_rates"),
        ("align", "gyrocompass.align"),
        ("ZUPT", "recordings.static_intervals"),
        ("DataFrame", "recordings.from_dataframe"),
    ],
)
def test_the_search_finds_what_a_reader_looks_for(site, page, words, found):
    page.goto((site / "index.html").as_uri())
    page.locator("input[name=q]").first.fill(words)
    page.keyboard.press("Enter")
    page.locator("ul.search li").first.wait_for()
    page.wait_for_function("document.querySelector('p.search-summary')?.textContent.includes('.')")
    first = page.locator("ul.search li").all_inner_texts()[:6]  # glossary and tasks before it
    assert any(found in text for text in first), first


def test_the_search_leads_to_the_section_of_a_task(site, page):
    page.goto((site / "search.html").as_uri() + "?q=gyrocompassing")
    title = "I want the heading from my log at rest, by gyrocompassing"
    found = page.locator("ul.search li a", has_text=title).first
    found.wait_for()
    address = found.get_attribute("href")
    assert address.startswith("i_want_to.html#i-want-the-heading-from-my-log-at-rest")


def test_recipes_show_their_whole_lines(site, page):
    page.set_viewport_size({"width": 1280, "height": 900})
    page.goto((site / "i_want_to.html").as_uri())
    beyond = "cells => cells.filter(cell => cell.scrollWidth > cell.clientWidth).length"
    assert page.locator("div.cell_input pre").evaluate_all(beyond) == 0

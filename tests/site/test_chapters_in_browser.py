"""The chapters in a browser: solutions and folds, search, what scrolls and what a tap opens."""

import pytest

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("site-chapters")]


def test_a_link_below_an_exercise_leads_to_its_solution(site, page):
    page.goto((site / "03_systematic_drift.html").as_uri())
    page.get_by_role("link", name="Worked solution").first.click()
    page.wait_for_url("**/solutions/03_systematic_drift.html#solution-3-1")
    assert page.complaints == []


def test_a_link_into_a_folded_section_unfolds_it(site, page):
    page.goto((site / "05_cayley_and_riccati.html").as_uri() + "#chapter-05-the-matrix-of-1-6")
    page.locator("h4", has_text="The matrix of (1.6)").wait_for(state="visible")
    assert page.locator("details.folded[open]").count() == 1


@pytest.mark.parametrize(
    ("said", "title"),
    [
        ("systematic drift", "03 The systematic drift"),
        ("seaway", "03 The systematic drift"),
        ("count by their area", "Small motions count by their area"),
        ("no ballistic error", "No ballistic error"),
    ],
)
def test_the_search_finds_chapters_and_their_sections(site, page, said, title):
    page.goto((site / "search.html").as_uri() + f"?q={said}")
    page.locator("ul.search li").first.wait_for()
    page.wait_for_function("document.querySelector('p.search-summary')?.textContent.includes('.')")
    found = page.locator("ul.search li").all_inner_texts()[:8]
    assert any(title in text for text in found), found


def test_on_a_phone_a_tap_shows_a_picture_at_its_full_size(address, page):
    page.set_viewport_size({"width": 390, "height": 844})
    page.goto(f"{address}/03_systematic_drift.html")
    picture = page.locator(".driftlab-figure a.picture").first
    file = picture.locator("img").get_attribute("src")
    picture.click()
    page.wait_for_url(f"**/{file}")


def test_on_a_phone_the_ways_to_other_chapters_stand_apart(address, page):
    page.set_viewport_size({"width": 390, "height": 844})
    page.goto(f"{address}/03_systematic_drift.html")
    following, before = (page.locator(f".{name}-page").bounding_box() for name in ("next", "prev"))
    assert before["y"] >= following["y"] + following["height"]
    assert min(before["height"], following["height"]) >= 44

"""Previews of what links lead to."""

import pytest
from notebook_page import FRAME, answer

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("site-landing")]
TO_EQUATION = "article a[href='#eq-larin-1-4']"
TO_ENTRY = "article a[href*='ledger/larin.html#ledger-larin-2-3']"
TO_FIGURE = "article a[href*='gallery/index.html#figure-03']"
TO_FUNCTION = "article a[href*='#driftlab.drift.drift_per_revolution']"
PLACES = [
    ("01_rotation_and_error_kinematics", TO_EQUATION, "mjx-container"),
    ("chapters", TO_ENTRY, "mjx-container"),
    ("03_systematic_drift", TO_FIGURE, "img"),
    ("i_want_to", TO_FUNCTION, "dt"),
]

STANDS = f"""async link => {{
  for (let frames = 0, before; frames < 20; frames += 1) {{
    await {FRAME};
    const {{ top }} = link.getBoundingClientRect();
    if (top !== before) [frames, before] = [0, top];
  }}
}}"""
"""Wait until a link stands: what moves it from under the pointer takes its card away."""


def boxes(page, link) -> tuple[dict, dict]:
    """Where the card and the link's first line are, in the window."""
    line = "link => { const { left, top, right, bottom } = link.getClientRects()[0]; "
    line += "return { left, top, right, bottom }; }"
    card = "card => { const { left, top, right, bottom } = card.getBoundingClientRect(); "
    card += "return { left, top, right, bottom }; }"
    return page.locator(".preview").evaluate(card), link.evaluate(line)


@pytest.mark.parametrize(("name", "selector", "has"), PLACES)
@pytest.mark.parametrize("width", [390, 1280])
def test_a_card_shows_what_stands_there(address, page, name, selector, has, width):
    page.set_viewport_size({"width": width, "height": 800})
    page.goto(f"{address}/{name}.html")
    answer(page, "async () => void (await window.MathJax?.startup?.promise)")
    link = page.locator(selector).locator("visible=true").first
    link.scroll_into_view_if_needed()
    answer(page, STANDS, link.element_handle())
    link.hover()
    card = page.locator(".preview[data-ready]")
    card.wait_for()
    assert card.locator(has).count() > 0
    assert card.inner_text().strip() or has == "mjx-container"
    assert page.locator(".preview [data-mjx-error]").count() == 0
    assert link.get_attribute("aria-describedby") == card.get_attribute("id")
    shown, line = boxes(page, link)
    assert shown["left"] >= 0
    assert shown["right"] <= width
    assert shown["top"] >= -1
    assert shown["bottom"] <= 801
    assert shown["bottom"] <= line["top"] or shown["top"] >= line["bottom"], "it covers its link"
    page.keyboard.press("Escape")
    assert page.locator(".preview").count() == 0
    assert link.get_attribute("aria-describedby") is None
    assert page.complaints == []


def test_the_keyboard_has_it_too(address, page):
    page.goto(f"{address}/chapters.html")
    link = page.locator(TO_ENTRY).first
    link.focus()
    page.keyboard.press("Shift+Tab")
    page.keyboard.press("Tab")  # so that the browser shows where the keyboard is
    page.locator(".preview[data-ready]").wait_for()
    assert link.get_attribute("aria-describedby") == "preview"
    page.keyboard.press("Escape")
    assert page.locator(".preview").count() == 0


def test_a_finger_follows_the_link(address, browser):
    context = browser.new_context(viewport={"width": 390, "height": 844}, has_touch=True)
    page = context.new_page()
    page.clock.install()
    page.goto(f"{address}/01_rotation_and_error_kinematics.html")
    page.locator(TO_EQUATION).locator("visible=true").first.tap()
    page.wait_for_function("location.hash === '#eq-larin-1-4'")
    page.clock.run_for(2000)
    assert page.locator(".preview").count() == 0
    context.close()


def test_from_a_disk_no_other_page_is_asked_for(site, page):
    page.clock.install()
    page.goto((site / "chapters.html").as_uri())
    page.locator(TO_ENTRY).first.hover()
    page.clock.run_for(2000)
    assert page.locator(".preview").count() == 0
    assert page.complaints == []

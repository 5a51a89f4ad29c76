"""The search finds what readers look for: functions, tasks, sections, words of three languages."""

import pytest

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("site")]
FOUND = {
    "drift_per_revolution": "driftlab.drift.drift_per_revolution",
    "sculling": "attitude.sculling",
    "bias instability": "noise_terms.fit_noise_terms",
    "ZUPT": "recordings.static_intervals",
    "DataFrame": "recordings.from_dataframe",
    "seaway": "03 Which misalignments drift?",
    "count by their area": "Small motions count by their area",
}
"""What is among the first eight, by what is typed."""
TERMS = {
    "гирокомпас": "gyrocompass",
    "уход": "drift-coefficient",
    "陀螺": "gyroscope",
    "fibre-optic gyro": "fibre-optic-gyro",
}
"""The row of the glossary, by what is typed."""


def search(page, folder: str, words: str):
    """The results, when all are there."""
    page.goto(f"{folder}/search.html?q={words}")
    page.locator("ul.search li").first.wait_for()
    page.wait_for_function("document.querySelector('p.search-summary')?.textContent.includes('.')")
    return page.locator("ul.search li")


def test_what_is_typed_on_a_page_is_found(site, page):
    page.goto((site / "index.html").as_uri())
    page.locator("input[name=q]").first.fill("observability")
    page.keyboard.press("Enter")
    page.locator("ul.search li", has_text="calibration.unobservable_subspace").first.wait_for()
    for words, expected in FOUND.items():
        found = search(page, site.as_uri(), words).all_inner_texts()[:8]
        assert any(expected in text for text in found), (words, found)
    task = search(page, site.as_uri(), "gyrocompassing").locator("a", has_text="I want the heading")
    assert task.first.get_attribute("href").startswith("i_want_to.html#i-want-the-heading-from-my")
    assert page.complaints == []


def test_words_of_the_glossary_are_found_in_their_row(site, page):
    for word, term in TERMS.items():
        link = search(page, site.as_uri(), word).locator(
            f"a[href^='glossary.html'][href$='#term-{term}']"
        )
        assert link.first.inner_text().startswith("Glossary: ")
    link.first.click()
    page.locator(f"#term-{term}", has_text=word).wait_for()
    assert page.complaints == []


def test_the_glossary_comes_before_functions(address, page):
    found = search(page, address, "Schuler")
    texts = found.all_inner_texts()[:12]
    glossary = [i for i, text in enumerate(texts) if text.startswith("Glossary: ")]
    functions = [i for i, text in enumerate(texts) if text.startswith("driftlab.")]
    assert max(glossary) < min(functions)

"""The search finds the words of the glossary in three languages, and leads to their row."""

import pytest

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("site-landing")]


@pytest.mark.parametrize(
    ("word", "term"),
    [
        ("гирокомпас", "gyrocompass"),
        ("лазерный гироскоп", "ring-laser-gyro"),
        ("ВОГ", "fibre-optic-gyro"),
        ("加速度计", "accelerometer"),
        ("дрейф", "drift-of-a-gyro"),
        ("уход", "drift-coefficient"),
        ("Schuler", "schuler-period"),
        ("陀螺", "gyroscope"),
        ("fibre-optic gyro", "fibre-optic-gyro"),
    ],
)
def test_a_word_is_found(site, page, word, term):
    page.goto(f"{(site / 'search.html').as_uri()}?q={word}")
    found = page.locator(f"ul.search li a[href^='glossary.html'][href$='#term-{term}']")
    found.first.wait_for()
    assert found.first.inner_text().startswith("Glossary: ")
    assert page.complaints == []
    found.first.click()
    page.wait_for_function("location.hash.startsWith('#term-')")
    row = page.locator(f"#term-{term}")
    row.wait_for()
    assert word in row.inner_text()


def test_the_glossary_comes_before_functions(address, page):
    page.goto(f"{address}/search.html?q=Schuler")
    page.wait_for_function("document.querySelector('p.search-summary')?.textContent.includes('.')")
    page.locator("ul.search li p.context").nth(5).wait_for()
    found = page.locator("ul.search li").all_inner_texts()[:12]
    glossary = [i for i, text in enumerate(found) if text.startswith("Glossary: ")]
    functions = [i for i, text in enumerate(found) if text.startswith("driftlab.")]
    assert glossary
    assert functions
    assert max(glossary) < min(functions)

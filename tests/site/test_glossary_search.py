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

"""Pictures on a dark page: white becomes its ground, and lines stand out."""

import io
from urllib.parse import quote

import numpy as np
import pytest
from PIL import Image

from driftlab.book.machinery.figure.picture import SERIES

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("site")]
LEAST_CONTRAST = 4.0  # of a line to the ground; 3 is what is asked for of things
COLOURS = [series["color"] for series in SERIES]
SHOW = """source => {
  const image = new Image();
  image.id = "bars";
  image.src = source;
  document.querySelector("article").prepend(image);
  return image.decode();
}"""


def seen(picture: bytes) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(picture)).convert("RGB"), float)


def luminance(colour: np.ndarray) -> float:
    part = colour / 255
    linear = np.where(part <= 0.04045, part / 12.92, ((part + 0.055) / 1.055) ** 2.4)
    return float(linear @ [0.2126, 0.7152, 0.0722])


@pytest.mark.parametrize("way", ["button", "system"])
def test_pictures_have_the_ground_of_the_page_and_lines_stand_out(site, browser, way):
    """Of a reader who has chosen the dark theme, or whose system has."""
    context = browser.new_context(
        viewport={"width": 1280, "height": 900},
        color_scheme="dark" if way == "system" else "light",
    )
    if way == "button":
        context.add_init_script("localStorage.setItem('theme', 'dark')")
    page = context.new_page()
    page.goto((site / "03_systematic_drift.html").as_uri())
    colour = "getComputedStyle(document.body).backgroundColor.match(/\\d+/g).map(Number)"
    ground = np.array(page.evaluate(colour))
    assert luminance(ground) < 0.02
    for selector in (".driftlab-figure img", ".driftlab-still[data-panel=DriftExplorer] img"):
        picture = page.locator(selector).locator("visible=true").first
        picture.scroll_into_view_if_needed()
        page.wait_for_function(
            "found => found.complete && found.naturalWidth", arg=picture.element_handle()
        )
        corner = seen(picture.screenshot())[2:5, 2:5].mean(axis=(0, 1))
        assert np.max(np.abs(corner - ground)) < 6
    bars = "".join(
        f'<rect x="{20 * k}" width="20" height="20" fill="{colour}"/>'
        for k, colour in enumerate(COLOURS)
    )
    drawing = f'<svg xmlns="http://www.w3.org/2000/svg" width="400" height="20">{bars}</svg>'
    page.evaluate(SHOW, f"data:image/svg+xml,{quote(drawing)}")
    pixels = seen(page.locator("#bars").screenshot())
    for k, colour in enumerate(COLOURS):
        contrast = (luminance(pixels[10, 20 * k + 10]) + 0.05) / (luminance(ground) + 0.05)
        assert contrast > LEAST_CONTRAST, colour
    page.emulate_media(media="print")
    assert page.locator("#bars").evaluate("image => getComputedStyle(image).filter") == "none"
    context.close()

"""Pictures on a dark page: white becomes its ground, and lines keep their colours and stand out."""

import colorsys
import io
from urllib.parse import quote

import numpy as np
import pytest
from PIL import Image

from driftlab.book.machinery.figure.picture import SERIES

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("site-landing")]
LEAST_CONTRAST = 4.0  # of a line to the ground; 3 is what is asked for of things
LEAST_APART = 14.0  # of two colours of lines in Lab; the nearest two are as near on white
COLOURS = [series["color"] for series in SERIES]


def seen(picture: bytes) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(picture)).convert("RGB"), float)


def linear(colour: np.ndarray) -> np.ndarray:
    part = colour / 255
    return np.where(part <= 0.04045, part / 12.92, ((part + 0.055) / 1.055) ** 2.4)


def luminance(colour: np.ndarray) -> float:
    return float(linear(colour) @ [0.2126, 0.7152, 0.0722])


def lab(colour: np.ndarray) -> np.ndarray:
    to_xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    x, y, z = np.cbrt(np.array(to_xyz) @ linear(colour) / [0.9505, 1, 1.089])
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


@pytest.fixture(params=["button", "system"])
def dark(request, browser):
    """A page of a reader who has chosen the dark theme, or whose system has."""
    context = browser.new_context(
        viewport={"width": 1280, "height": 900},
        color_scheme="dark" if request.param == "system" else "light",
    )
    if request.param == "button":
        context.add_init_script("localStorage.setItem('theme', 'dark')")
    yield context.new_page()
    context.close()


@pytest.mark.parametrize(
    ("name", "selector"),
    [
        ("gallery/index", "article img[alt='03-drift-map']"),
        ("gallery/index", "article img[alt='03-turning-block']"),
        ("03_systematic_drift", "figure.driftlab-still[data-panel=DriftExplorer] img"),
    ],
)
def test_the_ground_of_a_picture_is_the_page_s(site, dark, name, selector):
    dark.goto((site / f"{name}.html").as_uri())
    picture = dark.locator(selector).first
    picture.scroll_into_view_if_needed()
    dark.wait_for_function(
        "found => found.complete && found.naturalWidth", arg=picture.element_handle()
    )
    ground = dark.evaluate(
        "getComputedStyle(document.body).backgroundColor.match(/\\d+/g).map(Number)"
    )
    corner = seen(picture.screenshot())[2:5, 2:5].mean(axis=(0, 1))
    assert luminance(np.array(ground)) < 0.02
    assert np.max(np.abs(corner - ground)) < 6


def test_lines_keep_their_hue_and_stand_out(site, dark):
    dark.goto((site / "gallery/index.html").as_uri())
    bars = "".join(
        f'<rect x="{20 * k}" width="20" height="20" fill="{colour}"/>'
        for k, colour in enumerate(["#ffffff", *COLOURS])
    )
    drawing = f'<svg xmlns="http://www.w3.org/2000/svg" width="400" height="20">{bars}</svg>'
    show = "source => { const image = new Image(); image.id = 'bars'; image.src = source; "
    show += "document.querySelector('article').prepend(image); return image.decode(); }"
    dark.evaluate(show, f"data:image/svg+xml,{quote(drawing)}")
    pixels = seen(dark.locator("#bars").screenshot())
    ground, *lines = (pixels[10, 20 * k + 10] for k in range(len(COLOURS) + 1))
    for colour, line in zip(COLOURS, lines, strict=True):
        contrast = (luminance(line) + 0.05) / (luminance(ground) + 0.05)
        assert contrast > LEAST_CONTRAST, colour
        original = np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)])
        if np.ptp(original) > 20:
            hues = [colorsys.rgb_to_hsv(*(each / 255))[0] * 360 for each in (original, line)]
            assert abs((hues[1] - hues[0] + 180) % 360 - 180) < 15, colour
    apart = [np.linalg.norm(lab(a) - lab(b)) for i, a in enumerate(lines) for b in lines[:i]]
    assert min(apart) > LEAST_APART


def test_on_paper_pictures_are_as_drawn(site, dark):
    dark.goto((site / "gallery/index.html").as_uri())
    dark.emulate_media(media="print")
    filtered = "getComputedStyle(document.querySelector('article img')).filter"
    assert dark.evaluate(filtered) == "none"

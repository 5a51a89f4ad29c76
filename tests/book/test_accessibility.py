"""What can be tested of how well a figure can be seen: contrast, captions, no word of a colour."""

import re
from pathlib import Path

import numpy as np
import pytest
from matplotlib.collections import Collection
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.text import Text

from driftlab.book.machinery.figure import picture
from driftlab.book.machinery.figure.publish import PublishedFigure
from driftlab.book.panels import EXPLORERS, SCENES
from published import NAMES, published

COLOUR_WORDS = re.compile(
    r"\b(red|blue|green|orange|purple|violet|yellow|gr[ae]y|pink|cyan|magenta|vermilion)\b", re.I
)


def contrast(first, second="white"):
    """Contrast of two colours by WCAG 2.2, from 1 to 21."""
    luminances = []
    for colour in (first, second):
        parts = np.array(to_rgb(colour))
        linear = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
        luminances.append(linear @ [0.2126, 0.7152, 0.0722])
    low, high = sorted(luminances)
    return (high + 0.05) / (low + 0.05)


def test_line_styles_differ_in_more_than_colour():
    assert len({str(style["linestyle"]) for style in picture.SERIES}) == len(picture.SERIES)


def on_a_dark_page(colour):
    """A colour of a panel's picture after the filter that page.css lays over it there."""
    css = (Path(picture.__file__).parents[1] / "panel/page.css").read_text("utf-8")
    (amount,) = re.findall(r"filter: invert\(([\d.]+)\) hue-rotate\(180deg\)", css)
    inverted = float(amount) - (2 * float(amount) - 1) * np.array(to_rgb(colour))
    # The matrix of a half turn of the hue, of the W3C's filter effects.
    grey = np.array([0.213, 0.715, 0.072])
    return np.clip(2 * np.outer(np.ones(3), grey) @ inverted - inverted, 0.0, 1.0)


def test_every_line_style_stands_out_from_a_light_page_and_a_dark_one():
    assert contrast("#767676") == pytest.approx(4.54, abs=0.01)  # as WCAG gives it
    paper = on_a_dark_page("white")
    assert contrast(paper) > 15
    assert contrast(on_a_dark_page("black"), paper) > 12
    for style in picture.SERIES:
        assert contrast(style["color"]) >= 3, style
        assert contrast(on_a_dark_page(style["color"]), paper) >= 3, style


@published(*NAMES)
def test_lines_and_texts_stand_out_and_the_caption_names_no_colour(figure: PublishedFigure) -> None:
    assert re.match(r"[A-Z0-9“(].*[.”)]$", figure.caption, re.DOTALL), figure.caption
    drawn = figure.on_screen
    if isinstance(drawn, str):  # a scene: its colours are those of scene.css, below
        texts = re.findall(r"<text[^>]*>([^<]+)", drawn)
    else:
        texts = [text.get_text() for text in drawn.findobj(Text)]
        assert_seen(drawn)
    assert not [words for words in (figure.caption, *texts) if COLOUR_WORDS.search(words)]


def assert_seen(drawn: Figure) -> None:
    """Fail unless texts, lines and points stand out from the page."""
    for text in drawn.findobj(Text):
        if text.get_text().strip() and text.get_visible():
            assert contrast(text.get_color()) >= 4.5, text
    grids = {id(line) for axes in drawn.axes for line in axes.get_xgridlines()}
    grids |= {id(line) for axes in drawn.axes for line in axes.get_ygridlines()}
    for line in drawn.findobj(Line2D):
        if id(line) not in grids and line.get_visible() and line.get_linestyle() != "None":
            assert contrast(line.get_color()) >= 3, line
    for points in drawn.findobj(Collection):
        for edge in points.get_edgecolor():
            assert edge[3] == 0 or contrast(edge) >= 3 or contrast(edge) == 1, points


@pytest.mark.parametrize("theme", [0, 1], ids=["light", "dark"])
def test_what_a_scene_draws_stands_out_from_the_page(theme: int) -> None:
    """As a text does; grounds, rules and what is painted on paper aside."""
    css = (Path(picture.__file__).parents[1] / "scene/scene.css").read_text("utf-8")
    block = re.findall(r"\{([^}]*--dl-ink[^}]*)\}", css)[theme]
    colours = dict(re.findall(r"--dl-(\w+): (#\w+)", block))
    paper = colours.pop("paper")
    for name in ("rule", "sea", "block"):
        assert contrast(colours.pop(name), paper) > 1, name
    for name, colour in colours.items():
        assert contrast(colour, paper) >= 4.5, name


def test_panels_name_no_colour() -> None:
    for panel in (*EXPLORERS, *SCENES):
        labels = [control.label for control in panel.controls]
        for words in [panel.title, *panel.presets, *panel.look_for.values(), *labels]:
            assert not COLOUR_WORDS.search(words), words

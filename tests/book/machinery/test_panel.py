"""What any panel does with values, presets, refusals and errors, tried on a few."""

import base64
import html
import io
import json
import re
from importlib import import_module
from pathlib import Path
from typing import ClassVar
from xml.etree import ElementTree

import numpy as np
import pytest
from PIL import Image

from driftlab.book import (
    AllanExplorer,
    DriftExplorer,
    RootsExplorer,
    TurnCalibrationExplorer,
    TurningBlock,
)
from driftlab.book.ch02_characteristic_equation.experiments import characteristic_roots
from driftlab.book.ch02_characteristic_equation.figures.roots import RootsPicture
from driftlab.book.machinery.figure.picture import Picture
from driftlab.book.machinery.figure.sheet import COLUMN
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import ERROR_CLASS, Explorer
from driftlab.book.machinery.panel.results import Results
from driftlab.book.machinery.panel.still import still
from driftlab.book.machinery.panel.units import angle_text, number_text
from grouped import opened
from panel_numbers import results_of, shown_numbers


def test_value_rounded_by_a_browser_is_that_of_its_step() -> None:
    panel = TurnCalibrationExplorer("Scale error, three axes")
    panel._widgets["scale"].value = -0.5 + 70 * 0.01
    assert panel._widgets["scale"].value != 0.2
    assert panel.values["scale"] == 0.2
    assert panel.preset.value == "Scale error, three axes"


def test_opens_with_a_preset_and_goes_back_to_it() -> None:
    panel = DriftExplorer("Scale factor")
    assert panel.preset.value == "Scale factor"
    panel.set(m12=1.0)
    panel.reset.click()
    assert panel.preset.value == "Scale factor"
    with pytest.raises(ValueError, match=r"preset: expected one of Symmetric triad, .* got 'new'"):
        DriftExplorer("new")


def test_a_page_without_widgets_has_the_picture(monkeypatch) -> None:
    panel, shown = opened(RootsExplorer), []
    displays = import_module("IPython.display")  # the name alone is a function of IPython
    monkeypatch.setattr(displays, "display", lambda bundle, raw: shown.append(bundle))
    panel._ipython_display_()
    live, instead = shown
    assert "application/vnd.jupyter.widget-view+json" in live
    picture = base64.b64encode(panel.view.widget.value).decode()
    assert f"data:image/jpeg;base64,{picture}" in instead["text/html"]
    assert html.escape(panel.page.alt) in instead["text/html"]
    figure = ElementTree.fromstring(re.search("<figure.*?>", instead["text/html"])[0] + "</figure>")
    assert figure.get("data-panel") == "RootsExplorer"
    assert json.loads(figure.get("data-values")) == panel.values


def test_the_values_of_a_still_may_hold_any_text() -> None:
    values = {"formula": 'x\' < 2 & "μ" > 1', "turns": 3, "open": True, "most": np.inf}
    text = still(b"", "jpeg", "a picture", "Panel", values)
    figure = ElementTree.fromstring(re.search("<figure.*?>", text)[0] + "</figure>")
    assert json.loads(figure.get("data-values")) == {**values, "most": "inf"}


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"sise": 0.1}, "values: expected names from shape, size, azimuth, elevation, got sise"),
        ({"size": 0.9}, "size: expected one of 0.0001, .*, 0.5, got 0.9"),
        ({"elevation": 91}, "elevation: expected a number from -90.0 to 90.0, got 91"),
        ({"elevation": "up"}, "elevation: expected real numbers, got 'up'"),
        ({"elevation": np.nan}, "elevation: expected finite numbers"),
        ({"shape": "round"}, "shape: expected one of symmetric, skew.* got 'round'"),
    ],
)
def test_bad_values_are_refused_and_change_nothing(values: dict, sentence: str) -> None:
    panel = opened(RootsExplorer)
    before = panel.values
    with pytest.raises(ValueError, match=sentence):
        panel.set(**{"azimuth": 1.0, **values})
    assert panel.values == before


class Fragile(Explorer):
    """Refuses above 1 and breaks above 2."""

    title = "fragile"
    picture_class = RootsPicture
    controls = (Control("x", "x", 0.5, 0.0, 3.0, 0.1),)
    presets: ClassVar = {"start": {}}

    def compute(self, values):
        if values["x"] > 2:
            raise ZeroDivisionError("broken <here>")
        if values["x"] > 1:
            raise ValueError("x: expected at most 1, got more & more.")
        return characteristic_roots(0.1, np.eye(3), [1, 0, 0])

    def numbers(self, data):
        if self.values["x"] == 0:
            raise ValueError("broken <here> as well")  # not a refusal of the reader's values
        return Results(("n", "1"), [("m", "2")])

    def call(self, values):
        return "pass"


def test_a_refusal_is_a_sentence_in_the_panel_and_keeps_the_picture(tmp_path: Path) -> None:
    panel = Fragile()
    picture = panel.view.widget.value
    before = panel.save(tmp_path / "before.svg").read_bytes()
    panel.set(x=1.5)
    assert panel.save(tmp_path / "after.svg").read_bytes() == before
    assert "x: expected at most 1, got more &amp; more." in panel.message.value
    assert panel.view.widget.value == picture
    assert results_of(panel) == [("n", "–"), ("m", "–")]
    assert panel.code.value == ""
    panel.set(x=0.5)
    assert panel.message.value == ""


@pytest.mark.parametrize(("place", "error"), [(2.5, ZeroDivisionError), (0.0, ValueError)])
def test_a_broken_callback_is_raised_and_shown(place: float, error: type[Exception]) -> None:
    panel = Fragile()
    with pytest.raises(error, match="broken"):
        panel._widgets["x"].value = place
    assert ERROR_CLASS in panel.message.value
    assert "broken &lt;here&gt;" in panel.message.value


def test_a_slider_of_whole_numbers_refuses_a_fraction() -> None:
    control = Control("turns", "turns k", 5, 1, 20, 1)
    control.check(2.0)
    with pytest.raises(ValueError, match=r"^turns: expected a whole number from 1 to 20, got 2.5"):
        control.check(2.5)


@pytest.mark.slow
def test_what_a_panel_shows_is_saved(tmp_path: Path) -> None:
    """Of the values that it shows, in the width that is asked for, and the panel stays as it is."""
    panel = opened(AllanExplorer)
    shown = panel.view.widget.value
    assert panel.save(tmp_path / "a.pdf", width=COLUMN).read_bytes().startswith(b"%PDF")
    opening = panel.save(str(tmp_path / "a.svg"), width=COLUMN).read_bytes()
    assert opening == panel.save(tmp_path / "again.svg", width=COLUMN).read_bytes()
    assert panel.view.widget.value == shown
    panel.set(ramp=1000.0)
    assert panel.save(tmp_path / "moved.svg", width=COLUMN).read_bytes() != opening
    path = tmp_path / "a.png"
    assert picture_width(panel.save(path, width=COLUMN)) == 600 * COLUMN
    assert picture_width(panel.save(path)) == 100 * panel.picture_class.size[0]


def picture_width(path: Path) -> int:
    """Width of a picture in pixels."""
    with Image.open(path) as picture:
        return picture.width


def test_a_panel_says_how_its_picture_is_saved() -> None:
    begin, save = re.findall("<code>(.*?)</code>", html.unescape(RootsExplorer().paper.value))
    assert begin == "panel = RootsExplorer()"
    assert save == 'panel.save("picture.pdf", width=3.5)'
    assert 'panel.save("picture.svg")' in html.unescape(opened(TurningBlock).paper.value)


def test_a_scene_is_saved_as_it_is(tmp_path: Path) -> None:
    scene = opened(TurningBlock)
    saved = scene.save(tmp_path / "scene.svg").read_bytes()
    assert (saved, "svg+xml") == scene.view.still()
    with pytest.raises(ValueError, match=r"path: expected an ending of \.svg, got .*pdf"):
        scene.save(tmp_path / "scene.pdf")
    with pytest.raises(
        ValueError, match=r"width: expected None for what plays on a page, got 3\.5"
    ):
        scene.save(tmp_path / "scene.svg", width=3.5)


class ScreenPicture(Picture):
    """One that asks its sheet for nothing."""

    def build(self):
        self.figure.subplots()

    def update(self, data):
        """Nothing moves."""


class OnScreen(Fragile):
    picture_class = ScreenPicture


def test_a_picture_is_saved_only_in_a_form_and_width_that_it_has(tmp_path: Path) -> None:
    panel = opened(RootsExplorer)
    with pytest.raises(ValueError, match=r"path: expected an ending of \.pdf, \.svg, \.png, got"):
        panel.save(tmp_path / "numbers.csv")
    with pytest.raises(ValueError, match=r"width: expected inches between 3 and 12"):
        panel.save(tmp_path / "roots.pdf", width=89)
    assert not list(tmp_path.iterdir())
    panel = OnScreen()
    with pytest.raises(ValueError, match=r"width: expected None for .* for a screen, got 3\.5"):
        panel.save(tmp_path / "wide.pdf", width=3.5)
    assert picture_width(panel.save(tmp_path / "wide.png")) == 100 * ScreenPicture.size[0]


def test_a_picture_is_as_sharp_as_the_screen_within_bounds() -> None:
    panel = RootsExplorer()
    widths = {}
    for ratio in (2.0, 1.0, 3.0, 1.5):
        panel.page.ratio = ratio
        widths[ratio] = Image.open(io.BytesIO(panel.view.widget.value)).width
    assert widths == {1.0: 1312, 1.5: 1575, 2.0: 2100, 3.0: 2100}
    assert panel.view.widget.width == "1050"


def test_what_is_missing_has_a_sign_and_zero_has_none() -> None:
    results = Results(("a < b", "-0.00"), [("row", "-0", "1 & 2")], ("left", "right"))
    assert results_of_html(results) == [
        ("a < b", "0.00"),
        ("row: left", "0"),
        ("row: right", "1 & 2"),
    ]
    assert results_of_html(results.blank()) == [
        ("a < b", "–"),
        ("row: left", "–"),
        ("row: right", "–"),
    ]


def results_of_html(results: Results) -> list[tuple[str, str]]:
    return shown_numbers(results.headline_html() + results.table_html())


def test_numbers_and_angles_have_three_digits_and_a_unit_that_suits_them() -> None:
    numbers = {0.0123: "0.0123", 104.2: "104", 6502.0: "6500", 3.21e-7: "3.21·10⁻⁷", 0.0: "0"}
    for number, text in numbers.items():
        assert number_text(number) == text
    angles = {0.05: "2.86°", 0.001: "3.44′", 1e-5: "2.06″", 1e-13: "2.06·10⁻⁸″", 1e-17: "0″"}
    for angle, text in {**angles, np.nan: "–"}.items():
        assert angle_text(angle) == text

"""What any panel does with values, presets, refusals and errors, tried on a few."""

import base64
from typing import ClassVar

import numpy as np
import pytest

from driftlab.book import DriftExplorer, RootsExplorer, TurnCalibrationExplorer
from driftlab.book.ch02_characteristic_equation.experiments import characteristic_roots
from driftlab.book.ch02_characteristic_equation.figures.roots import RootsPicture
from driftlab.book.machinery.control import Control
from driftlab.book.machinery.panel import ERROR_CLASS, Explorer
from grouped import opened


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


def test_a_page_without_widgets_has_the_picture() -> None:
    panel = opened(RootsExplorer)
    bundle = panel._repr_mimebundle_()
    assert "application/vnd.jupyter.widget-view+json" in bundle
    assert base64.b64decode(bundle["image/jpeg"]) == bytes(panel.image.value)


def test_panels_share_no_state() -> None:
    first, second = RootsExplorer(), RootsExplorer()
    picture = second.image.value
    first.set(size=0.4)
    assert second.image.value == picture
    assert second.values["size"] != 0.4


def test_own_values_are_not_called_a_preset() -> None:
    panel = opened(RootsExplorer)
    panel.set(azimuth=12.0)
    assert panel.preset.value == ""


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"sise": 0.1}, "values: expected names from shape, size, azimuth, elevation, got sise"),
        ({"size": 0.9}, "size: expected one of 0.0001, .*, 0.5, got 0.9"),
        ({"elevation": 91}, "elevation: expected a number from -90.0 to 90.0, got 91"),
        ({"elevation": "up"}, "elevation: expected real numbers, got dtype"),
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
        return [("n", "1")]

    def call(self, values):
        return "pass"


def test_a_refusal_is_a_sentence_in_the_panel_and_keeps_the_picture() -> None:
    panel = Fragile()
    picture = panel.image.value
    panel.set(x=1.5)
    assert "x: expected at most 1, got more &amp; more." in panel.message.value
    assert panel.image.value == picture
    assert panel.text.value == panel.code.value == ""
    panel.set(x=0.5)
    assert panel.message.value == ""


@pytest.mark.parametrize(("place", "error"), [(2.5, ZeroDivisionError), (0.0, ValueError)])
def test_a_broken_callback_is_raised_and_shown(place: float, error: type[Exception]) -> None:
    panel = Fragile()
    with pytest.raises(error, match="broken"):
        panel._widgets["x"].value = place
    assert ERROR_CLASS in panel.message.value
    assert "broken &lt;here&gt;" in panel.message.value

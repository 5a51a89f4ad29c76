"""All panels: presets, names and units of controls, the same picture as the figure."""

import html
import io
import re

import ipywidgets as widgets
import numpy as np
import pytest
from matplotlib.axes import Axes
from PIL import Image

from driftlab import book
from driftlab.book.machinery.panel.panel import OWN_VALUES, Explorer
from grouped import every_panel, opened
from panel_numbers import results_of

UNITS = {
    *("°", "′", "″", "mrad", "°/s", "°/h", "10⁻³ °/√h", "10⁻³", "ppm"),
    *("°/√h", "°/h/√h", "°/h²"),
    *("m/s", "mm/s", "kn", "mg", "µg", "µg/√Hz", "Hz", "s", "min", "h"),
}
PURE_NUMBERS = {
    *(
        "size μ",
        "RK45 tolerance",
        "turns k",
        "steps in a turn",
        "tuning k₂R",
        "damping ratio",
        "run",
    ),
}


@pytest.mark.slow
@pytest.mark.usefixtures("no_pixels")
@every_panel
def test_reset_and_presets(panel_class: type[Explorer]) -> None:
    panel = opened(panel_class)
    starts = {control.name: control.start for control in panel.controls}
    for name, values in panel.presets.items():
        panel.preset.value = name
        assert panel.values == {**starts, **values}
        assert panel.preset.value == name
    panel.reset.click()
    assert panel.preset.value == next(iter(panel.presets))


@pytest.mark.slow
@every_panel
def test_picture_is_the_static_figure(panel_class: type[Explorer]) -> None:
    """Drawn move by move or all at once: the same pixels, and the same size."""
    panel = opened(panel_class)
    figure = panel.picture_class.draw(panel.compute(panel.values)).figure
    figure.dpi = panel.view.picture.figure.dpi
    figure.canvas.draw()
    static = np.asarray(figure.canvas.buffer_rgba())[..., :3].astype(int)
    moved = np.asarray(Image.open(io.BytesIO(panel.view.widget.value))).astype(int)
    assert static.shape == moved.shape
    # What moves is drawn above what stays, so the few pixels where they cross may differ.
    assert np.mean(np.abs(static - moved) > 60) < 0.005


@every_panel
def test_presets_lie_on_the_sliders_steps(panel_class: type[Explorer]) -> None:
    """A browser moves any other value to the next step, and the preset would not be itself."""
    for control in panel_class.controls:
        for preset in panel_class.presets.values():
            value = preset.get(control.name, control.start)
            control.check(value)
            if not (control.options or control.examples):
                steps = (value - control.low) / control.step
                assert steps == pytest.approx(round(steps), abs=1e-9), control.name


@every_panel
def test_every_control_has_a_name_of_its_own(panel_class: type[Explorer]) -> None:
    names = [control.full_name for control in panel_class.controls]
    assert len(set(names)) == len(names)
    labels = [control.label for control in panel_class.controls if not control.is_slider]
    assert len({*labels, "preset"}) == len(labels) + 1


@every_panel
def test_every_slider_says_its_unit(panel_class: type[Explorer]) -> None:
    for control in panel_class.controls:
        if control.is_slider:
            unit = control.label.rpartition(", ")[2]
            known = unit in UNITS or control.label in PURE_NUMBERS
            assert known, f"{control.label}: no unit of UNITS, no number of PURE_NUMBERS"


@every_panel
def test_a_slider_shows_every_step_it_makes(panel_class: type[Explorer]) -> None:
    for control in panel_class.controls:
        widget = control.widget()
        if isinstance(widget, widgets.FloatSlider):
            shown = {f"{widget.min + k * widget.step:{widget.readout_format}}" for k in (0, 1)}
            assert len(shown) == 2, widget.description
            step = float(f"{widget.step:{widget.readout_format}}")
            assert step == pytest.approx(widget.step), widget.description


@pytest.mark.usefixtures("no_pixels")
@every_panel
def test_every_preset_says_what_to_look_for(panel_class: type[Explorer]) -> None:
    """One line each, short enough to stay one, so that nothing below it moves."""
    panel = opened(panel_class)
    assert list(panel.look_for) == list(panel.presets)
    for sentence in panel.look_for.values():
        assert re.fullmatch(r"[A-Z0-9].*[.?]", sentence), sentence
        assert len(sentence) <= 80, sentence
    name, sentence = list(panel.look_for.items())[-1]
    panel.preset.value = name
    assert html.escape(sentence) in panel.guide.value
    assert sentence in panel.page.alt
    control = next(c for c in panel.controls if c.is_slider and not c.options)
    here = panel.values[control.name]
    panel.set(**{control.name: control.low if here != control.low else control.high})
    assert OWN_VALUES in panel.guide.value


@pytest.mark.slow
@pytest.mark.usefixtures("no_pixels")
@every_panel
def test_results_keep_their_rows_and_their_units(panel_class: type[Explorer]) -> None:
    """Nothing moves below them, and no number has a power of ten by e."""
    panel = opened(panel_class)
    sizes = set()
    for preset in panel.presets:
        panel.preset.value = preset
        results = panel.numbers(panel.compute(panel.values))
        sizes.add((len(results.rows), len(results.columns)))
        for name, text in results_of(panel):
            assert not re.search(r"\d[eE][-+]?\d|\[|deg|arcsec|arcmin", f"{name} {text}"), text
        assert ": ".join(results.headline) in panel.page.alt
        if preset not in NOTHING_TO_SEE:
            shares = [share_used(axes) for axes in panel.view.picture.figure.axes]
            assert max(shares, default=1.0) > 0.35, preset
    assert len(sizes) == 1


NOTHING_TO_SEE = {"No errors, level, to the North", "Vertical", "Straight"}
"""Presets in which there is no error, or no heading that might be wrong."""


def share_used(axes: Axes) -> float:
    """Part of the height of axes that moving curves or bars take, and zero with them.

    A drawing without axes, or of curves that stay, is as large as it has been made.
    """
    heights = [np.zeros(1)] if axes.get_yscale() == "linear" else []
    if axes.patches and axes.containers:  # bars lie down
        widths = [bar.get_width() for bar in axes.patches]
        return float(np.ptp([0.0, *widths]) / np.ptp(axes.get_xlim()))
    for line in axes.get_lines():
        if line.get_animated() and len(np.unique(line.get_xdata())) > 2:
            heights.append(np.asarray(line.get_ydata(), float))
    if not axes.axison or len(heights) == (axes.get_yscale() == "linear"):
        return 1.0
    shown = np.concatenate(heights)
    shown = shown[np.isfinite(shown)]
    ends = axes.transLimits.transform(axes.transScale.transform([(1, y) for y in shown]))[:, 1]
    return float(np.ptp(np.clip(ends, 0.0, 1.0)))


def test_presets_of_ones_own_stand_before_the_books():
    mine = {"My triad": {"m12": 1.0}, "Larin's triad": {"azimuth": 10.0}}
    panel = book.DriftExplorer(presets=mine)
    assert (panel.values["m12"], panel.preset.value) == (1.0, "My triad")
    names = [name for name, _ in panel.preset.options]
    assert names[:3] == ["own values", *mine]
    assert sorted(names[1:]) == sorted({*mine, *book.DriftExplorer.presets})
    panel.preset.value = "Larin's triad"
    assert panel.values["azimuth"] == 10.0
    panel.reset.click()
    assert panel.preset.value == "My triad"
    assert "My triad" not in book.DriftExplorer.presets
    scene = book.TurningBlock(presets={"Mine": {}})
    assert scene.preset.value == "Mine"


@pytest.mark.parametrize(
    ("presets", "words"),
    [
        ({"a": {"m99": 1.0}}, r"^presets: expected names from m11, .*, got m99"),
        ({"a": {"azimuth": 1e9}}, r"^azimuth: expected"),
        ({"azimuth": 1.0}, r"^presets: expected values by control for each name, got "),
        ([1], r"^presets: expected values by control for each name, got \[1\]"),
    ],
)
def test_presets_of_ones_own_are_refused_in_a_sentence(presets, words):
    with pytest.raises(ValueError, match=words):
        book.DriftExplorer(presets=presets)

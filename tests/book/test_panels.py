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
from panel_numbers import assert_shown, results_of

UNITS = {
    *("°", "′", "″", "mrad", "°/s", "°/h", "10⁻³ °/√h", "10⁻³", "ppm"),
    *("°/√h", "°/h/√h", "°/h²"),
    *("m/s", "mm/s", "kn", "mg", "µg", "µg/√Hz", "Hz", "s", "min", "h"),
}
PURE_NUMBERS = {
    *("size μ", "RK45 tolerance", "turns k", "steps in a turn", "tuning k₂R"),
    *("damping ratio", "run", "runs", "draw", "components", "true σ over stated"),
}


@every_panel
def test_controls_have_names_units_and_steps_that_a_reader_can_see(
    panel_class: type[Explorer],
) -> None:
    controls = panel_class.controls
    names = [control.full_name for control in controls]
    assert len(set(names)) == len(names)
    labels = [control.label for control in controls if not control.is_slider]
    assert len({*labels, "preset"}) == len(labels) + 1
    for control in controls:
        if control.is_slider:
            known = control.label.rpartition(", ")[2] in UNITS or control.label in PURE_NUMBERS
            assert known, f"{control.label}: no unit of UNITS, no number of PURE_NUMBERS"
        widget = control.widget()
        if isinstance(widget, widgets.FloatSlider):
            shown = {f"{widget.min + k * widget.step:{widget.readout_format}}" for k in (0, 1)}
            assert len(shown) == 2, widget.description
            step = float(f"{widget.step:{widget.readout_format}}")
            assert step == pytest.approx(widget.step), widget.description
        # A browser moves any other value to the next step, and the preset would not be itself.
        for preset in panel_class.presets.values():
            value = preset.get(control.name, control.start)
            control.check(value)
            if not (control.options or control.examples):
                steps = (value - control.low) / control.step
                assert steps == pytest.approx(round(steps), abs=1e-9), control.name
    # One line each, short enough to stay one, so that nothing below it moves.
    assert list(panel_class.look_for) == list(panel_class.presets)
    for sentence in panel_class.look_for.values():
        assert re.fullmatch(r"[A-Z0-9].{,78}[.?]", sentence), sentence


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


@pytest.mark.slow
@pytest.mark.usefixtures("no_pixels")
@every_panel
def test_presets_show_the_numbers_of_the_package(panel_class: type[Explorer]) -> None:
    """In the same rows, and no number has a power of ten by e."""
    panel = opened(panel_class)
    sizes = set()
    for name, values in panel._presets.items():
        panel.preset.value = name
        assert (panel.values, panel.preset.value) == (values, name)
        assert html.escape(panel.look_for[name]) in panel.guide.value
        assert panel.look_for[name] in panel.page.alt
        assert ": ".join(panel._results.headline) in panel.page.alt
        sizes.add((len(panel._results.rows), len(panel._results.columns)))
        shown = results_of(panel)
        assert_shown(panel_class.__name__, values, shown)
        for row, text in shown:
            assert not re.search(r"\d[eE][-+]?\d|\[|deg|arcsec|arcmin", f"{row} {text}"), text
        if name not in NOTHING_TO_SEE:
            shares = [share_used(axes) for axes in panel.view.picture.figure.axes]
            assert max(shares, default=1.0) > 0.35, name
    assert len(sizes) == 1
    control = next(c for c in panel.controls if c.is_slider and not c.options)
    here = panel.values[control.name]
    panel.set(**{control.name: control.low if here != control.low else control.high})
    assert OWN_VALUES in panel.guide.value
    panel.reset.click()
    assert panel.preset.value == next(iter(panel.presets))


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
    assert "My triad" not in book.DriftExplorer.presets
    assert book.TurningBlock(presets={"Mine": {}}).preset.value == "Mine"


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

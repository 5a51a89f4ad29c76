"""All panels: presets, names and units of controls, the same picture as the figure."""

import io

import ipywidgets as widgets
import numpy as np
import pytest
from PIL import Image

from driftlab.book.machinery.panel import Explorer
from grouped import every_panel, opened

UNITS = {
    *("degrees", "°", "″", "′", "arcsec a turn", "deg/s", "°/h", "1e-3 °/√h"),
    *("m/s", "mm/s", "mg", "µg/√Hz", "Hz", "s", "minutes", "ppm", "1e-3"),
}
PURE_NUMBERS = {
    *("size μ", "RK45 tolerance", "turns k", "steps in a turn", "tuning k2 R", "damping ratio"),
}


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


@every_panel
def test_picture_is_the_static_figure(panel_class: type[Explorer]) -> None:
    """Drawn move by move or all at once: the same pixels, and the same size."""
    panel = opened(panel_class)
    figure = panel.picture_class.draw(panel.compute(panel.values))
    figure.dpi = panel._picture.figure.dpi
    figure.canvas.draw()
    static = np.asarray(figure.canvas.buffer_rgba())[..., :3].astype(int)
    moved = np.asarray(Image.open(io.BytesIO(panel.image.value))).astype(int)
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

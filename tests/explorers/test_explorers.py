"""What each explorer promises: presets, refusals, its numbers, the same picture as the figure."""

import base64
import contextlib
import io
import re
from typing import ClassVar

import ipywidgets as widgets
import numpy as np
import pytest
from PIL import Image
from scipy.constants import degree, g, hour, micro

from driftlab.book import (
    AlignmentBudgetExplorer,
    CalibrationRunExplorer,
    CapstoneExplorer,
    DriftExplorer,
    GyrocompassExplorer,
    ObservabilityExplorer,
    RootsExplorer,
    SplitExplorer,
    TurnCalibrationExplorer,
)
from driftlab.book.ch02_characteristic_equation.experiments import characteristic_roots
from driftlab.book.ch02_characteristic_equation.figures.roots import RootsPicture
from driftlab.book.ch08_system_calibration.experiments import typical_trial
from driftlab.book.machinery.control import Control
from driftlab.book.machinery.panel import ERROR_CLASS, Explorer
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.calibration.linearization import linearize_along
from driftlab.calibration.observability import covariance_analysis
from driftlab.imu import ImuNoise, PriorDeviations
from driftlab.motion.scheme import NINETEEN_POSITIONS
from grouped import every_explorer

UNITS = {
    *("degrees", "°", "″", "′", "arcsec a turn", "deg/s", "°/h", "1e-3 °/√h"),
    *("m/s", "mm/s", "mg", "µg/√Hz", "Hz", "s", "minutes", "ppm", "1e-3"),
}
PURE_NUMBERS = {
    *("size μ", "RK45 tolerance", "turns k", "steps in a turn", "tuning k2 R", "damping ratio"),
}


@every_explorer
def test_reset_and_presets(explorer_class: type[Explorer]) -> None:
    explorer = explorer_class()
    starts = {control.name: control.start for control in explorer.controls}
    for name, values in explorer.presets.items():
        explorer.preset.value = name
        assert explorer.values == {**starts, **values}
        assert explorer.preset.value == name
    explorer.reset.click()
    assert explorer.preset.value == next(iter(explorer.presets))


@every_explorer
def test_picture_is_the_static_figure(explorer_class: type[Explorer]) -> None:
    """Drawn move by move or all at once: the same pixels, and the same size."""
    explorer = explorer_class()
    figure = explorer.picture_class.draw(explorer.compute(explorer.values))
    figure.dpi = explorer._picture.figure.dpi
    figure.canvas.draw()
    static = np.asarray(figure.canvas.buffer_rgba())[..., :3].astype(int)
    moved = np.asarray(Image.open(io.BytesIO(explorer.image.value))).astype(int)
    assert static.shape == moved.shape
    # What moves is drawn above what stays, so the few pixels where they cross may differ.
    assert np.mean(np.abs(static - moved) > 60) < 0.005


@every_explorer
def test_presets_lie_on_the_sliders_steps(explorer_class: type[Explorer]) -> None:
    """A browser moves any other value to the next step, and the preset would not be itself."""
    for control in explorer_class.controls:
        for preset in explorer_class.presets.values():
            value = preset.get(control.name, control.start)
            control.check(value)
            if not (control.options or control.examples):
                steps = (value - control.low) / control.step
                assert steps == pytest.approx(round(steps), abs=1e-9), control.name


@every_explorer
def test_every_control_has_a_name_of_its_own(explorer_class: type[Explorer]) -> None:
    names = [control.full_name for control in explorer_class.controls]
    assert len(set(names)) == len(names)
    labels = [control.label for control in explorer_class.controls if not control.is_slider]
    assert len({*labels, "preset"}) == len(labels) + 1


@every_explorer
def test_every_slider_says_its_unit(explorer_class: type[Explorer]) -> None:
    for control in explorer_class.controls:
        if control.is_slider:
            unit = control.label.rpartition(", ")[2]
            assert unit in UNITS or control.label in PURE_NUMBERS, control.label


def test_a_browser_s_last_digits_do_not_matter() -> None:
    explorer = TurnCalibrationExplorer("Scale error, three axes")
    explorer._widgets["scale"].value = -0.5 + 70 * 0.01
    assert explorer._widgets["scale"].value != 0.2
    assert explorer.values["scale"] == 0.2
    assert explorer.preset.value == "Scale error, three axes"


def test_opens_with_a_preset_and_goes_back_to_it() -> None:
    explorer = DriftExplorer("Scale factor")
    assert explorer.preset.value == "Scale factor"
    explorer.set(m12=1.0)
    explorer.reset.click()
    assert explorer.preset.value == "Scale factor"
    with pytest.raises(ValueError, match=r"preset: expected one of Symmetric triad, .* got 'new'"):
        DriftExplorer("new")


def test_a_page_without_widgets_has_the_picture() -> None:
    explorer = RootsExplorer()
    bundle = explorer._repr_mimebundle_()
    assert "application/vnd.jupyter.widget-view+json" in bundle
    assert base64.b64decode(bundle["image/jpeg"]) == bytes(explorer.image.value)


def test_explorers_share_no_state() -> None:
    first, second = RootsExplorer(), RootsExplorer()
    picture = second.image.value
    first.set(size=0.4)
    assert second.image.value == picture
    assert second.values["size"] != 0.4


def test_own_values_are_not_called_a_preset() -> None:
    explorer = RootsExplorer()
    explorer.set(azimuth=12.0)
    assert explorer.preset.value == ""


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
    explorer = RootsExplorer()
    before = explorer.values
    with pytest.raises(ValueError, match=sentence):
        explorer.set(**{"azimuth": 1.0, **values})
    assert explorer.values == before


def test_noise_gives_a_spread_and_its_mean() -> None:
    explorer = TurnCalibrationExplorer()
    assert "mean of" not in explorer.text.value
    explorer.preset.value = "Noisy gyros"
    assert "mean of 12" in explorer.text.value


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
    explorer = Fragile()
    picture = explorer.image.value
    explorer.set(x=1.5)
    assert "x: expected at most 1, got more &amp; more." in explorer.message.value
    assert explorer.image.value == picture
    assert explorer.text.value == explorer.code.value == ""
    explorer.set(x=0.5)
    assert explorer.message.value == ""


@pytest.mark.parametrize(("place", "error"), [(2.5, ZeroDivisionError), (0.0, ValueError)])
def test_a_broken_callback_is_raised_and_shown(place: float, error: type[Exception]) -> None:
    explorer = Fragile()
    with pytest.raises(error, match="broken"):
        explorer._widgets["x"].value = place
    assert ERROR_CLASS in explorer.message.value
    assert "broken &lt;here&gt;" in explorer.message.value


def test_a_scheme_is_typed_and_a_wrong_word_gives_a_sentence() -> None:
    explorer = ObservabilityExplorer()
    picture = explorer.image.value
    explorer._widgets["rotations"].value = "+90X +90W"
    assert "expected words like +90Y or -180X" in explorer.message.value
    assert "got &#x27;+90W&#x27;" in explorer.message.value
    assert explorer.image.value == picture
    explorer._widgets["rotations"].value = "+99999999X"
    assert "expected at most 3600 degrees a word" in explorer.message.value
    explorer._widgets["rotations"].value = "+90X −90Y"  # a pasted minus is one too
    assert explorer.message.value == ""
    explorer._widgets["rotations"].value = "+90X +90Y"
    assert explorer.message.value == ""
    assert explorer.image.value != picture
    with pytest.raises(ValueError, match="rotations: expected text, got 90"):
        explorer.set(rotations=90)


def test_observability_panel_says_rank_directions_and_deviations() -> None:
    explorer = ObservabilityExplorer("19 positions, all 30")
    assert "rank <b>27 of 30</b>" in explorer.text.value
    assert "both triads turned together about y, the attitude with them" in explorer.text.value
    # A short number has one column, a longer one two, the longest a row for itself.
    assert "flex: 0 0 21.5em; max-width: 100%'>rank" in explorer.text.value
    assert "flex: 0 0 43em; max-width: 100%'>unobservable" in explorer.text.value
    assert "flex: 0 0 100%; max-width: 100%'>accelerometer inst" in explorer.text.value
    explorer.preset.value = "19 positions, 27 states"
    assert "rank <b>27 of 27</b>" in explorer.text.value
    assert "unobservable" not in explorer.text.value
    noise = ImuNoise(0.005 * degree / np.sqrt(hour), 5 * micro * g, 0.01)
    model = ERROR_MODELS["averaged"]
    way = linearize_along(NINETEEN_POSITIONS, np.radians(37.5), model)
    covariance = covariance_analysis(way, noise, PriorDeviations())
    biases = np.sqrt(np.diag(covariance)[6:9]) / (degree / hour)
    said = ", ".join(f"{bias:.2g}" for bias in biases)
    assert f"gyro bias x, y, z <b>{said} deg/h</b>" in explorer.text.value


def test_split_panel_says_the_three_parts() -> None:
    explorer = SplitExplorer("One gyro leans")
    for words in ("non-orthogonality xy <b>40.0″</b>", "misalignment about z <b>-40.0″</b>"):
        assert words in explorer.text.value
    explorer.preset.value = "Turned as a whole"
    assert "non-orthogonality xy <b>0.0″</b>" in explorer.text.value
    assert "misalignment about z <b>80.0″</b>" in explorer.text.value


@pytest.mark.xdist_group("CalibrationRunExplorer")
def test_calibration_panel_agrees_with_the_run() -> None:
    explorer = CalibrationRunExplorer("Gyro scale")
    explorer.set(minute=20.0)
    trial = typical_trial("averaged")
    at = int(np.abs(trial.calibration.times - 1200).argmin())
    state = trial.calibration.model.names.index("gyro scale x")
    for name, value in (
        ("estimate", trial.calibration.state[at, state]),
        ("true", trial.imu_errors.gyro_error[0, 0]),
        ("error", trial.errors[at, state]),
        ("three deviations", 3 * trial.calibration.deviations[at, state]),
    ):
        said = explorer.text.value.split(f"{name} <b>")[1].split(" ppm")[0]
        # The averaged axes change a scale factor by second order only: 0.01 ppm.
        assert float(said) == pytest.approx(value / micro, abs=0.02)


@pytest.mark.xdist_group("GyrocompassExplorer")
def test_axes_that_must_reach_farther_are_drawn_anew_and_come_back() -> None:
    panel = GyrocompassExplorer()
    at_first, background = panel.image.value, panel._background
    panel.set(damping=0.5)
    assert panel._background is not background
    far = panel._picture.panels[0].get_ylim()
    assert far == (-25.0, 25.0)
    background = panel._background
    panel.set(damping=0.55)
    assert panel._background is background  # the same step: nothing to draw but lines
    panel.set(damping=0.0)
    assert panel._picture.panels[0].get_ylim() == (-1.0, 1.0)
    assert panel.image.value == at_first


def test_a_vertical_body_still_shows_its_attitude() -> None:
    panel = AlignmentBudgetExplorer()
    panel.set(pitch=90.0)
    assert panel.message.value == ""
    assert "sum, first order <b>none</b>" in panel.text.value
    assert re.search(r"attitude error, exact <b>0\.\d+°</b>", panel.text.value)


@pytest.mark.parametrize(
    ("explorer_class", "name"),
    [
        pytest.param(e, name, id=e.__name__, marks=pytest.mark.xdist_group(e.__name__))
        for e, name in (
            (AlignmentBudgetExplorer, "exact"),
            (GyrocompassExplorer, "at the end"),
            (CapstoneExplorer, "under way, as built"),
        )
    ],
)
def test_panels_of_part_four_say_what_their_code_prints(
    explorer_class: type[Explorer], name: str
) -> None:
    """The call beside the picture, run by itself, gives the panel's number."""
    panel = explorer_class()
    for preset in explorer_class.presets:
        panel.preset.value = preset
        found = re.search(rf">{name} <b>(-?\d+\.\d+)°</b>", panel.text.value)
        if found is None:  # no heading in a vertical body
            assert preset == "Vertical"
            continue
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            exec(panel.call(panel.values), {})
        printed = float(re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", output.getvalue())[0])
        assert float(found[1]) == pytest.approx(printed, abs=1e-4), preset


@every_explorer
def test_a_slider_shows_every_step_it_makes(explorer_class: type[Explorer]) -> None:
    for control in explorer_class.controls:
        widget = control.widget()
        if isinstance(widget, widgets.FloatSlider):
            shown = {f"{widget.min + k * widget.step:{widget.readout_format}}" for k in (0, 1)}
            assert len(shown) == 2, widget.description
            step = float(f"{widget.step:{widget.readout_format}}")
            assert step == pytest.approx(widget.step), widget.description

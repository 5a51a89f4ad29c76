"""The panels of chapter 11: schemes of a turntable, and a calibration."""

import numpy as np
import pytest
from scipy.constants import degree, g, hour, micro

from driftlab.book import CalibrationRunExplorer, ObservabilityExplorer
from driftlab.book.ch11_kalman_calibration.experiments import typical_trial
from driftlab.calibration.covariance import covariance_analysis
from driftlab.calibration.error_dynamics import linearize_along
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.motion.scheme import NINETEEN_POSITIONS
from panel_numbers import results_of


def test_a_scheme_is_typed_and_a_wrong_word_gives_a_sentence() -> None:
    panel = ObservabilityExplorer()
    picture = panel.view.widget.value
    panel._widgets["rotations"].value = "+90X +90W"
    assert "expected words like +90Y or -180X" in panel.message.value
    assert "got &#x27;+90W&#x27;" in panel.message.value
    assert panel.view.widget.value == picture
    panel._widgets["rotations"].value = "+99999999X"
    assert "expected at most 3600 degrees a word" in panel.message.value
    panel._widgets["rotations"].value = "+90X −90Y"  # a pasted minus is one too
    assert panel.message.value == ""
    panel._widgets["rotations"].value = "+90X +90Y"
    assert panel.message.value == ""
    assert panel.view.widget.value != picture
    with pytest.raises(ValueError, match="rotations: expected text, got 90"):
        panel.set(rotations=90)


def test_observability_panel_says_rank_directions_and_deviations() -> None:
    panel = ObservabilityExplorer("19 positions, all 30")
    said = dict(results_of(panel))
    assert said["states that this scheme shows"] == "27 of 30"
    hidden = said["not observable"]
    assert "both triads turned together about y, the attitude with them" in hidden
    panel.preset.value = "19 positions, 27 states"
    said = dict(results_of(panel))
    assert said["states that this scheme shows"] == "27 of 27"
    assert said["not observable"] == "nothing"
    noise = ImuNoise(0.005 * degree / np.sqrt(hour), 5 * micro * g, 0.01)
    model = ERROR_MODELS["averaged"]
    way = linearize_along(NINETEEN_POSITIONS, np.radians(37.5), model)
    covariance = covariance_analysis(way, noise, PriorStandardDeviations())
    biases = np.sqrt(np.diag(covariance)[6:9]) / (degree / hour)
    found = [float(text) for text in said["gyro bias x, y, z, °/h"].split(", ")]
    assert found == pytest.approx(biases, rel=0.005)


@pytest.mark.xdist_group("CalibrationRunExplorer")
def test_calibration_panel_agrees_with_the_run() -> None:
    panel = CalibrationRunExplorer("Gyro scale")
    panel.set(minute=20.0)
    trial = typical_trial("averaged")
    at = int(np.abs(trial.calibration.times - 1200).argmin())
    state = trial.calibration.model.names.index("gyro scale x")
    said = dict(results_of(panel))
    for name, value in (
        ("estimate", trial.calibration.state[at, state]),
        ("true", trial.imu_errors.gyro_error_matrix[0, 0]),
        ("error at this moment", trial.errors[at, state]),
        ("three deviations", 3 * trial.calibration.standard_deviations[at, state]),
    ):
        # The averaged axes change a scale factor by second order only: 0.01 ppm.
        assert float(said[name].removesuffix(" ppm")) == pytest.approx(value / micro, abs=0.02)

"""The deviations that the filter states, against an analysis that knows nothing of the package."""

import ast
from pathlib import Path

import numpy as np
import pytest
from scipy.constants import degree, g, hour, micro

import covariance_by_hand
from covariance_by_hand import ARC_SECOND, LATITUDE, standard_deviations
from driftlab.calibration.covariance import covariance_analysis, standard_deviation_history
from driftlab.calibration.error_dynamics import linearize_along
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.calibration.simulation import TurntableTrial
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme

AVERAGED = ERROR_MODELS["averaged"]


def test_the_other_analysis_imports_nothing_of_the_package() -> None:
    tree = ast.parse(Path(covariance_by_hand.__file__).read_text(encoding="utf-8"))
    imported = {
        name.name if isinstance(node, ast.Import) else node.module
        for node in ast.walk(tree)
        if isinstance(node, ast.Import | ast.ImportFrom)
        for name in node.names
    }
    assert {name.split(".")[0] for name in imported} == {"numpy", "scipy"}


@pytest.mark.slow
def test_filter_states_the_deviations_that_follow_without_the_package() -> None:
    trial = TurntableTrial(sample_interval=0.1)
    assert trial.latitude == LATITUDE
    found = trial.run(np.random.default_rng(1)).calibration
    assert found.model is AVERAGED
    # The filter goes along what it computes, some hundred arc seconds or 5e-4 from the true motion.
    np.testing.assert_allclose(
        found.standard_deviations[-1], standard_deviations(40 * ARC_SECOND), rtol=5e-4
    )


@pytest.mark.parametrize("installation", [40, 400])
def test_expected_deviations_are_those_that_follow_without_the_package(installation: int) -> None:
    prior = PriorStandardDeviations(installation=installation * ARC_SECOND)
    way = linearize_along(NINETEEN_POSITIONS, LATITUDE, AVERAGED)
    expected = np.sqrt(np.diag(covariance_analysis(way, ImuNoise(), prior)))
    found = standard_deviations(installation * ARC_SECOND)
    # Long steps are about one per cent off, as the docstring says.
    np.testing.assert_allclose(expected[6:], found[6:], rtol=0.02)


def test_deviations_are_those_that_a_third_hand_found() -> None:
    """Computed once more, by another program and another author; all their digits."""
    found = standard_deviations(40 * ARC_SECOND)
    for name, values, unit in (
        ("gyro scale", [3.582, 3.581, 3.549], micro),
        ("gyro non-orthogonality", [0.965, 0.962, 0.969], ARC_SECOND),
        ("accelerometer bias", [0.413, 0.502, 0.550], micro * g),
        ("accelerometer scale", [0.388, 0.351, 0.436], micro),
    ):
        states = [i for i, each in enumerate(AVERAGED.names) if each.startswith(name)]
        np.testing.assert_allclose(found[states] / unit, values, rtol=0, atol=5.001e-4)
    biases = found[6:9] / (degree / hour)
    assert 0.00765 < biases.min() < biases.max() < 0.00825


def test_the_velocity_is_seen_each_second_if_nothing_is_said_and_never_without_noise():
    turns = Scheme("+90Y", ("Up", "East", "North"))
    linearized = linearize_along(turns, 0.7, AVERAGED)
    known = linearized, ImuNoise(), PriorStandardDeviations()
    for analysis in (covariance_analysis, standard_deviation_history):
        np.testing.assert_array_equal(analysis(*known), analysis(*known, update=1.0))
        with pytest.raises(
            ValueError, match=r"^noise: expected a deviation .* above 0, got 0\.0 m"
        ):
            analysis(linearized, ImuNoise(reference_velocity=0.0), PriorStandardDeviations())


def test_what_is_measured_almost_exactly_has_no_deviation_that_is_no_number():
    """Its variance is then of the size of the rounding, and may be negative."""
    turns = Scheme("+90Y +90Y +90Y", ("Up", "East", "North"))
    linearized = linearize_along(turns, 0.7, ERROR_MODELS["averaged"])
    history = standard_deviation_history(
        linearized, ImuNoise(), PriorStandardDeviations(), update=1e-50
    )
    assert np.isfinite(history).all()

"""The deviations that the filter states, against an analysis that knows nothing of the package."""

import numpy as np
import pytest

from covariance_by_hand import ARC_SECOND, LATITUDE, standard_deviations
from driftlab.calibration.covariance import covariance_analysis, standard_deviation_history
from driftlab.calibration.error_dynamics import linearize_along
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.calibration.simulation import TurntableTrial
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme

AVERAGED = ERROR_MODELS["averaged"]


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

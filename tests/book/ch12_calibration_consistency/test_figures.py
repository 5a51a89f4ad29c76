"""The figures of chapter 12: is the calibration as good as it says?"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.constants import arcsecond, g

from driftlab.book import figures
from driftlab.book.ch11_kalman_calibration.experiments import STANDING
from driftlab.book.ch12_calibration_consistency.experiments import (
    ARM,
    TWELVE_TURNS,
    arms_alone,
    on_reference_velocity,
    squared_errors,
)
from driftlab.book.machinery.figure.publish import PublishedFigure
from driftlab.calibration import TurntableTrial, innovation_test
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.monte_carlo import mean_square_bounds
from driftlab.motion.scheme import SCHEMES, Scheme
from published import published


@published("12-filter-consistency")
def test_filter_consistency_of_the_published_runs(figure: PublishedFigure) -> None:
    data = figure.data
    low, high = data.innovation_mean_bounds
    assert low < data.innovation_mean < high
    # Of 814 independent values 95 % lie inside, with a standard deviation of 0.8 %.
    assert data.inside == pytest.approx(0.95, abs=0.025)
    assert data.state_bound_low < data.states_over_expected[-1] < data.state_bound_high


def test_a_study_is_computed_only_where_its_table_is_not_at_hand(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    name = "12-neglected-terms"
    known = figures.figure_definitions("12")[name]
    whole = figures.figure(name).data
    quick = replace(known, compute=lambda: whole)
    monkeypatch.setattr(figures, "figure_definitions", lambda _: {name: quick})
    assert figures.figure(name).data is not whole
    monkeypatch.setattr(figures, "_FOLDER", tmp_path)
    with pytest.warns(UserWarning, match=r"^12-neglected-terms is computed anew, which takes min"):
        assert figures.figure(name).data is whole


@pytest.mark.slow
@pytest.mark.parametrize(
    ("velocity", "scheme"),
    [
        (1e-4, "18 rotations"),
        pytest.param(1e-3, "19 positions", marks=pytest.mark.long),
        pytest.param(1e-5, "19 positions", marks=pytest.mark.long),
    ],
)
def test_the_filter_is_consistent_on_tables_that_stand(velocity: float, scheme: str) -> None:
    table = TurntableTrial(SCHEMES[scheme], sample_interval=0.1, keep=10**6,
                           noise=ImuNoise(reference_velocity=velocity))  # fmt: skip
    low, high = (bound / 27 for bound in mean_square_bounds(27, 20, 0.999))
    for size, passes in ((40, 1), (400, 2)):
        prior = PriorStandardDeviations(installation=size * arcsecond)
        found = replace(table, prior=prior, passes=passes).run(5, 20)
        assert low < found.nees[:, -1].mean() / 27 < high


@published("12-size-effect")
def test_what_hangs_on_the_reference_velocity(figure: PublishedFigure) -> None:
    """The range of each sentence of the section: 10 µm/s to 1 cm/s, both schemes."""
    known, arms = on_reference_velocity(), figure.data
    still = known.reference_velocity < 1.1 * STANDING
    # The noise of the gyros limits these.
    assert (known.gyro_bias / known.gyro_bias[:, :1]).max() < 1.3
    assert ((known.knots > 0.45) & (known.knots < 0.65)).all()
    assert ((known.knots_turned > 0.95) & (known.knots_turned < 1.35)).all()
    assert known.knots[:, still].max() < 0.5
    # These become sharper, and the lead of turns shrinks.
    for sharper in (known.pair, known.acc_bias):
        assert (np.diff(sharper) > 0).all()
        gain = sharper[:, -1:] / sharper[:, still]
        assert 2.4 < gain.min() < gain.max() < 3.4
    np.testing.assert_allclose(known.over_turns, known.pair / TWELVE_TURNS)
    assert 1.2 < known.over_turns[:, still].min() < known.over_turns[:, still].max() < 1.6
    assert 3.8 < known.over_turns[:, -1].min() < known.over_turns[:, -1].max() < 4.1
    # Lever arms: innovations notice them, the errors remain.
    assert known.with_arms.max() < 2
    assert known.with_arms[:, still].max() < 1.07
    bound = mean_square_bounds(3, int(arms.updates.max()))[1] / 3
    assert arms.noticed_at[0, -1] == pytest.approx(bound, abs=0.005)
    assert arms.noticed_at[:, arms.reference_velocity < 1.1e-3].min() > 2
    assert arms.noticed_at[:, still].min() > 7
    assert arms.worst_at.min() > 12


@published("12-many-runs")
def test_mean_of_many_runs_shows_errors_a_tenth_too_large(figure: PublishedFigure) -> None:
    data = figure.data
    assert data.verdict == "too large"
    assert data.mean == pytest.approx(1.21, abs=0.08)
    low, high = mean_square_bounds(27, 60)
    np.testing.assert_allclose(data.bounds, [low / 27, high / 27])
    assert data.bound_high[59] == pytest.approx(data.bounds[1])
    assert data.mean_so_far[-1] == data.mean
    right = squared_errors(27, 200, 1.0, 3)
    assert right.verdict == "consistent"
    assert squared_errors(27, 200, 0.7).verdict == "too small"


@published("12-varying-biases")
def test_innovations_do_not_show_varying_biases_at_1_cm_a_second(figure: PublishedFigure) -> None:
    data = figure.data
    loose, with_processes, still, still_with = data.squares
    assert (data.clean[[0, 1, 3]] == 1).all()
    assert loose[-1] > 7
    assert still[-1] > 100
    assert data.clean[2, -1] == 0
    for right in (with_processes, still_with):
        np.testing.assert_allclose(right, 1, atol=0.1)


@published("12-assumed-noise")
def test_squares_of_a_log_fit_once_the_noise_is_small_enough(figure: PublishedFigure) -> None:
    data = figure.data
    inside = (data.squares > data.squares_low) & (data.squares < data.squares_high)
    np.testing.assert_array_equal(inside, data.reference_velocity < 1e-4)
    assert (np.diff(data.stated) > 0).all()
    assert data.stated[-1] > 10 * data.error[-1]


@published("12-reference-velocity")
def test_reference_velocity_draws_what_the_chapter_lists(figure: PublishedFigure) -> None:
    np.testing.assert_array_equal(figure.data.pair, on_reference_velocity().pair)


@pytest.mark.long
def test_arms_bias_stays_in_size_while_it_grows_in_standard_deviations() -> None:
    """5 to 10 µg for any reference velocity, and the range of the innovations below 0.1 mm/s."""
    for scheme in SCHEMES.values():
        _, noticed, worst, bias, _ = np.transpose(
            [arms_alone(scheme, [ARM], velocity=each)[:, 0] for each in (1e-2, 1e-3, 1e-4, 1e-5)]
        )
        assert ((bias > 5e-6 * g) & (bias < 10e-6 * g)).all()
        assert (np.diff(worst) > 0).all()
        assert 1.25 < noticed[3] / noticed[2] < 1.45


@pytest.mark.long
@pytest.mark.parametrize("scheme", SCHEMES.values(), ids=SCHEMES)
def test_with_a_velocity_each_second_varying_biases_do_more_harm(scheme: Scheme) -> None:
    vary = ImuNoise(accelerometer_bias_instability=5e-6 * g, accelerometer_correlation_time=600.0)
    table = TurntableTrial(
        scheme, sample_interval=0.1, keep=10**6, noise=vary, assumed_noise=ImuNoise()
    )
    constants, honest = (
        replace(table, assumed_noise=each).run(np.random.default_rng(5), 12)
        for each in (ImuNoise(), None)
    )
    assert 10 < constants.nees[:, -1].mean() / 27 < 16
    assert np.mean(innovation_test(constants.calibration).verdict == "consistent") > 0.6
    stated = (each.calibration.standard_deviations[0, -1, 15:18] for each in (honest, constants))
    ratio = np.divide(*stated)
    assert ((ratio > 6) & (ratio < 7.5)).all()

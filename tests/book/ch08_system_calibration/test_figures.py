"""The figures of chapter 08: what a turntable shows, calibrations, and what they are good for."""

import numpy as np
import pytest
from scipy.constants import micro
from scipy.stats import binom

from driftlab.body_frames import BODY_FRAMES
from driftlab.book.ch08_system_calibration.experiments import (
    ALL_STARTS,
    FRAMES,
    PARAMETERS,
    STARTS,
    calibration_history,
    table_observability,
    typical_trial,
    unit_of,
    verdict,
)
from driftlab.book.ch08_system_calibration.figures import (
    table_observability as table_observability_figure,
)
from driftlab.book.machinery.publish import PublishedFigure
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.calibration.linearization import linearize_along
from driftlab.calibration.observability import covariance_analysis, unobservable_subspace
from driftlab.imu import ImuNoise, PriorDeviations
from driftlab.motion.scheme import Scheme
from published import published


@published("08-scheme-directions")
def test_scheme_directions_end_pauses_along_an_axis(figure: PublishedFigure) -> None:
    data = figure.data
    for times, up in zip(data.times, data.up, strict=True):
        assert len(times) == len(up)
        np.testing.assert_allclose(np.linalg.norm(up, axis=-1), 1, rtol=0, atol=1e-12)
        resting = np.linalg.norm(np.diff(up, axis=0), axis=-1) < 1e-12
        largest = np.abs(up[:-1][resting]).max(axis=-1)
        np.testing.assert_allclose(largest, 1, rtol=0, atol=1e-9)


@pytest.mark.xdist_group("CalibrationRunExplorer")
def test_calibration_run_is_what_the_trial_found() -> None:
    found = typical_trial("averaged")
    assert found.calibration.model.names[6:9] == PARAMETERS[:3]
    for i, parameter in enumerate(PARAMETERS):
        data = calibration_history(parameter, minute=10.0)
        np.testing.assert_allclose(data.true - data.estimate, found.errors[:, 6 + i], atol=1e-12)
        assert data.times[data.shown] == pytest.approx(600, abs=3)
    with pytest.raises(ValueError, match=r"parameter: expected one of gyro bias x, .*got 'new'"):
        calibration_history("new")


@published("08-calibration-errors")
def test_calibration_errors_stay_below_the_stated_deviations(figure: PublishedFigure) -> None:
    data = figure.data
    last = data.errors[-1] / data.deviations[-1]
    # Of 21 normal numbers one lies outside 4.5 in 7000 cases.
    assert np.abs(last).max() < 4.5
    assert (data.deviations[-1] < data.deviations[0]).all()
    assert unit_of("gyro scale x") == (micro, "ppm")
    assert unit_of("accelerometer installation xy")[1] == "arc seconds"


@published("08-filter-consistency")
def test_filter_consistency_of_the_published_runs(figure: PublishedFigure) -> None:
    data = figure.data
    low, high = data.innovation_mean_bounds
    assert low < data.innovation_mean < high
    # Of 814 independent values 95 % lie inside, with a standard deviation of 0.8 %.
    assert data.inside == pytest.approx(0.95, abs=0.025)
    low, high = data.state_bounds
    assert low < data.states[-1] < high
    by_frame = dict(zip(BODY_FRAMES, data.by_frame, strict=True))
    # Bent units make the model of first order too sure of itself, the triangles most.
    assert (data.by_frame[:, -1] > data.by_frame[:, 0]).all()
    for triangle in ("upper triangle", "lower triangle"):
        assert by_frame[triangle][-1] > by_frame["averaged"][-1]
    assert by_frame["accelerometers"][-1] < by_frame["averaged"][-1]


@published("08-table-observability")
def test_table_observability_draws_zero_for_the_unobservable(figure: PublishedFigure) -> None:
    data = figure.data
    assert data.unobservable == 3
    assert (data.eigenvalues[:3] < table_observability_figure.FLOOR).all()
    assert data.eigenvalues[3] > 1e-10
    assert len(data.descriptions) == 3
    drawn = table_observability_figure.TableObservabilityPicture()
    drawn.update(data)
    assert len(drawn.unobservable.get_xdata()) == 3
    assert len(drawn.bright.get_xdata()) == 27
    assert len(drawn.ratios.get_xdata()) == 24


@published("08-in-place")
def test_in_place_curves_are_one_if_both_start_from_one_attitude(figure: PublishedFigure) -> None:
    data = figure.data
    one, table = STARTS
    averaged, usual = FRAMES
    for quantity in ("velocity", "position"):
        curves = {key: getattr(run, quantity) for key, run in data.runs.items()}
        apart = np.abs(curves[averaged, one] - curves[usual, one]).max()
        assert apart < 0.01 * np.abs(curves[averaged, one]).max()
        assert np.abs(curves[averaged, table] - curves[usual, table]).max() > 50 * apart


def test_in_place_claim_verdict_counts() -> None:
    counted = verdict(np.array([0.5, 0.9, 0.99, 1.2]))
    assert (counted.better, counted.units) == (3, 4)
    assert counted.median == pytest.approx(0.945)
    # Clopper and Pearson: the chance of 3 or more is 2.5 % at the lower bound.
    low, high = counted.interval
    assert binom.sf(2, 4, low) == pytest.approx(0.025)
    assert binom.cdf(3, 4, high) == pytest.approx(0.025)


@published("08-in-place-claim")
def test_no_choice_of_axes_wins_from_one_attitude_and_averaged_axes_from_others(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    one, own, table = ALL_STARTS
    for quantity in ("attitude", "velocity", "position"):
        counted = verdict(data.ratios[one, quantity])
        assert counted.interval[0] < 0.5 < counted.interval[1]
        assert counted.median == pytest.approx(1, abs=2e-3)
    # The distance of the two sets of axes from the table: 1 to the root of 2 in the mean.
    assert verdict(data.ratios[table, "velocity"]).median < 0.9
    # What a calibration leaves over, about an arc second, moves the exact start by as much.
    exact = verdict(data.ratios[own, "velocity"])
    assert exact.interval[0] > 0.5
    assert 0.98 < exact.median < 1
    for quantity in ("attitude", "position"):
        low, high = verdict(data.ratios[own, quantity]).interval
        assert low < 0.5 < high
    # The numbers that the book states.
    assert (exact.better, exact.units) == (163, 200)
    assert verdict(data.ratios[table, "velocity"]).better == 145


def test_observability_of_a_table_is_that_of_its_own_scheme_model_latitude_and_noise() -> None:
    scheme = Scheme("+90Z -90X", ["East", "North", "Up"])
    for latitude in (0.6, -0.6):
        for model in ERROR_MODELS.values():
            for noise in (ImuNoise(), ImuNoise(reference_velocity=0.1)):
                data = table_observability(scheme, model, noise, latitude)
                way = linearize_along(scheme, latitude, model)
                after = np.sqrt(np.diag(covariance_analysis(way, noise, PriorDeviations())))
                np.testing.assert_array_equal(data.after, after)
                assert data.descriptions == unobservable_subspace(way).descriptions
                data.descriptions.clear()  # nothing that is kept
    with pytest.raises(ValueError, match="latitude: expected one number, got shape"):
        table_observability(scheme, latitude=[0.6])
    with pytest.raises(ValueError, match="model: expected an ErrorModel, got"):
        table_observability(scheme, ["x"])
    odd = Scheme("+90Z -90X", ("East", "North", "Up"), np.array(120.0), np.radians(10.0))
    assert (
        table_observability(odd, latitude=0.6).descriptions
        == unobservable_subspace(linearize_along(scheme, 0.6)).descriptions
    )

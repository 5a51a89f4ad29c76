"""From residual to mission: linear in variances, and what aligned units do that turn and rest."""

import numpy as np
import pytest
from scipy.constants import degree, hour, knot, nautical_mile

from driftlab.calibration.body_axes import attitude_error
from driftlab.calibration.error_budget import (
    MissionErrors,
    calibration_error_budget,
    mission_error_sources,
    mission_errors,
)
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.calibration.static_error_growth import (
    STATIC_ERROR_SOURCES,
    static_error_sources,
    static_errors,
)
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import align
from driftlab.imu import NO_ERRORS, PriorStandardDeviations
from driftlab.increments import measure
from driftlab.motion import Scheme, turntable_trajectory
from driftlab.motion.turntable import static_trajectory
from driftlab.strapdown import final_state, navigate, stationary_state

LEVEL = np.array([0.0, 0.0, 0.0, 1.0])
MODEL = ERROR_MODELS["averaged"]
LATITUDE = 0.65
TIMES = np.arange(600.0, 4 * hour + 1, 600.0)


def self_aligned(unit, standing):
    """Attitude that a unit finds from its own means, without noise."""
    still = measure(static_trajectory(standing, LATITUDE, 1.0, 2).increments, unit)
    rate, force = (row.mean(axis=-2)[..., [1, 2, 0]] for row in (still.angle, still.velocity))
    found = align(rate, force)
    return from_euler_angles(found.heading, found.pitch, found.roll)[..., [2, 0, 1, 3]]


def test_variances_add_and_deviations_scale():
    rng = np.random.default_rng(1)
    first, second = (half @ half.T for half in rng.standard_normal((2, 12, 12)))
    one, two, both, thrice = (
        mission_errors(TIMES, LATITUDE, part) for part in (first, second, first + second, 9 * first)
    )
    for name in ("position", "heading"):
        squares = getattr(one, name) ** 2 + getattr(two, name) ** 2
        np.testing.assert_allclose(getattr(both, name) ** 2, squares, rtol=1e-9)
        np.testing.assert_allclose(getattr(thrice, name), 3 * getattr(one, name), rtol=1e-9)
    assert thrice.radial_error_rate == pytest.approx(3 * one.radial_error_rate)


def test_distances_of_several_missions():
    position = np.array([[[3.0, 4.0], [5.0, 12.0]], [[8.0, 15.0], [0.0, 7.0]]])
    errors = MissionErrors(np.array([60.0, 120.0]), position, np.zeros((2, 2)))
    np.testing.assert_array_equal(errors.distance, [[5.0, 13.0], [17.0, 7.0]])


def test_one_certain_cause_has_the_size_of_its_curve():
    causes = np.linspace(1e-8, 2e-8, 12)
    errors = mission_errors(TIMES, LATITUDE, np.outer(causes, causes))
    curve = static_errors(TIMES, LATITUDE, causes)
    # A variance is the difference of large numbers where the curve crosses zero.
    np.testing.assert_allclose(errors.position, np.abs(curve.position), rtol=1e-5, atol=1e-7)
    np.testing.assert_allclose(errors.heading, np.abs(curve.attitude[:, 2]), rtol=1e-5, atol=1e-14)


def test_a_hundredth_of_a_degree_an_hour_is_three_fifths_of_a_mile_an_hour():
    """An arc minute of the Earth is a mile: 0.01 deg/h is 0.6 arc minutes an hour."""
    causes = np.zeros(12)
    causes[7] = 0.01 * degree / hour
    swing = 2 * np.pi / 1.24e-3  # Over whole swings of Schuler's pendulum there is the line alone.
    rate = abs(static_errors([swing], LATITUDE, causes).position[0, 1]) / swing
    # The Earth turns by 0.37 in that time, and away from East by a fifteenth of it.
    assert rate == pytest.approx(0.6 * knot, rel=0.03)


@pytest.mark.parametrize("standing", [LEVEL, [0.1, -0.2, 0.4, 0.9]])
def test_an_aligned_unit_begins_with_the_causes_that_are_computed(standing):
    standing = np.asarray(standing) / np.linalg.norm(standing)
    states = np.random.default_rng(2).multivariate_normal(
        np.zeros(27), 1e-4 * MODEL.covariance(PriorStandardDeviations(), LEVEL), 5
    )
    units = MODEL.imu_errors(states)
    found = static_error_sources(
        units, NO_ERRORS, standing, start=self_aligned(units, standing), reference=standing,
        latitude=LATITUDE,
    )  # fmt: skip
    computed = states @ mission_error_sources(MODEL, standing, LATITUDE).T
    # Second order: a heading that is wrong by 1e-3, times a tilt.
    gap = np.abs(found - computed).max(axis=0)
    assert (gap <= 2e-3 * np.abs(computed).max(axis=0)).all()


@pytest.mark.parametrize("turn", [90, -180])
def test_a_turn_after_the_alignment_does_what_is_computed(turn):
    """Navigate through a turn of a few seconds, and then at rest for an hour."""
    state = np.random.default_rng(3).multivariate_normal(
        np.zeros(27), 1e-4 * MODEL.covariance(PriorStandardDeviations(), LEVEL)
    )
    state[6:9] *= 1e-2  # so that the turn counts beside the gyros' biases
    unit = MODEL.imu_errors(state)
    scheme = Scheme(f"{turn:+d}Z", ("East", "North", "Up"), dwell=1e-3, rate=np.radians(60.0))
    way = turntable_trajectory(scheme, LATITUDE, 5e-3, multiple_of=2)
    moved = final_state(
        navigate(
            stationary_state(LATITUDE, self_aligned(unit, LEVEL)), measure(way.increments, unit)
        )
    )
    phi = attitude_error(moved.attitude, way.attitude[-1])
    causes = mission_error_sources(MODEL, LEVEL, LATITUDE, np.radians(turn)) @ state
    # What a few seconds add of their own: the Earth's turn under the errors, 15 arc seconds/s.
    size = np.abs(causes[:3]).max()
    np.testing.assert_allclose(phi, causes[:3], rtol=0, atol=1e-3 * size)
    assert (
        np.abs(mission_error_sources(MODEL, LEVEL, LATITUDE)[:3] @ state - phi).max() > 0.05 * size
    )
    end = static_trajectory(way.attitude[-1], LATITUDE, 1.0, 3600)
    start = moved._replace(velocity=np.zeros(3), latitude=LATITUDE, longitude=0.0, altitude=0.0)
    run = navigate(start, measure(end.increments, unit), hold_altitude=True, every=3600)
    curve = static_errors([3600.0], LATITUDE, causes).position[0]
    north = (final_state(run).latitude - LATITUDE) * 6.36e6
    east = final_state(run).longitude * 6.385e6 * np.cos(LATITUDE)
    assert np.hypot(*(curve - [east, north])) < 0.01 * np.hypot(*curve)


def test_budget_of_a_calibration_is_that_of_its_kinds():
    covariance = MODEL.covariance(PriorStandardDeviations(), LEVEL)
    budget = calibration_error_budget(TIMES, LATITUDE, MODEL, covariance, LEVEL, turn=1.0)
    assert list(budget) == [
        "gyro bias", "gyro scale", "gyro non-orthogonality",
        "accelerometer bias", "accelerometer scale", "accelerometer installation", "all",
    ]  # fmt: skip
    *kinds, whole = budget.values()
    assert isinstance(whole, MissionErrors)
    # Before a calibration the kinds are independent but for the choice of axes, which joins the
    # installation errors of both triads; biases are by far the largest.
    squares = sum(kind.distance**2 for kind in kinds)
    np.testing.assert_allclose(whole.distance**2, squares, rtol=1e-3)
    # The farther it turns after its alignment, the less of a gyro's bias cancels.
    rates = [
        calibration_error_budget(TIMES, LATITUDE, MODEL, covariance, LEVEL, turn)[
            "all"
        ].radial_error_rate
        for turn in np.radians([0, 90, 180])
    ]
    assert rates[0] < rates[1] < rates[2] < 3 * rates[0]
    assert whole.distance[-1] / nautical_mile > 100


@pytest.mark.parametrize("turn", [2 * np.pi, -2 * np.pi])
def test_a_whole_turn_after_the_alignment_leaves_what_the_scale_makes_of_it(turn):
    left = mission_error_sources(MODEL, LEVEL, 0.1, turn) - mission_error_sources(MODEL, LEVEL, 0.1)
    scale, up = MODEL.names.index("gyro scale z"), STATIC_ERROR_SOURCES.index("attitude Up")
    assert abs(left[up, scale]) == pytest.approx(2 * np.pi)
    left[up, scale] = 0.0
    np.testing.assert_allclose(left, 0, atol=1e-12)


def test_bad_arguments_are_refused_by_name():
    with pytest.raises(ValueError, match=r"^covariance: expected shape \(\.\.\., 12, 12\)"):
        mission_errors([1.0], 0.1, np.eye(7))
    none = np.zeros((MODEL.size, MODEL.size))
    with pytest.raises(ValueError, match=r"^covariance: expected shape \(27, 27\), as calib"):
        calibration_error_budget([1.0], 0.1, MODEL, none[np.newaxis], LEVEL)
    for negative in (np.ones(MODEL.size), np.eye(MODEL.size)[-1]):
        with pytest.raises(ValueError, match=r"^covariance: expected squares of deviations"):
            calibration_error_budget([1.0], 0.1, MODEL, np.diag(0.5 - negative), LEVEL)
    with pytest.raises(ValueError, match=r"^times: expected times since the start, got -5 s"):
        calibration_error_budget([-5.0], 0.1, MODEL, none, LEVEL)
    with pytest.raises(ValueError, match=r"^turn: expected at most a whole turn, in rad, got 180"):
        calibration_error_budget([1.0], 0.1, MODEL, none, LEVEL, 180.0)
    with pytest.raises(ValueError, match=r"^times: expected some time after the start"):
        _ = mission_errors([0.0], 0.1, np.eye(12)).radial_error_rate

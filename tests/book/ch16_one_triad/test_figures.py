"""The figure of chapter 16: one triad through all calibrations."""

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.constants import arcsecond

from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.book.ch12_calibration_consistency.experiments import (
    TWELVE_TURNS,
    on_reference_velocity,
)
from driftlab.book.ch16_one_triad import experiments as capstone
from driftlab.book.machinery.figure.publish import PublishedFigure
from driftlab.book.scenarios import TURN, ship_manoeuvre
from driftlab.calibration.simulation import TurntableTrial
from driftlab.drift.turn_calibration import earth_rate_offset
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import align
from driftlab.gyrocompass.simulation import simulate_gyrocompass
from driftlab.imu import TYPICAL_ERRORS
from driftlab.motion.vehicle import static_imu
from published import published
from saratov import LATITUDE, LEVEL_RATE
from support import EPS, largest

BEND = 1e-3  # size of the errors of the triads here
pytestmark = pytest.mark.xdist_group("CapstoneExplorer")  # all need its long calibration
six = st.tuples(*[st.floats(-BEND, BEND)] * 6).map(np.array)


@given(six)
def test_a_bent_triad_is_a_symmetric_bend_and_a_turn(numbers: np.ndarray) -> None:
    matrix = capstone.bent_triad(numbers[:3], numbers[3:])
    # Entries are a sum or a difference, and their halves bring both back.
    close = {"rtol": 0, "atol": 8 * EPS * BEND}
    np.testing.assert_allclose(capstone.pairs_and_turn(matrix), numbers, **close)
    assert not np.diag(matrix).any()
    rate = np.array([0.3, -0.5, 0.7])
    bend = capstone.bent_triad(numbers[:3], np.zeros(3))
    np.testing.assert_array_equal(bend, bend.T)
    turned = np.cross(numbers[3:], rate)
    np.testing.assert_allclose((matrix - bend) @ rate, turned, **close)


@published("16-capstone")
def test_turns_find_the_bend_within_their_noise_and_the_filter_both(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    true, turns, filtered = data.bend
    # 0.005 degrees a root hour in 36 s; half of the angle, over pi, is the estimate. A pair is one
    # about the axis between two less half of those about the two, each from both senses.
    noise = 0.005 * np.pi / 180 * np.sqrt(36 / 3600) / (2 * np.pi) * np.sqrt((1 + 2 / 4) / 2)
    of_filter = on_reference_velocity().pair[0, -1]  # at 1 cm/s, as the run
    np.testing.assert_allclose(capstone.turn_deviations(), noise)
    np.testing.assert_allclose(TWELVE_TURNS, noise)
    gap = np.abs(turns[:3] - true[:3])
    assert 0.05 * noise < gap.max() < 4.9 * noise
    assert (np.abs(filtered - true)[:3] < 4.9 * of_filter).all()
    assert np.isnan(turns[3:]).all()
    np.testing.assert_allclose(true, [*capstone.NON_ORTHOGONALITY, *capstone.MISALIGNMENT])
    leftover = capstone.pairs_and_turn(capstone.filter_leftover())
    np.testing.assert_allclose(filtered - true, leftover, rtol=0, atol=8 * EPS * largest(true))
    assert largest(filtered - true) < 1.5 * arcsecond


def test_the_lead_of_turns_over_the_filter_hangs_on_the_table() -> None:
    """Reference velocities of 10 µm/s to 1 cm/s, both schemes; a table that stops to 0 and 1″."""
    of_turns, known = capstone.turn_deviations(), on_reference_velocity()
    copies = np.diag(capstone.found_by_turns(np.zeros((3, 3))).covariance)[:3]
    with_stops = np.sqrt(of_turns**2 + copies * (arcsecond / (2 * np.pi)) ** 2)
    leads = known.pair / np.array([of_turns.max(), with_stops.max()])[:, np.newaxis, np.newaxis]
    still = known.reference_velocity < 1.1e-4
    assert 1 < leads[..., still].min() < leads[..., still].max() < 1.6
    assert 3.3 < leads[..., -1].min() < leads[..., -1].max() < 4.1


def test_twelve_turns_on_the_earth_are_as_noisy_as_they_say(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    bent = capstone.bent_triad(capstone.NON_ORTHOGONALITY, capstone.MISALIGNMENT)
    of_turns = capstone.turn_deviations()
    runs = 200
    errors = np.empty((runs, 3))
    for seed in range(runs):
        monkeypatch.setattr(capstone, "SEED", seed)
        errors[seed] = (capstone.found_by_turns(bent).sigma - capstone.NON_ORTHOGONALITY) / of_turns
    # Chi-square with 600 degrees of freedom: five standard deviations on either side.
    assert np.mean(errors**2) == pytest.approx(1, abs=5 * np.sqrt(2 / errors.size))


def test_one_sense_shows_the_earth_and_both_do_not() -> None:
    bent = capstone.bent_triad(capstone.NON_ORTHOGONALITY, capstone.MISALIGNMENT)
    there, back = capstone.turn_estimates(bent)
    expected = np.einsum("ni,ij,nj->n", capstone.AXES, bent, capstone.AXES)
    turn = capstone.TURNS[0]
    odd = (
        earth_rate_offset(turn.latitude, turn.rate)
        + capstone.AXES @ TYPICAL_ERRORS.gyro_bias / turn.rate
    )
    # Second order: squares and products of the bend, 2e-4, and the Earth's share, 3e-4.
    np.testing.assert_allclose((there + back) / 2, expected, rtol=0, atol=3e-7)
    np.testing.assert_allclose((there - back) / 2, odd, rtol=0, atol=3e-7)


@published("16-capstone")
def test_drift_per_turn_is_that_of_what_is_left(figure: PublishedFigure) -> None:
    """2 pi n^T M n; a pure turn of the triad shows in it only in second order."""
    data = figure.data
    found, left = capstone.bent_triad(*np.split(data.bend[0], 2)), capstone.filter_leftover()
    by_turns = capstone.bent_triad(data.bend[1, :3], np.zeros(3))
    for row, matrix in zip(data.drift, (found, found - by_turns, -left), strict=True):
        expected = 2 * np.pi * np.einsum("ni,ij,nj->n", capstone.AXES, matrix, capstone.AXES)
        # The exact drift has half of the square of what is across as well.
        second = np.pi * np.linalg.norm(matrix, 2) ** 2
        np.testing.assert_allclose(row, expected, rtol=0, atol=1.01 * second)
        assert largest(row) > 10 * second
    np.testing.assert_allclose(data.drift[0, 3:], 2 * np.pi * capstone.NON_ORTHOGONALITY, rtol=0.01)


@published("16-capstone")
def test_alignment_errors_of_the_triad_are_the_exact_ones_in_first_order(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    attitude = from_euler_angles(data.headings, 0.0, 0.0)
    rate, force = static_imu(attitude, LATITUDE)
    bent = capstone.bent_triad(*np.split(data.bend[0], 2))
    by_turns = capstone.bent_triad(data.bend[1, :3], np.zeros(3))
    matrices = (bent, bent - by_turns, -capstone.filter_leftover())
    for aligned, matrix in zip(data.aligned_error, matrices, strict=True):
        gap = align(rate + rate @ matrix.T, force).heading - data.headings
        gap = np.angle(np.exp(1j * gap))
        second = (np.linalg.norm(matrix, 2) / np.cos(LATITUDE)) ** 2
        np.testing.assert_allclose(aligned, gap, rtol=0, atol=second)
        assert largest(aligned) > 30 * second
    assert largest(data.aligned_error[2]) < 0.1 * largest(data.aligned_error[0])


def test_a_coning_mount_adds_one_drift_at_all_stages() -> None:
    still, shaken = (capstone.calibration_stages(half_angle=angle) for angle in (0.0, 0.02))
    cone = coning_drift("two-step-4", 0.02, capstone.CONING_FREQUENCY, capstone.SAMPLE_INTERVAL)
    # About the right axis, of which East gets the cosine of the heading.
    expected = float(cone) * np.cos(still.headings) / LEVEL_RATE
    for before, after in zip(still.aligned_error, shaken.aligned_error, strict=True):
        np.testing.assert_allclose(after - before, expected, rtol=0, atol=1e-15)
    assert largest(expected) > 1e-8
    worse = capstone.calibration_stages(half_angle=0.02, algorithm="picard-1")
    assert largest(worse.aligned_error[2] - still.aligned_error[2]) > 10 * largest(expected)


@published("16-capstone")
def test_each_calibration_makes_the_heading_under_way_better(figure: PublishedFigure) -> None:
    data = figure.data
    errors = np.degrees([largest(error) for error in data.heading_error])
    assert errors[1] < 0.5 * errors[0]
    assert errors[2] < 0.02 * errors[1]
    # After the turns the turn of the triad is left, and nothing else to speak of.
    turned = capstone.calibration_stages(np.zeros(3)).heading_error[0]
    assert largest(data.heading_error[1] - turned) < 0.02 * largest(turned)


@published("16-capstone")
def test_the_step_is_short_enough_for_the_bent_triad(figure: PublishedFigure) -> None:
    coarse = figure.data
    step = int(coarse.time[0])
    assert step > 1
    fine = capstone.calibration_stages(interval=1.0)
    np.testing.assert_allclose(coarse.time, fine.time[step - 1 :: step])
    gap = coarse.heading_error - fine.heading_error[:, step - 1 :: step]
    # A thousandth of what the bent triad has, in each of the stages.
    assert np.degrees(largest(gap)) < 0.0005
    assert np.degrees(largest(fine.heading_error[0])) == pytest.approx(0.797, abs=0.001)
    assert np.degrees(largest(fine.heading_error[1])) == pytest.approx(0.315, abs=0.001)


@pytest.mark.parametrize("latitude", [0.0, LATITUDE, np.radians(70)])
def test_a_quarter_turn_does_more_harm_than_rest_to_random_triads(latitude: float) -> None:
    matrices = 1e-4 * np.random.default_rng(1).normal(size=(200, 3, 3)) * (1 - np.eye(3))
    way = ship_manoeuvre(latitude, speed=0.0, interval=16.0)
    drifts = way.increments.mean_rate @ np.swapaxes(matrices, -1, -2)
    voyages = simulate_gyrocompass(way, drifts, speed_log=True)
    in_turn = np.abs(voyages.heading_error[:, voyages.times > sum(TURN)]).max(axis=-1)
    headings = np.radians(np.arange(0.0, 360.0, 10.0))
    rest = capstone.aligned_heading_error(matrices, headings, latitude)
    ratio = in_turn / np.abs(rest).max(axis=-1)
    assert np.mean(ratio > 3) > 0.9


def test_what_a_real_calibration_leaves_does_not_depend_on_the_bend() -> None:
    kept = capstone.filter_leftover()
    other = capstone.bent_triad(
        np.array([60.0, -40.0, -50.0]) * arcsecond, np.array([-30.0, 45.0, 10.0]) * arcsecond
    )
    trial = TurntableTrial(frame="accelerometers", sample_interval=0.1).run(
        np.random.default_rng(capstone.SEED), imu_errors=capstone.bent_unit(other)
    )
    left = trial.calibration.imu_errors.gyro_error_matrix - other
    default = capstone.bent_triad(capstone.NON_ORTHOGONALITY, capstone.MISALIGNMENT)
    # The two differ in second order: by the squares of the two bends.
    second = sum(np.linalg.norm(matrix, 2) ** 2 for matrix in (other, default))
    assert largest(left - kept) < 2 * second
    assert largest(kept) > 5 * second
    assert not kept.flags.writeable


@published("16-damped-turn")
def test_damping_leaves_of_the_swing_what_the_impulse_response_says(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    np.testing.assert_allclose(
        data.remaining, capstone.remaining_part(data.ratio), rtol=0.05, atol=0.02
    )
    # At 0 and 1 the formula is known; from both sides of 1 it comes to the same.
    np.testing.assert_allclose(capstone.remaining_part([0.0, 1.0]), [1.0, np.exp(-1)])
    beside = capstone.remaining_part([1 - 1e-4, 1 + 1e-4])
    np.testing.assert_allclose(beside, np.exp(-1), rtol=1e-3)
    # Strong damping reduces the error at once and then holds it; one half ends it.
    end = np.abs(data.heading_error[:, -1])
    worst = np.abs(data.heading_error).max(axis=1)
    assert end[-1] > 0.6 * worst[-1]
    assert end[2] < 0.2 * worst[2]

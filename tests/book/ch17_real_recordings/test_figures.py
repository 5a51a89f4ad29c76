"""What the book makes of published recordings, held against those who published them.

The numbers are those of the published tables of the figures; where the recordings are at hand,
`tests/book/test_figures.py` holds these against fresh computation.
"""

import numpy as np
import pytest

from driftlab.book.ch17_real_recordings import experiments
from driftlab.book.ch17_real_recordings.experiments import (
    BIAS_STEP,
    ODD,
    PAUSE,
    SOURCES,
    STOP,
    UNITS,
    WAY_NAMES,
    WAYS,
)
from driftlab.book.ch17_real_recordings.experiments.five_units import authors_rests
from driftlab.book.ch17_real_recordings.experiments.publishers_numbers import _FIVE_GYROS
from driftlab.earth import EARTH_RATE
from published import kept_table
from support import recording_or_skip

TURN = 2 * np.pi
IMUCAL = np.diag([1.0279243264288036, 0.9824277738468916, 0.9983104874451514]) @ [
    [0.999979342528037, -0.00045421361799804057, -0.006411568231274507],
    [-0.00022220540636464124, 0.9999961009525417, -0.002783649487862618],
    [0.009714004498496572, 0.0076410932929403316, 0.9999236229882218],
]
"""K times R of imucal 2.6.0 on its own session, gravity 9.81 m/s^2."""


@pytest.fixture(scope="module")
def turns():
    return kept_table("17-hand-turns")


@pytest.fixture(scope="module")
def two():
    return kept_table("17-two-calibrations")


@pytest.fixture(scope="module")
def five():
    return kept_table("17-five-units")


def largest(matrices):
    return np.abs(matrices).max(axis=(-2, -1))


def test_ferrariss_diagonal_is_that_of_imucal(turns):
    np.testing.assert_allclose(turns.ferraris, np.diag(IMUCAL) - 1, rtol=0, atol=2e-7)
    assert turns.ferraris.round(5).tolist() == [0.02790, -0.01758, -0.00177]


def test_larins_estimate_stands_beside_ferrariss_diagonal(turns):
    """Half the square of what stands across; from one cut they differ by that and gravity's part.

    From rest to rest another cut is seen to count for more than the two methods do.
    """
    along = np.abs(np.diag(turns.integral)) / TURN - 1
    across = ((turns.integral / TURN) ** 2).sum(axis=1) - (1 + along) ** 2
    np.testing.assert_allclose(turns.estimate - along, across / 2, rtol=0.15)
    assert (np.abs(turns.by_sections - turns.ferraris) < 2e-5).all()
    moved = np.abs(turns.estimate - turns.by_sections)
    assert moved.max() < 2e-4
    assert moved.max() > 10 * np.abs(turns.by_sections - turns.ferraris).max()
    assert (np.abs(turns.estimate - turns.ferraris) < turns.deviation).all()


def test_the_stop_that_is_assumed_is_no_better_than_the_hand_was_seen_to_be(turns):
    """The turn about x goes on for 0.07 degrees after the publishers' section; 0.1 is assumed."""
    after = np.abs(turns.estimate - turns.by_sections) * TURN
    assert np.degrees(after.max()) == pytest.approx(0.068, abs=2e-3)
    assert after.max() < STOP
    assert (turns.sources[:, 0] == turns.sources.max(axis=1)).all()


def test_what_stands_across_the_axis_adds_up_to_nothing(turns):
    """(-369.97, 0.16, -3.49) degrees turned, (-9.98, 0.02, -0.11) left, about x; so for all."""
    np.testing.assert_allclose(np.degrees(turns.integral[0]), [-369.97, 0.16, -3.49], atol=5e-3)
    np.testing.assert_allclose(np.degrees(turns.error[0]), [-9.98, 0.02, -0.11], atol=5e-3)
    others = ~np.eye(3, dtype=bool)
    added = np.abs(turns.integral[others]).reshape(3, 2).max(axis=1)
    left = np.abs(turns.error[others]).reshape(3, 2).max(axis=1)
    assert (added > 25 * left).all()


def test_deviations_of_the_turns_are_their_sources_in_quadrature(turns):
    np.testing.assert_allclose(turns.deviation, np.linalg.norm(turns.sources, axis=1), rtol=1e-9)
    earth = turns.sources[:, SOURCES.index("Earth")]
    np.testing.assert_allclose(earth, EARTH_RATE * turns.duration / TURN, rtol=1e-9)
    bias = np.abs(turns.with_bias - turns.estimate)
    assert (bias > 2.5 * turns.deviation).all()  # left in, it would be what counts


def test_a_rotation_carries_one_published_calibration_into_the_other(two):
    first, second = two.published_gyro
    assert largest(first - second) == pytest.approx(0.0214, abs=5e-5)
    # Their six digits, through an inverse and a rotation.
    assert largest(two.carried[0] - second) < 3e-6
    assert largest(two.carried[1] - two.published_accelerometer[1]) < 3e-6
    one, other = np.eye(3) + np.array([two.published_gyro, two.published_accelerometer])
    relative = one @ np.linalg.inv(other)
    assert largest(np.diff(relative, axis=0)[0]) < 5e-6
    assert np.degrees(np.linalg.norm(two.rotation)) == pytest.approx(1.34, abs=5e-3)


def test_the_published_accelerometers_come_out_to_their_last_digits(two):
    assert (largest(two.accelerometer - two.published_accelerometer) < 2e-6).all()
    assert two.costs[0] == pytest.approx(experiments.IMU_TK_COSTS[0], abs=5e-7)


def test_the_published_gyro_matrix_comes_out_within_its_deviation(two):
    difference = two.gyro - two.published_gyro
    assert (largest(difference) < 3.3e-4).all()
    assert (np.abs(difference[0]) < 0.2 * two.deviation).all()
    assert two.costs[1] == pytest.approx(experiments.IMU_TK_COSTS[1], rel=0.02)
    weighted = np.abs(two.by_poses - two.published_gyro[0])
    assert (weighted < two.by_poses_deviation).all()


def test_calibration_takes_most_of_the_tilt_away(two):
    before, after = (np.sqrt((angles**2).mean()) for angles in (two.before, two.calibrated))
    assert len(two.before) == len(two.calibrated) == 37
    assert np.degrees(after) == pytest.approx(0.52, abs=5e-3)
    assert before > 6 * after
    assert after**2 * 37 / 2 == pytest.approx(two.costs[1], rel=1e-9)


def test_the_authors_way_gives_all_five_published_gyro_matrices(five):
    assert (five.largest_difference[:, 0] < 3.5e-4).all()
    assert (five.in_deviations[0] < 1 / 3).all()
    assert (five.largest_difference[:, 1] < 5e-4).all()  # another integration of the same moves


def test_one_rest_of_six_samples_makes_the_second_unit(five):
    way = WAY_NAMES.index("without rests under 0.1 s")
    begin, end = five.pause
    assert end - begin == five.shortest[ODD] == 6
    others = np.arange(5) != ODD
    assert (five.shortest[others] >= 10).all()
    np.testing.assert_array_equal(five.gyro[way][others], five.gyro[way - 1][others])
    assert five.moves[way, ODD] == five.moves[way - 1, ODD] - 1
    # The two moves that meet in that rest are three times as bad as any other.
    worst = np.sort(five.angles)
    assert worst[-2] > 3 * worst[-3]
    left = np.degrees(five.angle_left[ODD])
    np.testing.assert_allclose(left[[0, way]], [0.30, 0.09], rtol=0, atol=5e-3)
    assert (left[way:] < 0.105).all()
    assert five.angle_left[ODD, 0] > 2 * five.angle_left[others, 0].max()
    assert (five.largest_difference[ODD, way:] > 4e-3).all()
    # Entry by entry, in deviations of the fit with that rest and of the one without.
    assert [way - 1, way] == PAUSE
    np.testing.assert_allclose(five.moved_in_deviations, [1.63, 5.15], rtol=0, atol=0.01)
    # Whatever else is chosen stays by the second matrix, and four deviations off the table.
    beside = np.abs(five.gyro[way + 1 :, ODD] - five.gyro[way, ODD])
    assert (beside < 2.35 * five.deviation[way + 1 :, ODD]).all()
    assert (five.in_deviations[way:, ODD] > 4).all()
    assert (five.in_deviations[way:, others] < 4).all()


def test_the_table_of_accelerometers_is_that_of_the_code_of_its_year(five):
    today = largest(five.accelerometer - five.published_accelerometer)
    then = largest(five.before_the_fix - five.published_accelerometer)
    assert (today < 2.2e-4).all()
    assert (then < 1.1e-4).all()
    assert (then < 4.1e-5).sum() == 4
    assert (then < 0.6 * today).all()


def test_rounded_biases_are_what_the_table_leaves_too_much(five):
    """Half a unit of their last digit is 0.03 degrees a second; refitted, nothing is left of it."""
    assert (five.published_residual > 1.03 * five.angle_left[:, 0]).all()
    np.testing.assert_allclose(five.with_own_bias, five.angle_left[:, 0], rtol=0.03)


def test_the_table_rounds_gyro_biases_to_a_thousandth():
    biases = np.radians([_FIVE_GYROS[f"b_{axis}"] for axis in "xyz"])
    steps = biases / BIAS_STEP
    # Its third digit after the point, of a degree, is 0.0175 of such a step.
    assert np.abs(steps - steps.round()).max() < 0.5 * 0.0175 + 1e-3


def test_the_rule_finds_that_rest_in_the_record(five):
    log = recording_or_skip(UNITS[ODD])
    cuts = authors_rests(log, WAYS[0])
    assert tuple(five.pause) in cuts
    assert len(cuts) == five.moves[0, ODD] + 1 == 24


def test_estimates_by_hand_are_those_of_the_turns(turns):
    shown = kept_table("17-hand-estimates")
    four = np.array([turns.estimate, turns.by_sections, turns.ferraris, turns.with_bias]).T
    np.testing.assert_allclose(shown.scale_error, four, rtol=1e-9)
    bars = (shown.high - shown.low) / 2
    np.testing.assert_allclose(bars[:, 0], turns.deviation, rtol=1e-6)
    assert not bars[:, 1:].any()
    # Methods agree on one cut, and within the bar; only the bias left in is outside.
    assert np.abs(four[:, 1] - four[:, 2]).max() < turns.deviation.min()
    assert (np.abs(four[:, 3] - four[:, 0]) > 2.5 * turns.deviation).all()

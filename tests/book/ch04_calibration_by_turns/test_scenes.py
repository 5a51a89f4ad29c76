"""The scene of chapter 04: four mountings, whose turns find what the package finds."""

import numpy as np
import pytest
from scipy.constants import arcsecond, degree

from driftlab.book.ch04_calibration_by_turns.experiments import mountings
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import LARIN_TRIAD, SKEW
from driftlab.drift import earth_rate_offset, error_quaternion, exact_turn_estimate
from driftlab.drift.weighing_designs import YATES_AXES
from driftlab.motion import TurntableRotation
from driftlab.quaternion import rotate, to_rotation_vector

TABLE = TurntableRotation(10 * degree)
ON_EARTH = TurntableRotation(10 * degree, latitude=37.5 * degree)
BENT = 1e-3 * np.array([[0.2, 1.5, 0], [0, 0, -1], [1, 0.3, -0.1]])


@pytest.fixture(scope="module")
def bent() -> DataTable:
    return mountings(BENT, TABLE)


def test_the_axis_of_each_mounting_stands_upright_while_it_turns(bent: DataTable) -> None:
    axes = rotate(bent.attitude, YATES_AXES[bent.mounting])[bent.turning]
    np.testing.assert_allclose(axes, np.tile([0, 0, 1], (len(axes), 1)), atol=1e-12)


def test_the_error_is_the_closed_form_and_the_estimates_are_exact(bent: DataTable) -> None:
    exact = exact_turn_estimate(YATES_AXES, BENT)
    np.testing.assert_allclose(bent.estimates, exact, rtol=1e-9)
    start = bent.ends[1] - 90
    rate = TABLE.rate * YATES_AXES[1]
    time = bent.time[start : start + 91] - bent.time[start]
    right = to_rotation_vector(error_quaternion(rate, rate + BENT @ rate, time))
    np.testing.assert_allclose(bent.error[start : start + 91], right, atol=1e-12)


def test_after_a_turn_only_the_part_along_the_axis_is_left(bent: DataTable) -> None:
    left = bent.vectors[np.arange(4), bent.ends]
    # Across it, second order: the error is one about the measured direction.
    assert np.abs(left[:, :2]).max() < 2 * np.pi * np.abs(BENT).max() ** 2 * 6
    np.testing.assert_allclose(left[:, 2], 2 * np.pi * bent.expected, atol=4 * np.pi * 1e-5)
    half_way = bent.vectors[np.arange(4), bent.ends - 45]
    assert np.linalg.norm(half_way[:, :2], axis=-1).min() > 1e-3


def test_each_vector_waits_for_its_mounting_and_stays_after_it(bent: DataTable) -> None:
    for i, vector in enumerate(bent.vectors):
        assert not vector[bent.mounting < i].any()
        after = vector[bent.ends[i] :]
        np.testing.assert_array_equal(after, np.tile(after[0], (len(after), 1)))


def test_the_body_never_jumps(bent: DataTable) -> None:
    dots = np.abs(np.sum(bent.attitude[1:] * bent.attitude[:-1], axis=-1))
    assert 2 * np.arccos(np.minimum(dots, 1)).max() < np.radians(16)


def test_the_false_rate_drives_the_error(bent: DataTable) -> None:
    moments = slice(0, 90)
    slope = np.diff(bent.vectors[0, :91], axis=0) / np.radians(4)
    middle = (bent.added[moments] + np.roll(bent.added[moments], -1, axis=0))[:-1] / 2
    np.testing.assert_allclose(slope[:-1], middle, atol=2e-5)


def test_skew_triads_leave_nothing_and_larins_leaves_the_second_and_the_third() -> None:
    assert np.abs(mountings(1e-3 * SKEW, TABLE).estimates).max() < 1e-6
    found = mountings(LARIN_TRIAD, TABLE).estimates
    np.testing.assert_allclose(found, [0, 1e-3, -1e-3, 0], atol=2e-6)


def test_a_perfect_triad_shows_the_earth_the_same_about_all_axes() -> None:
    found = mountings(np.zeros((3, 3)), ON_EARTH).estimates
    np.testing.assert_allclose(found, earth_rate_offset(37.5 * degree, 10 * degree), rtol=1e-6)
    assert f"{found[0] / arcsecond:.2f}" == "52.46"


def test_a_table_that_turns_otherwise_is_refused() -> None:
    with pytest.raises(ValueError, match="table: expected one even turn"):
        mountings(BENT, TurntableRotation(10 * degree, turns=2))
    with pytest.raises(ValueError, match="table: expected one even turn"):
        mountings(BENT, TurntableRotation(-10 * degree))

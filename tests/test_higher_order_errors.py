"""Size effect, time skew, g^2 and g-sensitivity: what the sensors feel beyond bias and matrix."""

import numpy as np
import pytest

from driftlab.higher_order_errors import (
    NO_HIGHER_ORDER_ERRORS,
    HigherOrderErrors,
    _rate_changes,
    checked_higher_order_errors,
    higher_order_effects,
)
from driftlab.imu import TYPICAL_ERRORS
from driftlab.increments import Increments, compensate, measure
from driftlab.motion.scheme import Scheme
from driftlab.motion.turntable import turntable_trajectory
from driftlab.quaternion import rotate
from support import EPS, order_of

RNG = np.random.default_rng(20)
BENT = HigherOrderErrors(
    0.05 * RNG.standard_normal((3, 3)),
    np.array(1e-3),
    1e-6 * RNG.standard_normal(3),
    1e-7 * RNG.standard_normal((3, 3)),
)
NODES, WEIGHTS = np.polynomial.legendre.leggauss(8)


def swaying(times):
    """Angle rates, angular accelerations and forces (..., 3) of a motion known in closed form."""
    phases, speeds = np.array([0.3, 1.1, 2.0]), np.array([1.0, 1.7, 2.3])
    angles = times[..., np.newaxis] * speeds + phases
    rate, turning = 0.4 * np.sin(angles), 0.4 * speeds * np.cos(angles)
    force = 9.8 * np.cos(times[..., np.newaxis] * speeds[::-1] + phases)
    return rate, turning, force


def exactly(errors, interval, count):
    """Increments of the motion, and what is felt besides, by quadrature of the definitions."""
    middles = interval * (np.arange(count)[:, np.newaxis] + 0.5 * (1 + NODES))
    rate, turning, force = swaying(middles)
    besides = np.empty_like(force)
    for i, arm in enumerate(errors.lever_arms):
        pull = np.cross(turning, arm) + np.cross(rate, np.cross(rate, arm))
        besides[..., i] = pull[..., i]
    besides += errors.time_skew * np.cross(rate, force)
    besides += errors.accelerometer_quadratic * force**2
    parts = rate, force, force @ errors.gyro_g_sensitivity.T, besides
    return [0.5 * interval * np.einsum("n,kni->ki", WEIGHTS, part) for part in parts]


def test_increments_permit_the_second_order_of_the_interval():
    """Halving the interval makes what is felt besides four times as exact, inside the record."""

    def error(size):
        count = 2 * round(2 / size)
        angle, velocity, *expected = exactly(BENT, size / 2, count)
        found = higher_order_effects(size / 2, angle, velocity, BENT)
        # As a rate; at the record's ends the rate beyond is not known.
        gaps = [np.abs((a - b)[1:-1]) for a, b in zip(found, expected, strict=True)]
        return max(gap.max() for gap in gaps) / size

    assert order_of(error) == pytest.approx(2, abs=0.1)


def test_the_size_effect_of_a_steady_turn_is_exact():
    rate, arm, seconds = np.array([0.3, -0.2, 0.5]), RNG.standard_normal((3, 3)), 0.1
    angle = np.tile(rate * seconds, (5, 1))
    _, found = higher_order_effects(
        seconds, angle, np.zeros((5, 3)), NO_HIGHER_ORDER_ERRORS._replace(lever_arms=arm)
    )
    for i in range(3):
        expected = seconds * np.cross(rate, np.cross(rate, arm[i]))[i]
        np.testing.assert_allclose(found[:, i], expected, rtol=0, atol=8 * EPS)


def test_an_arm_common_to_all_three_is_a_velocity_that_ends_with_the_turn():
    """The velocity of the point at the arm's end is w x r; nothing of it stays."""
    record = turntable_trajectory(Scheme("+90X +40Y", dwell=1.0), 0.7, 0.01)
    true = record.increments
    common = NO_HIGHER_ORDER_ERRORS._replace(lever_arms=np.tile([0.3, -0.2, 0.1], (3, 1)))
    own = NO_HIGHER_ORDER_ERRORS._replace(lever_arms=np.diag([0.3, -0.2, 0.1]))
    left = []
    for errors in (common, own):
        _, more = higher_order_effects(0.01, true.angle, true.velocity, errors)
        left.append(np.abs(rotate(record.attitude[1:], more).sum(axis=0)).max())
    # Turned by the attitude at the end of each interval, which turns by 1.7 milliradians in it.
    assert left[0] < 0.1745 * 0.4 * 2e-3 < 0.01 < left[1]


def test_changes_of_the_rate_add_up():
    angle = RNG.standard_normal((2, 7, 3))
    total = _rate_changes(0.5, angle).sum(axis=-2)
    np.testing.assert_allclose(total, (angle[:, -1] - angle[:, 0]) / 0.5, rtol=1e-13, atol=1e-13)


def test_late_accelerometers_read_what_was_there_before():
    """A force that is fixed in space: tau later the body has turned by tau w."""
    late, rate = 1e-4, np.array([0.2, 0.4, -0.1])
    force = np.array([1.0, 2.0, 9.0])
    _, found = higher_order_effects(
        0.01,
        rate[np.newaxis] * 0.01,
        force[np.newaxis] * 0.01,
        NO_HIGHER_ORDER_ERRORS._replace(time_skew=np.array(late)),
    )
    before = force + late * np.cross(rate, force)  # C(t - tau)^T f = (1 + tau [w x]) C^T f
    np.testing.assert_allclose(found[0] / 0.01, before - force, rtol=1e-12)


def test_compensation_is_the_inverse_to_third_order():
    true = turntable_trajectory(Scheme("+90X +40Y", dwell=1.0), 0.7, 0.05).increments

    def error(size):
        errors = HigherOrderErrors(*(300 * size * part for part in BENT))
        unit = TYPICAL_ERRORS
        found = compensate(measure(true, unit, higher_order=errors), unit, higher_order=errors)
        return np.abs(found.velocity - true.velocity).max()

    assert order_of(error) == pytest.approx(3, abs=0.1)
    found = compensate(
        measure(true, TYPICAL_ERRORS, higher_order=BENT), TYPICAL_ERRORS, higher_order=BENT
    )
    np.testing.assert_allclose(found.velocity, true.velocity, rtol=0, atol=1e-9)
    np.testing.assert_allclose(found.angle, true.angle, rtol=0, atol=1e-12)


def test_without_them_increments_are_what_they_were():
    true = Increments(0.1, RNG.standard_normal((6, 3)), RNG.standard_normal((6, 3)))
    plain, same = (
        measure(true, TYPICAL_ERRORS, higher_order=given)
        for given in (None, NO_HIGHER_ORDER_ERRORS)
    )
    np.testing.assert_array_equal(plain.velocity, same.velocity)
    np.testing.assert_array_equal(plain.angle, same.angle)


def test_the_unit_without_them_cannot_be_bent():
    for field in NO_HIGHER_ORDER_ERRORS:
        with pytest.raises(ValueError, match="read-only"):
            field[...] = 1.0


def test_leading_axes_are_units():
    true = turntable_trajectory(Scheme("+40Y", dwell=1.0), 0.7, 0.1).increments
    units = BENT._replace(time_skew=np.array([0.0, 1e-3]))
    together = measure(true, TYPICAL_ERRORS, higher_order=units)
    for k in range(2):
        alone = measure(
            true, TYPICAL_ERRORS, higher_order=units._replace(time_skew=units.time_skew[k])
        )
        np.testing.assert_allclose(together.velocity[k], alone.velocity, rtol=0, atol=8 * EPS)


@pytest.mark.parametrize("field", HigherOrderErrors._fields)
def test_one_kind_of_error_alone_may_be_that_of_several_units(field):
    several = np.stack([getattr(BENT, field)] * 2)
    found = checked_higher_order_errors(BENT._replace(**{field: several}))
    for part, one in zip(found, BENT, strict=True):
        np.testing.assert_array_equal(part, np.stack([one] * 2))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"lever_arms": np.zeros(3)}, r"^lever_arms: expected shape \(\.\.\., 3, 3\)"),
        ({"time_skew": np.nan}, "^time_skew: expected finite"),
        ({"accelerometer_quadratic": np.zeros(2)}, "^accelerometer_quadratic: expected"),
        ({"gyro_g_sensitivity": np.zeros((4, 3, 3)), "time_skew": np.zeros(3)}, "leading axes"),
    ],
)
def test_what_cannot_be_is_refused_by_name(change, words):
    with pytest.raises(ValueError, match=words):
        checked_higher_order_errors(NO_HIGHER_ORDER_ERRORS._replace(**change))
    with pytest.raises(ValueError, match=r"^higher_order: expected an? HigherOrderErrors"):
        checked_higher_order_errors(None)

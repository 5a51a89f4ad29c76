"""Drift on a cone from one step: against many, and the narrow cone's formula."""

from itertools import product

import mpmath
import numpy as np
import pytest

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS
from driftlab.attitude.drift_on_cones import _largest_change, coning_drift
from driftlab.attitude.integration import integrate
from driftlab.core.coning import step_drift
from driftlab.motion.profiles import Coning
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, to_rotation_vector
from support import EPS, order_of

every_algorithm = pytest.mark.parametrize("name", CONING_ALGORITHMS)
# Increments in so many turns: the cone goes round by 0.05 to 1.5 between two, all multiples of 2
# and 3.
RHYTHMS = [(120, 1), (60, 1), (24, 1), (12, 1), (6, 1), (30, 7)]


def measured_drift(name, half_angle, count, turns):
    """Drift about the axis of the cone, rad/s, over whole turns at 1 Hz."""
    chosen, motion = CONING_ALGORITHMS[name], Coning(half_angle, 1)
    rows = motion.increments(turns / count, count)
    # The motion is periodic: what was before the first increment is like the last.
    history = rows[-chosen.memory :] if chosen.memory else None
    end = integrate(rows, name, start=motion.attitude(0), history=history)[-1]
    # After whole turns the body is back, and all that the computed attitude has turned is error.
    error = to_rotation_vector(multiply(end, conjugate(motion.attitude(0))))
    return np.copysign(np.linalg.norm(error), error[2]) / turns


def narrow_drift(name, half_angle, x):
    """Drift of a step, rad, to the second power of the half angle, and without rounding."""
    chosen = CONING_ALGORITHMS[name]
    with mpmath.workdps(50):
        x = mpmath.mpf(x)
        step = chosen.samples * x
        estimate = sum(
            mpmath.mpf(weight) * 4 * mpmath.sin(x / 2) ** 2 * mpmath.sin((j - i) * x)
            for (i, j), weight in chosen.coning.items()
        )
        return float(mpmath.sin(half_angle) ** 2 * (estimate - (step - mpmath.sin(step)) / 2))


@every_algorithm
def test_one_step_tells_the_drift_of_many(name):
    for (count, turns), degrees in product(RHYTHMS, [1.0, 20.0, 60.0, 90.0, 150.0]):
        half_angle = np.radians(degrees)
        if (name, count, degrees) == ("rotation-vector-3", 30, 90.0):
            with pytest.raises(ValueError, match="less than half a turn a step"):
                coning_drift(name, half_angle, 1, turns / count)
            continue
        expected = coning_drift(name, half_angle, 1, turns / count)
        # Some eps a step; half a turn or more of drift cannot be told from what is left of it.
        bound = 16 * EPS * count
        if abs(expected) * turns < np.pi:
            measured = measured_drift(name, half_angle, count, turns)
            assert measured == pytest.approx(expected, rel=1e-9, abs=bound), (count, degrees)


@every_algorithm
@pytest.mark.parametrize("x", [0.05, 0.2, 0.5, 1.5])
def test_on_a_narrow_cone_it_is_the_closed_formula(name, x):
    """What the formula leaves out is of the fourth power of the half angle."""

    def rest(size):
        half_angle = 8 * size  # from 7 degrees to half a degree
        drift = (
            coning_drift(name, half_angle, x / (2 * np.pi), 1.0) * CONING_ALGORITHMS[name].samples
        )
        return abs(drift - narrow_drift(name, half_angle, x))

    if rest(1 / 64) > 1e5 * EPS:  # else rounding hides the power
        assert order_of(rest) == pytest.approx(4, abs=0.2)
    # Relative to the uncorrected drift, X^3/12 of a step, it is of the second power.
    step = CONING_ALGORITHMS[name].samples * x
    assert rest(0.001 / 8) < 1e-3**4 * step**3 + 16 * EPS


@every_algorithm
def test_drift_turns_with_the_coning_and_vanishes_without(name):
    there, back = coning_drift(name, 0.1, [3, -3], 0.01)
    assert there == pytest.approx(-back, rel=1e-9)
    assert there != 0
    # Nothing but rounding is left of a cone without width, or one that stands still.
    for half_angle, frequency in ((0, 3), (0.1, 0)):
        assert abs(coning_drift(name, half_angle, frequency, 0.01)) <= 8 * EPS / 0.01


@every_algorithm
def test_drift_depends_on_the_angle_per_interval(name):
    """Twice as fast in half the time: a drift twice as fast."""
    slow, fast = coning_drift(name, 0.1, [1, 2], [0.1, 0.05])
    np.testing.assert_allclose(fast, 2 * slow, rtol=8 * EPS)


@pytest.mark.parametrize("half_angle", [0.02, 1.0, 3.0])
@pytest.mark.parametrize("step_angle", [-2.5, 0.1, 2.0, 3.5])
def test_exact_step_does_not_drift_and_a_wrong_one_by_what_it_turns_too_far(half_angle, step_angle):
    motion = Coning(half_angle, 1.0)
    step = multiply(conjugate(motion.attitude(0)), motion.attitude(step_angle / (2 * np.pi)))
    angles = np.array(half_angle), np.array(step_angle)
    # Differences of angles of up to a turn.
    assert step_drift(step, *angles) == pytest.approx(0, abs=32 * EPS)
    # An error about the cone's axis, which leans in the body by the half angle.
    axis = np.array([0, np.sin(half_angle), np.cos(half_angle)])
    for error in (1e-9, -0.2):
        wrong = multiply(from_rotation_vector(error * axis), step)
        assert step_drift(wrong, *angles) == pytest.approx(error, abs=32 * EPS)


def test_more_than_a_sphere_is_refused():
    with pytest.raises(ValueError, match=r"^half_angle: expected at most pi rad, got 3\.2\.$"):
        coning_drift("memory-4", [0.1, -3.2], 1, 0.1)


def test_a_whole_turn_a_step_is_refused_where_k_is_infinite():
    words = "^half_angle, frequency, sample_interval: expected less than a whole turn a step, "
    with pytest.raises(ValueError, match=words):
        coning_drift("two-step-4", 2.0, 1.0, [0.1, 0.6])
    with pytest.raises(ValueError, match=words):
        coning_drift("picard-1", np.pi, 1.0, 0.5)  # just a whole turn
    assert np.isfinite(coning_drift("rotation-vector-2", 2.0, 1.0, 0.8))


@pytest.mark.parametrize("lean", [0.0, 0.2, 1.5, 2.0, np.pi])
@pytest.mark.parametrize(("size", "drift"), [(0.3, 0.9), (2.0, -0.4), (4.0, 0.0), (6.0, 0.9)])
def test_an_error_about_a_leaning_axis_swings_as_the_turning_itself_shows(lean, size, drift):
    """The part of a rotation about an axis, while it goes on about another one, step by step."""
    turned = np.linspace(0, 2 * np.pi, 20_001)
    before, after = (
        2 * np.unwrap(np.arctan2(np.cos(lean) * np.sin(angle / 2), np.cos(angle / 2)))
        for angle in (turned, turned + size)
    )
    begin = 2 * np.arctan2(np.cos(lean) * np.sin(size / 2), np.cos(size / 2))
    even = np.copysign(size, np.cos(lean))
    after += 2 * np.pi * np.round((begin - after[0]) / (2 * np.pi))
    expected = np.abs(drift + after - before - even).max()
    found = _largest_change(np.array(drift), np.array(size), np.array(size * np.cos(lean)))
    assert found == pytest.approx(expected, abs=1e-6)


def test_a_step_that_does_not_turn_changes_the_error_by_its_drift():
    drift = np.array([-0.5, 0.25])
    np.testing.assert_array_equal(_largest_change(drift, np.zeros(2), np.zeros(2)), np.abs(drift))

"""What rates at rest say against the Earth's: bounds, chances, the warning, a recording."""

import inspect

import numpy as np
import pytest
import sympy as sp
from scipy.stats import t as student

from driftlab.earth import EARTH_RATE
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass._contradictions import rate_contradiction
from driftlab.gyrocompass.alignment import InconsistentAlignmentWarning, align
from driftlab.gyrocompass.inertial_alignment import align_in_inertial_frame
from driftlab.increments import Increments
from driftlab.motion.vehicle import static_imu
from driftlab.vectors import wrap_angle
from support import recording_or_skip

LATITUDE = np.radians(51.5)
LEVEL = EARTH_RATE * np.cos(LATITUDE)
UP = EARTH_RATE * np.sin(LATITUDE)
ATTITUDE = from_euler_angles(2.0, 0.1, -0.3)
RATE, FORCE = static_imu(ATTITUDE, LATITUDE)


def quietly(rate, **options):
    return align(rate, FORCE, heading_tolerance=np.inf, **options)


# Bounds


def test_no_level_rate_of_a_size_turns_the_heading_farther_than_the_arcsine():
    size, level, direction = sp.symbols("s L theta", positive=True)
    tangent = size * sp.sin(direction) / (level + size * sp.cos(direction))
    worst = sp.acos(-size / level)
    assert sp.simplify(tangent.diff(direction).subs(direction, worst)) == 0
    # The tangent of arcsin(s/L) is s / sqrt(L^2 - s^2).
    assert sp.simplify((tangent.subs(direction, worst)) ** 2 - 1 / (level**2 / size**2 - 1)) == 0
    seen = rate_contradiction(LEVEL + 0.3 * LEVEL, latitude=LATITUDE)
    assert seen.heading_uncertainty == pytest.approx(np.arcsin(0.3))
    assert rate_contradiction(5.0, UP, LATITUDE).heading_uncertainty == np.pi / 2


def test_the_arcsine_is_also_the_bound_when_the_level_rate_is_the_one_found():
    angles = np.linspace(0, 2 * np.pi, 2001)
    spurious = 0.3 * LEVEL * np.stack([np.cos(angles), np.sin(angles)])
    true = np.array([[LEVEL], [0.0]]) - spurious
    assert np.abs(np.arctan2(true[1], true[0])).max() == pytest.approx(np.arcsin(0.3), rel=1e-5)


def test_two_directions_are_their_root_mean_square():
    seen = rate_contradiction(LEVEL + 3e-7, UP - 4e-7, LATITUDE)
    assert seen.spurious_rate == pytest.approx(5e-7 / np.sqrt(2))
    assert seen.heading_uncertainty == pytest.approx(np.arcsin(5e-7 / np.sqrt(2) / LEVEL))
    assert seen.rate_discrepancy == pytest.approx(np.hypot(LEVEL + 3e-7, UP - 4e-7) - EARTH_RATE)


def test_without_a_unit_the_least_rate_that_explains_the_latitude_counts():
    seen = rate_contradiction(7.0, 7.0 * np.tan(0.8), LATITUDE, size_known=False)
    scales = np.linspace(0, 2 * EARTH_RATE, 20_001)
    direction = np.array([np.cos(0.8), np.sin(0.8)])
    least = np.hypot(*(scales * direction[:, np.newaxis] - np.array([[LEVEL], [UP]]))).min()
    assert seen.spurious_rate == pytest.approx(least, rel=1e-6)
    assert seen.latitude_discrepancy == pytest.approx(0.8 - LATITUDE)
    assert np.isnan(seen.rate_discrepancy)


def test_a_level_rate_alone_needs_the_latitude():
    seen = rate_contradiction(1.01 * LEVEL, latitude=LATITUDE)
    assert seen.heading_uncertainty == pytest.approx(np.arcsin(0.01))
    assert np.isnan(rate_contradiction(LEVEL).heading_uncertainty)
    assert rate_contradiction(1.1 * EARTH_RATE).heading_uncertainty == pytest.approx(np.arcsin(0.1))
    assert np.isnan(rate_contradiction(1.0, 2.0, size_known=False).heading_uncertainty)


# Chances


def biased(deviation, runs, seed):
    """Alignments with drifts in all directions that turn the heading by a deviation."""
    drifts = deviation * LEVEL * np.random.default_rng(seed).standard_normal((runs, 3))
    found = quietly(RATE + drifts, latitude=LATITUDE)
    return np.abs(wrap_angle(found.heading - 2.0)), found.heading_uncertainty


@pytest.mark.parametrize("ratio", [1.0, 2.0])
def test_noise_gives_the_alarm_as_often_as_the_notes_say(ratio):
    runs, tolerance = 20_000, np.radians(0.5)
    _, doubt = biased(tolerance / ratio, runs, seed=1)
    chance = np.exp(-(ratio**2))
    bound = 4 * np.sqrt(chance * (1 - chance) / runs)
    assert abs(np.mean(doubt > tolerance) - chance) < bound


def test_errors_over_what_is_seen_are_students():
    error, doubt = biased(np.radians(0.2), 20_000, seed=2)
    for ratio in (1.0, 4.303):
        chance = 2 * student.sf(ratio, 2)
        assert abs(np.mean(error > ratio * doubt) - chance) < 4 * np.sqrt(chance / 20_000)


@pytest.mark.parametrize("deviation", np.radians([0.3, 1.0, 1.7, 3.0]))
def test_large_errors_without_an_alarm_are_few_whatever_the_drifts(deviation):
    """At most 2 in 100 are off by more than 4.3 tolerances in silence: both chances multiplied."""
    tolerance = np.radians(0.5)
    error, doubt = biased(deviation, 20_000, seed=3)
    assert np.mean((error > 4.3 * tolerance) & (doubt < tolerance)) < 0.02


# The warning


def test_what_is_warned_of_is_named_with_its_size_and_what_to_do():
    with pytest.warns(InconsistentAlignmentWarning) as caught:
        found = align(1.02 * RATE, FORCE, latitude=LATITUDE + np.radians(1.0))
    turned = f"by {np.degrees(found.heading_uncertainty):.2g} degrees."
    words = str(caught[0].message)
    assert words.startswith("angular_rate: expected the rate of the Earth")
    for part in ("+0.301 deg/h", "-1 degrees", turned, "align_in_inertial_frame("):
        assert part in words
    assert caught[0].filename == inspect.getsourcefile(biased)


def test_of_many_the_worst_is_told():
    rates = np.stack([1.0 * RATE, 1.02 * RATE, 1.03 * RATE])
    with pytest.warns(InconsistentAlignmentWarning, match=r"in 2 of 3 .* rate by \+0\.451 deg/h"):
        found = align(rates, FORCE)
    assert found.heading_uncertainty.shape == (3,)


@pytest.mark.parametrize("size", [1.0, np.radians(1 / 3600), np.radians(1), 100.0])
def test_the_unit_is_told_or_there_is_none(size):
    """A direction has no size to look at."""
    rate = 1.2 * RATE / size
    found = align(rate, FORCE, latitude=LATITUDE, rate_unit=None)
    told = quietly(rate, latitude=LATITUDE, rate_unit=size)
    assert told.rate_discrepancy == pytest.approx(0.2 * EARTH_RATE)
    assert np.isnan(found.rate_discrepancy)
    assert found.level_rate == pytest.approx(1.2 * LEVEL / size)


@pytest.mark.parametrize("place", [None, LATITUDE])
@pytest.mark.parametrize("factor", [1e-200, 0.1, 0.5, 0.9, 1.1, 1.85, 1.95, 2.1, 10.0, 57.3, 1e50])
def test_the_more_is_wrong_the_more_is_said(factor, place):
    """In the right direction, so the size alone tells of it: at 2 it was silent once."""
    with pytest.warns(InconsistentAlignmentWarning) as caught:
        found = align(factor * RATE, FORCE, latitude=place)
    assert found.heading_uncertainty > np.radians(3)
    assert ("tell rate_unit" in str(caught[0].message)) == (not 0.53 < factor < 1.9)


def test_a_cheap_gyro_gives_no_heading_without_a_word():
    bias = np.radians(100 / 3600) * np.array([0.0, 0.0, 1.0])
    level = static_imu(from_euler_angles(0.0, 0.0, 0.0), np.radians(60.0))
    with pytest.warns(InconsistentAlignmentWarning, match="these gyros do not see the Earth"):
        found = align(level[0] + bias, level[1])
    assert abs(found.heading) > np.radians(80)


@pytest.mark.parametrize("signs", [(-1, 1, 1), (1, -1, 1), (1, 1, -1)])
def test_a_wrong_sign_is_named_as_one(signs):
    rate, force, place = signs
    words = "is minus the one told: look at the sign of latitude; at those of the gyros"
    with pytest.warns(InconsistentAlignmentWarning, match=words) as caught:
        found = align(rate * RATE, force * FORCE, latitude=place * LATITUDE)
    assert "calibrate" not in str(caught[0].message)
    assert np.isclose(abs(wrap_angle(found.heading - 2.0)), np.pi) == (rate < 0)
    assert (abs(found.roll) > np.pi / 2) == (force < 0)


def test_rate_and_force_exchanged_are_known_by_their_sizes():
    with pytest.raises(ValueError, match=r"angular_rate, specific_force: .* of the two exchanged"):
        align(FORCE, RATE)


# The recording of a car that is not at rest


def stretches(seconds):
    record = recording_or_skip("laser-gyro").in_axes("FUR")
    whole, rows = record.increments(), round(100 * seconds)
    count = len(whole.angle) // rows
    parts = (part[: count * rows].reshape(count, rows, 3) for part in whole[1:])
    return Increments(whole.interval, *parts), record.latitude


@pytest.mark.parametrize(("seconds", "alarms", "missed"), [(70, 20, 1), (300, 4, 0)])
def test_the_parked_car_gives_the_alarm_where_its_heading_is_wrong(seconds, alarms, missed):
    parts, latitude = stretches(seconds)
    means = [part.mean(axis=-2) / parts.interval for part in parts[1:]]
    found = align(*means, latitude=latitude, heading_tolerance=np.inf)
    wrong = np.degrees(np.abs(wrap_angle(found.heading + np.radians(90.6))))
    alarm = found.heading_uncertainty > np.radians(0.5)
    assert alarm.sum() == alarms
    # Every error above a degree is warned of. A quarter of the alarms is false, one error of six
    # in silence is above the tolerance.
    assert wrong[~alarm].max() < 1.0
    assert np.sum(alarm & (wrong < 0.5)) <= alarms / 4
    assert np.sum(~alarm & (wrong > 0.5)) == missed
    # How large they are is not told: the car leans about one line more than about others.
    if seconds == 70:
        assert (wrong / np.degrees(found.heading_uncertainty)).max() > 10


def test_gravity_in_inertial_space_holds_on_every_five_minutes_and_every_restart():
    for seconds, bound in ((300, 0.1), (70, None)):
        parts, latitude = stretches(seconds)
        off = np.degrees(align_in_inertial_frame(parts, latitude).heading) + 90.6
        assert bound is None or np.abs(off).max() < bound
        assert off.std(ddof=1) < 0.5

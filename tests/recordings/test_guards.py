"""Each slip that one can make with a log, made on purpose with each published one, is named."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.constants import foot
from scipy.spatial.transform import Rotation

from driftlab.motion.profiles import Coning
from driftlab.recordings import PUBLISHED, RULES, Recording, data_problems
from driftlab.recordings._slips import force_factors, gyro_factors
from driftlab.recordings._units import ACCELEROMETER_UNITS, GYRO_UNITS
from driftlab.recordings.guards import (
    _BLOCK,
    _ENOUGH_ROWS,
    _clipped_rows,
    _dead_channels,
    _gravity_turns,
    _longest_run,
    _twin_channels,
)
from support import recording_or_skip

DEGREE, G = np.pi / 180, 9.80665
SIGNS = np.array([1, 1, -1])
# The other one is simulated and has no noise: the guards take it for stuck, and rightly.
MEASURED = [name for name in PUBLISHED if name != "nineteen-positions"]


@cache
def part_of(name):
    """A hundred seconds, with many moves in them but for the one that lies still."""
    return recording_or_skip(name).between(0, 30 if name == "laser-gyro" else 100)


def column(rows, index, values):
    changed = rows.copy()
    changed[:, index] = values
    return changed


def stuck(rows):
    changed = rows.copy()
    changed[1000:1300, 0] = changed[1000, 0]
    return changed


def clipped(rows):
    """One column cut off at half its range, or where five rows in a row are beyond."""
    middle = np.median(rows[:, 2])
    size = np.abs(rows[:, 2] - middle)
    together = np.lib.stride_tricks.sliding_window_view(size, 5).min(axis=1)
    most = min(size.max() / 2, together.max())
    return column(rows, 2, np.clip(rows[:, 2], middle - most, middle + most))


def lost_rows(recording):
    kept = np.r_[0:1000, 1002 : len(recording)]
    times = recording.interval * np.arange(len(recording))
    return replace(
        recording,
        gyro=recording.gyro[kept],
        accelerometer=recording.accelerometer[kept],
        times=times[kept],
    )


def gyro_slip(change):
    return lambda r: replace(r, gyro=change(r.gyro))


def force_slip(change):
    return lambda r: replace(r, accelerometer=change(r.accelerometer))


def other_kind(r):
    return replace(r, kind="increments" if r.kind == "rates" else "rates")


def scaled_by_interval(r):
    return replace(r, gyro=r.gyro * (r.interval if r.kind == "rates" else 1 / r.interval))


# What is done, and which rule says so with which words. Those of the last table need turns of
# gravity, which a unit that lies still does not have.
SLIPS = {
    "g for m/s^2": (force_slip(lambda f: f / G), "force", "taken for m/s"),
    "m/s^2 for g": (force_slip(lambda f: f * G), "force", "taken for g"),
    "the other kind": (other_kind, "force", "increments"),
    "triads exchanged": (
        lambda r: replace(r, gyro=r.accelerometer, accelerometer=r.gyro),
        "force",
        "a factor of",
    ),
    "a dead gyro": (gyro_slip(lambda w: column(w, 1, 0.0)), "dead", "gyro y: "),
    "a dead accelerometer": (force_slip(lambda f: column(f, 0, 0.5)), "dead", "accelerometer x: "),
    "a stuck gyro": (gyro_slip(stuck), "stuck", "rows from row 1001 on"),
    "a clipped gyro": (gyro_slip(clipped), "clipped", "gyro z: "),
    "lost rows": (lost_rows, "gap", "after row 1000"),
    "a column twice": (gyro_slip(lambda w: w[:, [0, 0, 2]]), "twins", "gyro x and gyro y"),
    "a column twice, negated": (gyro_slip(lambda w: column(w, 2, -w[:, 1])), "twins", "gyro z"),
}
MOVING_SLIPS = {
    "degrees for radians": (gyro_slip(lambda w: w / DEGREE), "turning", "degrees taken for rad"),
    "radians for degrees": (gyro_slip(lambda w: w * DEGREE), "turning", "radians taken for deg"),
    "increments for rates": (scaled_by_interval, "turning", "taken for rates"),
    "twice the interval": (
        lambda r: replace(r, interval=2 * r.interval, times=None),
        "turning",
        "half as long an interval",
    ),
    "a sign": (gyro_slip(lambda w: w * SIGNS), "axes", "the gyros' x, y, -z"),
    "a sign of a force": (force_slip(lambda f: f * [1, -1, 1]), "axes", "the gyros' -x, y, -z"),
    "left-handed axes": (
        lambda r: replace(r, gyro=r.gyro * SIGNS, accelerometer=r.accelerometer * SIGNS),
        "axes",
        "the other way: left-handed axes",
    ),
    "columns exchanged": (gyro_slip(lambda w: w[:, [1, 0, 2]]), "axes", "the gyros' y, x, z"),
    "columns in a circle": (gyro_slip(lambda w: w[:, [1, 2, 0]]), "axes", "the gyros' z, x, y"),
}


@pytest.mark.parametrize("name", MEASURED)
@pytest.mark.parametrize("slip", [*SLIPS, *MOVING_SLIPS])
def test_each_slip_is_named(slip, name):
    change, rule, words = (SLIPS | MOVING_SLIPS)[slip]
    found = data_problems(change(part_of(name)))
    named = [doubt for doubt in found if doubt.rule == rule]
    if name == "laser-gyro" and slip in MOVING_SLIPS:
        assert named == []  # the module says so: of a unit that is not tilted it cannot be known
    else:
        assert any(words in str(doubt) for doubt in named), [*map(str, found)]
        assert all(doubt.rule in RULES for doubt in found)


@pytest.mark.parametrize("name", MEASURED)
def test_half_a_record_is_as_good_as_the_whole(name):
    recording = part_of(name)
    count = len(recording)
    for half in (recording.part(0, count // 2), recording.part(count // 2, count)):
        assert data_problems(half) == ()


@pytest.mark.parametrize("name", [name for name in MEASURED if name != "laser-gyro"])
def test_gravity_turns_as_the_gyros_of_published_records_say(name):
    """In the whole, and in all pieces of forty seconds that tell anything."""
    recording = recording_or_skip(name)
    whole = _gravity_turns(recording)
    assert abs(np.log(whole.factor)) < np.log(1.15)
    assert whole.explained > max(0.9, whole.needed)
    for begin in np.arange(0, recording.duration - 40, 20):
        piece = _gravity_turns(recording.between(begin, begin + 40))
        if piece is not None and piece.explained > max(0.5, piece.needed):
            assert abs(np.log(piece.factor)) < np.log(2) / 2
            assert (piece.order == np.eye(3)).all()


def test_two_slips_at_once_are_both_named():
    recording = part_of("mpu9150-3")
    both = replace(recording, gyro=recording.gyro * SIGNS / DEGREE)
    assert {"rate", "turning", "axes"} == {doubt.rule for doubt in data_problems(both)}


def cone(scale, rate=100.0, seconds=60.0):
    """A unit that nods slowly, with noise; its gyros are multiplied with `scale`."""
    motion, rng = Coning(half_angle=0.5, frequency=0.1), np.random.default_rng(7)
    times = np.arange(0, seconds, 1 / rate)
    x, y, z, w = np.moveaxis(motion.attitude(times), -1, 0)
    down = np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), w**2 - x**2 - y**2 + z**2], axis=1)
    gyro = motion.rate(times) * scale + rng.normal(scale=0.01 * scale, size=(len(times), 3))
    force = G * down + rng.normal(scale=0.05, size=(len(times), 3))
    return Recording(gyro, force, 1 / rate, "rates")


@pytest.mark.parametrize(
    "factor", [1.0, 1.25, 1.33, 1 / 1.33, 1.5, 1 / 1.5, 2.0, 57.3, 1 / 57.3, 0.01, 100.0]
)
def test_the_factor_of_a_known_motion_is_found(factor):
    found = _gravity_turns(cone(factor))
    assert found.factor * factor == pytest.approx(1, rel=0.05)
    named = {doubt.rule for doubt in data_problems(cone(factor))} - {"rate"}
    less_than_half_way_to_two = abs(np.log2(factor)) < 1 / 2
    assert named == (set() if less_than_half_way_to_two else {"turning"})


def nods(about, strength, rate=100.0):
    """A unit that is turned to and fro about body axes within a quarter of a second each, between
    rests of as long; the gyros show so many times the rates."""
    rows = round(0.25 * rate)
    turn = 1 - np.cos(2 * np.pi * (np.arange(rows) + 0.5) / rows)
    gyro = np.zeros((len(about), 2, 2, rows, 3))
    for index, axis in enumerate(about):
        gyro[index, :, 1, :, axis] = rate / rows * turn * [[1], [-1]]
    gyro = np.concatenate([gyro.reshape(-1, 3), np.zeros((rows, 3))])
    angles = (np.cumsum(gyro, axis=0) - gyro / 2) / rate
    force = Rotation.from_rotvec(angles).inv().apply(np.full(3, G / np.sqrt(3)))
    return Recording(gyro * strength, force, 1 / rate, "rates")


@pytest.mark.parametrize("ratio", [1.9, 2.1, 2.9])
def test_an_order_that_changes_less_is_right_if_it_leaves_less_than_twice_as_much(ratio):
    """Of turns of one size, a share p about z and half of the others about x and y each, gyros
    that show 1 + d, 1 - d and -1 times the rate explain (1 - 2p)^2 / (1 + (1 - p) d^2), and with
    the other sign of z 1 / (1 + (1 - p) d^2)."""
    about = [0, 1] * 5 + [2]
    p = about.count(2) / len(about)
    # (1 - (1 - 2p)^2 best) / (1 - best) is the ratio.
    best = (ratio - 1) / (ratio - (1 - 2 * p) ** 2)
    d = np.sqrt((1 / best - 1) / (1 - p))
    found = _gravity_turns(nods(about, [1 + d, 1 - d, -1]))
    right = 1 if ratio < 2 else -1
    assert (found.order == np.diag([1, 1, right])).all()
    share = best if right < 0 else best * (1 - 2 * p) ** 2
    assert found.explained == pytest.approx(share, rel=1e-6)


@pytest.mark.parametrize("about", [[0, 1, 2], [0, 1], [2, 2, 2, 0], [0, 1, 2] * 7])
def test_what_is_needed_comes_by_chance_in_one_record_of_a_thousand(about):
    found = _gravity_turns(nods(about, 1.0))
    turns = 2 * len(about)
    if turns < 5:
        assert found is None
        return
    assert (found.turns, found.explained) == (turns, pytest.approx(1))
    tries, components = 48 / 2, 2 * turns
    chance = tries * (1 - found.needed) ** ((components - 1) / 2)
    assert chance == pytest.approx(1e-3)


def test_gyros_that_have_nothing_to_do_with_it_explain_nothing():
    moved = cone(1.0)
    rng, chance = np.random.default_rng(3), 0
    for _ in range(40):
        found = _gravity_turns(replace(moved, gyro=rng.normal(size=moved.gyro.shape)))
        chance += found is not None and found.explained > found.needed
    assert chance <= 1  # each would, once in a thousand


def test_turns_about_one_axis_leave_the_others_open():
    """Signs that do not matter are not called wrong, whatever the noise."""
    angle = 0.7 * np.sin(np.arange(6000) / 150)
    rng = np.random.default_rng(5)
    force = G * np.stack([np.sin(angle), 0 * angle, np.cos(angle)], axis=1)
    gyro = np.gradient(angle, 0.01)[:, None] * [0, -1, 0] + rng.normal(scale=0.02, size=(6000, 3))
    recording = Recording(gyro, force + rng.normal(scale=0.1, size=(6000, 3)), 0.01, "rates")
    assert data_problems(recording) == ()
    assert [doubt.rule for doubt in data_problems(replace(recording, gyro=-gyro))] == ["axes"]


def test_coarse_steps_and_samples_written_twice_are_not_called_stuck():
    noise = np.random.default_rng(4).normal(size=20_000)
    for channel in (noise.round(), noise.repeat(5), (noise / 3).round()):
        _, rows, allowed = _longest_run(channel)
        assert rows < allowed < 1000


def test_the_pulses_of_a_quiet_gyro_are_not_called_clipped():
    rng = np.random.default_rng(6)
    for mean in (0.02, 0.2, 1.0, 3.0):
        assert _clipped_rows(rng.poisson(mean, size=20_000).astype(float))[1] < 2.4


def test_a_record_without_accelerometers_is_judged_by_what_it_has():
    quiet = Recording(np.full((5, 3), 0.1), None, 0.01, "rates")
    assert data_problems(quiet) == ()
    assert [doubt.rule for doubt in data_problems(replace(quiet, gyro=quiet.gyro * 1e5))] == [
        "rate",
        "half turn",
    ]


def test_gravity_that_is_told_is_what_the_force_is_held_against():
    gyro, noise = 1e-3 * np.random.default_rng(1).standard_normal((2, 200, 3))
    on_mars = Recording(gyro, noise + np.array([0.0, 0.0, 3.71]), 0.01, "rates", gravity=3.71)
    assert data_problems(on_mars) == ()
    assert [doubt.rule for doubt in data_problems(replace(on_mars, gravity=None))] == ["force"]


INTERVAL = 0.02
MEANT_AND_TAKEN = {
    "g taken for m/s^2": ("g", "m/s^2"),
    "m/s^2 taken for g": ("m/s^2", "g"),
    "mg taken for m/s^2": ("mg", "m/s^2"),
    "increments of velocity for specific force": ("m/s", "m/s^2"),
    "increments in g*s for specific force": ("g*s", "m/s^2"),
    "specific force taken for increments": ("m/s^2", "m/s"),
    "specific force in g taken for increments": ("g", "m/s"),
    "specific force in mg taken for increments": ("mg", "m/s"),
    "g*s taken for m/s": ("g*s", "m/s"),
    "m/s taken for g*s": ("m/s", "g*s"),
    "degrees taken for radians": ("deg", "rad"),
    "radians taken for degrees": ("rad", "deg"),
    "mrad taken for rad": ("mrad", "rad"),
    "an hour taken for a second": ("deg/h", "deg/s"),
    "increments taken for rates": ("rad", "rad/s"),
    "increments in degrees taken for rates in radians": ("deg", "rad/s"),
    "rates taken for increments": ("rad/s", "rad"),
    "rates in degrees taken for increments in radians": ("deg/s", "rad"),
}
OTHER_FACTORS = {
    "feet taken for metres": 1 / foot,
    "twice as long an interval": {force_factors: 2.0, gyro_factors: 0.5},
    "half as long an interval": {force_factors: 0.5, gyro_factors: 2.0},
}


@pytest.mark.parametrize("kind", ["rates", "increments"])
@pytest.mark.parametrize("factors", [force_factors, gyro_factors])
def test_a_slip_of_units_makes_numbers_too_large_by_the_quotient_of_the_units(factors, kind):
    for name, found in factors(kind, INTERVAL).items():
        if name in MEANT_AND_TAKEN:
            (one, meant), (other, taken) = (
                (GYRO_UNITS | ACCELEROMETER_UNITS)[unit] for unit in MEANT_AND_TAKEN[name]
            )
            spans = (one == "increments") - (other == "increments")
            assert found == pytest.approx(taken / meant * INTERVAL**spans), name
        else:
            other = OTHER_FACTORS[name]
            assert found == (other[factors] if isinstance(other, dict) else pytest.approx(other))


@pytest.mark.parametrize(("told", "right"), [(2.0, "half"), (0.5, "twice")])
def test_the_interval_that_would_be_right_is_named_as_a_multiple_of_the_told_one(told, right):
    moved = cone(1.0)
    assert data_problems(moved) == ()
    (found,) = data_problems(replace(moved, interval=told * moved.interval))
    assert (found.rule, f": {right} as long an interval?" in str(found)) == ("turning", True)
    still = Recording(np.zeros((9, 3)), np.full((9, 3), G / 50 / np.sqrt(3)), 1 / 50, "increments")
    assert data_problems(still) == ()
    (found,) = data_problems(replace(still, interval=told * still.interval))
    assert (found.rule, f": {right} as long an interval?" in str(found)) == ("force", True)


@pytest.mark.parametrize("kind", ["rates", "increments"])
@pytest.mark.parametrize(
    ("rate", "interval", "rules"),
    [(-40.0, 0.01, ["rate"]), (30.0, 0.125, ["half turn"]), (40.0, 0.1, ["rate", "half turn"])],
)
def test_one_sample_that_cannot_be_is_enough(rate, interval, rules, kind):
    gyro = np.zeros((9, 3))
    gyro[4, 1] = rate * (1 if kind == "rates" else interval)
    found = {
        doubt.rule: doubt.size for doubt in data_problems(Recording(gyro, None, interval, kind))
    }
    sizes = {"rate": abs(rate), "half turn": abs(rate) * interval}
    assert found == pytest.approx({rule: sizes[rule] for rule in rules})


@pytest.mark.parametrize("unit", [1.0, 0.1, 0.01])
@pytest.mark.parametrize(("last", "gap"), [(7, False), (7.01, True), (8, True)])
def test_a_step_of_one_and_a_half_is_no_gap_and_more_is(last, gap, unit):
    times = unit * np.array([0, 2, 4, last, last + 2])
    recording = Recording(np.ones((5, 3)), None, 2 * unit, "rates", times)
    measured = [(doubt.rule, doubt.size, doubt.threshold) for doubt in data_problems(recording)]
    if gap:
        assert measured == [("gap", pytest.approx((last - 4) / 2), 1.5)]
        with pytest.raises(ValueError, match=r"^times: expected no gap longer than 1\.5 times"):
            recording.angles()
    else:
        assert measured == []
        assert np.ptp(recording.angles()) < 1e-12 * unit


@pytest.mark.parametrize("span", [0.5, 1.0, 2.0])
def test_a_clipped_channel_is_told_whatever_its_span(span):
    swing = np.minimum(np.sin(np.arange(1000) / 20), 0.5)
    channel = (swing - swing.min()) / np.ptp(swing) * span
    others = np.random.default_rng(2).standard_normal((2, 1000))
    (found,) = data_problems(Recording(np.stack([channel, *others], axis=1), None, 0.01, "rates"))
    assert np.ptp(channel) == span
    assert (found.rule, str(found)[:7]) == ("clipped", "gyro x:")


@pytest.mark.parametrize("kind", ["rates", "increments"])
@pytest.mark.parametrize("factor", [1 / 1000, 1000.0])
def test_the_size_of_a_force_that_is_none_is_that_over_gravity(kind, factor):
    step = 0.02
    force = np.tile([0.0, 0.0, factor * G * (step if kind == "increments" else 1.0)], (100, 1))
    force += 1e-6 * np.random.default_rng(1).standard_normal(force.shape) * np.abs(force).max()
    recording = Recording(np.zeros((100, 3)), force, step, kind, gravity=G)
    [doubt] = [doubt for doubt in data_problems(recording) if doubt.rule == "force"]
    assert doubt.size == pytest.approx(factor, rel=1e-5)


@pytest.mark.parametrize(("rows", "told"), [(_ENOUGH_ROWS, True), (_ENOUGH_ROWS - 1, False)])
def test_dead_channels_and_twins_are_told_from_a_hundred_rows_on(rows, told):
    one, other = np.random.default_rng(1).standard_normal((2, rows))
    channels = np.stack([one, np.full(rows, 3.0), other, 2 - one], axis=1)
    assert _dead_channels(channels[:, :2], channels[:, 2:]) == [False, told, False, False]
    assert _twin_channels(channels[:, :2], channels[:, 2:]) == ([(0, 3)] if told else [])
    assert _dead_channels(np.ones((rows, 2))) == [False, False]  # none of them changes


@pytest.mark.parametrize("begin", [0, 1, 7, 15])
def test_the_longest_run_is_found_wherever_it_begins(begin):
    channel = np.arange(20.0)
    channel[begin : begin + 5] = -1
    assert _longest_run(channel)[:2] == (begin, 5)


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("rows", [3, 40, 49, 50, 60, 97])
def test_a_channel_at_its_extreme_for_half_of_the_time_or_more_rests_there(rows, sign):
    """Each level below has one row, and one more is counted."""
    channel = -np.arange(100.0).clip(rows - 1)
    assert _clipped_rows(sign * channel) == ((rows, rows / 2) if rows < 50 else (0, 0.0))


@pytest.mark.parametrize("rows", [_BLOCK - 1, _BLOCK, 2 * _BLOCK + 1])
def test_twins_are_those_of_the_whole_record(rows):
    one, other = np.random.default_rng(1).standard_normal((2, rows))
    late = np.where(np.arange(rows) < rows - 1, one, -one)  # the last row alone differs
    assert _twin_channels(np.stack([one, other, late, 1e3 - 2 * one], axis=1)) == [(0, 3)]

"""The tests of the marine standards in simulation, against closed forms."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.constants import degree, g, hour, knot, milli, minute

from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity
from driftlab.gyrocompass import (
    COARSE,
    LIMITS,
    Gyrocompass,
    GyroNoise,
    marine_type_test,
    type_test,
)
from driftlab.gyrocompass.type_test import (
    BRAKING,
    REST,
    SWING,
    Steps,
    TypeTest,
    _at_its_worst,
    _change_of_speed,
    _checked_steps,
    _heading_errors,
    _quay,
    _speeding_up,
    _turn,
    _turned,
    _turning,
)

LATITUDE = np.radians(51.5)
BIAS = 0.05 * degree / hour
TO_THE_EAST = Gyrocompass(gyro_bias=(0.0, 0.0, BIAS))
NONE = (0.0, 0.0, 0.0)


def run(compass: Gyrocompass, latitude: float = LATITUDE, **kwargs: float) -> dict[str, float]:
    return marine_type_test(compass, latitude, steps=COARSE, **kwargs).measured


def test_a_compass_of_which_nothing_is_told_has_no_errors() -> None:
    ideal = Gyrocompass()
    assert ideal.gyro_bias == ideal.accelerometer_bias == NONE
    assert (
        ideal.gyro_noise.white
        == ideal.gyro_noise.gauss_markov
        == ideal.gyro_noise.quantisation
        == 0
    )
    assert ideal.damping == ideal.speed_log_scale_factor == 0


def test_fine_steps_meet_the_moments_at_which_a_manoeuvre_begins_and_swings_turn() -> None:
    steps = Steps()
    for step in (steps.speed, steps.turn):
        assert REST % step == 0
    for period in (6.0, 10.0, 15.0):
        assert period % steps.sea == 0
    # At the quay it is read in whole intervals: three times in half hours, then every 20 minutes.
    for read in (30 * minute, 20 * minute):
        for size in (steps.quay, COARSE.quay):
            assert read % size == 0


def test_a_minute_at_sea_is_enough() -> None:
    assert _checked_steps(Steps(rolling=60.0)).rolling == 60.0


def test_limits_are_the_numbers_of_the_resolutions() -> None:
    angles = {"settle point": 0.75, "scatter": 0.25, "repeatability": 0.25, "steady way": 0.25}
    for name, size in {**angles, "sea": 1.0, "repeatability in service": 1.0}.items():
        assert np.degrees(LIMITS[name].at(np.radians(60.0))) == pytest.approx(2 * size)
    for name, size in {"change of speed": 2.0, "turn": 3.0}.items():
        assert np.degrees(LIMITS[name].at(np.radians(60.0))) == pytest.approx(size)
    assert LIMITS["settling"].at(1.0) == LIMITS["settling at sea"].at(1.0) == 6 * hour
    assert [name for name, limit in LIMITS.items() if not limit.read] == ["sea"]


@pytest.mark.parametrize("latitude", [0.0, -1.2])
def test_what_uses_a_limit_up_passes_and_what_goes_beyond_fails(latitude: float) -> None:
    used = {name: limit.at(latitude) for name, limit in LIMITS.items()}
    assert TypeTest(latitude, used).passed == dict.fromkeys(LIMITS, True)
    beyond = {name: (1 + 1e-12) * size for name, size in used.items()}
    assert TypeTest(latitude, beyond).passed == dict.fromkeys(LIMITS, False)


@pytest.mark.parametrize("latitude", [75.0, -60.0])
def test_a_drift_takes_the_same_share_at_every_latitude(
    latitude: float,
) -> None:
    found = marine_type_test(TO_THE_EAST, np.radians(latitude))
    closed = BIAS / EARTH_RATE / np.radians(0.75)
    assert found.shares["settle point"] == pytest.approx(closed, rel=4e-3)
    assert found.passed["settle point"]


def test_an_offset_takes_a_share_with_the_sine_of_the_latitude() -> None:
    offset = Gyrocompass(accelerometer_bias=(0.0, 0.0, milli * g))
    for latitude in np.radians([0.0, 60.0]):
        closed = milli * g / gravity(latitude) * np.tan(latitude)
        found = marine_type_test(offset, latitude, steps=Steps(turn=3.0)).measured["settle point"]
        assert found == pytest.approx(closed, rel=5e-3, abs=1e-6)


def test_a_turn_shows_a_drift_four_times() -> None:
    """The error goes from one side to the other and swings as far beyond."""
    error = BIAS / (EARTH_RATE * np.cos(LATITUDE))
    # What it shows besides is at most what the turn does to a compass without a drift.
    assert abs(run(TO_THE_EAST)["turn"] - 4 * error) < run(Gyrocompass())["turn"]
    # Half of the critical damping lets a swing go beyond by exp(-pi/sqrt(3)) of the way.
    driftless = Gyrocompass(damping=0.5, speed_log=True)
    alone, by_log = (
        marine_type_test(compass, LATITUDE).measured["turn"]
        for compass in (driftless, replace(driftless, gyro_bias=TO_THE_EAST.gyro_bias))
    )
    closed = 2 * (1 + np.exp(-np.pi / np.sqrt(3)))
    assert abs(by_log - closed * error) < alone


@pytest.mark.parametrize(("latitude", "mounted"), [(0.0, (1.0, 0.0, 0.0)), (60.0, (0.0, 0.0, 1.0))])
def test_in_a_turn_an_accelerometer_bias_does_most_along_the_bow(
    latitude: float, mounted: tuple[float, float, float]
) -> None:
    """However the compass comes: the horizon swings about its new level by twice the bias."""
    place, tilt = np.radians(latitude), 0.5 * milli
    compass = Gyrocompass(accelerometer_bias=tuple(tilt * gravity(place) * np.array(mounted)))
    found = run(compass, place)["turn"] - run(Gyrocompass(), place)["turn"]
    swing = np.sqrt(gravity(place) / EARTH_RADIUS)
    closed = 2 * tilt * swing / (EARTH_RATE * np.cos(place))
    assert found == pytest.approx(closed, rel=0.06)  # what the turn itself does has a sign


def test_a_turn_counts_in_the_worst_mounting() -> None:
    mixed = Gyrocompass((0.6 * BIAS, 0.0, BIAS), accelerometer_bias=(0.0, 0.0, 0.3 * milli * g))
    found = run(mixed)["turn"]
    way = _turning(LATITUDE, 70 * knot, 3.0)
    # Past braking as in the test; the draws of a compass without noise do not matter.
    before = int((2 * REST + 70 * knot / BRAKING) // 3.0) - 1
    others = []
    for aside in np.radians(np.arange(7.0, 367.0, 40.0)):
        errors = _heading_errors(_turned(mixed, aside), way, np.random.default_rng(0))
        others.append(np.abs(errors[before:] - errors[before]).max())
    assert max(others) < 1.01 * found
    assert min(others) < 0.8 * found


@pytest.mark.parametrize("latitude", [0.0, 70.0])
def test_in_a_turn_a_drift_to_the_east_does_what_any_can(latitude: float) -> None:
    """And on a steady way others do more, but far within the limit."""
    place, rng = np.radians(latitude), np.random.default_rng(0)
    off, steady = [], []
    for aside in np.radians(np.arange(0.0, 360.0, 40.0)):
        compass = _turned(TO_THE_EAST, aside)
        off.append(_turn(compass, _turning(place, 70 * knot, 3.0), 70 * knot, rng)["turn"])
        way = _speeding_up(place, 70 * knot, 18.0)
        steady.append(_change_of_speed(compass, way, rng)["steady way"])
    assert off[0] > 0.99 * max(off)
    assert steady[0] < 0.6 * max(steady)
    assert max(steady) < 0.4 * LIMITS["steady way"].at(place)


def test_damping_needs_a_log() -> None:
    damped = Gyrocompass(damping=0.5)
    alone = marine_type_test(damped, LATITUDE)
    assert not alone.passed["turn"]
    assert not alone.passed["change of speed"]
    assert all(alone.passed[name] for name in ("settling", "settle point", "scatter"))
    by_log = marine_type_test(replace(damped, speed_log=True), LATITUDE)
    assert max(by_log.shares.values()) < 0.26  # the settling, and the speed error of the sway


def test_the_error_of_a_log_is_the_residual_error_of_a_steady_way() -> None:
    compass = Gyrocompass(damping=0.5, speed_log=True, speed_log_scale_factor=0.03)
    for speed in (20 * knot, 70 * knot):
        closed = 0.03 * speed / (EARTH_RADIUS * EARTH_RATE * np.cos(LATITUDE))
        # On the way, two swings to the North, the Earth's level rate becomes smaller.
        there = LATITUDE + speed * 2 * SWING / EARTH_RADIUS
        found = run(compass, speed=speed)["steady way"]
        assert 1 < found / closed < np.cos(LATITUDE) / np.cos(there)


@pytest.mark.parametrize("latitude", [0.0, 0.6, -1.2])
def test_at_its_worst_all_lasting_errors_look_to_the_east(latitude: float) -> None:
    """What leans by E east turns the heading as a drift of U sin(latitude) E would."""
    rng = np.random.default_rng(3)
    for gyro, accelerometer in rng.normal(size=(20, 2, 3)) * [[[1e-7], [1e-2]]]:
        drifting = Gyrocompass(gyro_bias=tuple(gyro), accelerometer_bias=tuple(accelerometer))

        def effect(compass: Gyrocompass) -> np.ndarray:
            lean = np.array(compass.accelerometer_bias) / gravity(latitude)
            across = np.array(compass.gyro_bias) - EARTH_RATE * np.sin(latitude) * lean
            return across / EARTH_RATE

        north, _, east = effect(_at_its_worst(drifting, latitude))
        assert abs(north) < 1e-12 * east
        size = np.hypot(*effect(drifting)[[0, 2]])
        assert east == pytest.approx(size, rel=1e-12)


def test_the_first_reading_has_the_noise_of_the_alignment() -> None:
    noise, starts = GyroNoise(white=0.5 * degree / hour, gauss_markov=0.02 * degree / hour), 400
    compass = Gyrocompass(gyro_noise=noise, alignment_time=300.0)
    rng = np.random.default_rng(4)
    first = _heading_errors(compass, _quay(LATITUDE, 240.0, 60.0), rng, starts)[:, 0]
    expected = noise.standard_deviation_of_mean(3000) / (EARTH_RATE * np.cos(LATITUDE))
    assert abs(first.std() / expected - 1) < 4 / np.sqrt(2 * starts)


def test_starts_differ_by_noise_alone_and_come_again_with_the_seed() -> None:
    quiet = run(TO_THE_EAST)
    assert quiet["repeatability"] == 0.0
    assert quiet["settling"] == 1.5 * hour + 60.0
    noisy = replace(TO_THE_EAST, gyro_noise=GyroNoise())
    assert run(noisy) == run(noisy)
    assert run(noisy, seed=1)["repeatability"] not in (0.0, run(noisy)["repeatability"])


@pytest.mark.parametrize("latitude", [0.0, -1.2])
def test_of_all_periods_of_a_sway_the_longest_does_most(
    latitude: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = []
    for period in (6.0, 8.0, 10.0, 12.5, type_test._SWAYING[1]):
        monkeypatch.setattr(type_test, "_SWAYING", (1.0, period))
        way = type_test._rolling.__wrapped__(latitude, 0.5, 600.0)
        found.append(type_test._at_sea(TO_THE_EAST, way, np.random.default_rng(0))["sea"])
    assert found == sorted(found)


def test_a_compass_that_never_settles_says_so() -> None:
    wild = Gyrocompass(gyro_noise=GyroNoise(white=0.0, gauss_markov=5 * degree / hour))
    found = marine_type_test(wild, LATITUDE, steps=COARSE)
    assert found.measured["settling"] == np.inf
    assert not found.passed["settling"]


def test_coarse_steps_see_what_fine_ones_see() -> None:
    compass = replace(TO_THE_EAST, damping=0.3, speed_log=True)
    fine = marine_type_test(compass, LATITUDE).shares
    coarse = marine_type_test(compass, LATITUDE, steps=COARSE).shares
    gaps = {name: abs(share - coarse[name]) for name, share in fine.items()}
    assert gaps.pop("turn") < np.radians(0.3) / LIMITS["turn"].size  # as `COARSE` says
    # By so much an arc is higher than its chord: of the ship's quickest swing in a second.
    assert gaps.pop("sea") < fine["sea"] * (2 * np.pi / 5.0) ** 2 / 8
    assert max(gaps.values()) < 0.01  # of a limit: no verdict depends on it


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"alignment_time": 0.0}, r"alignment_time: expected"),
        ({"speed_log_scale_factor": 0.01}, r"speed_log_scale_factor: expected zero without a log"),
        ({"gyro_bias": np.zeros((2, 3))}, r"gyro_bias: expected shape \(3,\), got \(2, 3\)"),
        ({"damping": -1.0}, r"damping: expected a number of at least 0, got -1\.0"),
    ],
)
def test_a_bad_compass_is_refused(change: dict, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        Gyrocompass(**change)


def test_a_pole_is_refused() -> None:
    with pytest.raises(ValueError, match=r"latitude: expected at most 85 degrees .* 89 degrees"):
        marine_type_test(Gyrocompass(), np.radians(89.0))


@pytest.mark.parametrize(
    ("steps", "words"),
    [
        (Steps(turn=0.0), r"steps\.turn: expected a positive number"),
        (Steps(speed=120.0), r"steps\.speed: expected at most 18 s, as in COARSE, got 120"),
        (Steps(rolling=1.0), r"steps\.rolling: expected at least a minute, got 1\.0"),
    ],
)
def test_bad_steps_are_refused(steps: object, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        marine_type_test(Gyrocompass(), LATITUDE, steps=steps)


def test_a_limit_is_asked_for_by_its_name_and_in_radians() -> None:
    with pytest.raises(ValueError, match=r"measured: expected some of settling, .* got 'trun'"):
        _ = TypeTest(1.0, {"trun": 1.0}).shares
    for name in ("settle point", "turn"):
        with pytest.raises(ValueError, match=r"latitude: expected at most 89.9 degrees .* 60 rad"):
            LIMITS[name].at(60.0)

"""Rests: found where they are, with their reasons, in simulated logs and in published ones."""

import warnings
from dataclasses import replace

import numpy as np
import pytest

from driftlab.checks import UnusualWarning
from driftlab.recordings.recording import Recording
from driftlab.recordings.static_detection import static_intervals
from support import recording_or_skip

NOISE, FORCE_NOISE = 1e-3, 2e-2


def log(*moves, rows=3000, interval=0.01, kind="rates", force=True):
    """Rest with noise, but for turns of 1 rad/s between the given rows."""
    rng = np.random.default_rng(3)
    gyro = NOISE * rng.standard_normal((rows, 3))
    accelerometer = FORCE_NOISE * rng.standard_normal((rows, 3)) + [0.0, 0.0, 9.8]
    for begin, end in moves:
        gyro[begin:end, 1] += 1 - np.cos(np.linspace(0, 2 * np.pi, end - begin))
    if kind == "increments":
        gyro, accelerometer = gyro * interval, accelerometer * interval
    return Recording(gyro, accelerometer if force else None, interval, kind)


@pytest.mark.parametrize("kind", ["rates", "increments"])
@pytest.mark.parametrize("force", [True, False])
def test_rests_lie_between_the_moves_and_touch_none(kind, force):
    moves = [(800, 1000), (1600, 1900)]
    found = static_intervals(log(*moves, kind=kind, force=force))
    assert len(found) == 3
    edges = [0, *np.ravel(moves), 3000]
    for (begin, end), first, last in zip(found.rows, edges[::2], edges[1::2], strict=True):
        # A window of 1 s is cut off, and may have reached into the move by less than that.
        assert first < begin <= first + 100
        assert last - 100 <= end < last
    np.testing.assert_allclose(found.durations, (found.end - found.begin) * 0.01)
    assert (found.loudest >= 1).all()
    assert (found.loudest < 20).all()


def test_noise_is_that_of_the_quietest_window():
    """A variance of n values has a deviation of sqrt(2/n) of itself; here 3 x 100 of them, the
    least of 24 independent windows: no more than 4 deviations below."""
    found = static_intervals(log((800, 1000)))
    for noise, true in ((found.gyro_noise, NOISE), (found.accelerometer_noise, FORCE_NOISE)):
        ratio = noise / (true * np.sqrt(3))
        assert 1 - 4 * np.sqrt(0.5 / 300) < ratio < 1


def test_what_is_quiet_but_too_short_is_told():
    found = static_intervals(log((800, 1000), (1200, 1400)))
    assert len(found) == 2
    ((begin, end),) = found.too_short
    assert 1000 < begin < end < 1200
    assert "too short" in repr(found)
    assert "1 quiet stretches were too short" in found.why
    longer = static_intervals(log((800, 1000), (1200, 1400)), window=0.5)
    assert len(longer) == 3


def test_a_log_without_moves_is_one_rest():
    found = static_intervals(log())
    assert found.rows == [(100, 2900)]
    assert found.why.startswith("1 rest: ")


@pytest.mark.parametrize("kind", ["rates", "increments"])
def test_a_log_that_never_rests_is_warned_of(kind):
    """Swings of a radian a second, whose calmest moment is no noise."""
    t = np.arange(6000) / 100
    gyro = np.stack([np.sin(5 * t), np.cos(3 * t), np.sin(7 * t)], axis=1)
    share = 1.0 if kind == "rates" else 0.01
    with pytest.warns(UnusualWarning, match=r"^recording\.gyro: .* ever lie still"):
        static_intervals(Recording(share * gyro, None, 0.01, kind))
    lively = log((500, 800), kind=kind)
    force = lively.accelerometer + 3 * share * gyro[: len(lively)]
    with pytest.warns(UnusualWarning, match=r"^recording\.accelerometer: "):
        static_intervals(replace(lively, accelerometer=force))


@pytest.mark.parametrize("kind", ["rates", "increments"])
@pytest.mark.parametrize("share", [0.995, 1.005])
@pytest.mark.parametrize(
    ("triad", "most", "unit"), [("gyro", 0.1, "rad/s"), ("accelerometer", 1.0, "m/s^2")]
)
def test_a_quietest_window_is_warned_of_if_it_scatters_by_more_than_sensors_do(
    triad, most, unit, share, kind
):
    """Of samples a and -a by turns each window has the deviation a."""
    span = 1.0 if kind == "rates" else 0.01
    still = log(rows=400, kind=kind)
    rows = np.zeros((400, 3))
    rows[:, 1] = share * most * span * (-1.0) ** np.arange(400)
    shaken = replace(still, **{triad: rows})
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = static_intervals(shaken)
    assert getattr(found, f"{triad}_noise") == pytest.approx(share * most * span)
    assert [one.category for one in caught] == [UnusualWarning] * (share > 1)
    words = f"recording.{triad}: expected a moment of rest, where samples scatter by less than"
    assert all(str(one.message).startswith(f"{words} {most:g} {unit}, got") for one in caught)


def test_other_multiples_are_told():
    found = static_intervals(log((800, 1000)))
    assert found.alternatives == ((10.0, 2), (40.0, 2))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"window": 20.0}, r"^recording: expected at least two windows of 20 s, got 30 s"),
        ({"multiple": 1.0}, r"^multiple: expected more than 1"),
        ({"trim": 0.1}, r"^trim: expected at least half a window, 0.5, got 0.1"),
        ({"window": 0}, r"^window: expected a positive number"),
        (
            {"shortest": 60.0},
            r"^recording: expected a rest of 62 s, settling included, .* got 30 s",
        ),
    ],
)
def test_refusals(change, words):
    with pytest.raises(ValueError, match=words):
        static_intervals(log(), **change)


def test_a_record_that_is_none_is_refused():
    with pytest.raises(ValueError, match=r"^recording: expected a Recording"):
        static_intervals(np.zeros((300, 3)))


@pytest.mark.parametrize("offset", [0.0, 0.3, -0.7])
@pytest.mark.parametrize("move", [0.0, 1.0, 10.0, 100.0])
@pytest.mark.parametrize("begin", [400, 433])
def test_a_triad_that_hangs_is_refused_whatever_it_showed_before(offset, move, begin):
    gyro = NOISE * np.random.default_rng(1).standard_normal((1000, 3)) + offset
    gyro[200:350, 1] += move * np.sin(np.linspace(0, np.pi, 150))
    gyro[begin : begin + 300] = gyro[begin]
    words = rf"^recording.gyro: expected noise .* 100 equal rows from row {begin}:"
    with pytest.raises(ValueError, match=words):
        static_intervals(Recording(gyro, None, 0.01, "rates"))


@pytest.mark.parametrize(("share", "told"), [(0.995, False), (1.005, True)])
def test_noise_is_told_down_to_a_thousand_millionth_of_the_largest_sample(share, told):
    gyro = np.zeros((600, 3))
    gyro[:, 0] = share * 1e-9 * (-1.0) ** np.arange(600)
    gyro[:, 1] = -1
    log = Recording(gyro, None, 0.01, "rates")
    if told:
        assert static_intervals(log).gyro_noise == pytest.approx(share * 1e-9, rel=1e-9)
    else:
        with pytest.raises(ValueError, match=r"^recording.gyro: expected noise in every window"):
            static_intervals(log)


@pytest.mark.parametrize("begin", [0, 1500, 2900])
def test_a_large_sample_elsewhere_does_not_hide_the_noise(begin):
    gyro = 1e-7 * np.random.default_rng(1).standard_normal((3000, 3))
    gyro[begin : begin + 50] += 200.0
    found = static_intervals(Recording(gyro, None, 0.01, "rates"))
    assert 1e-7 < found.gyro_noise < np.sqrt(3) * 1e-7


@pytest.mark.parametrize("force", [True, False])
@pytest.mark.parametrize("window", [1.0, 0.5, 0.37, 0.04])
def test_noise_and_loudest_windows_are_those_of_the_rows_one_by_one(window, force):
    """A rest that is shorter than a window is as loud as the one about its middle."""
    recording = log((800, 1000), (1140, 1300), (1362, 1500), force=force)
    found = static_intervals(recording, window=window, trim=window / 2, shortest=0.03)
    width = round(window / recording.interval)
    scatter, noises = np.zeros(len(recording) - width + 1), []
    for triad in (recording.gyro, recording.accelerometer)[: 1 + force]:
        windows = np.lib.stride_tricks.sliding_window_view(triad, width, axis=0)
        deviation = np.sqrt(windows.var(axis=-1).sum(axis=-1))
        noises.append(deviation.min())
        scatter = np.maximum(scatter, deviation / noises[-1])
        if len(noises) == 1:
            assert found.quietest == np.argmin(deviation) + width // 2
    assert [found.gyro_noise, found.accelerometer_noise][: len(noises)] == pytest.approx(noises)
    loudest = [
        scatter[begin : end - width + 1].max()
        if end - begin >= width
        else scatter[(begin + end) // 2 - width // 2]
        for begin, end in found.rows
    ]
    assert found.loudest == pytest.approx(loudest)


@pytest.mark.parametrize(
    ("name", "count"),
    [
        ("xsens-mti", 38),  # as IMU-TK finds
        ("ferraris-session", 13),  # six poses, the ways to the turns, and between them
        *((f"mpu9150-{number}", 22) for number in range(1, 6)),
    ],
)
def test_published_records(name, count):
    recording = recording_or_skip(name)
    for multiple in (20, 30, 40):
        assert len(static_intervals(recording, multiple=multiple)) == count


def test_a_parked_car_rests_for_most_of_the_time():
    found = static_intervals(recording_or_skip("laser-gyro"))
    longest = int(np.argmax(found.durations))
    assert found.durations.sum() > 0.9 * 1847
    # The quiet stretch that its users speak of.
    begin, end = (row * 0.01 for row in found.rows[longest])
    assert begin < 1050
    assert end > 1490


def test_what_was_asked_for_stands_in_the_answer():
    asked = {"window": 0.5, "multiple": 12.0, "trim": 0.25, "shortest": 0.75}
    found = static_intervals(log(), **asked)
    assert {name: getattr(found, name) for name in asked} == asked
    assert [multiple for multiple, _ in found.alternatives] == [6.0, 24.0]

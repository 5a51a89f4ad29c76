"""Settling on a ship that rolls, pitches and sways: over the periods and latitudes of A.821(19)."""

import numpy as np
import pytest
from scipy.constants import g, hour, minute

from driftlab.book.ch15_gyrocompass_trials.experiments import at_sea
from driftlab.book.machinery.figure.publish import PublishedFigure
from driftlab.earth import EARTH_RATE
from driftlab.gyrocompass import LIMITS, align, align_in_inertial_frame
from driftlab.motion import vehicle_trajectory
from published import published

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("periods", [(6, 6), (8.3, 8.3), (11, 11), (15, 15), (15, 6)])
@pytest.mark.parametrize("latitude", np.radians([-70.0, -30.0, 0.0, 50.0, 70.0]).tolist())
def test_a_stiff_horizon_never_settles_and_others_do(
    latitude: float, periods: tuple[float, float]
) -> None:
    """In two hours of six. Roll at 15 s and pitch at 6 are of the draft of ISO 22090-1, 6.5."""
    limit = LIMITS["settle point"].at(latitude)
    way = at_sea.ship_at_sea(latitude, periods, 2 * hour, 0.5)
    found = [at_sea.horizon_headings(way, f) for f in at_sea.HORIZONS.values()]
    stiff, *others = (np.abs(headings[-2400:]).max() for headings in found)
    assert stiff > 8 * limit
    assert max(others) < limit
    # A wave is so quick that the integral adds up the push.
    closed = 0.004**2 * at_sea.PUSH * periods[0] / (2 * np.pi * g * EARTH_RATE)
    assert others[0] == pytest.approx(closed / np.cos(latitude), rel=0.03)
    read = at_sea.sensed(at_sea.ship_at_sea(latitude, periods, 10 * minute, 0.02))
    for minutes in (3, 5, 10):
        part = read.part(0, 600 * minutes)
        assert abs(align_in_inertial_frame(part, latitude).heading) < 0.5 * limit


def test_a_light_or_very_slow_damping_needs_more_than_the_six_hours() -> None:
    """With a ratio of 0.7 periods from 25 minutes to four hours do; not for any ratio or period."""
    latitude, schuler = float(np.radians(51.5)), at_sea.HORIZONS["Schuler's"]
    way = at_sea.ship_at_sea(latitude, (15.0, 15.0), LIMITS["settling at sea"].size, 0.5)

    def share(minutes: float, damping: float = at_sea.DAMPING) -> float:
        headings = at_sea.horizon_headings(way, 2 * np.pi / (60 * minutes), damping)
        return float(np.abs(headings[-4320:]).max() / LIMITS["settle point"].at(latitude))

    assert share(25) < 1
    assert share(240) < 0.5
    assert share(450) > 1.5
    assert share(25, 0.05) > 1.5
    assert share(2 * np.pi / schuler / 60, 0.1) > 2


def test_the_stiff_horizon_settles_if_the_waves_stop_for_the_readings() -> None:
    """Five minutes before each reading half an hour apart, as the draft of ISO 22090-1 allows."""
    times = 0.5 * np.arange(14401)
    wave, on = 2 * np.pi / 11 * times, (times - 0.1) % 1800 < 1500
    push = at_sea.PUSH * 11 / (2 * np.pi) * np.sin(wave + 1) * on
    way = vehicle_trajectory(
        0.9, np.stack([push, 0 * push], axis=-1), 0 * times,
        at_sea.LEAN * np.cos(wave) * on, at_sea.LEAN * np.sin(wave) * on, interval=0.5,
    )  # fmt: skip
    headings = np.degrees(at_sea.horizon_headings(way, at_sea.HORIZONS["stiff"]))
    assert np.abs(headings[3599::3600]).max() < 0.35
    assert np.ptp(headings[3600:]) > 20


def test_means_find_no_north_at_sea_in_an_hour() -> None:
    """Unless the time is a whole number of waves: a roll to the other side is left over."""
    _, angle, velocity = at_sea.ship_at_sea(0.9, (10.0, 10.0), 3605.0, 0.5).increments
    means = align(2 * angle.mean(axis=0), velocity.mean(axis=0), heading_tolerance=np.inf)
    assert abs(means.heading) > 0.2


@pytest.mark.parametrize("period", [6.0, 10.0, 15.0])
def test_readings_half_an_hour_apart_do_not_see_the_waves(period: float) -> None:
    way = at_sea.ship_at_sea(0.9, (period, period), 2.1 * hour, 0.5)
    headings = np.degrees(at_sea.horizon_headings(way, at_sea.HORIZONS["stiff"]))
    assert np.ptp(headings[3600::3600]) < 0.7
    assert np.ptp(headings[-3600:]) > 20


def irregular(latitude: float, turn: float, rng: np.random.Generator) -> at_sea.Trajectory:
    """A ship on any course in waves of all periods from 6 to 15 s that turns early, 20 minutes."""
    times, shape = 0.02 * np.arange(60001), (4, 12, 1)
    phases = 2 * np.pi * (times / rng.uniform(6, 15, shape) + rng.uniform(size=shape))
    waves = np.sum(rng.normal(size=shape) * np.sin(phases), axis=1)
    waves /= np.abs(waves).max(axis=1, keepdims=True)
    heading = rng.uniform(-3, 3) + turn * np.clip(times / 60 - 6, 0, 1)
    lean = at_sea.LEAN * waves[2:]
    return vehicle_trajectory(latitude, 0.4 * waves[:2].T, heading, *lean, interval=0.02)


@pytest.mark.parametrize(
    ("latitude", "period"),
    [
        (1.2, 15.0),
        (-1.1, None),
        *(
            pytest.param(*place, marks=pytest.mark.long)
            for place in ((-1.2, 6), (0, 15), (0.2, None))
        ),
    ],
)
def test_a_turn_tells_the_filter_the_drifts(latitude: float, period: float | None) -> None:
    """In the middle of the record; gravity in inertial space gains nothing. The filter states too
    much, not too little.
    """
    rng, rows = np.random.default_rng(5), []
    for turn in (0.0, np.pi / 2, np.pi):
        if period:
            way = at_sea.ship_at_sea(latitude, (period, period), 20 * minute, 0.02, turn)
        else:
            way = irregular(latitude, turn, rng)
        rows.append(at_sea.spreads(way, 16, rng))
    (by_frame, by_filter, stated), *turned = rows
    assert by_filter == pytest.approx(by_frame, rel=0.15)
    assert 0.5 < by_filter / stated < 1.6
    for frame, filtered, says in turned:
        assert filtered < 0.3 * by_filter
        assert frame > 0.5 * by_frame
        assert 0.2 < filtered / says < 1


@published("15-settling-at-sea")
def test_the_study_at_sea_is_what_the_code_makes(figure: PublishedFigure) -> None:
    again, data = at_sea.settling_at_sea([15.0], [0.0]), figure.data
    np.testing.assert_allclose(again.settling[:, 0], data.settling[:, -1], rtol=1e-6)
    np.testing.assert_allclose(again.swing[:, 0], data.swing[:, -1], rtol=1e-6)
    np.testing.assert_allclose(again.deviation[:, 0], data.deviation[:, 0], rtol=1e-6)

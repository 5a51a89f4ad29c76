"""Allan plots of two real gyros: the published numbers, and where each comes from."""

import numpy as np
import pytest

from driftlab.book.ch17_real_recordings.experiments import allan_lines as lines
from driftlab.book.machinery.figure.publish import PublishedFigure
from published import kept_table, published
from support import recording_or_skip


@published("17-allan-plots")
def test_fits_to_the_recordings_are_the_published_ones(figure: PublishedFigure) -> None:
    for name in (lines.CHEAP, lines.DEAR):
        recording_or_skip(name)
    shown = kept_table("17-allan-plots")
    # Fits that are searched for end within a thousandth of each other.
    for name in ("cheap_terms", "dear_terms", "cheap_bounds", "dear_bounds", "missed", "forward"):
        np.testing.assert_allclose(getattr(figure.data, name), getattr(shown, name), rtol=2e-3)


@published("17-allan-plots")
def test_the_slope_of_the_laser_gyro_is_the_car_and_not_its_pulses(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    angle = data.dear_terms[0]
    assert angle > 12 * lines.ROUNDING
    assert angle == pytest.approx(data.rocking, rel=0.1)
    assert data.missed[0] > 3
    assert data.missed[1] < 1.5
    # At the shortest time, before the car has rocked, the angle is no worse than rounding makes it.
    own = data.dear_deviation[0] * data.dear_time[0] / np.sqrt(3)
    assert own < lines.ROUNDING


def test_between_zeros_the_laser_gyros_counts_add_up_to_whole_pulses() -> None:
    """Of all sums 15 % would lie within 0.7 counts of a whole number of pulses by chance."""
    counts = np.round(recording_or_skip(lines.DEAR).gyro / lines.COUNT)
    pulse = lines.PULSE / lines.COUNT
    for gyro in counts.T:
        zeros, added = np.flatnonzero(gyro == 0), np.append(0, np.cumsum(gyro))
        length = np.diff(zeros)
        sums = (added[zeros[1:]] - added[zeros[:-1]])[(length > 1) & (length < 10)]
        off = np.abs(sums - pulse * np.round(sums / pulse))
        assert len(sums) > 15_000
        assert (off < 0.7).mean() > 0.995


@published("17-allan-plots")
def test_the_walk_of_the_fit_is_the_cars(figure: PublishedFigure) -> None:
    """As the forward gyro's it would make headings far worse than those of the same car."""
    by_fit, allowed = np.degrees(figure.data.forward) * 60  # per root of an hour
    assert by_fit > 50 * allowed
    assert by_fit == pytest.approx(0.0528, abs=0.0036)  # its standard deviation
    assert allowed < 0.001


@published("17-allan-plots")
def test_a_short_record_bounds_what_it_cannot_see(figure: PublishedFigure) -> None:
    data = figure.data
    for gyro in ("cheap", "dear"):
        terms, uncertainty, bounds = (
            getattr(data, f"{gyro}_{name}") for name in ("terms", "uncertainty", "bounds")
        )
        assert (np.isnan(bounds) == (terms > 0)).all()
        assert (np.isnan(uncertainty) == (terms == 0)).all()
        assert terms[1] > 2 * uncertainty[1]
        assert not terms[2:].any()
    assert data.cheap_terms[1] > 20 * data.dear_terms[1]

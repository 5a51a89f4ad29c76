"""The figures of chapter 13: the errors of an alignment, over the vertical, and averages."""

from pathlib import Path

import numpy as np
import pytest

from driftlab.book import figures
from driftlab.book.ch13_finding_north import experiments as alignments
from driftlab.book.machinery.figure.csv_table import read_table
from driftlab.book.machinery.figure.publish import PublishedFigure
from driftlab.earth import gravity
from published import published
from saratov import GRAVITY, HOURLY, LATITUDE, LEVEL_RATE
from support import EPS, chi_bounds, largest, order_of

ROUNDED = 32 * EPS
"""Angles of up to a turn, and what they add up to, are rounded by this."""


@published("13-alignment-budget")
def test_the_budget_is_the_sum_of_its_terms_and_off_in_second_order(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    assert data.error[:4].sum() == pytest.approx(data.error[4], rel=1e-12)
    assert (data.error[:4] != 0).all()

    def gap(size: float) -> float:
        gyro_bias, accelerometer_bias = (
            size * alignments.GYRO_BIAS,
            size * alignments.ACCELEROMETER_BIAS,
        )
        part = alignments.alignment_budget(
            gyro_bias=gyro_bias, accelerometer_bias=accelerometer_bias
        )
        pairs = (part.pitch, part.roll, part.latitude, part.attitude, part.error[4:])
        return largest([first - exact for first, exact in pairs])

    # A hundred times the default errors, which are some 1e-3 in angles.
    assert order_of(lambda size: gap(100 * size)) == pytest.approx(2, abs=0.1)


@published("13-alignment-budget")
def test_the_budget_over_all_headings_is_a_mean_and_one_wave(figure: PublishedFigure) -> None:
    """Body-fixed errors stand still in the tangent of the pitch, and go round in the rest."""
    data = figure.data
    waves = np.stack([np.ones(73), np.cos(data.at_heading), np.sin(data.at_heading)], axis=-1)
    fitted, *_ = np.linalg.lstsq(waves, data.first_order)
    np.testing.assert_allclose(waves @ fitted, data.first_order, rtol=0, atol=1e-16)
    assert (np.abs(fitted) > 1e-4).all()
    assert largest(data.exact - data.first_order) < 5e-3 * largest(data.exact)


def test_a_body_that_heads_nowhere_has_no_bars_in_the_table(tmp_path: Path) -> None:
    vertical = figures.figure("13-alignment-budget", pitch=np.pi / 2)
    table = read_table(vertical.save(tmp_path / "budget.csv"))[1]
    assert set(table["error_deg"]) == {""}
    assert set(table["exact_deg"]) == {""}


@published("13-alignment-terms")
def test_each_term_goes_with_its_angle(figure: PublishedFigure) -> None:
    data = figure.data
    over_heading, over_pitch, over_latitude = (
        np.array([getattr(data, f"error_over_{name}")[of] for of in alignments.LABELS])
        for name in alignments.GRIDS
    )
    east, by_cosine, by_sine, by_latitude = over_heading
    grid = alignments.GRIDS["heading"]
    assert np.ptp(east) == np.ptp(by_latitude) == 0
    for term, wave in ((by_cosine, np.cos(grid)), (by_sine, np.sin(grid))):
        np.testing.assert_allclose(term, largest(term) * np.sign(term @ wave) * wave, atol=ROUNDED)
    tangent = np.tan(alignments.GRIDS["pitch"])
    for term in over_pitch[1:3]:
        np.testing.assert_allclose(term, term[-1] / tangent[-1] * tangent, rtol=1e-12)
    place = alignments.GRIDS["latitude"]
    pull = gravity(place)
    laws = (1 / np.cos(place), 1 / pull, 1 / pull, np.tan(place) / pull)
    for term, law in zip(over_latitude, laws, strict=True):
        np.testing.assert_allclose(term, term[-1] / law[-1] * law, rtol=1e-12)


@published("13-alignment-terms")
def test_the_stray_factor_is_what_separates_the_formula_of_the_copy_from_the_exact_error(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    for errors in (data.error_over_heading, data.error_over_pitch):
        corrected = largest(errors["corrected"] - errors["exact"])
        assert corrected < np.radians(0.01)
        assert largest(errors["as in the copy"] - errors["exact"]) > 20 * corrected
    for panel, grid in alignments.GRIDS.items():
        place = grid if panel == "latitude" else LATITUDE
        errors = getattr(data, f"error_over_{panel}")
        third = errors[alignments.LABELS[2]]
        right = sum(errors[term] for term in alignments.LABELS)
        np.testing.assert_allclose(errors["corrected"], right, rtol=0, atol=1e-15)
        expected = right - third + third * np.tan(place)
        np.testing.assert_allclose(errors["as in the copy"], expected, rtol=0, atol=2e-15)
    # Where the tangent is one the factor does not show.
    at_45 = np.isclose(alignments.GRIDS["latitude"], np.pi / 4)
    assert at_45.sum() == 1
    right, wrong = (data.error_over_latitude[of][at_45] for of in ("corrected", "as in the copy"))
    np.testing.assert_allclose(right, wrong, rtol=1e-12)


@published("13-over-the-vertical")
def test_over_the_vertical_the_attitude_keeps_what_heading_and_roll_lose(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    up = data.angle < np.pi / 2
    np.testing.assert_allclose(data.true_heading[up], alignments.HEADING, atol=1e-12)
    np.testing.assert_allclose(data.true_heading[~up], alignments.HEADING - np.pi, atol=1e-12)
    np.testing.assert_allclose(data.true_roll[up], 0, atol=1e-12)
    np.testing.assert_allclose(np.abs(data.true_roll[~up]), np.pi, atol=1e-12)
    assert largest(data.heading_error) > 30 * largest(data.attitude_error)
    assert largest(data.roll_error) > 30 * largest(data.attitude_error)
    assert (data.heading_and_roll_error[up] < 1.1 * data.attitude_error[up]).all()
    # The error of the attitude does not know where the vertical is.
    assert np.ptp(data.attitude_error) < 0.1 * data.attitude_error.min()


@published("13-over-the-vertical")
def test_over_the_vertical_errors_are_as_large_as_the_first_order_says(
    figure: PublishedFigure,
) -> None:
    """Heading: d - e tan(lat) + s tan(pitch); roll: -s/cos(pitch); s = e cos(psi) + n sin(psi).

    d, e and n are what the errors of the East gyro and of two accelerometers are in angles, and
    independent, of one size in each direction of the body.
    """
    data = figure.data
    gyro_bias = largest(alignments.GYRO_BIAS) / LEVEL_RATE
    accelerometer_bias = largest(alignments.ACCELEROMETER_BIAS) / GRAVITY
    pitch = np.minimum(data.angle, np.pi - data.angle)
    cosine, sine = np.cos(data.true_heading), np.sin(data.true_heading)

    def size(by_pitch: np.ndarray) -> np.ndarray:
        east, north = cosine * by_pitch - np.tan(LATITUDE), sine * by_pitch
        return np.sqrt(gyro_bias**2 + accelerometer_bias**2 * (east**2 + north**2))

    low, high = np.sqrt(chi_bounds(data.runs))
    expected = {
        "heading_error": size(np.tan(pitch)),
        "roll_error": accelerometer_bias / np.cos(pitch),
        "heading_and_roll_error": size(np.tan(pitch) - 1 / np.cos(pitch)),
        "attitude_error": np.sqrt(
            gyro_bias**2 + accelerometer_bias**2 * (2 + np.tan(LATITUDE) ** 2)
        ),
    }
    # Half a degree from the vertical tilts of a tenth of a degree are not small.
    small = np.abs(data.angle - np.pi / 2) > np.radians(2)
    for name, law in expected.items():
        ratio = (getattr(data, name) / law)[small]
        assert (low < ratio).all()
        assert (ratio < high).all()


@published("13-averaging-window")
def test_averaging_falls_with_the_square_root_down_to_the_slow_part(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    low, high = np.sqrt(chi_bounds(data.runs - 1))
    # Of the heading, to first order: white noise of a sample, 0.5 deg/h, is 3 degrees of it.
    simulated, formula, white_alone = np.moveaxis(data.spread, 1, 0)
    ratio = simulated / formula
    assert (low < ratio).all()
    assert (ratio < high).all()
    for white, alone in zip(alignments.WHITE, white_alone, strict=True):
        expected = white * HOURLY / np.sqrt(data.samples) / LEVEL_RATE
        np.testing.assert_allclose(alone, expected, rtol=1e-12)
    slow = np.sqrt(formula**2 - white_alone**2)
    floor = alignments.SLOW * HOURLY / LEVEL_RATE
    x = data.samples * 0.1 / 3600
    # The variance of a mean over x correlation times; a sum for an integral.
    expected = floor * np.sqrt(2 * (x + np.expm1(-x))) / x
    np.testing.assert_allclose(slow[:, 2:], np.tile(expected[2:], (2, 1)), rtol=1e-3)
    assert (slow > 0.9 * floor)[:, :-1].all()


@published("13-averaging-window")
def test_a_rounded_angle_meets_the_paper_s_numbers_as_well(figure: PublishedFigure) -> None:
    """And predicts another fall of the heading's spread: with the window, and without a floor."""
    data = figure.data
    low, high = np.sqrt(chi_bounds(data.runs - 1))
    (_, formula, _), (_, rival_formula) = data.spread[1], data.rival_spread[1]
    ratio = data.rival_spread[:, 0] / data.rival_spread[:, 1]
    assert (low < ratio).all()
    assert (ratio < high).all()
    in_range = []
    for window in range(1, 100):
        means = [
            alignments.rival_noise(t).standard_deviation_of_mean(window) for t in alignments.WHITE
        ]
        if [round(mean / HOURLY, 2) for mean in means] == [0.01, 0.02]:
            in_range.append(window)
    assert in_range == list(range(23, 43))
    assert alignments.RIVAL_WINDOW in in_range
    # White alone, or rounding alone, asks for other windows at the two ends.
    before, after = np.array(alignments.WHITE), np.array([0.01, 0.02])
    assert (before / after).round().tolist() == [6, 25]
    assert ((before / after) ** 2).round().tolist() == [36, 625]
    slopes = np.diff(np.log(rival_formula)) / np.diff(np.log(data.samples))
    assert slopes[0] < -0.95
    assert slopes[-1] == pytest.approx(-0.5, abs=0.005)
    slopes = np.diff(np.log(formula)) / np.diff(np.log(data.samples))
    assert slopes[0] == pytest.approx(-0.5, abs=0.001)
    assert slopes[-1] > -0.25


@pytest.mark.parametrize("rate", [0.0, 0.01, 1.0, 9.4])
def test_steps_whose_rest_is_carried_on_are_a_rounded_angle(rate: float) -> None:
    """As a closed loop counts; rates rounded one by one are off for good by up to half a step."""
    rival, window, runs = alignments.rival_noise(0.5), alignments.RIVAL_WINDOW, 4000
    step, rng = np.sqrt(12) * rival.quantisation, np.random.default_rng(3)
    turns = rival.interval * (
        rate * HOURLY + rival.white * rng.standard_normal((runs, 10 * window))
    )
    angles = np.cumsum(turns / step, axis=1) + rng.uniform(size=(runs, 1))
    counts = np.diff(np.floor(angles), axis=1, prepend=0.0)
    for count in (window, 10 * window):
        mean = counts[:, :count].sum(axis=1) * step / (count * rival.interval)
        # The model's rounding is new at each end; of a quiet angle it is the same now and then.
        assert mean.std() == pytest.approx(rival.standard_deviation_of_mean(count), rel=0.06)
    assert len(np.unique(counts[:, :window].sum(axis=1))) < 5
    assert len(np.unique(np.round(turns / step))) < 3
    columns = step / (window * rival.interval) / LEVEL_RATE
    assert np.degrees(columns) == pytest.approx(0.2, abs=0.01)


@published("13-two-positions")
def test_units_in_two_positions_spread_as_the_closed_forms_say(figure: PublishedFigure) -> None:
    data = figure.data
    # A deviation of n units is known to 1 in sqrt(2 n); of so many ratios none beyond four.
    bound = 4 / np.sqrt(2 * alignments.UNITS)
    for spread in (data.by_turn, data.by_time):
        simulated, formula = np.moveaxis(spread, 1, 0)
        assert np.abs(simulated / formula - 1).max() < bound


@published("13-two-positions")
def test_two_positions_have_a_best_time_and_one_has_a_floor(figure: PublishedFigure) -> None:
    one, two, carried = figure.data.by_time[:, 1]
    best = int(np.argmin(two))
    assert 0 < best < len(two) - 1
    assert (two < one).all()
    assert (one < carried).all()
    floor = alignments.SLOW * HOURLY / LEVEL_RATE
    assert one[-1] > 0.9 * floor > 5 * two[best]
    assert two[0] == pytest.approx(figure.data.white_noise_alone[0], rel=0.01)

"""The figures: what they compute, that they repeat, and that the published files are theirs."""

import base64
import csv
import html
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, strategies as st

from driftlab.attitude import coning_algorithms
from driftlab.attitude.coning_algorithms import ALGORITHMS
from driftlab.attitude.finite_precision import integrate_in_word
from driftlab.attitude.integration import integrate
from driftlab.book import figures
from driftlab.book.__main__ import write_figures
from driftlab.book.ch01_rotation_and_error_kinematics.experiments import (
    error_motion,
    integration_error,
)
from driftlab.book.ch02_characteristic_equation.experiments import characteristic_roots, root_errors
from driftlab.book.ch03_systematic_drift.experiments import drift_history, drift_map
from driftlab.book.ch03_systematic_drift.figures import drift_history as drift_history_figure
from driftlab.book.ch04_calibration_by_turns.experiments import (
    FORMULAS as FORMULAS_04,
    PLANS,
    expected_noise,
    turn_bias,
    turn_estimates,
)
from driftlab.book.ch05_cayley_and_riccati.experiments import cayley_map
from driftlab.book.ch06_picard_algorithms.experiments import (
    EARTH_RATE,
    EARTH_SECONDS,
    SAMPLE_RATES,
    algorithm_errors,
    coning_area,
    measured_drift,
)
from driftlab.book.machinery.picture import long_table
from driftlab.book.machinery.publish import PublishedFigure, gallery
from driftlab.book.scenarios import LARIN_TRIAD, SYMMETRIC
from driftlab.drift.systematic_drift import drift_coefficient
from driftlab.drift.turn_calibration import TurnExperiment
from driftlab.motion.profiles import Coning, Sway
from driftlab.quaternion import conjugate, multiply, rotation_angle
from driftlab.triad import non_orthogonality
from driftlab.vectors import direction_from_angles
from published import NAMES, published
from support import directions, matrices

PUBLISHED = Path(__file__).parents[2] / "figures"


def read(path: Path) -> dict[str, np.ndarray]:
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    return dict(zip(rows[0], np.array(rows[1:]).T, strict=True))


def published_captions() -> dict[str, str]:
    """Captions below the figures of the published gallery, by name."""
    page = (PUBLISHED / "README.md").read_text(encoding="utf-8")
    return dict(re.findall(r"^\*\*(\S+)\.\*\* (.*)$", page, re.MULTILINE))


@published(*NAMES)
def test_published_numbers_are_what_is_computed(figure: PublishedFigure) -> None:
    path = PUBLISHED / f"{figure.definition.name}.csv"
    if figure.definition.columns is None:
        assert not path.exists()
        return
    assert_same_table(read(path), figure.definition.columns(figure.data))


def assert_same_table(published: dict[str, np.ndarray], computed: dict[str, Any]) -> None:
    """Fail unless two tables have the same columns, words and numbers."""
    assert list(published) == list(computed)
    for name, column in computed.items():
        if isinstance(column[0], str):
            assert list(published[name]) == list(column)
        else:
            # Twelve digits are written; other processors may round the last few differently.
            np.testing.assert_allclose(published[name].astype(float), column, 1e-8, 1e-12, name)


@published(*NAMES)
def test_picture_repeats_byte_by_byte_and_has_a_caption(
    figure: PublishedFigure, tmp_path: Path
) -> None:
    """Drawn twice from the same data, once for a file and once for a page."""
    name = figure.definition.name
    figure.write(tmp_path)
    written = {path.name for path in tmp_path.iterdir()}
    assert written == {path.name for path in PUBLISHED.glob(f"{name}.*")}
    picture = (tmp_path / f"{name}.svg").read_bytes()
    assert picture.startswith(b"<?xml")
    page = PublishedFigure(figure.definition, figure.data)._repr_html_()
    (shown,) = re.findall(r'src="data:image/svg\+xml;base64,([^"]*)"', page)
    repeats = base64.b64decode(shown) == picture
    assert repeats, "another drawing of the same data is another picture"
    assert figure.caption.endswith(".")
    assert page.count(html.escape(figure.caption)) == 2  # alt text and caption


@published(*NAMES)
def test_the_gallery_has_the_caption_that_is_computed(figure: PublishedFigure) -> None:
    assert published_captions()[figure.definition.name] == figure.caption


def test_the_folder_holds_the_catalogue_and_nothing_else() -> None:
    captions = published_captions()
    assert list(captions) == list(figures.figure_definitions())
    assert (PUBLISHED / "README.md").read_text(encoding="utf-8") == gallery(captions)
    definitions = figures.figure_definitions()
    names = {f"{name}.svg" for name in definitions}
    names |= {f"{name}.csv" for name, each in definitions.items() if each.columns}
    names |= {"04-larin-table.csv", "README.md"}
    assert {path.name for path in PUBLISHED.iterdir()} == names


def test_a_rebuild_writes_every_entry_the_gallery_and_larins_table(tmp_path: Path) -> None:
    definitions = {
        name: each
        for name, each in figures.figure_definitions().items()
        if name in ("00-frames", "05-cayley-map")
    }
    write_figures(tmp_path, definitions)
    assert {path.name for path in tmp_path.iterdir()} == {
        "00-frames.svg",
        "05-cayley-map.svg",
        "05-cayley-map.csv",
        "04-larin-table.csv",
        "README.md",
    }
    captions = {name: each.caption(each.compute()) for name, each in definitions.items()}
    assert (tmp_path / "README.md").read_text(encoding="utf-8") == gallery(captions)
    for name in ("05-cayley-map.csv", "04-larin-table.csv"):
        table = read(tmp_path / name)
        computed = {
            title: column if title in ("name", "curve") else column.astype(float)
            for title, column in table.items()
        }
        assert_same_table(read(PUBLISHED / name), computed)


def test_unknown_figure() -> None:
    with pytest.raises(ValueError, match=r"name: expected one of 00-frames.* got 'none'"):
        figures.figure("none")


@given(matrices(1.0), directions())
def test_roots_picture_shows_the_biquadratic(shape: np.ndarray, direction: np.ndarray) -> None:
    data = characteristic_roots(0.1, shape, direction)
    # The printed equation spoils the sum of the squares and keeps their product.
    squares = data.roots[..., 0] ** 2 * data.roots[..., 2] ** 2
    np.testing.assert_allclose(squares[3], squares[0], rtol=1e-6, atol=1e-12)


def test_roots_errors_have_the_slopes_of_the_text() -> None:
    data = characteristic_roots(0.1, SYMMETRIC, [1, 1, 0.3])
    small = (data.sizes > 1e-4) & (data.sizes < 1e-2)
    slopes = [
        np.polyfit(np.log(data.sizes[small]), np.log(error[small]), 1)[0]
        for error in np.moveaxis(root_errors(data), -1, 1).reshape(-1, len(data.sizes))
    ]
    # first order: fast, slow; with the next term: fast, slow; as printed: fast, slow
    np.testing.assert_allclose(slopes, [2, 2, 3, 3, 2, 3], atol=0.05)


@given(matrices(2e-3), directions())
def test_drift_history_stays_within_the_fixed_axes(
    triad_error: np.ndarray, direction: np.ndarray
) -> None:
    data = drift_history(triad_error, direction)
    table = drift_history_figure.columns(data)
    assert np.degrees(np.abs(table["along_rad"])).max() < 12
    assert 60 * np.degrees(table["across_rad"]).max() < 45
    np.testing.assert_allclose(data.turns[::60], data.whole_turns, rtol=0, atol=1e-12)
    # (2.3), made exact: once a turn the error is so many times the drift of one turn.
    seen = np.linalg.norm(data.snapshots, axis=-1)
    expected = np.abs(data.whole_turns * data.exact_per_turn)
    np.testing.assert_allclose(seen, expected, rtol=1e-6, atol=1e-14)


@published("03-drift-by-symmetry")
def test_drift_by_symmetry_slopes_and_cosine(figure: PublishedFigure) -> None:
    data = figure.data
    slope = [
        np.polyfit(np.log(data.sizes), np.log(drift), 1)[0] for drift in (data.symmetric, data.skew)
    ]
    np.testing.assert_allclose(slope, [1, 2], atol=0.01)
    # The skew part adds nothing about (1, 1, 1), its own axis; only second order is left.
    expected = 4 * np.pi * np.cos(data.mixing)
    np.testing.assert_allclose(data.mixed / data.mixed_size, expected, rtol=0, atol=1e-10)


@given(matrices(1e-2))
def test_drift_map_lies_between_its_principal_values(triad_error: np.ndarray) -> None:
    data = drift_map(triad_error)
    assert data.coefficient.min() >= data.principal[0] - 1e-16
    assert data.coefficient.max() <= data.principal[2] + 1e-16
    at_axes = drift_coefficient(data.axes, triad_error)
    np.testing.assert_allclose(at_axes, data.principal, rtol=0, atol=1e-16)


def test_error_motion_integrator_keeps_its_tolerance() -> None:
    rate, measured = [0.1, 0.2, 0.1], [0.12, 0.15, 0.1]
    for tolerance in (1e-4, 1e-8):
        data = error_motion(rate, measured, tolerance=tolerance)
        # The tolerance holds for one step; the steps' errors add up at worst.
        worst = integration_error(data, rate, measured).max()
        assert worst < 2 * tolerance * len(data.integrated_time)


@pytest.mark.parametrize("plan", PLANS)
def test_every_plan_finds_sigma_up_to_the_bias(plan: str) -> None:
    data = turn_estimates(LARIN_TRIAD, plan)
    np.testing.assert_array_equal(data.true, non_orthogonality(LARIN_TRIAD)[[0, 0, 1], [1, 2, 2]])
    # The bias of one estimate is half of the square of what lies across, at most 2 |M|^2;
    # no plan weighs the estimates with more than 2 in all.
    assert np.abs(data.runs - data.true).max() < 4 * np.linalg.norm(LARIN_TRIAD) ** 2


def test_only_a_fit_with_scale_is_unharmed_by_a_scale_error() -> None:
    triad = LARIN_TRIAD + 2e-4 * np.eye(3)
    errors = {}
    for plan in PLANS:
        data = turn_estimates(triad, plan)
        errors[plan] = np.abs(data.runs - data.true).max()
    unharmed = [plan for plan, error in errors.items() if error < 1e-5]
    assert unharmed == [plan for plan in PLANS if "scale" in plan]


def test_noise_of_turn_estimates_repeats_with_its_seed() -> None:
    noisy = TurnExperiment(turns=2, angle_noise=1e-4)
    runs = [turn_estimates(LARIN_TRIAD, experiment=noisy, seed=s).runs for s in (1, 1, 2)]
    np.testing.assert_array_equal(runs[0], runs[1])
    assert np.abs(runs[0] - runs[2]).max() > 0


def test_turn_bias_floor_is_the_method_and_noise_falls_with_turns() -> None:
    data = turn_bias(LARIN_TRIAD)
    exact = data.by_formula[FORMULAS_04.index("exact")]
    np.testing.assert_allclose(exact, data.bias, rtol=1e-6)
    # A standard deviation from n runs has the relative deviation 1/sqrt(2n); allow four of them.
    ratio = data.noise / expected_noise(data.turns)
    assert np.abs(ratio - 1).max() < 4 / np.sqrt(2 * data.runs)


@published("04-larin-digits")
def test_three_candidates_give_all_seven_printed_numbers(figure: PublishedFigure) -> None:
    data = figure.data
    assert data.winners == 3
    assert [data.labels[i] for i in np.flatnonzero(data.agrees[0].all(axis=-1))] == [
        "unit third axis, pade"
    ]


@published("04-weighing-designs")
def test_weighing_monte_carlo_agrees_with_the_closed_forms(figure: PublishedFigure) -> None:
    data = figure.data
    # half_width is 1.96 standard deviations; ten comparisons, so allow four.
    deviations = np.abs(data.measured - data.expected) / (data.half_width / 1.96)
    assert deviations.max() < 4
    # Variances by hand: 1; (1 + 1 + 1 + 9/4)/4; ...; 17/21; 2.
    by_hand = np.sqrt([1, 21 / 16, 17 / 21, 2])
    np.testing.assert_allclose(data.expected[0, [0, 1, 3, 4]], by_hand, rtol=1e-12)


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: characteristic_roots(-0.1, np.eye(3), [1, 0, 0]), "size: expected a number of at"),
        (lambda: characteristic_roots(0.1, np.eye(2), [1, 0, 0]), r"shape: expected shape"),
        (lambda: characteristic_roots(0.1, np.eye(3), [0, 0, 0]), "direction: expected nonzero"),
        (lambda: error_motion([1, 0, 0], [1, 0, 0], 0.0), "duration: expected a number"),
        (
            lambda: error_motion([1, 0, 0], [1, 0, 0], tolerance=-1),
            "tolerance: expected a number above 0",
        ),
        (lambda: drift_history(np.eye(3), [0, 0, 0]), "direction: expected nonzero"),
        (lambda: drift_history(np.eye(3), [1, 0, 0], 0), "samples_per_turn: expected a"),
        (lambda: turn_estimates(np.eye(3), "guess"), "plan: expected one of three pair"),
        (lambda: drift_map(np.full((3, 3), np.nan)), "triad_error: expected finite"),
    ],
)  # fmt: skip
def test_refusals(call, sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        call()


@given(st.floats(-180, 180), st.floats(-90, 90))
def test_direction_is_a_unit_vector_with_its_angles(azimuth: float, elevation: float) -> None:
    x, y, z = direction_from_angles(np.radians(azimuth), np.radians(elevation))
    assert np.isclose(x**2 + y**2 + z**2, 1)
    assert np.isclose(np.degrees(np.arcsin(np.clip(z, -1, 1))), elevation, atol=1e-5)
    if abs(elevation) < 89:
        turned = np.radians(azimuth) - np.arctan2(y, x)
        assert np.isclose(np.cos(turned), 1)


def test_cayley_map_shows_the_tangents_and_says_what_is_infinite() -> None:
    degrees = np.array([-270.0, -90.0, 10.0, 130.0, 300.0])
    for phi in np.radians(degrees):
        data = cayley_map(phi, [0.3, -2, 1])
        found = [data.along_3, data.along_4, data.shadow]
        np.testing.assert_allclose(
            found, [-np.tan(phi / 2), -np.tan(phi / 4), 1 / np.tan(phi / 4)], rtol=1e-13
        )
    for angle, infinite in ((np.pi, "along_3"), (-2 * np.pi, "along_4"), (0.0, "shadow")):
        data = cayley_map(angle, [1, 0, 0])
        names = [name for name in ("along_3", "along_4", "shadow") if getattr(data, name) is None]
        assert names == [infinite]
    with pytest.raises(ValueError, match=r"^angle: expected at most a whole turn either way"):
        cayley_map(7.0, [1, 0, 0])


@published("05-riccati-turns")
def test_riccati_turns_say_what_the_caption_says(figure: PublishedFigure) -> None:
    data = figure.data
    assert 0.99999 < data.ended.time[-1] < 1 < data.plain.time[-1] == data.switched.time[-1]
    assert np.linalg.norm(data.ended.vector[-1]) == pytest.approx(1e6, rel=1e-3)
    assert np.linalg.norm(data.switched.vector, axis=-1).max() < 1.2 + 1e-6
    # Nearest to the singularity, after a turn: the vector of an angle of 2 pi less the miss.
    longest = np.linalg.norm(data.plain.vector[data.plain.time < 1.5], axis=-1).max()
    assert longest == pytest.approx(1 / np.tan(data.miss / 4), rel=1e-2)
    plain, switched = data.fixed_errors[:, -1]
    assert plain > 1000 * switched
    # At each tolerance: errors alike, more work without the switch, and more for a closer pass.
    assert np.abs(np.log(data.worst[1] / data.worst[0])).max() < np.log(5)
    assert np.all(data.evaluations[0] > 2 * data.evaluations[1])
    assert np.all(data.evaluations[0, 1] > data.evaluations[0, 0])
    # Along each curve, a smaller tolerance is more work for less error.
    assert np.all(np.diff(data.evaluations) > 0)
    assert np.all(np.diff(data.worst) < 0)


@pytest.mark.parametrize("samples", [4, 8, 20, 100])
def test_slivers_are_the_coning_drift(samples: int) -> None:
    """Area of the circle, of the polygon, and of parabolas on the chords of pairs."""
    data = coning_area(samples)
    x = 2 * np.pi / samples
    assert data.polygon_area == pytest.approx(samples / 2 * np.sin(x), rel=1e-12)
    missing = np.array([data.polygon_area, data.paired_area]) - data.circle_area
    for name, area in zip(("picard-1", "two-step-4"), missing, strict=True):
        # Drift over a round of one second, to the second power of the half angle.
        drift = coning_algorithms.coning_drift(name, 1e-3, 1.0, 1 / samples)
        assert drift == pytest.approx(np.sin(1e-3) ** 2 * area, rel=1e-9)
    with pytest.raises(ValueError, match=r"^samples: expected an even number, got 5"):
        coning_area(5)


@pytest.mark.parametrize("name", ["one-step-3", "two-step-3"])
def test_third_order_error_is_no_drift_even_on_a_wide_cone(name: str) -> None:
    rates = np.array([48.0, 96, 192, 384])
    drift = [abs(measured_drift(name, np.radians(60), 1.0, rate)) for rate in rates]
    assert -np.polyfit(np.log(rates), np.log(drift), 1)[0] == pytest.approx(4, abs=0.1)


@published("06-algorithm-orders")
def test_algorithm_orders_are_those_of_the_derivation_except_where_symmetry_hides_them(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    orders = {
        name: dict(zip(ALGORITHMS, row, strict=True))
        for name, row in zip(("narrow", "wide", "ship", "axis"), data.orders, strict=True)
    }
    for name, algorithm in ALGORITHMS.items():
        assert orders["ship"][name] == pytest.approx(algorithm.order, abs=0.1)
        assert orders["wide"][name] == pytest.approx(algorithm.order, abs=0.15)
        assert orders["narrow"][name] == pytest.approx(2 if name == "picard-1" else 4, abs=0.1)
        if algorithm.iterate == "rotation vector":
            assert orders["axis"][name] is None
        else:
            assert orders["axis"][name] == pytest.approx(2 if name == "picard-1" else 4, abs=0.1)


@pytest.mark.parametrize("name", ALGORITHMS)
def test_measured_coning_drift_is_the_closed_formula(name: str) -> None:
    # Terms of the fourth power of the half angle are left out: 1e-4 of the second with 0.01 rad.
    # Where the formula itself nearly vanishes, they are compared with the uncorrected drift.
    for frequency, rate in ((1.0, 30.0), (5.0, 40.0), (5.0, 100.0)):
        found = measured_drift(name, 0.01, frequency, rate)
        plain = abs(coning_algorithms.coning_drift("picard-1", 0.01, frequency, 1 / rate))
        formula = coning_algorithms.coning_drift(name, 0.01, frequency, 1 / rate)
        assert found == pytest.approx(formula, rel=0, abs=1e-4 * plain)


@published("06-short-word")
def test_short_word_saves_the_step_but_not_the_sum(figure: PublishedFigure) -> None:
    data = figure.data
    # 1 - l0 is a few operations on numbers rounded to 24 bits.
    assert data.carried.max() < 8 * 2.0**-24
    # A step whose 1 - l0 is below half the last digit before 1 stores l0 as 1.
    lost = 2 * np.sin(data.angles / 4) ** 2 < 2.0**-25
    assert np.all(data.subtracted[lost] == 1)
    product, small_first, complement, compensated = data.earth
    # At steps as small as these l0 is stored as 1, so 1 - l0 does no more than a better order.
    np.testing.assert_allclose(small_first, complement, rtol=0.01)
    assert np.all(complement <= product)
    # The compensated sum errs by the last digit of the attitude, whatever the rate.
    assert compensated.max() < 2.0**-23
    assert np.all(compensated < complement / 5)
    # Where a step changes the attitude by less than half its last digit, it changes nothing.
    turn = EARTH_RATE * EARTH_SECONDS
    assert product[-1] == pytest.approx(turn, rel=0.01)
    # At larger steps it serves the norm.
    worst = data.norms.max(axis=1)
    assert worst[2] < worst[:2].min() / 50


def test_long_table_keeps_every_curve() -> None:
    table = long_table({"a": ([1, 2], [3, 4]), "b": ([5], 6.0)})
    assert table["curve"] == ["a", "a", "b"]
    np.testing.assert_array_equal(table["x"], [1, 2, 5])
    np.testing.assert_array_equal(table["y"], [3, 4, 6])


def test_laboratory_refuses_another_rate_and_shows_what_is_ticked() -> None:
    motion = Coning(0.02, 1.0)
    data = algorithm_errors(motion, 48, ["two-step-4", "rotation-vector-3"])
    assert [len(times) for times in data.times] == [48, 32]
    assert data.worst.shape == (2, len(SAMPLE_RATES))
    assert data.histories[0].max() == data.worst[0, SAMPLE_RATES.index(48)]
    with pytest.raises(ValueError, match=r"^rate: expected one of 12, 24, .* Hz, got 50"):
        algorithm_errors(motion, 50, ["two-step-4"])
    with pytest.raises(ValueError, match=r"^algorithm: expected one of picard-1, .* got 'euler'"):
        algorithm_errors(motion, 48, ["euler"])


def test_laboratory_gives_each_algorithm_its_own_error_in_any_order() -> None:
    motion = Sway(0.1, 0.5)
    for short, method in ((False, integrate), (True, integrate_in_word)):
        for names in (list(ALGORITHMS), list(ALGORITHMS)[::-1], ["rotation-vector-3", "picard-1"]):
            data = algorithm_errors(motion, 24, names, short_word=short)
            increments = motion.increments(1 / 24, 48)
            for i, name in enumerate(names):
                found = method(increments, name, start=motion.attitude(0.0))
                error = rotation_angle(multiply(conjugate(motion.attitude(data.times[i])), found))
                np.testing.assert_allclose(data.histories[i], error, rtol=0, atol=1e-14)

"""The figures of chapter 07: the orders of algorithms, coning, last stages."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import simpson

from driftlab.attitude.coning_algorithms import ALGORITHMS, CONING_ALGORITHMS, Algorithm
from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.attitude.finite_precision import integrate_finite_word
from driftlab.attitude.integration import integrate
from driftlab.book import figures
from driftlab.book.ch07_coning.experiments import (
    COMPARED_STAGES,
    SAMPLE_RATES,
    algorithm_errors,
    coning_area,
    leading_errors,
    stage_drift,
)
from driftlab.book.ch07_coning.figures.coning_drift import alike
from driftlab.book.ch18_deep_end.experiments.word_length import random_increments
from driftlab.book.machinery.figure.publish import PublishedFigure
from driftlab.motion.profiles import Coning, Sway
from driftlab.quaternion import (
    conjugate,
    cumulative_product,
    from_rotation_vector,
    multiply,
    rotate,
    rotation_angle,
    to_rotation_vector,
)
from driftlab.symbolic import operations, run_program, step_program
from published import published


@pytest.mark.parametrize("samples", [4, 8, 20, 100])
def test_area_that_a_polygon_misses_is_the_coning_drift(samples: int) -> None:
    """Area of the circle, of the polygon, and of parabolas on the chords of pairs."""
    data = coning_area(samples)
    x = 2 * np.pi / samples
    assert data.polygon_area == pytest.approx(samples / 2 * np.sin(x), rel=1e-12)
    missing = np.array([data.polygon_area, data.paired_area]) - data.circle_area
    for name, area in zip(("picard-1", "two-step-4"), missing, strict=True):
        # Drift over a round of one second, to the second power of the half angle.
        drift = coning_drift(name, 1e-3, 1.0, 1 / samples)
        # Left out is the fourth power; and some eps of rounding a sample.
        small = 1e-3**2
        assert drift == pytest.approx(small * area, rel=10 * small, abs=samples * 1e-15)


@published("07-polynomials")
def test_polynomials_have_the_increments_of_the_rate(figure: PublishedFigure) -> None:
    table = figure.data
    for way, edges in (("two halves", (0, 0.5, 1)), ("two before", (-2, -1, 0, 1))):
        time = table.time[way]
        for begin, end in pairwise(edges):
            there = (time > begin - 1e-9) & (time < end + 1e-9)
            found, true = (
                simpson(column[way][there], x=time[there])
                for column in (table.polynomial, table.true)
            )
            assert found == pytest.approx(true, abs=1e-8)


@published("07-trap-on-a-cone")
def test_third_order_goes_round_and_the_drift_is_of_fourth_order(figure: PublishedFigure) -> None:
    """Twice as many samples: an eighth of the circle, and a sixteenth of the drift."""
    table = figure.data
    coarse, fine = table.samples
    around = [np.ptp(table.first[each]) for each in (coarse, fine)]
    assert around[0] / around[1] == pytest.approx(8, rel=0.05)
    grown = [table.along[each][-1] for each in (coarse, fine)]
    assert grown[0] / grown[1] == pytest.approx(16, rel=0.05)
    for each in table.samples:
        # The circle closes after each round; only the drift is left.
        ends = np.searchsorted(table.rounds[each], [1.0, 2.0, 3.0])
        across = np.hypot(table.first[each][ends], table.second[each][ends])
        assert across.max() < 0.01 * np.ptp(table.first[each])
        drift = -coning_drift("two-step-3", table.half_angle, 1.0, 1 / int(each))
        np.testing.assert_allclose(
            np.abs(table.along[each][ends]) / [1, 2, 3], abs(drift), rtol=1e-3
        )


@published("07-algorithm-orders")
def test_algorithm_orders_are_those_of_the_derivation_except_where_symmetry_hides_them(
    figure: PublishedFigure,
) -> None:
    orders = dict(zip(("narrow", "wide", "ship", "axis"), figure.data.orders.values(), strict=True))
    for name, algorithm in CONING_ALGORITHMS.items():
        assert orders["ship"][name] == pytest.approx(algorithm.order, abs=0.1)
        assert orders["wide"][name] == pytest.approx(algorithm.order, abs=0.15)
        assert orders["narrow"][name] == pytest.approx(2 if name == "picard-1" else 4, abs=0.1)
        if algorithm.last_stage == "rotation vector":
            assert orders["axis"][name] is None
        else:
            assert orders["axis"][name] == pytest.approx(2 if name == "picard-1" else 4, abs=0.1)


def test_a_curve_of_ones_own_stands_beside_those_of_the_book() -> None:
    """By function, by `Algorithm`, and under another name: in the data, the picture, the table."""

    def mine(g: np.ndarray) -> np.ndarray:
        return g[0::2] + g[1::2] + 0.6 * np.cross(g[0::2], g[1::2])

    weights = Algorithm("weights", 2, 0, {(0, 1): 0.6}, "rotation vector", 3)
    chosen = {"mine": mine, "weights": weights, "another name": "memory-4"}
    drifts = figures.figure("07-coning-drift", algorithms=chosen)
    assert alike(drifts.data) == [["mine", "weights"], ["another name"]]
    legend = drifts.on_screen.legends[0].get_texts()
    assert [text.get_text() for text in legend] == [
        "mine and weights, nearly equal",
        "another name",
    ]
    table = drifts.table()
    for way in ("frequency", "rate"):
        found, formula = (table[f"{kind}_deg_per_h, mine, by {way}"] for kind in KINDS)
        at, fine = table[f"{way}_Hz"], table[f"formula_{way}_Hz"]
        between = np.exp(np.interp(np.log(at), np.log(fine), np.log(formula)))
        np.testing.assert_allclose(found, between, rtol=0.02)
    assert "algorithms={'mine': mine, 'weights': Algorithm(" in drifts.call
    orders = figures.figure("07-algorithm-orders", algorithms=chosen).data
    assert all(list(of_motion) == list(chosen) for of_motion in orders.orders.values())
    one, other, _ = orders.largest_error.swapaxes(0, 1)
    np.testing.assert_allclose(one, other, rtol=1e-6, atol=1e-13)


def test_what_an_algorithm_refuses_is_not_drawn() -> None:
    wide = {"algorithms": ["functional-iteration"], "half_angle": 0.5}
    formula = figures.figure("07-coning-drift", **wide).data.formula
    refused = np.isnan(formula["functional-iteration, by rate"])
    assert refused[0]
    assert not refused[len(refused) // 2]


KINDS = ("measured", "formula")


@published("07-last-stages")
def test_last_stages_part_on_wide_cones(figure: PublishedFigure) -> None:
    table = figure.data
    drift = dict(zip(COMPARED_STAGES, table.drift, strict=True))
    narrow, wide = table.half_angle < np.radians(3), table.half_angle > np.radians(30)
    for stage in COMPARED_STAGES:
        np.testing.assert_allclose(
            drift[stage][narrow], drift["rotation vector"][narrow], rtol=0.005
        )
    # The tangent of the corrected sum does as the series does, to within what lies beyond both.
    np.testing.assert_allclose(drift["tangent"], drift["series"], rtol=0.05)
    assert np.all(drift["tangent"][wide] < 0.75 * drift["third iterate"][wide])
    assert np.all(drift["rotation vector"][wide] < drift["tangent"][wide])
    np.testing.assert_allclose(drift["series"], drift["series, normalised"], rtol=1e-9)


def of_stage(stage: str, increments: np.ndarray) -> np.ndarray:
    """Quaternions of steps by a last stage, of length one."""
    program = step_program(CONING_ALGORITHMS["two-step-4"], stage)
    steps = run_program(program, increments)
    return steps / np.linalg.norm(steps, axis=-1, keepdims=True)


def test_map_of_last_stages_is_that_of_their_steps() -> None:
    """One step of a body that turns and vibrates in a circle, seen by an observer on the circle."""
    x = 0.02  # rad by which the circle goes round between two samples
    turns, amplitude = np.meshgrid([-2.5, -0.5, -0.1, 0, 0.3, 1, 2.5], [0.05, 0.3, 1, 3])
    across, phases = 2 * np.sin(x / 2) * amplitude, x * np.array([-0.5, 0.5])
    waves = across[..., np.newaxis, np.newaxis] * np.transpose([np.cos(phases), np.sin(phases)])
    along = np.broadcast_to(x * turns[..., np.newaxis, np.newaxis], (*turns.shape, 2, 1))
    increments = np.concatenate([waves, along], axis=-1)
    lasting = np.stack([amplitude, 0 * amplitude, turns + 1], axis=-1)  # rate of the observer
    true, back = from_rotation_vector(2 * x * lasting), from_rotation_vector([0, 0, x])

    def error(stage: str) -> np.ndarray:
        seen = multiply(multiply(back, of_stage(stage, increments)), back)
        turned = 2 * multiply(conjugate(true), seen)
        return np.sign(turned[..., 3]) * np.einsum("...i,...i->...", turned[..., :3], lasting)

    shared, added = leading_errors(turns, amplitude)
    unit = -4 * (2 * x) ** 5  # the angle of a rotation is -4 times that of k
    # The next terms are smaller by (turn of a step)^2, times a few; rounding stays below.
    tolerance = 5 * (2 * x) ** 2 * (np.abs(shared) + np.abs(added)) * (1 + turns**2 + amplitude**2)
    for stage, factor in (("rotation vector", 0), ("tangent", 1), ("tangent, dimension 3", 16)):
        found = error(stage) / unit
        assert np.all(np.abs(found - shared - factor * added) < (1 + factor) * tolerance), stage


@published("07-last-stages")
def test_map_of_last_stages_as_the_text_reads_it(figure: PublishedFigure) -> None:
    turns, amplitude = figure.data.turns, figure.data.amplitude
    shared, added = leading_errors(turns, amplitude)
    better = figure.data.gain < 0
    # A fast turn or a wide swing: sine and cosine.
    assert not better[(np.abs(turns) > 2.1) | (amplitude > 4)].any()
    # No steady turn: between the two roots of 3 p^4/4 - 8 p^2 + 3.
    still = np.sqrt((8 + np.array([-1, 1]) * np.sqrt(55)) / 1.5)
    np.testing.assert_allclose(still, [0.62, 3.21], atol=0.005)
    between = (amplitude[turns == 0] > still[0]) & (amplitude[turns == 0] < still[1])
    np.testing.assert_array_equal(better[turns == 0], between)
    # A narrow circle without a turn: the vibration makes the error, alike to 1 %.
    assert np.abs(figure.data.gain[(turns == 0) & (amplitude < 0.3)]).max() < 0.015
    three_better = np.abs(shared + 16 * added) < np.abs(shared + added)
    assert three_better.any()
    assert (turns[three_better] > -1).all()
    assert (turns[three_better] < 0).all()
    assert amplitude[three_better].max() < 0.5


@pytest.mark.parametrize(
    ("faster", "wave_rate", "turning"),
    [
        *((1.0, 0.5, turning) for turning in (0.0, 1.0, 3.0)),
        *((1.0, 0.05, turning) for turning in (0.0, 0.3, 1.0)),
        *((5.0, 0.5, 0.0), (0.2, 0.5, 0.0), (0.2, 1.5, 0.0)),
    ],
)
def test_one_product_tells_which_last_stage_errs_less_on_a_random_motion(
    faster: float, wave_rate: float, turning: float
) -> None:
    """Six waves of 0.1 to 1 Hz in each component, so many times faster, and a steady turn."""
    rng, motions, finer = np.random.default_rng(3), 40, 8
    interval = 1 / (24 * finer)
    waves = random_increments(rng, motions, 96 * finer, faster * interval)
    fine = waves * wave_rate / 0.5 / faster
    fine += interval * turning * rng.standard_normal((motions, 1, 3))
    true = integrate(fine, "rotation-vector-2")
    pairs = fine.reshape(motions, -1, 2, finer, 3).sum(axis=-2)

    def error(stage: str) -> np.ndarray:
        found = cumulative_product(of_stage(stage, pairs))[:, -1]
        return to_rotation_vector(multiply(found, conjugate(true[:, -1])))

    shared, four, three = map(error, ("rotation vector", "tangent", "tangent, dimension 3"))
    turned = pairs.sum(axis=-2)
    lost = -turned * np.linalg.norm(turned, axis=-1, keepdims=True) ** 4 / 1920
    added = rotate(true[:, finer // 2 - 1 :: finer], lost).sum(axis=1)
    size, product = np.linalg.norm, np.einsum
    assert np.median(size(four - shared - added, axis=1) / size(added, axis=1)) < 0.02
    for other, factor, better in ((shared, 1, four), (three, 17, four)):
        decides = product("mi,mi->m", added, 2 * shared + factor * added)
        less = size(better, axis=1) < size(other, axis=1)
        np.testing.assert_array_equal(less, decides < 0 if factor == 1 else decides > 0)


def test_costs_are_those_of_the_text() -> None:
    cost = {
        stage: sum(operations(step_program(CONING_ALGORITHMS["two-step-4"], stage)).values())
        for stage in COMPARED_STAGES
    }
    assert cost["series"] < cost["sine series and root"] < cost["tangent"]
    assert cost["tangent"] == cost["tangent, dimension 3"] < cost["series, normalised"]
    assert cost["series, normalised"] < cost["third iterate"]


@pytest.mark.parametrize("samples", [5, 6, 12, 24, 48])
def test_dimension_4_errs_less_than_dimension_3_beyond_narrow_cones(samples: int) -> None:
    """And less than with the cube of the sum instead of the corrected sum's."""
    half_angles = np.radians(np.arange(20.0, 180.0, 10.0))
    four, three, cube = (
        np.abs(stage_drift(stage, half_angles, samples))
        for stage in ("tangent", "tangent, dimension 3", "third iterate")
    )
    assert np.all(four < np.minimum(three, cube))


@pytest.mark.parametrize("name", ["two-step-3", "two-step-4", "rotation-vector-2"])
def test_drift_of_a_stage_is_that_of_the_algorithm_with_it(name: str) -> None:
    half_angles = np.radians([1.0, 60.0])
    found = stage_drift(CONING_ALGORITHMS[name].last_stage, half_angles, 24)
    expected = coning_drift(name, half_angles, 1.0, 1 / 24)
    np.testing.assert_allclose(found, expected, rtol=0, atol=24e-15)


def test_laboratory_refuses_another_rate_and_shows_what_is_ticked() -> None:
    motion = Coning(0.02, 1.0)
    table = algorithm_errors(motion, 48, ["two-step-4", "rotation-vector-3"])
    assert [len(times) for times in table.time.values()] == [48, 32]
    assert table.largest_error.shape == (2, len(SAMPLE_RATES))
    assert table.error["two-step-4"].max() == table.largest_error[0, SAMPLE_RATES.index(48)]
    with pytest.raises(ValueError, match=r"^rate: expected one of 12, 24, .* Hz, got 50"):
        algorithm_errors(motion, 50, ["two-step-4"])
    with pytest.raises(ValueError, match=r"^algorithms: expected one of picard-1, .* got 'euler'"):
        algorithm_errors(motion, 48, ["euler"])


def test_laboratory_gives_each_algorithm_its_own_error_in_any_order() -> None:
    motion = Sway(0.1, 0.5)
    for short, method in ((False, integrate), (True, integrate_finite_word)):
        for names in (list(ALGORITHMS), list(ALGORITHMS)[::-1], ["rotation-vector-3", "picard-1"]):
            table = algorithm_errors(motion, 24, names, short_word=short)
            increments = motion.increments(1 / 24, 48)
            for name, time in table.time.items():
                found = method(increments, name, start=motion.attitude(0.0))
                error = rotation_angle(multiply(conjugate(motion.attitude(time)), found))
                np.testing.assert_allclose(table.error[name], error, rtol=0, atol=1e-14)
            assert list(table.time) == names


def test_laboratory_shows_where_functional_iteration_refuses() -> None:
    motion = Coning(np.radians(60), 3.0)
    table = algorithm_errors(motion, 12, ["two-step-4", "functional-iteration"])
    assert np.isfinite(table.largest_error[0]).all()
    assert np.isnan(table.largest_error[1]).tolist() == [True, *[False] * 4]
    assert np.isnan(table.error["functional-iteration"]).all()

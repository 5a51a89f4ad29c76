"""The figures of chapter 06: the orders of algorithms, coning, short words."""

import numpy as np
import pytest

from driftlab.attitude import coning_algorithms
from driftlab.attitude.coning_algorithms import ALGORITHMS
from driftlab.attitude.finite_precision import integrate_in_word
from driftlab.attitude.integration import integrate
from driftlab.book.ch06_picard_algorithms.experiments import (
    EARTH_RATE,
    EARTH_SECONDS,
    SAMPLE_RATES,
    algorithm_errors,
    coning_area,
    measured_drift,
)
from driftlab.book.machinery.publish import PublishedFigure
from driftlab.motion.profiles import Coning, Sway
from driftlab.quaternion import conjugate, multiply, rotation_angle
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

"""The figures of chapter 04: turns, weighings, and the digits of Larin's seven numbers."""

import numpy as np
import pytest

from driftlab.book.ch04_calibration_by_turns.experiments import (
    FORMULAS as FORMULAS_04,
    PLANS,
    expected_noise,
    turn_bias,
    turn_estimates,
)
from driftlab.book.machinery.figure.drawing import nature, panels
from driftlab.book.machinery.figure.publish import PublishedFigure
from driftlab.book.scenarios import LARIN_TRIAD
from driftlab.drift.turn_calibration import TurnExperiment
from driftlab.triad import non_orthogonality
from published import published


@pytest.mark.parametrize("plan", PLANS)
def test_every_plan_finds_sigma_up_to_the_bias(plan: str) -> None:
    data = turn_estimates(LARIN_TRIAD, plan, TurnExperiment())
    np.testing.assert_array_equal(data.true, non_orthogonality(LARIN_TRIAD)[[0, 0, 1], [1, 2, 2]])
    # The bias of one estimate is half of the square of what lies across, at most 2 |M|^2;
    # no plan weighs the estimates with more than 2 in all.
    assert np.abs(data.runs - data.true).max() < 4 * np.linalg.norm(LARIN_TRIAD) ** 2


def test_only_a_fit_with_scale_is_unharmed_by_a_scale_error() -> None:
    triad = LARIN_TRIAD + 2e-4 * np.eye(3)
    errors = {}
    for plan in PLANS:
        data = turn_estimates(triad, plan, TurnExperiment())
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
    exact = data.error[FORMULAS_04.index("exact")]
    np.testing.assert_allclose(exact, data.bias, rtol=1e-6)
    # A standard deviation from n runs has the relative deviation 1/sqrt(2n); allow four of them.
    ratio = data.noise / expected_noise(data.turns)
    assert np.abs(ratio - 1).max() < 4 / np.sqrt(2 * data.runs)


@published("04-larin-digits")
def test_three_candidates_give_all_seven_numbers(figure: PublishedFigure) -> None:
    data = figure.data
    assert data.winners == 3
    assert [data.candidate[i] for i in np.flatnonzero(data.agrees[0].all(axis=0))] == [
        "unit third axis, pade"
    ]


@published("04-larin-digits")
def test_marks_of_digits_are_those_of_the_table(figure: PublishedFigure) -> None:
    """Both axes are words, so that the header leaves it to this test."""
    for agrees, panel in zip(figure.data.agrees, panels(figure.on_screen), strict=True):
        assert nature(panel) == "words both ways"
        rows = [word.get_text() for word in panels(figure.on_screen)[0].get_yticklabels()]
        assert rows == figure.data.candidate
        drawn = np.full(agrees.T.shape, -1)
        for line in panel.lines:
            number, candidate = np.asarray(line.get_xydata(), int).T
            assert np.all(drawn[candidate, number] == -1)
            drawn[candidate, number] = line.get_label() != "does not agree"
        np.testing.assert_array_equal(drawn, agrees.T)


@published("04-weighing-designs")
def test_weighing_monte_carlo_agrees_with_the_closed_forms(figure: PublishedFigure) -> None:
    data = figure.data
    # From its middle an interval reaches 1.96 standard deviations; ten comparisons: allow four.
    for name in ("without_offset", "with_offset"):
        titles = f"rms_{name}", f"rms_{name}_from", f"expected_{name}"
        rms, low, expected = map(data.shown, titles)
        assert (np.abs(rms - expected) / ((rms - low) / 1.96)).max() < 4
    # Variances by hand: 1; (1 + 1 + 1 + 9/4)/4; ...; 17/21; 2.
    by_hand = np.sqrt([1, 21 / 16, 17 / 21, 2])
    np.testing.assert_allclose(data.expected_without_offset[[0, 1, 3, 4]], by_hand, rtol=1e-12)

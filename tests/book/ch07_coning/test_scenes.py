"""The scenes of chapter 07: what they show against the closed forms."""

import numpy as np
import pytest

from driftlab.attitude import coning_drift
from driftlab.book.ch07_coning.experiments import (
    BRACKET,
    BRACKET_SAMPLE_RATE,
    bracket_run,
    square_of_turns,
)
from driftlab.book.ch07_coning.experiments.bracket import ROUNDS


def test_the_bracket_drifts_as_the_closed_formula_says() -> None:
    table, cone = bracket_run(), (BRACKET.half_angle, BRACKET.frequency, 1 / BRACKET_SAMPLE_RATE)
    # After whole rounds only the growth along the cone's axis is left.
    drifts = {"picard-1": table.drift_one_by_one, "two-step-4": table.drift_with_pairs}
    for algorithm, drift in drifts.items():
        assert drift == pytest.approx(-float(coning_drift(algorithm, *cone)), rel=1e-3)
    assert table.shown("one_by_one")[-1] == pytest.approx(16.2, abs=0.05)
    assert table.shown("with_pairs")[-1] == pytest.approx(0.317, abs=0.001)


@pytest.mark.parametrize("rate", [20.0, 40.0, 100.0, 200.0])
def test_the_slivers_are_the_error_of_samples_one_by_one(rate: float) -> None:
    """To the second power of the half angle, so on a narrow cone to its square: 1e-4 or so."""
    table = bracket_run(BRACKET.half_angle, rate)
    assert table.one_by_one[-1] == pytest.approx(table.slivers[-1], rel=1e-3)
    circle = np.pi * np.sin(BRACKET.half_angle) ** 2
    assert table.slivers[-1] == pytest.approx(ROUNDS * table.missed_part * circle)
    assert table.time[-1] == pytest.approx(ROUNDS / BRACKET.frequency)
    assert table.places.max() < len(table.circle)


def test_the_square_is_left_open_by_its_area() -> None:
    """The rest is of the third power of the turns: halve them, and an eighth of it is left."""
    rests = []
    for size in (0.1, 0.05):
        data = square_of_turns(size, size / 2)
        assert np.allclose(data.summed[-1], 0)
        assert data.area[-1] == pytest.approx(size**2 / 2)
        rests.append(np.linalg.norm(data.vector[-1] - [0, 0, data.area[-1]]))
    assert rests[0] / rests[1] == pytest.approx(8, rel=0.05)


def test_the_body_turns_by_the_increments() -> None:
    data = square_of_turns(0.5, 0.3, samples=10)
    assert np.allclose(data.vector[10], [0.5, 0, 0])
    assert np.allclose(data.tips[0], np.eye(3))
    assert np.allclose(data.tips[10, 2], [0, -np.sin(0.5), np.cos(0.5)])

"""What limits the estimate from one turn: the method's bias, the integrator, and the noise."""

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import LARIN_TRIAD
from driftlab.checks import FloatArray, positive_number, whole_number
from driftlab.drift.systematic_drift import drift_coefficient
from driftlab.drift.turn_calibration import TurnExperiment, exact_turn_estimate
from driftlab.drift.weighing_designs import PAIR_AXES

FORMULAS = ("taylor-2", "cayley", "taylor-3", "taylor-4", "pade", "exact")
ANGLE_NOISE = 2e-5
"""Noise of the published figures: rad a turn and gyro, about 4 arc seconds."""
SEED = 1987
"""Of all noise of the chapter."""


def turn_bias(
    error_matrix: ArrayLike = LARIN_TRIAD,
    runs: int = 400,
    seed: int = SEED,
    angle_noise: float = ANGLE_NOISE,
) -> DataTable:
    """Error of the turn estimate about (1, 0, 1) against the steps a turn and the turns k."""
    count = whole_number(runs, "runs", least=2)
    size = positive_number(angle_noise, "angle_noise")
    steps = np.array([6, 8, 12, 16, 24, 32, 48, 64, 100, 160, 240, 360])
    by_formula = np.abs([estimate_errors(error_matrix, name, steps) for name in FORMULAS])
    turns = np.array([1, 2, 3, 5, 8, 13, 21, 34])
    rng = np.random.default_rng(seed)
    repeated = np.broadcast_to(PAIR_AXES[1], (count, 3))
    noise = [
        TurnExperiment(int(k), 12, "exact", size).estimate(repeated, error_matrix, rng).std()
        for k in turns
    ]
    bias_by_turns = np.abs([method_bias(error_matrix, int(k)) for k in turns])
    bias = float(bias_by_turns[0])
    return DataTable(
        {
            "steps_per_turn": (steps, "", "integration steps"),
            "error": (
                by_formula, "", "size of the error of sigma2 by step formula, without noise",
                FORMULAS,
            ),
            "bias_of_the_method": (np.full(len(steps), bias), "", "the error with exact steps"),
            "turns": (turns, "", "whole turns"),
            "noise": (np.array(noise), "", "standard deviation of the error over the runs"),
            "noise_expected": (expected_noise(turns, size), "", "the same in closed form"),
            "bias_by_turns": (bias_by_turns, "", "bias of the method for so many turns"),
        },
        {"runs": (count, "", "runs"), "bias": (bias, "", "bias of the method in one turn")},
    )  # fmt: skip


def estimate_errors(error_matrix: ArrayLike, step_formula: str, steps: ArrayLike) -> FloatArray:
    """Error (m,) of the estimate of sigma2 after one turn of each number of `steps` (m,)."""
    found = [
        TurnExperiment(1, int(count), step_formula).estimate(PAIR_AXES[1], error_matrix)
        for count in np.asarray(steps)
    ]
    return np.array(found) - drift_coefficient(PAIR_AXES[1], error_matrix)


def method_bias(error_matrix: ArrayLike, turns: int = 1) -> float:
    """Error of the estimate of sigma2 that no number of steps removes; Larin (3.3)."""
    exact = exact_turn_estimate(PAIR_AXES[1], error_matrix, turns)
    return float(exact - drift_coefficient(PAIR_AXES[1], error_matrix))


def expected_noise(turns: ArrayLike, angle_noise: float = ANGLE_NOISE) -> FloatArray:
    """Standard deviation (...) of the turn estimate: angle_noise / (2 pi sqrt(k))."""
    return angle_noise / (2 * np.pi * np.sqrt(turns))

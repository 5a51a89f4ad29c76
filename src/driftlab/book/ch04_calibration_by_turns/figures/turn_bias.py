"""What limits calibration by turns: the method's bias, the integrator, and the noise."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.machinery.picture import GREY, SERIES, Picture
from driftlab.checks import FloatArray
from driftlab.drift.systematic_drift import drift_coefficient
from driftlab.drift.turn_calibration import (
    PAIR_AXES,
    TurnExperiment,
    exact_turn_estimate,
)

FORMULAS = ("taylor-2", "cayley", "taylor-3", "taylor-4", "pade", "exact")
ANGLE_NOISE = 2e-5
"""Noise of the second panel: rad a turn and gyro, about 4 arc seconds."""


class TurnBias(NamedTuple):
    """Errors of the estimate of sigma2, dimensionless."""

    steps: FloatArray  # (m,)
    by_formula: FloatArray  # (formula, m): size of the error with each step formula
    bias: float  # the method's own
    turns: FloatArray  # (n,)
    noise: FloatArray  # (n,): standard deviation over the runs
    runs: int
    bias_by_turns: FloatArray  # (n,)


def compute(misalignment: ArrayLike, runs: int = 400, seed: int = 1987) -> TurnBias:
    """Error of the turn estimate about (1, 0, 1) against the steps a turn and the turns k."""
    axis = PAIR_AXES[1]
    true = drift_coefficient(axis, misalignment)
    steps = np.array([6, 8, 12, 16, 24, 32, 48, 64, 100, 160, 240, 360])
    by_formula = [
        [
            abs(TurnExperiment(1, int(count), name).estimate(misalignment, axis) - true)
            for count in steps
        ]
        for name in FORMULAS
    ]
    turns = np.array([1, 2, 3, 5, 8, 13, 21, 34])
    rng = np.random.default_rng(seed)
    repeated = np.broadcast_to(axis, (runs, 3))
    noise = [
        TurnExperiment(int(k), 12, "exact", ANGLE_NOISE).estimate(misalignment, repeated, rng).std()
        for k in turns
    ]
    bias_by_turns = [abs(exact_turn_estimate(misalignment, axis, int(k)) - true) for k in turns]
    return TurnBias(
        steps,
        np.array(by_formula),
        float(bias_by_turns[0]),
        turns,
        np.array(noise),
        runs,
        np.array(bias_by_turns),
    )


def expected_noise(turns: ArrayLike, angle_noise: float = ANGLE_NOISE) -> FloatArray:
    """Standard deviation (...) of the turn estimate: angle_noise / (2 pi sqrt(k))."""
    return angle_noise / (2 * np.pi * np.sqrt(turns))


def columns(data: TurnBias) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the first panel."""
    return {"steps_per_turn": data.steps, **dict(zip(FORMULAS, data.by_formula, strict=True))}


class TurnBiasPicture(Picture[TurnBias]):
    """Error over the steps a turn, and noise over the number of turns."""

    size = (10.0, 4.0)

    def build(self) -> None:
        steps, turns = self.figure.subplots(1, 2)
        self.figure.subplots_adjust(0.075, 0.14, 0.985, 0.9, wspace=0.22)
        steps.set(title="one turn, no noise", xscale="log", yscale="log", xlim=(6, 360))
        steps.set(
            xlabel="integration steps in the turn", ylim=(1e-9, 1), ylabel="error of $\\sigma_2$"
        )
        steps.set_xticks(
            [6, 10, 20, 50, 100, 200, 360], ["6", "10", "20", "50", "100", "200", "360"]
        )
        steps.minorticks_off()
        markers = "osD^vx"
        floor = {"color": GREY, "linewidth": 5, "alpha": 0.5, "label": "bias of the method"}
        self.formulas = [
            self.line(steps, **style, marker=marker, markersize=4, label=name)
            for name, style, marker in zip(FORMULAS, SERIES, markers, strict=False)
        ]
        self.bias = self.line(steps, **floor)
        steps.legend(loc="upper right", ncols=2)
        turns.set(title="k turns, exact steps, noisy gyros", xscale="log", yscale="log")
        turns.set(
            xlabel="turns k", ylabel="error of $\\sigma_2$", xlim=(0.9, 40), ylim=(1e-7, 1e-4)
        )
        turns.set_xticks([1, 2, 5, 10, 20, 40], ["1", "2", "5", "10", "20", "40"])
        turns.minorticks_off()
        dots = {"color": SERIES[0]["color"], "linestyle": "none", "marker": "o"}
        self.noise = self.line(turns, **dots, label="noise, standard deviation of the runs")
        self.expected = self.line(
            turns, color=GREY, linestyle="--", label=r"noise expected, falls as $1/\sqrt{k}$"
        )
        self.turn_bias = self.line(turns, **floor)
        turns.legend(loc="upper right")

    def update(self, data: TurnBias) -> None:
        for line, values in zip(self.formulas, data.by_formula, strict=True):
            line.set_data(data.steps, values)
        self.bias.set_data(data.steps[[0, -1]], [data.bias, data.bias])
        self.noise.set_data(data.turns, data.noise)
        self.expected.set_data(data.turns, expected_noise(data.turns))
        self.turn_bias.set_data(data.turns, data.bias_by_turns)

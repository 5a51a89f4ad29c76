"""What limits calibration by turns: the method's bias, the integrator, and the noise."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import GREY, SERIES, decades, in_style, legend_below
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import FORMULAS, TurnBias

_BIAS: dict[str, Any] = {"color": GREY, "linewidth": 5, "alpha": 0.5, "label": "bias of the method"}


def columns(data: TurnBias) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: errors over the steps a turn, then over the turns."""
    return {
        "steps_per_turn": data.steps,
        **dict(zip(FORMULAS, data.by_formula, strict=True)),
        "bias_of_the_method": np.full(len(data.steps), data.bias),
        "turns": data.turns,
        "noise_standard_deviation": data.noise,
        "noise_expected": data.expected_noise,
        "bias_by_turns": data.bias_by_turns,
    }


@in_style
def draw(data: TurnBias, sheet: Sheet) -> Figure:
    """Error over the steps a turn, and noise over the number of turns."""
    figure, panels = sheet.mosaic(
        "ab", (10.0, 4.0), (0.075, 0.14, 0.985, 0.9), spaces=(0.22, 0.2), column_height=5.2
    )
    steps, turns = panels["a"], panels["b"]
    table = columns(data)
    size = "error of $\\sigma_2$"
    steps.set(title="one turn, no noise", xscale="log", yscale="log", xlim=(6, 360))
    steps.set(xlabel="integration steps in the turn", ylabel=size)
    steps.set_ylim(*decades([*data.by_formula, table["bias_of_the_method"]], 1e-9, 1))
    steps.set_xticks([6, 10, 20, 50, 100, 200, 360], ["6", "10", "20", "50", "100", "200", "360"])
    steps.minorticks_off()
    dot = 2.5 if sheet.on_paper else 4
    for name, errors, style, marker in zip(
        FORMULAS, data.by_formula, SERIES, "osD^vx", strict=False
    ):
        steps.plot(data.steps, errors, **style, marker=marker, markersize=dot, label=name)
    steps.plot(data.steps, table["bias_of_the_method"], **_BIAS)
    if sheet.on_paper:
        legend_below(steps, 3)
    else:
        steps.legend(loc="upper right", ncols=2)
    turns.set(title="k turns, exact steps, noisy gyros", xscale="log", yscale="log")
    turns.set(xlabel="turns k", ylabel=size, xlim=(0.9, 40))
    turns.set_ylim(*decades([data.noise, data.expected_noise, data.bias_by_turns], 1e-7, 1e-4))
    turns.set_xticks([1, 2, 5, 10, 20, 40], ["1", "2", "5", "10", "20", "40"])
    turns.minorticks_off()
    turns.plot(
        data.turns,
        data.noise,
        color=SERIES[0]["color"],
        linestyle="none",
        marker="o",
        label="noise, standard deviation of the runs",
    )
    turns.plot(
        data.turns,
        data.expected_noise,
        color=GREY,
        linestyle="--",
        label=r"noise expected, falls as $1/\sqrt{k}$",
    )
    turns.plot(data.turns, data.bias_by_turns, **_BIAS)
    turns.legend(loc="upper right")
    return figure

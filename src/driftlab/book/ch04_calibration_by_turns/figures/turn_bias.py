"""What limits calibration by turns: the method's bias, the integrator, and the noise."""

from typing import Any

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import GREY, SERIES, decades, legend_below

from ..experiments import FORMULAS

_BIAS: dict[str, Any] = {"color": GREY, "linewidth": 5, "alpha": 0.5, "label": "bias of the method"}


@from_table
def draw(drawing: Drawing) -> None:
    """Error over the steps a turn, and noise over the number of turns."""
    table, on_paper = drawing.table, drawing.sheet.on_paper
    panels = drawing.mosaic(
        "ab", (10.0, 4.0), (0.075, 0.14, 0.985, 0.9), spaces=(0.22, 0.2), column_height=5.2
    )
    steps, turns = panels["a"], panels["b"]
    size = "error of $\\sigma_2$"
    steps.set(title="one turn, no noise", xscale="log", yscale="log", xlim=(6, 360))
    steps.set(xlabel="integration steps in the turn", ylabel=size)
    steps.set_ylim(*decades([*table.error, table.bias_of_the_method], 1e-9, 1))
    steps.set_xticks([6, 10, 20, 50, 100, 200, 360], ["6", "10", "20", "50", "100", "200", "360"])
    steps.minorticks_off()
    dot = 2.5 if on_paper else 4
    for name, style, marker in zip(FORMULAS, SERIES, "osD^vx", strict=False):
        look = {**style, "marker": marker, "markersize": dot, "label": name}
        drawing.curve(steps, "steps_per_turn", f"error, {name}", **look)
    drawing.curve(steps, "steps_per_turn", "bias_of_the_method", **_BIAS)
    if on_paper:
        legend_below(steps, 3)
    else:
        steps.legend(loc="upper right", ncols=2)
    turns.set(title="k turns, exact steps, noisy gyros", xscale="log", yscale="log")
    turns.set(xlabel="turns k", ylabel=size, xlim=(0.9, 40))
    turns.set_ylim(*decades([table.noise, table.noise_expected, table.bias_by_turns], 1e-7, 1e-4))
    turns.set_xticks([1, 2, 5, 10, 20, 40], ["1", "2", "5", "10", "20", "40"])
    turns.minorticks_off()
    drawing.curve(
        turns, "turns", "noise", color=SERIES[0]["color"], linestyle="none", marker="o",
        label="noise, standard deviation of the runs",
    )  # fmt: skip
    drawing.curve(
        turns, "turns", "noise_expected", color=GREY, linestyle="--",
        label=r"noise expected, falls as $1/\sqrt{k}$",
    )  # fmt: skip
    drawing.curve(turns, "turns", "bias_by_turns", **_BIAS)
    turns.legend(loc="upper right")

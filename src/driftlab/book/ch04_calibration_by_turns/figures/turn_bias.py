"""What limits calibration by turns: the method's bias, the integrator, and the noise."""

from matplotlib.figure import Figure

from driftlab.book.machinery.picture import GREY, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import FORMULAS, TurnBias, expected_noise

_BIAS = {"color": GREY, "linewidth": 5, "alpha": 0.5, "label": "bias of the method"}


def columns(data: TurnBias) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the first panel."""
    return {"steps_per_turn": data.steps, **dict(zip(FORMULAS, data.by_formula, strict=True))}


@in_style
def draw(data: TurnBias, sheet: Sheet) -> Figure:
    """Error over the steps a turn, and noise over the number of turns."""
    figure = Figure(figsize=(10.0, 4.0))
    steps, turns = figure.subplots(1, 2)
    figure.subplots_adjust(0.075, 0.14, 0.985, 0.9, wspace=0.22)
    steps.set(title="one turn, no noise", xscale="log", yscale="log", xlim=(6, 360))
    steps.set(xlabel="integration steps in the turn", ylim=(1e-9, 1), ylabel="error of $\\sigma_2$")
    steps.set_xticks([6, 10, 20, 50, 100, 200, 360], ["6", "10", "20", "50", "100", "200", "360"])
    steps.minorticks_off()
    for name, errors, style, marker in zip(
        FORMULAS, data.by_formula, SERIES, "osD^vx", strict=False
    ):
        steps.plot(data.steps, errors, **style, marker=marker, markersize=4, label=name)
    steps.plot(data.steps[[0, -1]], [data.bias, data.bias], **_BIAS)
    steps.legend(loc="upper right", ncols=2)
    turns.set(title="k turns, exact steps, noisy gyros", xscale="log", yscale="log")
    turns.set(xlabel="turns k", ylabel="error of $\\sigma_2$", xlim=(0.9, 40), ylim=(1e-7, 1e-4))
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
        expected_noise(data.turns),
        color=GREY,
        linestyle="--",
        label=r"noise expected, falls as $1/\sqrt{k}$",
    )
    turns.plot(data.turns, data.bias_by_turns, **_BIAS)
    turns.legend(loc="upper right")
    return figure

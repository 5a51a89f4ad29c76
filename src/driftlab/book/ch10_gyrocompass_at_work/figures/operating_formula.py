"""The paper's formula for the heading error at work, term by term, against the simulation."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import minute

from driftlab.book.machinery.picture import BLACK, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.book.scenarios import DURATION
from driftlab.checks import FloatArray

from ..experiments import OperatingFormula
from .operation import shade_manoeuvres

TERMS = ("rate about East", "rate about North", "minus the yaw's error", "tilt by tan pitch")


def columns(data: OperatingFormula) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, each two minutes."""
    rows = slice(119, None, 120)
    run = data.run
    table = {
        "time_s": run.times[rows],
        "simulated_deg": np.degrees(run.compass_error[rows]).round(7),
        "formula_deg": np.degrees(run.formula.compass_angle[rows]).round(7),
    }
    for name, term in zip(TERMS, run.formula, strict=True):
        table[f"{name}_deg"] = np.degrees(term[rows]).round(7)
    return table


@in_style
def draw(data: OperatingFormula, sheet: Sheet) -> Figure:
    """The terms and their sum; and what is missing without each."""
    figure = Figure(figsize=(10.5, 4.3))
    terms, gaps = figure.subplots(1, 2)
    figure.subplots_adjust(0.065, 0.28, 0.985, 0.91, wspace=0.2)
    terms.set(title="error of the compass angle, degrees")
    gaps.set(title="simulated minus formula, size, degrees", yscale="log", ylim=(1e-4, 3))
    for panel in (terms, gaps):
        panel.set(xlabel="time, minutes", xlim=(0, DURATION / minute))
        shade_manoeuvres(panel)
    run = data.run
    minutes = run.times / minute
    terms.plot(minutes, np.degrees(run.compass_error), color=BLACK, linewidth=3.5, alpha=0.35,
               label="simulated")  # fmt: skip
    terms.plot(minutes, np.degrees(run.formula.compass_angle), color=BLACK, linewidth=1.0,
               label="formula, all terms")  # fmt: skip
    gaps.plot(minutes, np.degrees(np.abs(data.gaps[0])), color=BLACK, linewidth=1.0)
    for i, name in enumerate(TERMS):
        terms.plot(minutes, np.degrees(run.formula[i]), **SERIES[i], label=name)
        gaps.plot(minutes, np.degrees(np.abs(data.gaps[i + 1])), **SERIES[i])
    handles, labels = terms.get_legend_handles_labels()
    figure.legend(
        handles, labels, loc="lower center", ncols=3,
        title="left: the terms; right: what is missing without each", title_fontsize=8,
    )  # fmt: skip
    return figure

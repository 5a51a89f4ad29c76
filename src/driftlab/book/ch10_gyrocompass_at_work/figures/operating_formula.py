"""The paper's formula for the heading error at work, term by term, against the simulation."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import minute

from driftlab.book.machinery.picture import BLACK, SERIES, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet
from driftlab.book.scenarios import DURATION
from driftlab.checks import FloatArray

from ..experiments import OperatingFormula
from .operation import shade_manoeuvres

TERMS = ("rate about East", "rate about North", "minus the yaw's error", "tilt by tan pitch")


SHOWN = slice(5, None, 6)
"""Steps of the voyage that are drawn."""
LEAST, MOST = 1e-4, 3.0
"""Reach of what is missing, degrees, unless it is more."""


def columns(data: OperatingFormula) -> dict[str, FloatArray]:
    """Columns of the figure's CSV; the last ones are sizes of simulated minus formula."""
    run = data.run
    table = {
        "time_min": run.times[SHOWN] / minute,
        "simulated_deg": run.compass_error,
        "formula_deg": run.formula.compass_angle,
        **{f"{name}_deg": term for name, term in zip(TERMS, run.formula, strict=True)},
        "missing_deg": np.abs(data.gaps[0]),
    }
    for name, gap in zip(TERMS, data.gaps[1:], strict=True):
        table[f"missing_without_{name}_deg"] = np.abs(gap)
    time, *angles = table
    return {time: table[time], **{name: np.degrees(table[name][SHOWN]) for name in angles}}


@in_style
def draw(data: OperatingFormula, sheet: Sheet) -> Figure:
    """The terms and their sum; and what is missing without each."""
    figure, panels = sheet.mosaic(
        "ab", (10.5, 4.3), (0.065, 0.28, 0.985, 0.91), page_height=3.3, column_height=4.9
    )
    terms, gaps = panels["a"], panels["b"]
    sizes = np.degrees(np.abs(data.gaps))
    terms.set(title="error of the compass angle, degrees")
    gaps.set(title="simulated minus formula, size, degrees", yscale="log")
    gaps.set(ylim=(LEAST, max(MOST, 1.5 * sizes.max())))
    for panel in (terms, gaps):
        panel.set(xlabel="time, minutes", xlim=(0, DURATION / minute))
        shade_manoeuvres(panel)
    run = data.run
    minutes = run.times[SHOWN] / minute
    terms.plot(minutes, np.degrees(run.compass_error[SHOWN]), color=BLACK,
               linewidth=2.2 if sheet.on_paper else 3.5, alpha=0.35,
               label="simulated")  # fmt: skip
    terms.plot(minutes, np.degrees(run.formula.compass_angle[SHOWN]), color=BLACK,
               linewidth=0.7 if sheet.on_paper else 1.0, label="formula, all terms")  # fmt: skip
    gaps.plot(minutes, sizes[0, SHOWN], color=BLACK, linewidth=0.7 if sheet.on_paper else 1.0,
              label="with all terms")  # fmt: skip
    for i, name in enumerate(TERMS):
        terms.plot(minutes, np.degrees(run.formula[i][SHOWN]), **SERIES[i], label=name)
        gaps.plot(minutes, sizes[i + 1, SHOWN], **SERIES[i], label=f"without {name}")
    first, second = ("above", "below") if sheet.narrow else ("left", "right")
    words = f"{first}: the terms; {second}: what is missing without each"
    size = "medium" if sheet.on_paper else 8
    legend_below_all(figure, sheet, terms, 3, title=words, title_fontsize=size)
    return figure

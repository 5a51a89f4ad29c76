"""The paper's formula for the heading error at work, term by term, against the simulation."""

from typing import Any

import numpy as np
from scipy.constants import minute

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, SERIES, legend_below_all
from driftlab.book.scenarios import DURATION

from ..experiments import TERMS
from .operation import shade_manoeuvres

LEAST, MOST = 1e-4, 3.0
"""Reach of what is missing, degrees, unless it is more."""


@from_table
def draw(drawing: Drawing) -> None:
    """The terms and their sum; and what is missing without each."""
    sheet = drawing.sheet
    panels = drawing.mosaic(
        "ab", (10.5, 4.3), (0.065, 0.28, 0.985, 0.91), page_height=3.3, column_height=4.9
    )
    terms, gaps = panels["a"], panels["b"]
    terms.set(title="error of the compass angle, degrees")
    gaps.set(title="simulated minus formula, size, degrees", yscale="log")
    gaps.set(ylim=(LEAST, max(MOST, 1.5 * np.abs(drawing.table.shown("gaps")).max())))
    for panel in (terms, gaps):
        panel.set(xlabel="time, minutes", xlim=(0, DURATION / minute))
        shade_manoeuvres(panel)
    wide, thin = (2.2, 0.7) if sheet.on_paper else (3.5, 1.0)
    drawing.curve(terms, "time", "simulated", color=BLACK, linewidth=wide, alpha=0.35,
                  label="simulated")  # fmt: skip
    fine: dict[str, Any] = {"color": BLACK, "linewidth": thin}
    drawing.curve(terms, "time", "formula", **fine, label="formula, all terms")
    drawing.curve(gaps, "time", "missing", **fine, label="with all terms")
    for name, style in zip(TERMS, SERIES, strict=False):
        drawing.curve(terms, "time", f"term, {name}", **style, label=name)
        drawing.curve(gaps, "time", f"missing_without, {name}", **style, label=f"without {name}")
    first, second = ("above", "below") if sheet.narrow else ("left", "right")
    words = f"{first}: the terms; {second}: what is missing without each"
    size = "medium" if sheet.on_paper else 8
    legend_below_all(drawing.figure, sheet, terms, 3, title=words, title_fontsize=size)

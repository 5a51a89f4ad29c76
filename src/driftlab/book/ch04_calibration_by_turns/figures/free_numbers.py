"""Regions of two free numbers, the integrator's error and a factor, that give Larin's digits."""

from typing import Any

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, SERIES, legend_below_all

from ..experiment_numbers import NAMES, SUM_FACTORS, TRIADS
from .larin_digits import pretty

DOT: dict[str, Any] = {"color": BLACK, "linestyle": "none", "marker": "o", "markersize": 4}
TITLES = ("axes as in (2.4)", "third axis of unit length", "symmetric part only")


@from_table
def draw(drawing: Drawing) -> None:
    """A panel a reading; what comes out everywhere or nowhere is said below it."""
    table, sheet = drawing.table, drawing.sheet
    panels = list(drawing.mosaic(
        "abc", (11.0, 4.9), (0.06, 0.3, 0.91, 0.92), spaces=(0.08, 0.2), sharey=True,
        column_height=7.4, page_height=3.6,
    ).values())  # fmt: skip
    first, apart = (-29, 11) if sheet.on_paper else (-43, 21)
    size = "medium" if sheet.on_paper else 10
    label = "a step formula in 100 steps, with a factor"
    for panel, title, reading, extent in zip(panels, TITLES, TRIADS, table.extent, strict=True):
        panel.set(title=title, xlabel=r"error of a step, $10^{-9}$ rad", ylim=table.factors)
        panel.set_xlim(-table.shown("largest_step_error"), table.shown("largest_step_error"))
        for number, name in enumerate(NAMES):
            if extent[number] == "in part":
                drawing.band(
                    panel, "step_error", "factor_from", "factor_to",
                    where={"reading": reading, "number": name},
                    color=SERIES[number]["color"], alpha=0.45, linewidth=1.5,
                    label=f"{pretty(name)} comes out",
                )  # fmt: skip
        drawing.curve(panel, "formula_error", "formula_factor", **DOT, label=label)
        for line, word in enumerate(("everywhere", "nowhere")):
            names = [pretty(name) for name, at in zip(NAMES, extent, strict=True) if at == word]
            text = f"{word}: {', '.join(names) or 'none'}"
            below: dict[str, Any] = {"xycoords": "axes fraction", "textcoords": "offset points"}
            panel.annotate(
                text, (0, 0), (0, first - apart * line), fontsize=size, va="top", **below
            )
        if panel is panels[0] or sheet.narrow:
            factor = "factor" if sheet.on_paper else "factor before the arc tangent"
            panel.set_ylabel(rf"{factor} in $\sigma_4^\ast$")
    for factor, name in zip(SUM_FACTORS.values(), ("1", r"$\sqrt{3/2}$", "3/2"), strict=True):
        if table.factors[0] <= factor <= table.factors[1]:
            at: dict[str, Any] = {"xycoords": ("axes fraction", "data"), "va": "center"}
            panels[-1].annotate(name, (1.02, factor), **at)
    artists = [panel.get_legend_handles_labels() for panel in panels]
    handles = {label: handle for both in artists for handle, label in zip(*both, strict=True)}
    handles |= {label: handles.pop(label)}  # the dots last
    entries = list(handles.values())
    if sheet.on_paper:
        legend_below_all(
            drawing.figure, sheet, entries, len(entries), column=1, labels=list(handles)
        )
    else:
        drawing.figure.legend(entries, handles, loc="lower left", ncols=len(entries), fontsize=10)

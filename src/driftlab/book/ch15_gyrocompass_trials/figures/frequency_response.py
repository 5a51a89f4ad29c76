"""Poles of the levelling loop, and how much of each disturbance passes it at each period."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.legend_handler import HandlerTuple
from matplotlib.ticker import NullLocator
from scipy.constants import hour, minute

from driftlab.book.machinery.figure.data_table import UNITS
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GREY, GUIDE, SERIES, legend_below_all
from driftlab.book.scenarios import SCHULER_PERIOD

from ..experiments import DAY, GAINS, SWELL

MARKS = {
    f"a day,\n{DAY / hour:.0f} h": DAY,
    f"Schuler,\n{SCHULER_PERIOD / minute:.0f} min": SCHULER_PERIOD,
    f"swell,\n{SWELL:g} s": SWELL,
}
REACHES = ((1e-3, 30), (1e-6, 1e3), (1e-6, 3), (1e-3, 0.1), (1e-4, 1e5))
"""Of the gains, arc minutes and degrees."""


@from_table
def draw(drawing: Drawing) -> None:
    """The poles; then gains over the period, slow on the left."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        "abc;def", (10.5, 6.6), (0.06, 0.165, 0.985, 0.95), spaces=(0.24, 0.38),
        column="ab;cd;ef", column_height=7.4, page_height=5.0,
    )  # fmt: skip
    styles = dict(zip(table.loops, SERIES, strict=False))
    poles, *gains = panels.values()
    _draw_poles(drawing, poles, styles)
    for panel, name, reach in zip(gains, GAINS, REACHES, strict=True):
        _draw_gains(drawing, panel, name, styles)
        panel.set(xscale="log", yscale="log", xlim=(2 * DAY, 3.0), ylim=reach, xlabel="period")
        panel.xaxis.set_minor_locator(NullLocator())
        panel.set_xticks(list(MARKS.values()), list(MARKS))
        panel.grid(axis="x", color="#b0b0b0")
        what, cause = name.split(", by ")
        first = f"{what}, {UNITS[table.entry(f'{name}, simulated').unit][1]}"
        if sheet.on_paper:
            words = f"{first}, by\n{cause}"
            panel.set_title(words, fontsize="small" if sheet.narrow else "medium")
            panel.set_xticks(list(MARKS.values()), ["24 h", *list(MARKS)[1:]], fontsize="small")
        else:
            panel.set_title(f"{first}, by {cause}", fontsize=10)
    _legend(drawing, poles, styles)


def _legend(drawing: Drawing, poles: Axes, styles: dict[str, dict[str, Any]]) -> None:
    sheet = drawing.sheet
    lines: list[Any] = [poles.plot([], [], **style)[0] for style in styles.values()]
    whole = [style for name, style in styles.items() if "log" not in name]
    thin = {"color": GREY, "linewidth": 0.9}
    lines.append(tuple(poles.plot([], [], **style | thin)[0] for style in whole))
    size = 3 if sheet.on_paper else 5
    lines.append(poles.plot([], [], "o", color=BLACK, markersize=size, fillstyle="none")[0])
    names = [*styles, "the same loops, whole rate", "simulated compass"]
    several = {tuple: HandlerTuple(ndivide=None, pad=0.4)}
    legend_below_all(drawing.figure, sheet, lines, 3, labels=names, handler_map=several,
                     handlelength=3 if sheet.on_paper else 4, columnspacing=1.2,
                     fontsize="small" if sheet.on_paper else None)  # fmt: skip


def _draw_poles(drawing: Drawing, panel: Axes, styles: dict[str, dict[str, Any]]) -> None:
    """Poles in units of Schuler's frequency; on the circle they wander with the damping."""
    table, sheet = drawing.table, drawing.sheet
    angle = np.linspace(np.pi / 2, 3 * np.pi / 2, 100)
    panel.plot(np.cos(angle), np.sin(angle), color=GREY, linewidth=0.9, label=GUIDE)
    title = (
        "poles, over\nSchuler's frequency" if sheet.on_paper else "poles, over Schuler's frequency"
    )
    panel.set(title=title, aspect="equal")
    panel.set(xlim=(-1.75, 0.75), ylim=(-1.3, 1.3), xlabel="real part", ylabel="imaginary part")
    size = 5 if sheet.on_paper else 9
    both = np.reshape(table.pole_real + 1j * table.pole_imaginary, (-1, 2))
    for (name, style), found, marker in zip(styles.items(), both, "xo+s", strict=True):
        if np.abs(found).max() < 2:
            drawing.curve(panel, "pole_real", "pole_imaginary", where={"loop": name},
                          color=style["color"], marker=marker, linestyle="none", markersize=size,
                          fillstyle="none", mew=0.2 * size, label=name)  # fmt: skip
        else:
            far = np.abs(found).max()
            for pole in found / far:
                start, end = 1.22 * pole, 1.55 * pole
                panel.annotate(
                    "", (end.real, end.imag), (start.real, start.imag),
                    arrowprops={"arrowstyle": "-|>", "color": style["color"]}, label=GUIDE,
                )  # fmt: skip
            place = -0.8 if sheet.on_paper else -1.7
            panel.text(place, 0.0, f"stiff:\n{far:.0f} times\nas far", va="center",
                       fontsize="small" if sheet.on_paper else 8.5)  # fmt: skip
    if not sheet.on_paper:
        _draw_splitting(drawing, panel)


def _draw_splitting(drawing: Drawing, panel: Axes) -> None:
    """The undamped pole on the turning Earth, enlarged."""
    inset, name = panel.inset_axes((0.76, 0.1, 0.22, 0.42)), "undamped_pole_on_the_turning_earth"
    drawing.curve(inset, f"{name}_real", name, linestyle="none", marker="x",
                  color=SERIES[0]["color"], markersize=7, mew=1.6)  # fmt: skip
    upper, lower = drawing.table.shown(name)
    inset.set(xlim=(-0.05, 0.05), ylim=(0.94, 1.06))
    inset.set_xticks([])
    inset.set_yticks([lower, 1.0, upper], [f"{lower:.3f}", "1", f"{upper:.3f}"])
    inset.tick_params(labelsize=7)
    inset.grid(visible=False)
    inset.set_title("enlarged", fontsize=8)


def _draw_gains(
    drawing: Drawing, panel: Axes, name: str, styles: dict[str, dict[str, Any]]
) -> None:
    for loop in drawing.table.answering[name]:
        drawing.curve(panel, "period", f"{name}, {loop}", **styles[loop], label=loop)
        if name.endswith("offset") and "log" not in loop:
            thin = styles[loop] | {"linewidth": 0.9, "color": GREY}
            drawing.curve(panel, "period", f"{name}, whole rate, {loop}", **thin, zorder=1.5,
                          label=f"{loop}, whole rate")  # fmt: skip
    drawing.curve(panel, "driven_period", f"{name}, simulated", linestyle="none", marker="o",
                  color=BLACK, markersize=3 if drawing.sheet.on_paper else 5, fillstyle="none",
                  label="simulated compass")  # fmt: skip

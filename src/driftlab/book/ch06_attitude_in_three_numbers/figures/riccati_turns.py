"""The Riccati equation integrated through whole turns, with and without the shadow switch."""

from typing import Any

import numpy as np

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GREY, SERIES, decades

from ..experiments import WAYS


@from_table
def draw(drawing: Drawing) -> None:
    """Length of k, error of the attitude, and work against the miss."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        "abc", (10.5, 4.0), (0.065, 0.14, 0.985, 0.9), spaces=(0.32, 0.2), page_height=3.4
    )
    length, error, work = panels.values()
    dot: dict[str, Any] = {"markersize": 3} if sheet.on_paper else {}
    length.set(title="length of the vector k", xlabel="turns", ylabel="|k|")
    length.set(xlim=(0, table.turns), yscale="log", ylim=(1e-2, 1e10))
    error.set(title=f"fixed step, {table.steps} a turn", xlabel="turns")
    error.set(ylabel="error of attitude, rad", xlim=(0, table.turns), yscale="log")
    at_the_end = table.fixed_errors[:, -1]
    error.set_ylim(*decades([*at_the_end, table.fixed_errors.max()], 1e-11, 1e-1))
    work.set(title=f"variable step, {table.turns} turns", xlabel="evaluations of the rate")
    work.set(xscale="log", yscale="log", xlim=decades(table.evaluations, 100, 20000))
    work.set_ylim(*decades(table.worst, 1e-12, 1e-1))
    work.set(ylabel="largest error of attitude, rad")
    styles = ({"color": GREY, "linewidth": 2.4 if sheet.on_paper else 3.5}, SERIES[1], SERIES[0])
    cross: dict[str, Any] = {"color": BLACK, "marker": "x", "linestyle": "none"}
    drawn = [
        (length, f"|k| {way}, over turns", way, style)
        for way, style in zip(WAYS, styles, strict=True)
    ]
    drawn.append((length, "|k| given up, over turns", "given up", cross))
    drawn += [
        (error, f"fixed step, {way}, rad over turns", way, style)
        for way, style in zip(WAYS[1:], styles[1:], strict=True)
    ]
    for switch, pair in (("no switch", SERIES[1:]), ("with switch", SERIES[0::4])):
        for miss, style, marker in zip(table.misses, pair, "so", strict=False):
            label = f"{np.degrees(miss):.3g}°, {switch}"
            curve = f"variable step, {label}, rad over evaluations"
            drawn.append((work, curve, label, {**style, **dot, "marker": marker}))
    for axes, curve, label, style in drawn:
        drawing.curve(axes, "x", "y", where={"curve": curve}, label=label, **style)
    length.legend(loc="upper right")
    error.legend(loc="upper right" if sheet.narrow else "upper left")
    work.legend(loc="upper right")

"""The Riccati equation integrated through whole turns, with and without the shadow switch."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import (
    BLACK,
    GREY,
    SERIES,
    decades,
    in_style,
    long_table,
)
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import RiccatiTurns

NAMES = ("fixed axis, no switch", "near miss, no switch", "near miss, with switch")
"""Of the three ways to integrate."""


def columns(data: RiccatiTurns) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: lengths, errors with a fixed step, errors over the work."""
    answers = (data.ended, data.plain, data.switched)
    curves = {
        f"|k| {name}, over turns": (answer.time, np.linalg.norm(answer.vector, axis=-1))
        for name, answer in zip(NAMES, answers, strict=True)
    }
    time, vector = data.ended.time[-1:], data.ended.vector[-1:]
    curves["|k| given up, over turns"] = (time, np.linalg.norm(vector, axis=-1))
    for name, error in zip(NAMES[1:], data.fixed_errors, strict=True):
        curves[f"fixed step, {name}, rad over turns"] = (data.fixed_times[1:], error[1:])
    for i, name in enumerate(("no switch", "with switch")):
        for j, miss in enumerate(data.misses):
            title = f"variable step, {np.degrees(miss):.3g}°, {name}, rad over evaluations"
            curves[title] = (data.evaluations[i, j], data.worst[i, j])
    return long_table(curves)


@in_style
def draw(data: RiccatiTurns, sheet: Sheet) -> Figure:
    """Length of k, error of the attitude, and work against the miss."""
    figure, panels = sheet.mosaic(
        "abc", (10.5, 4.0), (0.065, 0.14, 0.985, 0.9), spaces=(0.32, 0.2), page_height=3.4
    )
    length, error, work = panels.values()
    thick = {"linewidth": 2.4 if sheet.on_paper else 3.5}
    dot: dict[str, Any] = {"markersize": 3} if sheet.on_paper else {}
    length.set(title="length of the vector k", xlabel="turns", ylabel="|k|")
    length.set(xlim=(0, data.turns), yscale="log", ylim=(1e-2, 1e10))
    error.set(
        title=f"fixed step, {data.steps} a turn", xlabel="turns", ylabel="error of attitude, rad"
    )
    error.set(xlim=(0, data.turns), yscale="log")
    at_the_end = data.fixed_errors[:, -1]
    error.set_ylim(*decades([*at_the_end, data.fixed_errors.max()], 1e-11, 1e-1))
    work.set(title=f"variable step, {data.turns} turns", xlabel="evaluations of the rate")
    work.set(xscale="log", yscale="log", xlim=decades(data.evaluations, 100, 20000))
    work.set_ylim(*decades(data.worst, 1e-12, 1e-1))
    work.set(ylabel="largest error of attitude, rad")
    styles = ({"color": GREY, **thick}, SERIES[1], SERIES[0])
    answers = (data.ended, data.plain, data.switched)
    for answer, style, name in zip(answers, styles, NAMES, strict=True):
        length.plot(answer.time, np.linalg.norm(answer.vector, axis=-1), **style, label=name)
    last = np.linalg.norm(data.ended.vector[-1])
    cross: dict[str, Any] = {"color": BLACK, "marker": "x", "linestyle": "none"}
    length.plot([data.ended.time[-1]], [last], **cross, label="given up")
    for errors, style, name in zip(data.fixed_errors, styles[1:], NAMES[1:], strict=True):
        error.plot(data.fixed_times[1:], errors[1:], **style, label=name)
    for i, (name, pair) in enumerate((("no switch", SERIES[1:]), ("with switch", SERIES[0::4]))):
        for j, (miss, style, marker) in enumerate(zip(data.misses, pair, "so", strict=False)):
            label = f"{np.degrees(miss):.3g}°, {name}"
            work.plot(
                data.evaluations[i, j], data.worst[i, j], **style, **dot, marker=marker, label=label
            )
    length.legend(loc="upper right")
    error.legend(loc="upper right" if sheet.narrow else "upper left")
    work.legend(loc="upper right")
    return figure

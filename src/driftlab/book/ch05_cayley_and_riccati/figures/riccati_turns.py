"""The Riccati equation integrated through whole turns, with and without the shadow switch."""

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, in_style, long_table
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import MISSES, STEPS, TURNS, RiccatiTurns


def columns(data: RiccatiTurns) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the first panel's lengths and the second one's errors."""
    names = ("fixed axis, no switch", "no switch", "with switch")
    answers = (data.ended, data.plain, data.switched)
    curves = {
        f"|k| {name}, over turns": (answer.time, np.linalg.norm(answer.vector, axis=-1))
        for name, answer in zip(names, answers, strict=True)
    }
    for name, error in zip(names[1:], data.fixed_errors, strict=True):
        curves[f"fixed step {name}, rad over turns"] = (data.fixed_times, error)
    return long_table(curves)


@in_style
def draw(data: RiccatiTurns, sheet: Sheet) -> Figure:
    """Length of k, error of the attitude, and work against the miss."""
    figure = Figure(figsize=(10.5, 4.0))
    length, error, work = figure.subplots(1, 3)
    figure.subplots_adjust(0.065, 0.14, 0.985, 0.9, wspace=0.32)
    length.set(title="length of the vector k", xlabel="turns", ylabel="|k|")
    length.set(xlim=(0, TURNS), yscale="log", ylim=(1e-2, 1e10))
    error.set(title=f"fixed step, {STEPS} a turn", xlabel="turns", ylabel="error of attitude, rad")
    error.set(xlim=(0, TURNS), yscale="log", ylim=(1e-11, 1e-1))
    work.set(title=f"variable step, {TURNS} turns", xlabel="evaluations of the rate")
    work.set(xscale="log", yscale="log", xlim=(100, 20000), ylim=(1e-12, 1e-1))
    work.set(ylabel="largest error of attitude, rad")
    names = ("fixed axis, no switch", "near miss, no switch", "near miss, with switch")
    styles = ({"color": GREY, "linewidth": 3.5}, SERIES[1], SERIES[0])
    answers = (data.ended, data.plain, data.switched)
    for answer, style, name in zip(answers, styles, names, strict=True):
        length.plot(answer.time, np.linalg.norm(answer.vector, axis=-1), **style, label=name)
    last = np.linalg.norm(data.ended.vector[-1])
    cross = {"color": BLACK, "marker": "x", "linestyle": "none"}
    length.plot([data.ended.time[-1]], [last], **cross, label="given up")
    for errors, style, name in zip(data.fixed_errors, styles[1:], names[1:], strict=True):
        error.plot(data.fixed_times[1:], errors[1:], **style, label=name)
    for i, (name, pair) in enumerate((("no switch", SERIES[1:]), ("with switch", SERIES[0::4]))):
        for j, (miss, style, marker) in enumerate(zip(MISSES, pair, "so", strict=False)):
            label = f"{np.degrees(miss):g}°, {name}"
            work.plot(data.evaluations[i, j], data.worst[i, j], **style, marker=marker, label=label)
    length.legend(loc="upper right")
    error.legend(loc="upper left")
    work.legend(loc="upper right")
    return figure

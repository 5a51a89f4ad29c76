"""Which choice of body axes leaves out least: means over many units, and unit by unit."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from driftlab.body_frames import BODY_FRAMES
from driftlab.book.machinery.picture import BLACK, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray
from driftlab.motion.scheme import SCHEMES

from ..experiments import SIZES, Case, ChoiceOfAxes

PASSES = {1: "one pass", 2: "two passes"}
MORE = ", more units"


def columns(data: ChoiceOfAxes) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: one row a unit; two columns a case that has twice as many."""
    units = min(map(len, data.squares.values()))
    return {
        _title(case) + i * MORE: part
        for case, values in data.squares.items()
        for i, part in enumerate(values.round(6).reshape(-1, units))
    }


def restore(table: Mapping[str, Sequence[str]]) -> ChoiceOfAxes:
    """Return the study that a CSV holds."""
    squares: dict[Case, FloatArray] = {}
    for title, row in table.items():
        case = _case(title.removesuffix(MORE))
        squares[case] = np.append(squares.get(case, []), np.array(row, float))
    return ChoiceOfAxes(squares)


def _title(case: Case) -> str:
    return f"{case.scheme}, {case.size} arc seconds, {case.frame}, {PASSES[case.passes]}"


def _case(title: str) -> Case:
    scheme, size, frame, passes = title.split(", ")
    counts = {words: count for count, words in PASSES.items()}
    return Case(scheme, int(size.split()[0]), frame, counts[passes])


@in_style
def draw(data: ChoiceOfAxes, sheet: Sheet) -> Figure:
    """Draw two panels of means, one for each scheme, and one of units."""
    figure = Figure(figsize=(10.5, 4.6))
    *schemes, units = figure.subplots(1, 3)
    figure.subplots_adjust(0.055, 0.26, 0.985, 0.92, wspace=0.38)
    sizes = np.array(SIZES)
    for panel, scheme in zip(schemes, SCHEMES, strict=True):
        panel.set(title=f"27 states at the end, {scheme}", xscale="log", yscale="log")
        panel.set(xlabel="installation errors, arc seconds", xlim=(33, 560), ylim=(0.85, 25))
        panel.axhline(1.0, color=BLACK, linewidth=0.8)
        for i, (frame, style, marker) in enumerate(zip(BODY_FRAMES, SERIES, "os^Dv", strict=False)):
            once = [data.squares[Case(scheme, size, frame, 1)] for size in SIZES]
            twice = data.squares[Case(scheme, SIZES[-1], frame, 2)]
            # Side by side, or they would hide each other.
            beside = 1.04 ** (i - 2)
            panel.errorbar(
                sizes * beside, [values.mean() for values in once],
                [_standard_error(values) for values in once],
                **style, marker=marker, markersize=4, label=frame,
            )  # fmt: skip
            panel.errorbar(
                [SIZES[-1] * beside], [twice.mean()], [_standard_error(twice)],
                color=style["color"], marker=marker, markersize=5, markerfacecolor="white",
                linestyle="none",
            )  # fmt: skip
        panel.set_xticks(sizes, [f"{size}" for size in sizes])
        panel.set_yticks([1, 2, 5, 10, 20], ["1", "2", "5", "10", "20"])
        panel.minorticks_off()
    schemes[0].set_ylabel("mean over what it should be")
    _draw_units(units, data)
    handles, labels = schemes[0].get_legend_handles_labels()
    figure.legend(
        handles, labels, loc="lower left", ncols=3, fontsize=8, bbox_to_anchor=(0.09, 0.02)
    )
    return figure


def _draw_units(panel: Axes, data: ChoiceOfAxes) -> None:
    """Part of the units in which averaged axes err less than each rival, with 95 % intervals."""
    size = SIZES[-1]
    panel.set(title=f"averaged axes err less, {size}″", xlabel="part of the units", xlim=(0.2, 0.9))
    panel.axvline(0.5, color=BLACK, linewidth=0.8)
    rivals = BODY_FRAMES[1:]
    for k, (scheme, passes) in enumerate((s, p) for p in PASSES for s in SCHEMES):
        for row, rival in enumerate(rivals):
            counted = data.compared(scheme, size, rival, passes)
            part = counted.better / counted.units
            low, high = counted.interval
            panel.errorbar(
                [part], [row + 0.18 * (k - 1.5)], xerr=[[part - low], [high - part]],
                color=SERIES[k % 2]["color"], marker="os"[k % 2], markersize=5, linestyle="none",
                markerfacecolor="white" if passes == 2 else None,
                label=f"{scheme}, {PASSES[passes]}" if row == 0 else None,
            )  # fmt: skip
    names = ["than upper\ntriangle", "than lower\ntriangle", "than accel-\nerometers",
             "than averaged\naccelerometers"]  # fmt: skip
    panel.set_yticks(range(len(rivals)), names, fontsize=8)
    panel.set_ylim(len(rivals) - 0.4, -0.6)
    panel.legend(loc="upper center", bbox_to_anchor=(0.35, -0.15), ncols=2, fontsize=8)


def _standard_error(values: FloatArray) -> float:
    return float(values.std(ddof=1) / np.sqrt(len(values)))

"""Which choice of body axes leaves out least: means over many units, and unit by unit."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from driftlab.body_frames import BODY_FRAMES
from driftlab.book.machinery.picture import BLACK, GUIDE, SERIES, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray
from driftlab.motion.scheme import SCHEMES

from ..experiments import Case, ChoiceOfAxes

PASSES = {1: "one pass", 2: "two passes"}
MORE = ", more units"


def columns(data: ChoiceOfAxes) -> dict[str, Any]:
    """Columns of the figure's CSV: one row a unit; two columns a case that has twice as many.

    What is drawn of them is in the last columns: one row a case, then one row a comparison.
    """
    units = min(map(len, data.squares.values()))
    table: dict[str, Any] = {
        _title(case) + i * MORE: part
        for case, values in data.squares.items()
        for i, part in enumerate(values.round(6).reshape(-1, units))
    }
    means = [(case, *_mean(values)) for case, values in data.squares.items()]
    parts = [(*key, *_part(data, *key)) for key in _compared()]
    return table | {
        "mean_of": [f"{case.scheme}; {PASSES[case.passes]}" for case, *_ in means],
        "axes": [case.frame for case, *_ in means],
        "drawn_at_arcsec": np.array([case.size * _beside(case.frame) for case, *_ in means]),
        "mean": np.array([mean for _, mean, _ in means]),
        "mean_low": np.array([mean - error for _, mean, error in means]),
        "mean_high": np.array([mean + error for _, mean, error in means]),
        "part_of": [f"{scheme}; {PASSES[passes]}" for scheme, passes, *_ in parts],
        "rival": [rival for _, _, rival, *_ in parts],
        **{name: np.array([row[3 + i] for row in parts])
           for i, name in enumerate(("part", "part_low", "part_high"))},
    }  # fmt: skip


def restore(table: Mapping[str, Sequence[str]]) -> ChoiceOfAxes:
    """Return the study that a CSV holds."""
    squares: dict[Case, FloatArray] = {}
    for title, row in table.items():
        if title.count(", ") < 3:
            continue  # what is drawn of the others
        case = _case(title.removesuffix(MORE))
        squares[case] = np.append(squares.get(case, []), np.array(row, float))
    return ChoiceOfAxes(squares)


def _title(case: Case) -> str:
    return f"{case.scheme}, {case.size:g} arc seconds, {case.frame}, {PASSES[case.passes]}"


def _case(title: str) -> Case:
    scheme, size, frame, passes = title.split(", ")
    counts = {words: count for count, words in PASSES.items()}
    return Case(scheme, float(size.split()[0]), frame, counts[passes])


def _beside(frame: str) -> float:
    """Choices of axes are drawn side by side, or they would hide each other."""
    return 1.04 ** (BODY_FRAMES.index(frame) - 2)


def _mean(values: FloatArray) -> tuple[float, float]:
    """Mean and its standard error."""
    return float(values.mean()), float(values.std(ddof=1) / np.sqrt(len(values)))


def _compared() -> list[tuple[str, int, str]]:
    """Scheme, passes and rival of each comparison of averaged axes in units bent most."""
    return [(s, passes, rival) for passes in PASSES for s in SCHEMES for rival in BODY_FRAMES[1:]]


def _part(data: ChoiceOfAxes, scheme: str, passes: int, rival: str) -> tuple[float, float, float]:
    """Part of the units in which averaged axes err less, and its 95 % interval."""
    counted = data.compared(scheme, data.sizes[-1], rival, passes)
    return counted.better / counted.units, *counted.interval


def caption(data: ChoiceOfAxes) -> str:
    """Say in how many units bent most averaged axes err less, and what a second pass does."""
    size = data.sizes[-1]
    counts = []
    for rival in BODY_FRAMES[1:]:
        first, second = (data.compared(scheme, size, rival) for scheme in SCHEMES)
        counts.append(f"{rival} {first.better} and {second.better}")
    twice = [values.mean() for case, values in data.squares.items() if case.passes == 2]
    return (
        f"{first.units // 2} random units in each case, {first.units} of those bent most; the "
        "same ones for each of five choices of body axes, on the nineteen positions and on "
        "eighteen rotations, commonly quoted as those of Camberlein, whom the paper cites (not "
        "confirmed), with short pauses. "
        "Left and middle: squared normalised errors, means with their standard errors. Right: how "
        "often averaged axes err less in a unit, with 95 % "
        f"intervals. After one pass over the record of units bent by {size:g}″ they err less than "
        f"{', '.join(counts)} times, on the first scheme and on the second. After a second pass, "
        "linearised about the first, all means lie between "
        f"{min(twice):.2f} and {max(twice):.2f} (hollow)."
    )


@in_style
def draw(data: ChoiceOfAxes, sheet: Sheet) -> Figure:
    """Draw two panels of means, one for each scheme, and one of units."""
    figure, panels = sheet.mosaic(
        "abc", (10.5, 4.6), (0.055, 0.26, 0.985, 0.92), spaces=(0.38, 0.2),
        column_height=7.6, page_height=3.6,
    )  # fmt: skip
    schemes, units = (panels["a"], panels["b"]), panels["c"]
    sizes = np.array(data.sizes)
    small = "small" if sheet.on_paper else 8
    dot = 0.6 if sheet.on_paper else 1.0
    highest = max(sum(_mean(values)) for values in data.squares.values())
    lowest = min(values.mean() for values in data.squares.values())
    for panel, scheme in zip(schemes, SCHEMES, strict=True):
        words = f"27 states, {scheme}" if sheet.on_paper else f"27 states at the end, {scheme}"
        panel.set(title=words, xscale="log", yscale="log")
        panel.set(xlabel="installation errors, arc seconds")
        panel.set(xlim=(0.825 * sizes[0], 1.4 * sizes[-1]))
        panel.set(ylim=(min(0.85, 0.9 * lowest), max(25.0, 1.2 * highest)))
        panel.axhline(1.0, color=BLACK, linewidth=0.8, label=GUIDE)
        for frame, style, marker in zip(BODY_FRAMES, SERIES, "os^Dv", strict=False):
            once, errors = np.transpose(
                [_mean(data.squares[Case(scheme, size, frame, 1)]) for size in sizes]
            )
            twice, error = _mean(data.squares[Case(scheme, sizes[-1], frame, 2)])
            panel.errorbar(sizes * _beside(frame), once, errors, **style, marker=marker,
                           markersize=4 * dot, label=frame)  # fmt: skip
            panel.errorbar(
                [sizes[-1] * _beside(frame)], [twice], [error], color=style["color"],
                marker=marker, markersize=5 * dot, markerfacecolor="white", linestyle="none",
            )  # fmt: skip
        panel.set_xticks(sizes, [f"{size:g}" for size in sizes])
        ticks = [k for k in (1, 2, 5, 10, 20, 50, 100, 200, 500) if k <= max(20.0, highest)]
        panel.set_yticks(ticks, [f"{tick}" for tick in ticks])
        panel.minorticks_off()
    schemes[0].set_ylabel("mean over what it should be")
    if sheet.narrow:
        schemes[1].set_ylabel("mean over what it should be")
    _draw_units(units, data, sheet)
    if sheet.on_paper:
        handles, labels = _both(schemes[0], units)
        legend_below_all(figure, sheet, handles, labels=labels, fontsize="small")
    else:
        handles, labels = schemes[0].get_legend_handles_labels()
        figure.legend(
            handles, labels, loc="lower left", ncols=3, fontsize=small, bbox_to_anchor=(0.09, 0.02)
        )
    return figure


def _both(*panels: Axes) -> tuple[list[Any], list[Any]]:
    """Handles and labels of several panels."""
    found = [panel.get_legend_handles_labels() for panel in panels]
    return [h for handles, _ in found for h in handles], [x for _, labels in found for x in labels]


def _draw_units(panel: Axes, data: ChoiceOfAxes, sheet: Sheet) -> None:
    """Part of the units in which averaged axes err less than each rival, with 95 % intervals."""
    panel.set(title=f"averaged axes err less, {data.sizes[-1]:g}″", xlabel="part of the units")
    panel.axvline(0.5, color=BLACK, linewidth=0.8, label=GUIDE)
    rivals = BODY_FRAMES[1:]
    dot = 0.6 if sheet.on_paper else 1.0
    reach = [0.2, 0.9]
    for k, (scheme, passes) in enumerate((s, p) for p in PASSES for s in SCHEMES):
        part, low, high = np.transpose([_part(data, scheme, passes, rival) for rival in rivals])
        reach = [min(reach[0], low.min() - 0.02), max(reach[1], high.max() + 0.02)]
        panel.errorbar(
            part, np.arange(len(rivals)) + 0.18 * (k - 1.5), xerr=[part - low, high - part],
            color=SERIES[k % 2]["color"], marker="os"[k % 2], markersize=5 * dot,
            linestyle="none", markerfacecolor="white" if passes == 2 else None,
            label=f"{scheme}, {PASSES[passes]}",
        )  # fmt: skip
    names = ["than upper\ntriangle", "than lower\ntriangle", "than accel-\nerometers",
             "than averaged\naccelerometers"]  # fmt: skip
    panel.set_yticks(range(len(rivals)), names, fontsize="small" if sheet.on_paper else 8)
    panel.set(xlim=tuple(reach), ylim=(len(rivals) - 0.4, -0.6))
    if not sheet.on_paper:
        panel.legend(loc="upper center", bbox_to_anchor=(0.35, -0.15), ncols=2, fontsize=8)

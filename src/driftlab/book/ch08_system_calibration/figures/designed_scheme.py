"""What a designed rotation scheme shows better, and random ones; simulated units confirm it."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, BLUE, GREEN, GREY, GUIDE, VERMILION, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.calibration.design_task import CRITERIA
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.checks import FloatArray
from driftlab.motion.scheme import SCHEMES, Scheme

from ..experiments import BEST, FREE, DesignedSchemes, TriedScheme

NAMES = ERROR_MODELS["averaged"].names[6:]
UNIT = "unit after "
_, EIGHTEEN = SCHEMES
LEAST, MOST = 0.024, 1.1
"""Reach of what is left of the sensor error that is known worst."""


def columns(data: DesignedSchemes) -> dict[str, FloatArray | list[str]]:
    """Columns of the figure's CSV: one row a scheme, then one row a unit and scheme.

    A unit has its errors in place of the deviations, and its NEES / 27 in place of the criteria.
    What is drawn of them is in the last columns: one row a sensor error, and one row a bar.
    """
    rows = list(data.schemes)
    for name, errors in data.errors.items():
        scheme = data.named(name).scheme
        for error, nees in zip(errors, data.nees[name], strict=True):
            rows.append(TriedScheme(UNIT + name, "", scheme, np.full(3, nees), error))
    kinds, names, schemes, criteria, ratios = zip(*rows, strict=True)
    first = np.array(criteria).T
    after = np.array(ratios).T
    return {
        "kind": list(kinds),
        "name": list(names),
        "rotations": [scheme.rotations for scheme in schemes],
        "start": [" ".join(scheme.start) for scheme in schemes],
        "pause": np.array([scheme.dwell for scheme in schemes]),
        **dict(zip(CRITERIA, first, strict=True)),
        **dict(zip(NAMES, after, strict=True)),
        **_drawn(data),
    }


def _drawn(data: DesignedSchemes) -> dict[str, FloatArray | list[str]]:
    """What is drawn over the sensor errors, and how many random rows leave how much."""
    low, middle, high = np.percentile([e.ratios for e in data.of_kind("random")], [5, 50, 95], 0)
    ratio, spread = data.gained()
    counts, edges = _bars(data)
    return {
        "sensor_error": list(NAMES),
        "random_5_percent": low,
        "random_median": middle,
        "random_95_percent": high,
        **{f"after {name}": data.named(name).ratios for name in (EIGHTEEN, FREE, BEST)},
        "simulated": ratio,
        "simulated_low": ratio - spread,
        "simulated_high": ratio + spread,
        "worst_of_random_rows": (edges[1:] + edges[:-1]) / 2,
        "random_rows": counts,
        **{
            f"least known after {name}": data.named(name).criteria[:1]
            for name in (*SCHEMES, BEST, FREE)
        },
    }


def _bars(data: DesignedSchemes) -> tuple[FloatArray, FloatArray]:
    """How many random rows are in each of 24 classes, and the edges of these."""
    drawn = [each.criteria[0] for each in data.of_kind("random")]
    counts, edges = np.histogram(drawn, np.geomspace(LEAST, MOST, 25))
    return counts, edges


def restore(table: Mapping[str, Sequence[str]]) -> DesignedSchemes:
    """Return the study that a CSV holds."""
    criteria = np.array([table[name] for name in CRITERIA], float).T
    ratios = np.array([table[name] for name in NAMES], float).T
    kinds = np.array(table["kind"])
    tried = [
        TriedScheme(
            kind,
            table["name"][i],
            _scheme(*(table[name][i] for name in ("rotations", "start", "pause"))),
            criteria[i],
            ratios[i],
        )
        for i, kind in enumerate(table["kind"])
        if not kind.startswith(UNIT)
    ]
    names = [kind.removeprefix(UNIT) for kind in dict.fromkeys(kinds) if kind.startswith(UNIT)]
    errors = {name: ratios[kinds == UNIT + name] for name in names}
    return DesignedSchemes(tried, errors, {n: criteria[kinds == UNIT + n, 0] for n in names})


def _scheme(rotations: str, start: str, pause: str) -> Scheme:
    x, y, z = start.split()
    return Scheme(rotations, (x, y, z), float(pause))


def caption(data: DesignedSchemes) -> str:
    """Say how good the rows are, and whether simulated units confirm it."""
    nineteen, eighteen = (each.criteria[0] for each in data.of_kind("published"))
    best, free = (data.named(name).criteria[0] for name in (BEST, FREE))
    drawn = np.array([each.criteria[0] for each in data.of_kind("random")])
    first, second = (f"{values.mean():.2f}" for values in data.nees.values())
    turns = len(data.named(BEST).scheme.turns)
    return (
        f"Rows of {turns} quarter and half turns, all in the time of the nineteen positions. Left: "
        "deviations of the sensor errors over those after the nineteen positions; bars, nine in "
        f"ten of {drawn.size} random rows; hollow, errors of {len(data.nees[BEST])} "
        "simulated units after the designed row over those of the same units after the nineteen "
        f"positions, with standard errors (NEES / 27: {second} and {first}). Right: how much of "
        "what was unknown before is left of the sensor error that is known worst: "
        f"{nineteen:.2%} after nineteen positions, {eighteen:.2%} after eighteen rotations, "
        f"{best:.2%} after the row designed for two axes, {free:.2%} for three; "
        f"{np.mean(drawn < nineteen):.0%} of the random rows leave less than the nineteen "
        "positions."
    )


@in_style
def draw(data: DesignedSchemes, sheet: Sheet) -> Figure:
    """Draw deviations of all sensor errors, and the criterion of all rows."""
    figure, panels = sheet.mosaic(
        "ab", (10.5, 4.9), (0.065, 0.28, 0.985, 0.93), width_ratios=(1.0, 0.5),
        page_height=4.2, column_height=6.6, column_heights=(1.35, 1.0),
    )  # fmt: skip
    errors, worst = panels["a"], panels["b"]
    places = np.arange(len(NAMES))
    drawn = np.array([each.ratios for each in data.of_kind("random")])
    low, middle, high = np.percentile(drawn, [5, 50, 95], axis=0)
    small = "small" if sheet.on_paper else 8
    dot = 0.6 if sheet.on_paper else 1.0
    errors.set(title="deviation, over that after the nineteen positions", yscale="log")
    top = max(60.0, 2 * high.max())
    errors.set(xlim=(-0.7, len(NAMES) - 0.3), ylim=(min(0.4, 0.8 * low.min()), top))
    errors.axhline(1.0, color=BLACK, linewidth=0.8, label=GUIDE)
    errors.bar(places, high - low, 0.8, low, color="#dcdcdc", label="random rows, 90 %")
    errors.plot(
        places, middle, color=GREY, marker="_", linestyle="none", label="random rows, median"
    )
    for name, color, marker, beside, label in (
        (EIGHTEEN, VERMILION, "s", -0.25, EIGHTEEN),
        (FREE, GREEN, "^", 0.25, "designed, three axes"),
        (BEST, BLUE, "o", 0.0, "designed, two axes"),
    ):
        errors.plot(
            places + beside, data.named(name).ratios, color=color, marker=marker,
            markersize=4 * dot, linestyle="none", label=label,
        )  # fmt: skip
    ratio, spread = data.gained()
    errors.errorbar(
        places + 0.08, ratio, spread, color=BLUE, marker="o", markersize=5 * dot, linewidth=dot,
        markerfacecolor="none", linestyle="none", label="the same, simulated units",
    )  # fmt: skip
    errors.set_yticks([0.5, 1, 2, 5, 10, 20, 50], ["0.5", "1", "2", "5", "10", "20", "50"])
    errors.minorticks_off()
    names = [_short(name) for name in NAMES]
    if sheet.narrow:
        errors.set_xticks(places, names, rotation=90, fontsize=5.8)
    else:
        size = 6 if sheet.on_paper else 7
        errors.set_xticks(places, names, rotation=55, ha="right", fontsize=size)
    handles, _ = errors.get_legend_handles_labels()  # lines first, then bars
    errors.legend(
        handles=[handles[4], *handles[:4], *handles[5:]],
        loc="upper left",
        ncols=2 if sheet.narrow else 3,
        fontsize=small,
        framealpha=1.0,
    )
    _draw_worst(worst, data, sheet)
    return figure


def _draw_worst(panel: Axes, data: DesignedSchemes, sheet: Sheet) -> None:
    """How many random rows leave how much of the least known error, and where the others are."""
    counts, edges = _bars(data)
    panel.set(title="the least known of the 21 errors", xscale="log", xlim=(LEAST, MOST))
    panel.set(xlabel="deviation after, over that before", ylabel="random rows")
    panel.bar(edges[:-1], counts, np.diff(edges), align="edge", color="#dcdcdc", edgecolor=GREY,
              linewidth=0.5)  # fmt: skip
    nineteen, _ = SCHEMES
    for name, color, style, label in (
        (nineteen, BLACK, "-", nineteen),
        (EIGHTEEN, VERMILION, "--", EIGHTEEN),
        (BEST, BLUE, "-", "designed, two axes"),
        (FREE, GREEN, "-.", "designed, three axes"),
    ):
        panel.axvline(data.named(name).criteria[0], color=color, linestyle=style, label=label)
    panel.set_xticks([0.03, 0.1, 0.3, 1], ["3 %", "10 %", "30 %", "100 %"])
    panel.minorticks_off()
    if sheet.on_paper:
        panel.set_ylim(0, 1.5 * counts.max())  # room for the legend
        panel.legend(loc="upper right", fontsize="small")
    else:
        panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=2, fontsize=8)


def _short(name: str) -> str:
    """Name of a sensor error as the axis has it."""
    words = name.replace("accelerometer", "acc.").split()
    return " ".join(word for word in words if word not in ("installation", "non-orthogonality"))

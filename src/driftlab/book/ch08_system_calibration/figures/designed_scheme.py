"""What a designed rotation scheme shows better, and random ones; simulated units confirm it."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, BLUE, GREEN, GREY, VERMILION, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.calibration.design_task import CRITERIA
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.checks import FloatArray
from driftlab.motion.scheme import SCHEMES, Scheme

from ..experiments import BEST, FREE, DesignedSchemes, TriedScheme

NAMES = ERROR_MODELS["averaged"].names[6:]
UNIT = "unit after "


def columns(data: DesignedSchemes) -> dict[str, FloatArray | list[str]]:
    """Columns of the figure's CSV: one row a scheme, then one row a unit and scheme.

    A unit has its errors in place of the deviations, and its NEES / 27 in place of the criteria.
    """
    rows = list(data.schemes)
    for name, errors in data.errors.items():
        scheme = data.named(name).scheme
        for error, nees in zip(errors, data.nees[name], strict=True):
            rows.append(TriedScheme(UNIT + name, "", scheme, np.full(3, nees), error))
    kinds, names, schemes, criteria, ratios = zip(*rows, strict=True)
    first = np.array(criteria).round(6).T
    after = np.array(ratios).round(4).T
    return {
        "kind": list(kinds),
        "name": list(names),
        "rotations": [scheme.rotations for scheme in schemes],
        "start": [" ".join(scheme.start) for scheme in schemes],
        "pause": np.array([scheme.dwell for scheme in schemes]),
        **dict(zip(CRITERIA, first, strict=True)),
        **dict(zip(NAMES, after, strict=True)),
    }


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


@in_style
def draw(data: DesignedSchemes, sheet: Sheet) -> Figure:
    """Draw deviations of all sensor errors, and the criterion of all rows."""
    figure = Figure(figsize=(10.5, 4.9))
    errors, worst = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1.0, 0.5]})
    figure.subplots_adjust(0.065, 0.28, 0.985, 0.93, wspace=0.2)
    places = np.arange(len(NAMES))
    drawn = np.array([each.ratios for each in data.of_kind("random")])
    low, middle, high = np.percentile(drawn, [5, 50, 95], axis=0)
    errors.set(title="deviation, over that after the nineteen positions", yscale="log")
    errors.set(xlim=(-0.7, len(NAMES) - 0.3), ylim=(0.4, 60))
    errors.axhline(1.0, color=BLACK, linewidth=0.8)
    errors.bar(places, high - low, 0.8, low, color="#dcdcdc", label="random rows, 90 %")
    errors.plot(
        places, middle, color=GREY, marker="_", linestyle="none", label="random rows, median"
    )
    _, eighteen = SCHEMES
    for name, color, marker, beside, label in (
        (eighteen, VERMILION, "s", -0.25, eighteen),
        (FREE, GREEN, "^", 0.25, "designed, three axes"),
        (BEST, BLUE, "o", 0.0, "designed, two axes"),
    ):
        errors.plot(
            places + beside, data.named(name).ratios, color=color, marker=marker, markersize=4,
            linestyle="none", label=label,
        )  # fmt: skip
    ratio, spread = data.gained()
    errors.errorbar(
        places + 0.08, ratio, spread, color=BLUE, marker="o", markersize=5, linewidth=1,
        markerfacecolor="none", linestyle="none", label="the same, simulated units",
    )  # fmt: skip
    errors.set_yticks([0.5, 1, 2, 5, 10, 20, 50], ["0.5", "1", "2", "5", "10", "20", "50"])
    errors.minorticks_off()
    errors.set_xticks(places, [_short(name) for name in NAMES], rotation=55, ha="right", fontsize=7)
    handles, _ = errors.get_legend_handles_labels()  # lines first, then bars
    errors.legend(
        handles=[handles[4], *handles[:4], *handles[5:]],
        loc="upper left",
        ncols=3,
        fontsize=8,
        framealpha=1.0,
    )
    _draw_worst(worst, data)
    return figure


def _draw_worst(panel: Axes, data: DesignedSchemes) -> None:
    """How many random rows leave how much of the least known error, and where the others are."""
    drawn = np.array([each.criteria[0] for each in data.of_kind("random")])
    panel.set(title="the least known of the 21 errors", xscale="log", xlim=(0.024, 1.1))
    panel.set(xlabel="deviation after, over that before", ylabel="random rows")
    panel.hist(
        drawn, np.geomspace(0.024, 1.1, 25).tolist(), color="#dcdcdc", edgecolor=GREY, linewidth=0.5
    )
    nineteen, eighteen = SCHEMES
    for name, color, style, label in (
        (nineteen, BLACK, "-", nineteen),
        (eighteen, VERMILION, "--", eighteen),
        (BEST, BLUE, "-", "designed, two axes"),
        (FREE, GREEN, "-.", "designed, three axes"),
    ):
        panel.axvline(data.named(name).criteria[0], color=color, linestyle=style, label=label)
    panel.set_xticks([0.03, 0.1, 0.3, 1], ["3 %", "10 %", "30 %", "100 %"])
    panel.minorticks_off()
    panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=2, fontsize=8)


def _short(name: str) -> str:
    """Name of a sensor error as the axis has it."""
    words = name.replace("accelerometer", "acc.").split()
    return " ".join(word for word in words if word not in ("installation", "non-orthogonality"))

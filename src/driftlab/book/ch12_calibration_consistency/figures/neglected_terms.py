"""In which body axes the neglected second order is least: error equations, and filters."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GREY, GUIDE, SERIES, legend_below_all
from driftlab.motion.scheme import SCHEMES

from ..experiments import COMPARISONS, EQUATIONS, MOUNTINGS, RIVALS, WAYS


def caption(table: DataTable) -> str:
    """Say what is drawn, and in how many comparisons averaged axes certainly leave out less."""
    better, worse = table.part_low > 0.5, table.part_high < 0.5
    equations, filters = np.s_[..., : len(EQUATIONS)], np.s_[..., len(EQUATIONS) :]
    return (
        f"In which part of {table.units} random units averaged axes leave out less than four "
        "rivals. Filled: nineteen positions; hollow: eighteen rotations, commonly quoted as those "
        "of Camberlein, whom the paper cites (not confirmed); both with short pauses. Installation "
        f"errors of the triad that is built worse: {table.words('spread')} (1σ); of the other: as "
        f"much, or divided by {table.ratio:g}. Above the black line: what the error equations "
        "leave out of a nonlinear navigation. Below: the squared errors of four filters with a "
        f"reference velocity of 1 cm/s. All {COMPARISONS} intervals of the study hold together, "
        "with 95 %. In the error equations averaged axes "
        f"are certainly better in {better[equations].sum()} of {better[equations].size} "
        f"comparisons and certainly worse in {worse[equations].sum()}; in the filters in "
        f"{better[filters].sum()} and {worse[filters].sum()}."
    )


@from_table
def draw(drawing: Drawing) -> None:
    """Draw a panel for each mounting of the triads, with a band for each way to neglect."""
    sheet = drawing.sheet
    panels = drawing.mosaic(
        "abc", (10.5, 7.4), (0.175, 0.15, 0.985, 0.95), spaces=(0.05, 0.2), column="a;b;c",
        column_height=13.0, page_height=6.4,
    )  # fmt: skip
    places = np.arange(len(WAYS), dtype=np.float64)
    names = [f"equations,\n{way}" if way in EQUATIONS else way for way in WAYS]
    small = "small" if sheet.on_paper else 9
    dot = 0.6 if sheet.on_paper else 1.0
    series = [(rival, scheme) for rival in RIVALS for scheme in SCHEMES]
    for panel, mounting in zip(panels.values(), MOUNTINGS, strict=True):
        panel.set_title(mounting, fontsize=small)
        panel.set(xlim=(-0.02, 1.02), ylim=(len(WAYS) - 0.5, -0.5), xticks=[0, 0.25, 0.5, 0.75, 1])
        panel.set_xticklabels(["0", "", "½", "", "1"])
        panel.axvline(0.5, color=BLACK, linewidth=0.8, label=GUIDE)
        for k, edge in enumerate(places[1:] - 0.5, 1):
            line = (BLACK, 1.2) if k == len(EQUATIONS) else (GREY, 0.4)
            panel.axhline(edge, color=line[0], linewidth=line[1], label=GUIDE)
        for k, (rival, scheme) in enumerate(series):
            style = k // len(SCHEMES)
            of = f"{scheme}, {mounting}, {rival}"
            drawing.error_bars(
                panel, f"part, {of}", places + 0.105 * (k - (len(series) - 1) / 2),
                f"part_low, {of}", f"part_high, {of}", across=True,
                color=SERIES[style]["color"], marker="os^D"[style], markersize=4.5 * dot,
                elinewidth=1.2 * dot, linestyle="none",
                markerfacecolor="white" if k % 2 else None, label=f"{rival}, {scheme}",
            )  # fmt: skip
        first = panel is panels["a"] or sheet.narrow
        panel.set_yticks(places, names if first else [], fontsize=small)
    panels["c" if sheet.narrow else "b"].set_xlabel(
        "part where averaged axes leave out less"
        if sheet.narrow
        else "part of the units in which averaged axes leave out less than the rival"
    )
    columns = 2 if sheet.on_paper else 4
    legend_below_all(drawing.figure, sheet, panels["a"], columns, 1, fontsize=small)

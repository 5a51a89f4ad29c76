"""Yates's weighing against its rivals, with and without an offset common to all turns."""

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, BLUE, ORANGE, legend_below_all

from ..experiments import METHODS


@from_table
def draw(drawing: Drawing) -> None:
    """Two marks a method, with the closed form beside them."""
    sheet = drawing.sheet
    panels = drawing.mosaic("a", (9.0, 3.6), (0.24, 0.15, 0.98, 0.9), column_height=2.7)
    axes = panels["a"]
    title = (
        "rms error of the sigmas" if sheet.narrow else "root mean square error of the three sigmas"
    )
    axes.set(title=title, xscale="log")
    narrow = "error / noise of one turn estimate"
    axes.set_xlabel(narrow if sheet.narrow else "error in units of the noise of one turn estimate")
    axes.set_yticks(range(len(METHODS)), METHODS)
    axes.invert_yaxis()
    dash = 9 if sheet.on_paper else 14
    for name, label, colour, marker, shift in (
        ("without_offset", "no offset", BLUE, "o", -0.12),
        ("with_offset", f"common offset, {drawing.table.offset:.3g} times the noise", ORANGE, "s",
         0.12),
    ):  # fmt: skip
        rms, places = f"rms_{name}", [row + shift for row in range(len(METHODS))]
        drawing.error_bars(
            axes, rms, places, f"{rms}_from", f"{rms}_to", across=True, elinewidth=1.5,
            color=colour, marker=marker, linestyle="none", label=label,
        )  # fmt: skip
        drawing.curve(
            axes, f"expected_{name}", places, color=BLACK, linestyle="none", marker="|",
            markersize=dash, label="closed form" if name == "with_offset" else None,
        )  # fmt: skip
    if sheet.on_paper:
        legend_below_all(drawing.figure, sheet, axes, ncols=3, column=1)
    else:
        axes.legend(loc="upper right", fontsize=10)

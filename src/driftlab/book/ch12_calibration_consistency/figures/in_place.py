"""A calibrated unit navigates in place, with two choices of body axes; Wu Figs. 3-5."""

from driftlab.book.machinery.figure.data_table import UNITS, DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GREY, SERIES

from ..experiments import SHOWN

UNIT_NAMES = {"arcsec": "arc seconds"}


def caption(table: DataTable) -> str:
    """Say what is seen, and how far the analytic curves are from the simulated ones."""
    return (
        "The paper's Figs. 3 to 5, simulated from its description; published for the typical "
        "unit of this chapter. A unit calibrated with either choice of body axes "
        "navigates at rest. If both "
        "computers start from one attitude, each in its own axes, the curves are one. If both "
        "start from the table's axes, each has its own distance to them as initial error. "
        "Thin black: the analytic curves, from what each calibration left over; their position is "
        f"within {table.words('gap', '.0f')} of the simulated one, which goes "
        f"{table.words('farthest', '.1f')} away. "
        "Dashed and thin: the first of them without its swing, which is the beginning of the "
        f"terms of 24 hours. The swing's plane turns by {table.shown('turned'):.0f} degrees, "
        "Foucault's exchange between East and North."
    )


@from_table
def draw(drawing: Drawing) -> None:
    """Draw seven panels: three of attitude, two of velocity, two of position."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        "abcx;defg", (10.5, 5.4), (0.055, 0.1, 0.99, 0.94), column="ab;cx;de;fg",
        column_height=7.6, page_height=4.6, spaces=(0.27, 0.25), sharex=True,
    )  # fmt: skip
    corner = panels.pop("x")
    corner.axis("off")
    thick, thin, middle = (1.6, 0.5, 0.9) if sheet.on_paper else (2.6, 0.7, 1.4)
    shown = [(quantity, axis, unit) for quantity, (unit, axes) in SHOWN.items() for axis in axes]
    for panel, (quantity, axis, unit) in zip(panels.values(), shown, strict=True):
        sign = UNITS[unit][1].strip()
        name = sign if sheet.on_paper else UNIT_NAMES.get(unit, sign)
        size = "medium" if sheet.on_paper else 9
        panel.set_title(f"{quantity} {axis}, {name}", fontsize=size)
        for run, style in zip(table.runs, SERIES, strict=False):
            label = run.replace(", start from ", ",\nstart: ")
            drawing.curve(
                panel, "time", f"{quantity}, {run}, {axis}", **style, label=label, linewidth=thick
            )
        for run in table.runs:
            label = "analytic" if run == table.runs[0] else "_"
            curve = f"analytic {quantity}, {run}, {axis}"
            drawing.curve(panel, "time", curve, color=BLACK, linewidth=thin, label=label)
        drawing.curve(
            panel, "time", f"{quantity} without its swing, {axis}", color=GREY, dashes=(6, 3),
            linewidth=middle, zorder=1, label="first one, without\nits swing: 24 hours",
        )  # fmt: skip
        panel.set_xlim(0, table.shown("time")[-1])
    for letter in "fg" if sheet.narrow else "defg":
        panels[letter].set_xlabel("time, hours")
    handles, labels = panels["a"].get_legend_handles_labels()
    corner.legend(handles, labels, loc="center", labelspacing=0.4 if sheet.on_paper else 0.8,
                  fontsize="small" if sheet.on_paper else None)  # fmt: skip

"""All 21 sensor errors of one calibration: what is left, and three standard deviations."""

from driftlab.book.machinery.figure.data_table import UNITS, DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import SERIES, legend_below_all

from ..experiments import state_unit, unit_of

WIDE = "abc;def;ghi;jkl;mno;pqr;stu"


def caption(table: DataTable) -> str:
    """Say what is drawn of how many sensor errors."""
    return (
        f"A unit on {table.positions} positions (default: the typical unit): size of the "
        f"error of each of the {len(table.names)} sensor errors, and three standard deviations "
        "as the filter states them. A parameter becomes known when the right axis is turned or "
        "points up."
    )


@from_table
def draw(drawing: Drawing) -> None:
    """Draw seven rows of three small panels."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        WIDE, (10.5, 10.5), (0.065, 0.085, 0.99, 0.975), column=WIDE, column_height=8.0,
        page_height=8.5, spaces=(0.18, 0.36), sharex=True,
    )  # fmt: skip
    thick = 0.8 if sheet.on_paper else None
    for panel, name in zip(panels.values(), table.names, strict=True):
        for column, style, label in (
            ("error", SERIES[0], "size of the error"),
            ("three_deviations", SERIES[1], "three standard deviations that the filter states"),
        ):
            drawing.curve(panel, "time", f"{column}, {name}", **style, linewidth=thick, label=label)
        bound = table.shown(f"three_deviations, {name}")
        panel.set(yscale="log", ylim=(bound[-1] / 30, 2 * bound[0]))
        panel.set(xlim=(0, table.shown("time")[-1]))
        panel.minorticks_off()
        if sheet.on_paper:
            words = name.replace("accelerometer", "acc.").replace("orthogonality", "orth.")
            kind, which = words.rsplit(" ", 1)
            between = "\n" if sheet.narrow else " "
            words = f"{kind}{between}{which}, {UNITS[state_unit(name)][1].strip()}"
            panel.set_title(words, fontsize="small" if sheet.narrow else "medium")
        else:
            panel.set_title(f"{name}, {unit_of(name)[1]}", fontsize=9)
    for letter in WIDE.split(";")[-1]:
        panels[letter].set_xlabel("time, minutes")
    legend_below_all(drawing.figure, sheet, panels["a"], ncols=2, column=1)

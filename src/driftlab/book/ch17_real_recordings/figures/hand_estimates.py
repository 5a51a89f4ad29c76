"""One scale-factor error estimated in four ways, a panel a turn."""

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLUE

from ..experiments.hand_estimates import ESTIMATES


@from_table
def draw(drawing: Drawing) -> None:
    """A row a way; the bar of the first is the stated standard deviation."""
    panels = drawing.mosaic(
        "abc", (10.5, 2.6), (0.165, 0.2, 0.985, 0.88), spaces=(0.12, 0.5), column_height=6.0,
        page_height=2.6,
    )  # fmt: skip
    rows = range(len(ESTIMATES))
    for name, letter in zip("xyz", "abc", strict=True):
        panel, end = panels[letter], f"turn about {name}"
        drawing.error_bars(
            panel, f"scale_error, {end}", rows, f"low, {end}", f"high, {end}", across=True,
            color=BLUE, marker="o", linestyle="none",
        )  # fmt: skip
        panel.set(title=end, xlabel="scale-factor error, thousandths", ylim=(len(rows) - 0.5, -0.5))
        labelled = letter == "a" or drawing.sheet.narrow
        panel.set_yticks(rows, ESTIMATES if labelled else [""] * len(rows))
        panel.tick_params(axis="y", length=0)


def caption(data: DataTable) -> str:
    """What the figure shows, without the credit."""
    return (
        "The scale-factor errors of three gyros from one turn by hand each, estimated in four "
        "ways. From one cut of the turn Larin and Ferraris differ by at most "
        f"{data.shown('apart'):.3f} thousandths; another cut moves an estimate by up to "
        f"{data.shown('moved'):.2f}, the gyro bias left in by up to {data.shown('bias'):.1f}. The "
        "bars are one standard deviation, for a final heading known to "
        f"{data.shown('stop_standard_deviation'):.1f} degrees."
    )

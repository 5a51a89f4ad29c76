"""Which way is up in body axes, all along the rotation schemes."""

import numpy as np
from scipy.constants import minute

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import SERIES, legend_below_all


def caption(table: DataTable) -> str:
    """Say how long each scheme takes."""
    each = [
        f"{name}: {table.shown(f'time, {name}')[-1]:.1f} minutes with pauses of "
        f"{pause / minute:g} and turns of {np.degrees(rate):g} degrees a second"
        for name, pause, rate in zip(table.names, table.pauses, table.rates, strict=True)
    ]
    return f"Which body axis points up along a rotation scheme. {'; '.join(each)}."


@from_table
def draw(drawing: Drawing) -> None:
    """Draw one row a scheme, one line a body axis."""
    names = drawing.table.names
    letters = [chr(ord("a") + i) for i in range(len(names))]
    panels = drawing.mosaic(
        ";".join(letters), (10.5, 2.2 * len(letters)), (0.065, 0.18, 0.985, 0.93),
        column_height=0.6 + 1.3 * len(letters), spaces=(0.2, 0.28), sharex=True, sharey=True,
    )  # fmt: skip
    for letter, name in zip(letters, names, strict=True):
        panel = panels[letter]
        panel.set(title=name, ylabel="along Up", ylim=(-1.15, 1.15), yticks=(-1, 0, 1))
        for axis, style in zip("xyz", SERIES, strict=False):
            up, label = f"up, {name}, {axis}", f"body axis {axis}"
            drawing.curve(panel, f"time, {name}", up, **style, label=label)
    panels[letters[-1]].set_xlabel("time, minutes")
    legend_below_all(drawing.figure, drawing.sheet, panels["a"], ncols=3, column=3)

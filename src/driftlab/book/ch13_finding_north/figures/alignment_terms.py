"""Terms of the alignment's heading error over heading, pitch, latitude, and the stray factor."""

from typing import Any

import numpy as np

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, SERIES, legend_below_all

from ..experiments import GRIDS, LABELS

REACHES = (0.8, 2.0, 5.0, 10.0, 20.0, 50.0, 180.0)
"""How far the axis of the error may reach, degrees."""


@from_table
def draw(drawing: Drawing) -> None:
    """Three panels, with one ordinate."""
    table, sheet = drawing.table, drawing.sheet
    mosaic = drawing.mosaic(
        "abc", (10.5, 4.3), (0.065, 0.27, 0.985, 0.92), spaces=(0.06, 0.2), column_height=7.2,
        page_height=3.3, sharey=True,
    )  # fmt: skip
    panels = list(mosaic.values())
    for panel in panels if sheet.narrow else panels[:1]:
        panel.set_ylabel("heading error, degrees")
    fixed = {
        name: f"{name} {table.shown(f'fixed_{name}'):.{digits}f}°"
        for name, digits in zip(GRIDS, (0, 0, 1), strict=True)
    }
    # Toward the zenith and the poles there is no bound.
    over_heading = [table.shown(f"error_over_heading, {of}") for of in ("exact", *LABELS)]
    shown = np.abs(over_heading).max()
    most = next((r for r in REACHES if shown < 0.9 * r), REACHES[-1])
    for panel, name in zip(panels, GRIDS, strict=True):
        rest = ", ".join(words for other, words in fixed.items() if other != name)
        on_page = sheet.on_paper and not sheet.narrow
        title = f"over {name};{chr(10) if on_page else ' '}{rest}"
        panel.set_title(title, fontsize=None if sheet.on_paper else 9)
        reach = 180 if name == "heading" else 90
        panel.set(xlabel=f"{name}, degrees", xlim=(-reach, reach), ylim=(-most, most))
        # Without the ends, whose labels would run into those of the next panel.
        panel.set_xticks(np.arange(-reach, reach + 1, reach // 3)[1:-1])
        corrected = {"color": BLACK, "marker": "o", "markersize": 4, "linestyle": "none"}
        curves: list[tuple[str, str, dict[str, Any]]] = [
            *zip(LABELS, LABELS, SERIES, strict=False),
            ("exact", "exact, all", {"color": BLACK, "linewidth": 2.0}),
            ("as in the copy", "all, formula of the copy", SERIES[5]),
            ("corrected", "all, formula corrected", {**corrected, "every": 4}),
        ]
        for of, label, style in curves:
            drawing.curve(panel, f"at_{name}", f"error_over_{name}, {of}", label=label, **style)
    legend_below_all(drawing.figure, sheet, panels[0])

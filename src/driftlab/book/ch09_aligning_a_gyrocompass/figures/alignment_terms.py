"""Terms of the alignment's heading error over heading, pitch, latitude, and the stray factor."""

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, SERIES, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import GRIDS, AlignmentTerms

LABELS = (
    "east gyro",
    "east acc. by tan pitch",
    "north acc. by tan pitch",
    "east acc. by tan latitude",
)


REACHES = (0.8, 2.0, 5.0, 10.0, 20.0, 50.0, 180.0)
"""How far the axis of the error may reach, degrees."""


def columns(data: AlignmentTerms) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the errors of each panel beside its abscissa."""
    table = {}
    for name, values in GRIDS.items():
        table[f"{name}_deg"] = np.degrees(values)
        for label, term in zip(LABELS, data.terms[name].T, strict=True):
            table[f"error_deg, {label}, over {name}"] = term
        table[f"error_deg, exact, over {name}"] = data.exact[name]
        table[f"error_deg, as in the copy, over {name}"] = data.in_copy[name]
        table[f"error_deg, corrected, over {name}"] = data.terms[name].sum(axis=-1)
    return table


@in_style
def draw(data: AlignmentTerms, sheet: Sheet) -> Figure:
    """Three panels, with one ordinate."""
    figure, mosaic = sheet.mosaic(
        "abc", (10.5, 4.3), (0.065, 0.27, 0.985, 0.92), spaces=(0.06, 0.2), column_height=7.2,
        page_height=3.3, sharey=True,
    )  # fmt: skip
    panels = list(mosaic.values())
    for panel in panels if sheet.narrow else panels[:1]:
        panel.set_ylabel("heading error, degrees")
    angles = np.degrees(list(data.fixed.values()))
    fixed = {
        name: f"{name} {angle:.{digits}f}°"
        for name, angle, digits in zip(data.fixed, angles, (0, 0, 1), strict=True)
    }
    # Toward the zenith and the poles there is no bound.
    shown = np.abs(data.exact["heading"]).max(), np.abs(data.terms["heading"]).max()
    most = next((r for r in REACHES if max(shown) < 0.9 * r), REACHES[-1])
    for panel, (name, values) in zip(panels, GRIDS.items(), strict=True):
        rest = ", ".join(words for other, words in fixed.items() if other != name)
        on_page = sheet.on_paper and not sheet.narrow
        title = f"over {name};{chr(10) if on_page else ' '}{rest}"
        panel.set_title(title, fontsize=None if sheet.on_paper else 9)
        reach = 180 if name == "heading" else 90
        panel.set(xlabel=f"{name}, degrees", xlim=(-reach, reach), ylim=(-most, most))
        # Without the ends, whose labels would run into those of the next panel.
        panel.set_xticks(np.arange(-reach, reach + 1, reach // 3)[1:-1])
        grid, terms = np.degrees(values), data.terms[name]
        for i, label in enumerate(LABELS):
            panel.plot(grid, terms[:, i], **SERIES[i], label=label)
        panel.plot(grid, data.exact[name], color=BLACK, linewidth=2.0, label="exact, all")
        panel.plot(grid, data.in_copy[name], **SERIES[5],
                   label="all, formula of the copy")  # fmt: skip
        panel.plot(grid[::4], terms.sum(axis=-1)[::4], color=BLACK, marker="o", markersize=4,
                   linestyle="none", label="all, formula corrected")  # fmt: skip
    legend_below_all(figure, sheet, panels[0])
    return figure

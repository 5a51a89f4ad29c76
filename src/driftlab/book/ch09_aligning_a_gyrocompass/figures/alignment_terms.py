"""Terms of the alignment's heading error over heading, pitch, latitude, and the stray factor."""

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, SERIES, in_style, long_table
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import FIXED, GRIDS, AlignmentTerms

LABELS = (
    "east gyro",
    "east acc. by tan pitch",
    "north acc. by tan pitch",
    "east acc. by tan latitude",
)


def columns(data: AlignmentTerms) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    curves = {}
    for name, values in GRIDS.items():
        grid = np.degrees(values).round(6)
        for i, label in enumerate(LABELS):
            curves[f"{label} over {name}"] = (grid, data.terms[name][:, i].round(8))
        curves[f"exact over {name}"] = (grid, data.exact[name].round(8))
        curves[f"as in the copy over {name}"] = (grid, data.in_copy[name].round(8))
    return long_table(curves)


@in_style
def draw(data: AlignmentTerms, sheet: Sheet) -> Figure:
    """Three panels, with one ordinate."""
    figure = Figure(figsize=(10.5, 4.3))
    panels = figure.subplots(1, 3, sharey=True)
    figure.subplots_adjust(0.065, 0.27, 0.985, 0.92, wspace=0.06)
    panels[0].set_ylabel("heading error, degrees")
    fixed = {
        "heading": f"heading {np.degrees(FIXED['heading']):.0f}°",
        "pitch": f"pitch {np.degrees(FIXED['pitch']):.0f}°",
        "latitude": f"latitude {np.degrees(FIXED['latitude']):.1f}°",
    }
    for panel, (name, values) in zip(panels, GRIDS.items(), strict=True):
        rest = ", ".join(words for other, words in fixed.items() if other != name)
        panel.set_title(f"over {name}; {rest}", fontsize=9)
        reach = 180 if name == "heading" else 90
        panel.set(xlabel=f"{name}, degrees", xlim=(-reach, reach), ylim=(-0.8, 0.8))
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
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=4)
    return figure

"""The drift coefficient over all axes of rotation, and the axes where it is extreme."""

import numpy as np

from driftlab.book.machinery.figure.drawing import GUIDE, Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK

NAMES = ("least", "least", "middle", "middle", "greatest", "greatest")
"""Of both ends of each principal axis."""


@from_table
def draw(drawing: Drawing) -> None:
    """Contour map with the principal axes."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic("a", (9.0, 4.2), (0.08, 0.13, 0.99, 0.91), column_height=2.5)
    axes = panels["a"]
    axes.set(title=r"drift coefficient $\rho$ in units of $10^{-3}$, for every axis")
    axes.set(xlabel="azimuth of the axis, degrees", ylabel="elevation, degrees")
    axes.set(xticks=range(-180, 181, 60), yticks=range(-90, 91, 30))
    axes.grid(False)
    names = ("azimuth", "elevation", "drift_coefficient")
    reach = np.abs(table.shown("drift_coefficient")).max()
    colours = drawing.contours(axes, *names, levels=24, cmap="PuOr", vmin=-reach, vmax=reach)
    grid = (np.reshape(table.shown(name), (61, 121)) for name in names)
    lines = axes.contour(*grid, levels=8, colors=BLACK, linewidths=0.7)
    lines.set_label(GUIDE)
    if not sheet.narrow:
        axes.clabel(lines, fmt="%.2g", fontsize="medium")
    scale = drawing.figure.colorbar(colours, ax=axes, pad=0.02)
    scale.ax.tick_params(labelsize="medium")
    scale.ax.set_axisbelow("line")
    stars = ("principal_azimuth", "principal_elevation")
    size = 12 if not sheet.on_paper else 7
    drawing.curve(
        axes, *stars, linestyle="none", marker="*", color=BLACK, markersize=size, label="extremes"
    )
    values = (table.shown(name) for name in (*stars, "principal_coefficient"))
    for name, azimuth, elevation, value in zip(NAMES, *values, strict=True):
        words = f"{name} {round(value, 2) + 0.0:.2f}"
        axes.annotate(
            words.replace(" ", "\n") if sheet.narrow else words,
            (azimuth, elevation),
            (0, -0.9 * size - 7 if elevation > 60 else 0.8 * size),
            textcoords="offset points",
            ha="center",
            fontsize="medium",
            bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1},
        )

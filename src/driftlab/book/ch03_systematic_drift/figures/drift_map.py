"""The drift coefficient over all axes of rotation, and the axes where it is extreme."""

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, GUIDE, filled_contours, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import DriftMap


def columns(data: DriftMap) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the nodes of the grid, and below them the principal axes."""
    azimuth, elevation = np.meshgrid(np.degrees(data.azimuth), np.degrees(data.elevation))
    ends = _principal_axes(data)
    return {
        "azimuth_deg": azimuth.ravel(),
        "elevation_deg": elevation.ravel(),
        "drift_coefficient_e3": 1e3 * data.coefficient.ravel(),
        "principal_azimuth_deg": ends[:, 0],
        "principal_elevation_deg": ends[:, 1],
        "principal_coefficient_e3": np.repeat(1e3 * data.principal, 2),
    }


def _principal_axes(data: DriftMap) -> FloatArray:
    """Azimuth and elevation (6, 2) in degrees of both ends of each axis."""
    ends = np.stack([data.axes, -data.axes], axis=1).reshape(-1, 3)
    return np.degrees(
        np.stack([np.arctan2(ends[:, 1], ends[:, 0]), np.arcsin(ends[:, 2])], axis=-1)
    )


@in_style
def draw(data: DriftMap, sheet: Sheet) -> Figure:
    """Contour map with the principal axes."""
    figure, panels = sheet.mosaic("a", (9.0, 4.2), (0.08, 0.13, 0.99, 0.91), column_height=2.5)
    axes = panels["a"]
    axes.set(title=r"drift coefficient $\rho$ in units of $10^{-3}$, for every axis")
    axes.set(xlabel="azimuth of the axis, degrees", ylabel="elevation, degrees")
    axes.set(xticks=range(-180, 181, 60), yticks=range(-90, 91, 30))
    axes.grid(False)
    grid = np.degrees(data.azimuth), np.degrees(data.elevation), 1e3 * data.coefficient
    reach = np.abs(grid[2]).max()
    colours = filled_contours(axes, *grid, levels=24, cmap="PuOr", vmin=-reach, vmax=reach)
    lines = axes.contour(*grid, levels=8, colors=BLACK, linewidths=0.7)
    lines.set_label(GUIDE)
    if not sheet.narrow:
        axes.clabel(lines, fmt="%.2g", fontsize="medium")
    scale = figure.colorbar(colours, ax=axes, pad=0.02)
    scale.ax.tick_params(labelsize="medium")
    scale.ax.set_axisbelow("line")
    names = ("least", "middle", "greatest")
    ends = _principal_axes(data)
    size = 12 if not sheet.on_paper else 7
    axes.plot(*ends.T, linestyle="none", marker="*", color=BLACK, markersize=size, label="extremes")
    for k, (azimuth, elevation) in enumerate(ends):
        words = f"{names[k // 2]} {round(1e3 * data.principal[k // 2], 2) + 0.0:.2f}"
        axes.annotate(
            words.replace(" ", "\n") if sheet.narrow else words,
            (azimuth, elevation),
            (0, -0.9 * size - 7 if elevation > 60 else 0.8 * size),
            textcoords="offset points",
            ha="center",
            fontsize="medium",
            bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1},
        )
    return figure

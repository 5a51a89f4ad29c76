"""The drift coefficient over all axes of rotation, and the axes where it is extreme."""

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, in_style
from driftlab.checks import FloatArray

from ..experiments import DriftMap


def columns(data: DriftMap) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: every third node of the grid, in degrees."""
    azimuth, elevation = np.meshgrid(data.azimuth[::3], data.elevation[::3])
    return {
        "azimuth_deg": np.degrees(azimuth).ravel(),
        "elevation_deg": np.degrees(elevation).ravel(),
        "drift_coefficient": data.coefficient[::3, ::3].ravel(),
    }


@in_style
def draw(data: DriftMap) -> Figure:
    """Contour map with the principal axes."""
    figure = Figure(figsize=(9.0, 4.2))
    axes = figure.subplots()
    figure.subplots_adjust(0.08, 0.13, 0.99, 0.91)
    axes.set(title=r"drift coefficient $\rho$ in units of $10^{-3}$, for every axis")
    axes.set(xlabel="azimuth of the axis, degrees", ylabel="elevation, degrees")
    axes.set(xticks=range(-180, 181, 60), yticks=range(-90, 91, 30))
    axes.grid(False)
    grid = np.degrees(data.azimuth), np.degrees(data.elevation), 1e3 * data.coefficient
    reach = np.abs(grid[2]).max()
    colours = axes.contourf(*grid, levels=24, cmap="PuOr", vmin=-reach, vmax=reach)
    lines = axes.contour(*grid, levels=8, colors=BLACK, linewidths=0.7)
    axes.clabel(lines, fmt="%.2g", fontsize=10)
    scale = figure.colorbar(colours, ax=axes, pad=0.02)
    scale.ax.tick_params(labelsize=10)
    scale.ax.set_axisbelow("line")
    names = ("least", "middle", "greatest")
    for axis, value, name in zip(data.axes, data.principal, names, strict=True):
        for end in (axis, -axis):
            azimuth, elevation = np.degrees([np.arctan2(end[1], end[0]), np.arcsin(end[2])])
            axes.plot(azimuth, elevation, marker="*", color=BLACK, markersize=12, linewidth=1.5)
            axes.annotate(
                f"{name} {round(1e3 * value, 2) + 0.0:.2f}",
                (azimuth, elevation),
                (0, -16 if elevation > 60 else 10),
                textcoords="offset points",
                ha="center",
                fontsize=10,
                bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1},
            )
    return figure

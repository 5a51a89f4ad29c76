"""The drift coefficient over all axes of rotation, and the axes where it is extreme."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.machinery.picture import BLACK, Picture
from driftlab.checks import FloatArray
from driftlab.drift.systematic_drift import drift_coefficient, principal_drifts
from driftlab.vectors import direction_from_angles


class DriftMap(NamedTuple):
    """Drift coefficient on a grid of directions."""

    azimuth: FloatArray  # (m,), rad
    elevation: FloatArray  # (n,), rad
    coefficient: FloatArray  # (n, m)
    principal: FloatArray  # (3,), rising
    axes: FloatArray  # (3, 3), rows


def compute(misalignment: ArrayLike) -> DriftMap:
    """Drift coefficient of a misalignment (3, 3) for every axis of rotation."""
    azimuth = np.radians(np.linspace(-180, 180, 121))
    elevation = np.radians(np.linspace(-90, 90, 61))
    axes = direction_from_angles(azimuth, elevation[:, np.newaxis])
    return DriftMap(
        azimuth, elevation, drift_coefficient(axes, misalignment), *principal_drifts(misalignment)
    )


def columns(data: DriftMap) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: every third node of the grid, in degrees."""
    azimuth, elevation = np.meshgrid(data.azimuth[::3], data.elevation[::3])
    return {
        "azimuth_deg": np.degrees(azimuth).ravel(),
        "elevation_deg": np.degrees(elevation).ravel(),
        "drift_coefficient": data.coefficient[::3, ::3].ravel(),
    }


class DriftMapPicture(Picture[DriftMap]):
    """Contour map with the principal axes; drawn once, for the page only."""

    size = (9.0, 4.2)

    def build(self) -> None:
        self.axes = self.figure.subplots()
        self.figure.subplots_adjust(0.08, 0.13, 0.99, 0.91)
        self.axes.set(title=r"drift coefficient $\rho$ in units of $10^{-3}$, for every axis")
        self.axes.set(xlabel="azimuth of the axis, degrees", ylabel="elevation, degrees")
        self.axes.set(xticks=range(-180, 181, 60), yticks=range(-90, 91, 30))
        self.axes.grid(False)

    def update(self, data: DriftMap) -> None:
        grid = np.degrees(data.azimuth), np.degrees(data.elevation), 1e3 * data.coefficient
        reach = np.abs(grid[2]).max()
        colours = self.axes.contourf(*grid, levels=24, cmap="PuOr", vmin=-reach, vmax=reach)
        lines = self.axes.contour(*grid, levels=8, colors=BLACK, linewidths=0.7)
        self.axes.clabel(lines, fmt="%.2g")
        self.figure.colorbar(colours, ax=self.axes, pad=0.02)
        names = ("least", "middle", "greatest")
        for axis, value, name in zip(data.axes, data.principal, names, strict=True):
            for end in (axis, -axis):
                azimuth, elevation = np.degrees([np.arctan2(end[1], end[0]), np.arcsin(end[2])])
                self.axes.plot(azimuth, elevation, marker="*", color=BLACK, markersize=12)
                self.axes.annotate(
                    f"{name} {round(1e3 * value, 2) + 0.0:.2f}",
                    (azimuth, elevation),
                    (0, -16 if elevation > 60 else 10),
                    textcoords="offset points",
                    ha="center",
                    bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1},
                )

"""The terms of the alignment's heading error over heading, pitch and latitude, and the misprint."""

from typing import Any, NamedTuple

import numpy as np

from driftlab.book.machinery.picture import BLACK, SERIES, Picture, long_table
from driftlab.checks import FloatArray
from driftlab.frames import attitude_from_angles
from driftlab.gyrocompass.alignment import align, alignment_errors
from driftlab.motion.vehicle import sensed_at_rest
from driftlab.quaternion import conjugate, rotate
from driftlab.vectors import wrap_angle

from .alignment_budget import DRIFT, LATITUDE, OFFSET

HEADING, PITCH = float(np.radians(60.0)), float(np.radians(30.0))
LABELS = (
    "east gyro",
    "east acc. by tan pitch",
    "north acc. by tan pitch",
    "east acc. by tan latitude",
)
PANELS = ("heading", "pitch", "latitude")
GRIDS: dict[str, FloatArray] = {
    "heading": np.radians(np.linspace(-180, 180, 73)),
    "pitch": np.radians(np.linspace(-85, 85, 69)),
    "latitude": np.radians(np.linspace(-85, 85, 69)),
}


class AlignmentTerms(NamedTuple):
    """Each by the quantity that varies: degrees of it, and errors in degrees."""

    terms: dict[str, FloatArray]  # (n, 4)
    exact: dict[str, FloatArray]  # (n,)
    printed: dict[str, FloatArray]  # (n,): first order, with the factor that is a misprint


def compute() -> AlignmentTerms:
    """Vary heading, pitch and latitude, each with the two others at rest."""
    terms, exact, printed = {}, {}, {}
    for panel, grid in GRIDS.items():
        at: dict[str, Any] = {"heading": HEADING, "pitch": PITCH, "latitude": LATITUDE, panel: grid}
        attitude = attitude_from_angles(at["heading"], at["pitch"], 0.0)
        rate, force = sensed_at_rest(attitude, at["latitude"])
        # The errors are given in local axes, so that the terms do not mix.
        to_body = conjugate(attitude)
        found = align(rate + rotate(to_body, DRIFT), force + rotate(to_body, OFFSET))
        gap = found.heading - at["heading"]
        formula = alignment_errors(at["heading"], at["pitch"], at["latitude"], DRIFT, OFFSET)
        terms[panel] = np.degrees(formula.heading_terms)
        exact[panel] = np.degrees(wrap_angle(gap))
        surplus = formula.heading_terms[:, 2] * (np.tan(at["latitude"]) - 1)
        printed[panel] = np.degrees(formula.heading + surplus)
    return AlignmentTerms(terms, exact, printed)


def columns(data: AlignmentTerms) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    curves = {}
    for panel in PANELS:
        grid = np.degrees(GRIDS[panel]).round(6)
        for i, label in enumerate(LABELS):
            curves[f"{label} over {panel}"] = (grid, data.terms[panel][:, i].round(8))
        curves[f"exact over {panel}"] = (grid, data.exact[panel].round(8))
        curves[f"as printed over {panel}"] = (grid, data.printed[panel].round(8))
    return long_table(curves)


class AlignmentTermsPicture(Picture[AlignmentTerms]):
    """Three panels, with one ordinate."""

    size = (10.5, 4.3)

    def build(self) -> None:
        self.panels = self.figure.subplots(1, 3, sharey=True)
        self.figure.subplots_adjust(0.065, 0.27, 0.985, 0.92, wspace=0.06)
        fixed = {
            "heading": f"heading {np.degrees(HEADING):.0f}°",
            "pitch": f"pitch {np.degrees(PITCH):.0f}°",
            "latitude": f"latitude {np.degrees(LATITUDE):.1f}°",
        }
        for panel, name in zip(self.panels, PANELS, strict=True):
            rest = ", ".join(words for other, words in fixed.items() if other != name)
            panel.set_title(f"over {name}; {rest}", fontsize=9)
            reach = 180 if name == "heading" else 90
            panel.set(xlabel=f"{name}, degrees", xlim=(-reach, reach), ylim=(-0.8, 0.8))
            # Without the ends, whose labels would run into those of the next panel.
            panel.set_xticks(np.arange(-reach, reach + 1, reach // 3)[1:-1])
        self.panels[0].set_ylabel("heading error, degrees")

    def update(self, data: AlignmentTerms) -> None:
        for panel, name in zip(self.panels, PANELS, strict=True):
            grid = np.degrees(GRIDS[name])
            for i, label in enumerate(LABELS):
                panel.plot(grid, data.terms[name][:, i], **SERIES[i], label=label)
            panel.plot(grid, data.exact[name], color=BLACK, linewidth=2.0, label="exact, all")
            panel.plot(grid, data.printed[name], **SERIES[5], label="all, formula as printed")
            panel.plot(
                grid[::4], data.terms[name].sum(axis=-1)[::4], color=BLACK, marker="o",
                markersize=4, linestyle="none", label="all, formula corrected",
            )  # fmt: skip
        handles, labels = self.panels[0].get_legend_handles_labels()
        self.figure.legend(handles, labels, loc="lower center", ncols=4, fontsize=8)

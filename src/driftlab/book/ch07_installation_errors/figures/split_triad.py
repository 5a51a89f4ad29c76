"""An error matrix taken apart, and what each part does to the three axes; Wu (7)-(15), Fig. 1."""

import numpy as np

from driftlab.book.machinery.picture import (
    BLUE,
    GREEN,
    GREY,
    VERMILION,
    Picture,
    plain_axes,
    project,
)
from driftlab.checks import FloatArray

from ..experiments import SplitTriad

EXAGGERATION = 600.0
"""How many times larger than it is an error is drawn."""

TITLES = ("the whole triad", "scale", "non-orthogonality", "misalignment")


def columns(data: SplitTriad) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the entries row by row."""
    names = ("whole", "scale", "non_orthogonality", "misalignment")
    return {name: part.ravel() for name, part in zip(names, data.parts, strict=True)}


class SplitTriadPicture(Picture[SplitTriad]):
    """Four triads: the bent one, and what each part alone would do."""

    size = (10.5, 3.3)

    def build(self) -> None:
        panels = self.figure.subplots(1, 4)
        self.figure.subplots_adjust(0.005, 0.09, 0.995, 0.88, wspace=0.02)
        self.axes_lines = []
        for panel, title in zip(panels, TITLES, strict=True):
            plain_axes(panel)
            panel.set(xlim=(-0.75, 1.45), ylim=(-0.6, 1.45))
            panel.set_title(title)
            for tip in project(np.eye(3)):
                panel.plot([0, tip[0]], [0, tip[1]], color=GREY, linewidth=1.2)
            self.axes_lines.append([
                self.line(panel, color=color, linewidth=2.2, marker=marker, markevery=[1])
                for color, marker in ((BLUE, "o"), (VERMILION, "s"), (GREEN, "^"))
            ])  # fmt: skip
        for line, label in zip(self.axes_lines[0], "xyz", strict=True):
            line.set_label(f"sensitive axis {label}")
        self.figure.legend(
            handles=[*self.axes_lines[0]], loc="lower center", ncols=3, bbox_to_anchor=(0.5, -0.01)
        )
        self.figure.text(0.005, 0.02, f"errors drawn {EXAGGERATION:g} times too large", color=GREY)

    def update(self, data: SplitTriad) -> None:
        for lines, part in zip(self.axes_lines, data.parts, strict=True):
            # The rows of I + K are the sensitive axes.
            for line, tip in zip(lines, project(np.eye(3) + EXAGGERATION * part), strict=True):
                line.set_data([0, tip[0]], [0, tip[1]])

"""An error matrix taken apart, and what each part does to the three axes; Wu (7)-(15), Fig. 1."""

import numpy as np
from scipy.constants import arcsecond, micro

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.picture import (
    BLUE,
    GREEN,
    GREY,
    VERMILION,
    Picture,
    plain_axes,
    project,
)

EXAGGERATION = 600.0
"""How many times larger than it is an error is drawn, if it is not too large for that."""
FARTHEST = 0.6
"""What an error may reach in the drawing."""

DARK_GREY = "#5c5c5c"
"""The grey of the lines, dark enough for small letters."""

TITLES = ("the whole triad", "scale", "non-orthogonality", "misalignment")


def exaggeration(table: DataTable) -> float:
    """How many times larger than they are the errors are drawn."""
    largest = float(np.abs(table.parts).max())
    if EXAGGERATION * largest <= FARTHEST:
        return EXAGGERATION
    power = 10.0 ** np.floor(np.log10(FARTHEST / largest))
    return max(step * power for step in (1.0, 2.0, 5.0) if step * power * largest <= FARTHEST)


class SplitTriadPicture(Picture):
    """Four triads with their matrices: the bent one, and what each part alone would do."""

    size = (10.5, 3.9)

    def build(self) -> None:
        self.figure, mosaic = self.sheet.mosaic(
            "abcd", self.size, (0.005, 0.02, 0.995, 0.93), spaces=(0.02, 0.2), column="ab;cd",
            column_height=4.8, page_height=2.9,
        )  # fmt: skip
        panels = list(mosaic.values())
        self.axes_lines, self.matrices = [], []
        for panel, title, sign in zip(panels, TITLES, " =++", strict=True):
            plain_axes(panel)
            panel.set(xlim=(-0.65, 1.3), ylim=(-0.68, 2.0))
            panel.set_title(title)
            panel.text(-0.72, 1.62, sign, fontsize="xx-large", ha="center", va="center")
            for tip in project(np.eye(3)):
                panel.plot([0, tip[0]], [0, tip[1]], color=GREY, linewidth=1.2)
            self.axes_lines.append([
                self.line(panel, color=color, linewidth=2.2, marker=marker, markevery=[1])
                for color, marker in ((BLUE, "o"), (VERMILION, "s"), (GREEN, "^"))
            ])  # fmt: skip
            size = 9.5 if not self.sheet.on_paper else 6.5
            matrix = self.words(panel, family="DejaVu Sans Mono", fontsize=size, ha="center",
                                va="center", linespacing=1.35)  # fmt: skip
            matrix.set_position((0.33, 1.62))
            self.matrices.append(matrix)
        # That of y stands farther out, where a lean does not carry the tip.
        for tip, name, out in zip(project(np.eye(3)), "xyz", (1.17, 1.35, 1.17), strict=True):
            for panel in panels:
                x, y = out * tip
                panel.text(x, y, name, ha="center", va="center")
        if self.sheet.on_paper:
            self.note = self.figure.supxlabel("", color=DARK_GREY, fontsize="medium")
        else:
            self.note = self.figure.text(0.005, 0.02, "", color=DARK_GREY, fontsize=8.5)

    def update(self, table: DataTable) -> None:
        factor = exaggeration(table)
        note = f"leans drawn ×{factor:g}; matrices: ″, and ppm on the diagonal"
        if note != self.note.get_text():
            self.note.set_text(note)
            self.rescaled = True
        units = np.where(np.eye(3, dtype=bool), micro, arcsecond)
        for lines, words, part in zip(self.axes_lines, self.matrices, table.parts, strict=True):
            # The rows of I + K are the sensitive axes.
            for line, tip in zip(lines, project(np.eye(3) + factor * part), strict=True):
                line.set_data([0, tip[0]], [0, tip[1]])
            rounded = np.round(part / units, 1) + 0.0  # no negative zero
            words.set_text("\n".join(" ".join(f"{x:5g}" for x in row) for row in rounded))

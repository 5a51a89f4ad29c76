"""The installation errors of two gyros in a plane, taken apart; Wu Fig. 1."""

import numpy as np

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, BLUE, GREEN, GREY, plain_axes

from .plane_axes import beside, lowest, pair, three_planes


@from_table
def draw(drawing: Drawing) -> None:
    """Draw the two gyros with both errors, with the one and with the other."""
    table, panels, narrow = drawing.table, three_planes(drawing), drawing.sheet.narrow
    closing = "close up" if table.non_orthogonality[0] >= 0 else "open"
    titles = (
        "two gyros", "misalignment: both turn alike", f"non-orthogonality: they {closing}"
    )  # fmt: skip
    parts = table.whole, table.misalignment, table.non_orthogonality
    for panel, title, sign, angles in zip(panels, titles, ("", "= ", "+ "), parts, strict=True):
        plain_axes(panel, reach=1.3)
        panel.set_title(sign + title if narrow else title)
        panel.set(xlim=(-0.62 - beside(table.whole[1]), 1.98), ylim=(lowest(table.whole[0]), 1.5))
        pair(panel, np.zeros(2), ("$x$", "$y$"), 1.3, color=GREY)
        pair(panel, angles, ("", ""), 1.1, color=BLUE, linestyle="--")
        for right, angle in zip((0.0, np.pi / 2), angles, strict=True):
            arc = right + np.linspace(0, angle, 30)
            panel.plot(0.8 * np.cos(arc), 0.8 * np.sin(arc), color=GREEN)
            # Beside the tip of the gyro.
            x, y = 1.2 * np.cos(right + angle), 1.2 * np.sin(right + angle)
            outside = "right" if right and angle > 0 else "left"
            words = f"{angle:+.2f} rad".replace("-", "−")
            panel.text(x, y, words, color=BLACK, ha=outside, va="center")
    if not narrow:
        for panel, sign in zip(panels, ("=", "+"), strict=False):
            panel.text(1.93, 0.6, sign, fontsize="xx-large", ha="center")

"""The installation errors of two gyros in a plane, taken apart; Wu Fig. 1."""

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, BLUE, GREEN, GREY, in_style, plain_axes
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import PlaneSplit
from .plane_axes import beside, lowest, pair, three_planes


def columns(data: PlaneSplit) -> dict[str, FloatArray | list[str]]:
    """Columns of the figure's CSV."""
    whole, turned, closed = data
    return {
        "gyro": ["x", "y"],
        "whole_rad": whole,
        "misalignment_rad": turned,
        "non_orthogonality_rad": closed,
    }


@in_style
def draw(data: PlaneSplit, sheet: Sheet) -> Figure:
    """Draw the two gyros with both errors, with the one and with the other."""
    figure, panels = three_planes(sheet)
    closing = "close up" if data.non_orthogonality[0] >= 0 else "open"
    titles = (
        "two gyros", "misalignment: both turn alike", f"non-orthogonality: they {closing}"
    )  # fmt: skip
    for panel, title, sign, angles in zip(panels, titles, ("", "= ", "+ "), data, strict=True):
        plain_axes(panel, reach=1.3)
        panel.set_title(sign + title if sheet.narrow else title)
        panel.set(xlim=(-0.62 - beside(data.whole[1]), 1.98), ylim=(lowest(data.whole[0]), 1.5))
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
    if not sheet.narrow:
        for panel, sign in zip(panels, ("=", "+"), strict=False):
            panel.text(1.93, 0.6, sign, fontsize="xx-large", ha="center")
    return figure

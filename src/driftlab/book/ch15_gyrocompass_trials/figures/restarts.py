"""Plotnikov Fig. 2, simulated from its description: 26 restarts, and what their spread can say."""

import numpy as np

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GREY, SERIES


@from_table
def draw(drawing: Drawing) -> None:
    """Restarts, noise before and after averaging, and the ratio of spread to deviation."""
    table, on_paper = drawing.table, drawing.sheet.on_paper
    panels = drawing.mosaic(
        "abc", (10.5, 3.8), (0.065, 0.14, 0.985, 0.91), spaces=(0.27, 0.2), page_height=2.8,
        column_height=6.2,
    )  # fmt: skip
    first, second, third = panels.values()
    heading, restarts = table.shown("aligned_heading"), len(table.aligned_heading)
    reach = max(0.25, 1.2 * np.abs(heading).max())
    first.set(xlabel="restart", ylabel="heading, degrees", ylim=(-reach, reach))
    spread, deviation = f"{np.ptp(heading):.2f}°", f"{heading.std(ddof=1):.3f}°"
    if on_paper:
        first.set_title(f"spread {spread}, deviation {deviation}")
    else:
        first.set_title(f"{restarts} restarts: spread {spread}, deviation {deviation}", fontsize=9)
    drawing.curve(first, "restart", "aligned_heading", **SERIES[0], marker="o",
                  markersize=2.5 if on_paper else 4, label="restarts")  # fmt: skip
    second.set(title="gyro noise, one restart", xlabel="time, minutes", ylabel="deg/h")
    drawing.curve(second, "sample_time", "rate", color=GREY, linewidth=0.3,
                  label="every fifth sample")  # fmt: skip
    drawing.curve(second, "mean_time", "mean_rate", color=BLACK, label=f"mean of {table.window}")
    second.legend(loc="upper right", fontsize="small" if on_paper else 8)
    edges, (most,) = table.edges, table.largest_possible_ratio
    third.set(title=f"range over deviation of {restarts}" if on_paper else
              f"range of {restarts} values over deviation", xlabel="ratio")  # fmt: skip
    third.set(ylabel="probability density", ylim=(0, max(1.6, 1.6 * table.density.max())))
    third.set(xlim=(min(2.5, edges[0] - 0.1), max(7.3, most + 0.2)))
    drawing.bar_chart(third, "range_over_standard_deviation", "density", width=np.diff(edges),
                      color=SERIES[6]["color"], label="normal samples")  # fmt: skip
    drawing.level(third, x="paper_range_over_deviation", **SERIES[1],
                  label="0.3 over 0.054, as a range")  # fmt: skip
    drawing.spans(third, "paper_ratio_rounded_from", "paper_ratio_rounded_to",
                  color=SERIES[1]["color"], alpha=0.15, label="within rounding")  # fmt: skip
    drawing.level(third, x="largest_possible_ratio", **SERIES[4], label="largest possible")
    third.legend(loc="upper right", fontsize="small" if on_paper else 7)

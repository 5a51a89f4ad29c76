"""Heading after a turn with more and more damping, and how much of the error remains."""

from scipy.constants import minute

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLUE, GREY, SERIES, legend_below_all
from driftlab.book.scenarios import DURATION


@from_table
def draw(drawing: Drawing) -> None:
    """Heading errors over time on the left; largest errors over the damping ratio on the right."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        "ab", (10.5, 3.9), (0.065, 0.24, 0.985, 0.91), spaces=(0.2, 0.3), width_ratios=[1.5, 1],
        column_height=6.0, page_height=3.2,
    )  # fmt: skip
    voyage, parts = panels["a"], panels["b"]
    for name, style in zip(table.entry("heading_error").names, SERIES, strict=False):
        drawing.curve(voyage, "time", f"heading_error, {name}", **style, label=f"ξ = {name}")
    voyage.set(title="heading error, degrees", xlabel="time, min", xlim=(0, DURATION / minute))
    drawing.curve(parts, "any_ratio", "by_formula", color=GREY, label="formula")
    drawing.curve(parts, "ratio", "remaining", color=BLUE, marker="o", linestyle="none",
                  label="simulated")  # fmt: skip
    parts.set(title="largest error over the undamped one", xlabel="damping ratio ξ", ylim=(0, 1.1))
    parts.legend(loc="upper right")
    legend_below_all(drawing.figure, sheet, voyage, 3 if sheet.on_paper else 5)


def caption(data: DataTable) -> str:
    """What the figure shows."""
    pairs = zip(data.ratio, data.remaining, strict=True)
    left = ", ".join(f"{part:.2f} at {ratio:.3g}" for ratio, part in pairs)
    return (
        "Heading error of a misaligned triad on a ship that turns, with a horizon that a speed log "
        f"damps. Without damping it is at most {data.shown('undamped'):.2f} degrees. Of this "
        f"remains, by damping ratio: {left}. The line is the largest value of the impulse response."
    )

"""A rate between its samples, guessed in three ways, and what the guess costs."""

from typing import Any

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GREY, SERIES, legend_below_all

STYLES: dict[str, dict[str, Any]] = {
    "rectangle": SERIES[1],
    "trapezoid": SERIES[2],
    "spline of degree 3": SERIES[3],
    "spline of degree 5": SERIES[0],
    "spline of degree 7": SERIES[4],
}


@from_table
def draw(drawing: Drawing) -> None:
    """Draw two periods of the rate, and the error of an increment over the samples in a period."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        "ab", (10.0, 4.3), (0.07, 0.22, 0.985, 0.91), spaces=(0.24, 0.2), column_height=5.0
    )
    rate, error = panels["a"], panels["b"]
    rate.set(title=f"{table.samples:g} samples in a period", xlabel="periods", xlim=(0, 2))
    rate.set_ylabel("rate, relative")
    drawing.curve(rate, "moment", "guess, true", color=GREY, linewidth=3.5, label="true rate")
    for name in ("rectangle", "trapezoid", "spline of degree 5"):
        drawing.curve(rate, "moment", f"guess, {name}", label=name, **STYLES[name])
    dots: dict[str, Any] = {"color": BLACK, "marker": "o", "linestyle": "none"}
    drawing.curve(rate, "sampled_at", "sampled", label="samples", **dots)
    error.set(title="error of an increment", xlabel="samples in a period", xlim=(2.2, 40))
    error.set(xscale="log", yscale="log", ylabel="relative to the largest increment")
    error.set_xticks([2.5, 5, 10, 20, 40], ["2.5", "5", "10", "20", "40"])
    error.minorticks_off()
    handles = [*rate.get_lines()[:1], *rate.get_lines()[-1:]]
    for name, style in STYLES.items():
        drawing.curve(error, "samples_a_round", f"error, {name}", label=name, **style)
    handles += error.get_lines()
    legend_below_all(drawing.figure, sheet, handles, 4, column=2, points=8)

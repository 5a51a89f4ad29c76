"""Allan plots of a cheap and a dear gyro, with the lines of their noise labelled where they run."""

from matplotlib import rcParams
from matplotlib.axes import Axes
from scipy.constants import arcsecond

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, GREY, SERIES
from driftlab.noise_terms import TERMS

from ..experiments.allan_lines import PULSE

LABELS = {
    "quantisation": "slope −1",
    "angle_random_walk": "angle random walk",
    "bias_instability": "bias instability",
    "rate_random_walk": "rate random walk",
    "rate_ramp": "rate ramp",
}
ROOM, ROOM_ON_PAPER = 1.75, 1.9
"""Factors between heights at which two labels do not touch."""


@from_table
def draw(drawing: Drawing) -> None:
    """Two panels with the same axes for times and deviations."""
    panels = drawing.mosaic(
        "ab", (10.5, 4.6), (0.075, 0.115, 0.985, 0.93), spaces=(0.05, 0.2), column_height=6.0,
        sharey=True,
    )  # fmt: skip
    cheap, dear = panels["a"], panels["b"]
    _panel(cheap, drawing, "cheap")
    _panel(dear, drawing, "dear", angle_random_walk="slope −½")
    table = drawing.table
    cheap.set_title(f"a cheap gyro: MPU-9150, {table.cheap_length:.0f} s at rest")
    dear.set_title(f"a dear one: laser gyro, {table.dear_length:.0f} s on a parked car")
    for panel in panels.values() if drawing.sheet.narrow else [cheap]:
        panel.set_ylabel("Allan deviation, °/h")
    words = "rounding of its pulses"
    drawing.curve(dear, "rounding_time", "rounding", color=GREY, linestyle=":", label=words)
    for panel, words, tip, place in (
        (cheap, "a hump near 10 Hz", (0.02, 230), (0.06, 800)),
        (dear, "the car rocks", (0.13, 62), (0.7, 240)),
        (dear, f"rounding of pulses\nof {PULSE / arcsecond:.2f}″", (0.85, 0.55), (0.012, 0.4)),
    ):
        panel.annotate(words, tip, place, fontsize="small",
                       arrowprops={"arrowstyle": "-", "color": GREY})  # fmt: skip


def _panel(panel: Axes, drawing: Drawing, gyro: str, **names: str) -> None:
    """Points with their intervals, lines that are seen, and bounds of those that are not."""
    table, labelled = drawing.table, LABELS | names
    panel.set(xscale="log", yscale="log", xlim=(0.008, 20000), ylim=(0.004, 3000))
    panel.set(xlabel="averaging time, s")
    for word, face in (("yes", BLACK), ("no", "white")):
        if word in getattr(table, f"{gyro}_in_the_fit"):
            points = (f"{gyro}_{name}" for name in ("time", "deviation", "lower", "upper"))
            drawing.error_bars(
                panel, *points, where={f"{gyro}_in_the_fit": word}, fmt="o", color=BLACK,
                markersize=0.67 * rcParams["lines.markersize"], markerfacecolor=face,
                linewidth=0.9,
            )  # fmt: skip
    drawing.curve(panel, f"{gyro}_fit_time", f"{gyro}_fit", color=BLACK, linewidth=0.8, label="fit")
    labels = []
    for name, term, series in zip(TERMS, getattr(table, f"{gyro}_terms"), SERIES, strict=False):
        if not hasattr(table, f"{gyro}_{name}"):
            continue
        words = labelled[name] if term > 0 else f"at most: {labelled[name]}"
        style = "-" if term > 0 else (0, (2, 3))
        drawing.curve(
            panel, f"{gyro}_line_time", f"{gyro}_{name}", color=series["color"], linestyle=style,
            label=words,
        )  # fmt: skip
        labels.append((table.shown(f"{gyro}_{name}")[1], words))
    place, room = 0.0, ROOM_ON_PAPER if drawing.sheet.on_paper else ROOM
    for height, words in sorted(labels):
        place = max(place * room, height)
        right = 1.25 * getattr(table, f"{gyro}_line_time")[1]
        panel.text(right, place, words, fontsize="small", va="center")

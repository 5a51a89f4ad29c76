"""Allan plots of a cheap and a dear gyro, with the lines of their noise labelled where they run."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray
from scipy.constants import arcsecond, degree, hour

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, in_style, long_table
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray
from driftlab.noise_terms import TERMS, NoiseTerms

from ..experiments.allan_lines import PULSE, ROUNDING, AllanLines, Lines

LABELS = {
    "quantisation": "slope −1",
    "angle_random_walk": "angle random walk",
    "bias_instability": "bias instability",
    "rate_random_walk": "rate random walk",
    "rate_ramp": "rate ramp",
}
UNIT = degree / hour
ROOM, ROOM_ON_PAPER = 1.75, 1.9
"""Factors between heights at which two labels do not touch."""


def columns(data: AllanLines) -> dict[str, Any]:
    """Columns of the figure's CSV: what is drawn, and beside it all else of the experiment."""
    found: dict[str, tuple[ArrayLike, ArrayLike]] = {}
    drawn: dict[str, Any] = {}
    for gyro, lines in (("cheap", data.cheap), ("dear", data.dear)):
        drawn[f"{gyro}_time_s"] = lines.times
        drawn[f"{gyro}_in_the_fit"] = np.where(_fitted(lines), "yes", "no")
        for name in ("deviation", "lower", "upper"):
            drawn[f"{gyro}_{name}_deg_per_h"] = getattr(lines, name) / UNIT
        drawn[f"{gyro}_fit_time_s"], drawn[f"{gyro}_fit_deg_per_h"] = _sum(lines)
        drawn[f"{gyro}_line_time_s"] = _ends(lines)
        for name, (_, line) in _lines(lines).items():
            drawn[f"{gyro}_{name}_deg_per_h"] = line
        for name in ("terms", "uncertainty", "bounds"):
            found[f"{gyro}: {name} over term"] = (np.arange(5.0), getattr(lines, name))
        found[f"{gyro}: fit from, s; length, s"] = (np.arange(2.0), [lines.begin, lines.length])
    drawn["rounding_time_s"], drawn["rounding_deg_per_h"] = _rounding(data.dear)
    found["dear: missed without and with slope -1"] = (np.arange(2.0), data.missed.round(5))
    found["dear: rocking, rad"] = (np.zeros(1), np.array([data.rocking]))
    found["dear: coherence with the forward gyro"] = (np.zeros(1), np.array([data.shared]))
    found["forward: walk by fit, at most by headings"] = (np.arange(2.0), data.forward)
    return {**drawn, **long_table(found)}


def restore(table: Mapping[str, list[str]]) -> AllanLines:
    """Return the data from the columns of the CSV."""
    curve, y = np.array(table["curve"]), np.array([float(word or "nan") for word in table["y"]])

    def drawn(name: str) -> FloatArray:
        return np.array([float(word) for word in table[name] if word])

    def lines(gyro: str) -> Lines:
        middle, low, high = (
            UNIT * drawn(f"{gyro}_{name}_deg_per_h") for name in ("deviation", "lower", "upper")
        )
        terms, uncertainty, bounds = (
            y[curve == f"{gyro}: {name} over term"] for name in ("terms", "uncertainty", "bounds")
        )
        begin, length = y[curve == f"{gyro}: fit from, s; length, s"].tolist()
        times = drawn(f"{gyro}_time_s")
        return Lines(times, middle, low, high, terms, uncertainty, bounds, begin, length)

    return AllanLines(
        lines("cheap"),
        lines("dear"),
        y[curve == "dear: missed without and with slope -1"],
        float(y[curve == "dear: rocking, rad"][0]),
        float(y[curve == "dear: coherence with the forward gyro"][0]),
        y[curve == "forward: walk by fit, at most by headings"],
    )


def _fitted(lines: Lines) -> NDArray[np.bool_]:
    """Which points (k,) the fit was made of."""
    return lines.times >= lines.begin * (1 - 1e-9)


def _ends(lines: Lines) -> FloatArray:
    """Averaging times (2,) between which the lines are drawn, s."""
    return lines.times[[0, -1]]


def _lines(lines: Lines) -> dict[str, tuple[bool, FloatArray]]:
    """By term, whether it is seen, and its line (2,) or that of its bound, degrees an hour."""
    found = {}
    for name, term, bound in zip(TERMS, lines.terms, lines.bounds, strict=True):
        if np.isfinite(size := float(term if term > 0 else bound)):
            noise = NoiseTerms(**{name: size})
            found[name] = (bool(term > 0), noise.deviation(_ends(lines)) / UNIT)
    return found


def _sum(lines: Lines) -> tuple[FloatArray, FloatArray]:
    """Averaging times in s, and the fit there in degrees an hour."""
    times = np.geomspace(max(lines.begin, lines.times[0]), lines.times[-1], 50)
    return times, NoiseTerms(*map(float, lines.terms)).deviation(times) / UNIT


def _rounding(lines: Lines) -> tuple[FloatArray, FloatArray]:
    """Averaging times in s, and what rounded pulses alone would do, degrees an hour."""
    return _ends(lines), NoiseTerms(quantisation=ROUNDING).deviation(_ends(lines)) / UNIT


@in_style
def draw(data: AllanLines, sheet: Sheet) -> Figure:
    """Two panels with the same axes for times and deviations."""
    figure, panels = sheet.mosaic(
        "ab", (10.5, 4.6), (0.075, 0.115, 0.985, 0.93), spaces=(0.05, 0.2), column_height=6.0,
        sharey=True,
    )  # fmt: skip
    cheap, dear = panels["a"], panels["b"]
    room = ROOM_ON_PAPER if sheet.on_paper else ROOM
    _panel(cheap, data.cheap, room)
    _panel(dear, data.dear, room, angle_random_walk="slope −½")
    cheap.set_title(f"a cheap gyro: MPU-9150, {data.cheap.length:.0f} s at rest")
    dear.set_title(f"a dear one: laser gyro, {data.dear.length:.0f} s on a parked car")
    for panel in panels.values() if sheet.narrow else [cheap]:
        panel.set_ylabel("Allan deviation, °/h")
    times, rounding = _rounding(data.dear)
    dear.plot(times, rounding, color=GREY, linestyle=":", label="rounding of its pulses")
    x, y = 0.0125, 1.3  # along the line, which falls as 1 / x
    dear.text(x, y, f"rounding of its pulses of {PULSE / arcsecond:.1f}″", color=GREY,
              fontsize="small", rotation=-np.degrees(np.arctan2(y, x)), rotation_mode="anchor",
              transform_rotates_text=True)  # fmt: skip
    for panel, words, tip, place in (
        (cheap, "a hump near 10 Hz", (0.02, 230), (0.06, 800)),
        (dear, "the car rocks", (0.13, 62), (0.7, 240)),
    ):
        panel.annotate(words, tip, place, fontsize="small",
                       arrowprops={"arrowstyle": "-", "color": GREY})  # fmt: skip
    return figure


def _panel(panel: Axes, lines: Lines, room: float, **names: str) -> None:
    """Points with their intervals, lines that are seen, and bounds of those that are not."""
    labelled = LABELS | names
    panel.set(xscale="log", yscale="log", xlim=(0.008, 20000), ylim=(0.004, 3000))
    panel.set(xlabel="averaging time, s")
    fitted = _fitted(lines)
    for chosen, face in ((fitted, BLACK), (~fitted, "white")):
        if chosen.any():
            middle, low, high = (
                part[chosen] / UNIT for part in (lines.deviation, lines.lower, lines.upper)
            )
            panel.errorbar(
                lines.times[chosen], middle, [middle - low, high - middle], fmt="o",
                markersize=0.67 * rcParams["lines.markersize"],
                color=BLACK, markerfacecolor=face, linewidth=0.9,
            )  # fmt: skip
    panel.plot(*_sum(lines), color=BLACK, linewidth=0.8, label="fit")
    wide = _ends(lines)
    labels = []
    for name, (seen, line) in _lines(lines).items():
        words = labelled[name] if seen else f"at most: {labelled[name]}"
        color = SERIES[TERMS.index(name)]["color"]
        style = "-" if seen else (0, (2, 3))
        panel.plot(wide, line, color=color, linestyle=style, label=words)
        labels.append((line[1], words))
    place = 0.0
    for height, words in sorted(labels):
        place = max(place * room, height)
        panel.text(1.25 * wide[1], place, words, fontsize="small", va="center")

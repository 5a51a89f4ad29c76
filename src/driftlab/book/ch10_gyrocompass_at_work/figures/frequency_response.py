"""Poles of the levelling loop, and how much of each disturbance passes it at each period."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.legend_handler import HandlerTuple
from matplotlib.ticker import NullLocator
from scipy.constants import arcminute, degree, hour, minute

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.book.scenarios import SARATOV_LATITUDE, SCHULER_PERIOD
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE

from ..experiments import DAY, LOOPS, SWELL, FrequencyResponse

MARKS = {
    f"a day,\n{DAY / hour:.0f} h": DAY,
    f"Schuler,\n{SCHULER_PERIOD / minute:.0f} min": SCHULER_PERIOD,
    f"swell,\n{SWELL:g} s": SWELL,
}
_HEADING = 1 / (EARTH_RATE * np.cos(SARATOV_LATITUDE) * degree)
"""Degrees of heading for a rate of one rad/s."""
PANELS: dict[str, tuple[str, str, float, float, tuple[float, float]]] = {
    "tilt, ′, by 0.01 m/s² of acceleration": (
        "acceleration", "tilt", 0.01, 1 / arcminute, (1e-3, 30)
    ),
    "heading, °, by 0.01 m/s² of acceleration": (
        "acceleration", "rate", 0.01, _HEADING, (1e-6, 1e3)
    ),
    "heading, °, by 0.01 °/h of drift": (
        "gyro_bias", "rate", 0.01 * degree / hour, _HEADING, (1e-6, 3)
    ),
    "heading, °, by 0.1 m/s of the log": ("log_error", "rate", 0.1, _HEADING, (1e-3, 0.1)),
    "heading, °, by 0.01 m/s² of offset": (
        "accelerometer_bias", "rate", 0.01, _HEADING, (1e-4, 1e5)
    ),
}  # fmt: skip
"""Title: disturbance, what of it, its size, what makes the unit of the title, reach."""
STYLES = dict(zip(LOOPS, SERIES, strict=False))


def columns(data: FrequencyResponse) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: every eighth period, gain and phase of each curve."""
    rows = slice(None, None, 8)
    table = {"period_s": data.periods[rows]}
    for title, (disturbance, part, size, unit, _) in PANELS.items():
        for name, response in data.curves[disturbance].items():
            values = size * unit * getattr(response, part)[rows]
            table[f"{title}, {name}"] = np.array([float(f"{abs(x):.6g}") for x in values])
            table[f"phase, degrees: {title}, {name}"] = np.degrees(np.angle(values)).round(4)
    return table


@in_style
def draw(data: FrequencyResponse, sheet: Sheet) -> Figure:
    """The poles; then gains over the period, slow on the left."""
    figure = Figure(figsize=(10.5, 6.6))
    axes = figure.subplots(2, 3)
    figure.subplots_adjust(0.06, 0.165, 0.985, 0.95, wspace=0.24, hspace=0.38)
    poles, *gains = axes.flat
    _draw_poles(poles)
    for panel, (title, what) in zip(gains, PANELS.items(), strict=True):
        _draw_gains(panel, data, *what)
        panel.set_title(title, fontsize=10)
    lines = [poles.plot([], [], **style)[0] for style in STYLES.values()]
    whole = [style for name, style in STYLES.items() if "log" not in name]
    thin = {"color": GREY, "linewidth": 0.9}
    lines.append(tuple(poles.plot([], [], **style | thin)[0] for style in whole))
    lines.append(poles.plot([], [], "o", color=BLACK, markersize=5, fillstyle="none")[0])
    names = [*STYLES, "the same loops, whole rate", "simulated compass"]
    several = {tuple: HandlerTuple(ndivide=None, pad=0.4)}
    figure.legend(lines, names, handler_map=several, handlelength=4, loc="lower center", ncols=3)
    return figure


def _draw_poles(panel: Axes) -> None:
    """Poles in units of Schuler's frequency; on the circle they wander with the damping."""
    swing = 2 * np.pi / SCHULER_PERIOD
    angle = np.linspace(np.pi / 2, 3 * np.pi / 2, 100)
    panel.plot(np.cos(angle), np.sin(angle), color=GREY, linewidth=0.9)
    panel.set(title="poles, over Schuler's frequency", aspect="equal")
    panel.set(xlim=(-1.75, 0.75), ylim=(-1.3, 1.3), xlabel="real part", ylabel="imaginary part")
    for (name, loop), marker in zip(LOOPS.items(), "xo+s", strict=True):
        found = loop.poles() / swing
        if np.abs(found).max() < 2:
            style = {"color": STYLES[name]["color"], "marker": marker, "linestyle": "none"}
            panel.plot(found.real, found.imag, **style, markersize=9, fillstyle="none", mew=1.8)
        else:
            far = np.abs(found).max()
            for pole in found / far:
                start, end = 1.22 * pole, 1.55 * pole
                panel.annotate(
                    "", (end.real, end.imag), (start.real, start.imag),
                    arrowprops={"arrowstyle": "-|>", "color": STYLES[name]["color"]},
                )  # fmt: skip
            panel.text(-1.7, 0.0, f"stiff:\n{far:.0f} times\nas far", va="center", fontsize=8.5)
    _draw_splitting(panel)


def _draw_splitting(panel: Axes) -> None:
    """The undamped pole on the turning Earth, enlarged."""
    swing, turning = 2 * np.pi / SCHULER_PERIOD, EARTH_RATE * np.sin(SARATOV_LATITUDE)
    upper, lower = next(iter(LOOPS.values())).poles(turning) / swing
    inset = panel.inset_axes((0.76, 0.1, 0.22, 0.42))
    heights = [upper.imag, -lower.imag]
    inset.plot([0, 0], heights, "x", color=SERIES[0]["color"], markersize=7, mew=1.6)
    inset.set(xlim=(-0.05, 0.05), ylim=(0.94, 1.06))
    inset.set_xticks([])
    inset.set_yticks([heights[1], 1.0, heights[0]], [f"{heights[1]:.3f}", "1", f"{heights[0]:.3f}"])
    inset.tick_params(labelsize=7)
    inset.grid(visible=False)
    inset.set_title("enlarged", fontsize=8)


def _draw_gains(
    panel: Axes,
    data: FrequencyResponse,
    disturbance: str,
    part: str,
    size: float,
    unit: float,
    reach: tuple[float, float],
) -> None:
    for name, response in data.curves[disturbance].items():
        values = size * unit * np.abs(getattr(response, part))
        panel.plot(data.periods, values, **STYLES[name])
        if disturbance == "accelerometer_bias" and "log" not in name:
            # The whole rate is that of the tilt: nothing else turns the horizon.
            whole = size * unit * 2 * np.pi / data.periods * np.abs(response.tilt)
            style = STYLES[name] | {"linewidth": 0.9, "color": GREY}
            panel.plot(data.periods, whole, **style, zorder=1.5)
    seen = size * unit * np.abs(data.driven[disturbance][0 if part == "tilt" else 1])
    panel.plot(data.driven_periods, seen, "o", color=BLACK, markersize=5, fillstyle="none")
    panel.set(xscale="log", yscale="log", xlim=(2 * DAY, 3.0), ylim=reach, xlabel="period")
    panel.xaxis.set_minor_locator(NullLocator())
    panel.set_xticks(list(MARKS.values()), list(MARKS))
    panel.grid(axis="x", color="#b0b0b0")

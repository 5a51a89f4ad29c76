"""Poles of the levelling loop, and how much of each disturbance passes it at each period."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.legend_handler import HandlerTuple
from matplotlib.ticker import NullLocator
from numpy.typing import NDArray
from scipy.constants import arcminute, degree, hour, minute

from driftlab.book.machinery.picture import BLACK, GREY, GUIDE, SERIES, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet
from driftlab.book.scenarios import SCHULER_PERIOD
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity

from ..experiments import DAY, SWELL, FrequencyResponse

MARKS = {
    f"a day,\n{DAY / hour:.0f} h": DAY,
    f"Schuler,\n{SCHULER_PERIOD / minute:.0f} min": SCHULER_PERIOD,
    f"swell,\n{SWELL:g} s": SWELL,
}
Kind = tuple[str, str, float, tuple[float, float]]
PANELS: dict[str, Kind] = {
    "tilt, ′, by 0.01 m/s² of acceleration": ("acceleration", "tilt", 0.01, (1e-3, 30)),
    "heading, °, by 0.01 m/s² of acceleration": ("acceleration", "rate", 0.01, (1e-6, 1e3)),
    "heading, °, by 0.01 °/h of drift": ("gyro_bias", "rate", 0.01 * degree / hour, (1e-6, 3)),
    "heading, °, by 0.1 m/s of the log": ("log_error", "rate", 0.1, (1e-3, 0.1)),
    "heading, °, by 0.01 m/s² of offset": ("accelerometer_bias", "rate", 0.01, (1e-4, 1e5)),
}
"""Title: disturbance, what of it, its size, reach of the gains."""


def _styles(data: FrequencyResponse) -> dict[str, dict[str, Any]]:
    return dict(zip(data.loops, SERIES, strict=False))


def _unit(data: FrequencyResponse, part: str) -> float:
    """Arc minutes of a tilt, or degrees of heading for a rate of one rad/s."""
    level = EARTH_RATE * np.cos(data.latitude)
    return 1 / arcminute if part == "tilt" else 1 / (level * degree)


def _gains(
    data: FrequencyResponse, kind: Kind
) -> tuple[dict[str, NDArray[np.complex128]], dict[str, FloatArray], FloatArray]:
    """Answers of the loops, sizes of those of the whole rate, and of the driven compass."""
    disturbance, part, size, _ = kind
    size = size * _unit(data, part)
    answers = {name: size * getattr(each, part) for name, each in data.curves[disturbance].items()}
    whole = {}
    if disturbance == "accelerometer_bias":
        # The whole rate is that of the tilt: nothing else turns the horizon.
        for name, each in data.curves[disturbance].items():
            if "log" not in name:
                whole[name] = size * 2 * np.pi / data.periods * np.abs(each.tilt)
    seen = size * np.abs(data.driven[disturbance][0 if part == "tilt" else 1])
    return answers, whole, seen


def columns(data: FrequencyResponse) -> dict[str, Any]:
    """Columns of the figure's CSV: poles; gain and phase of each curve; the driven compass."""
    poles = _poles(data)
    table: dict[str, Any] = {
        "loop": [name for name, found in poles.items() for _ in found],
        "pole_real": np.concatenate([found.real for found in poles.values()]),
        "pole_imaginary": np.concatenate([found.imag for found in poles.values()]),
        "undamped_pole_on_the_turning_earth_real": np.zeros(2),
        "undamped_pole_on_the_turning_earth": _split_poles(data),
        "period_s": data.periods,
        "driven_period_s": data.driven_periods,
    }
    for title, kind in PANELS.items():
        answers, whole, seen = _gains(data, kind)
        for name, answer in answers.items():
            table[f"{title}, {name}"] = np.abs(answer)
            table[f"phase, degrees: {title}, {name}"] = np.degrees(np.angle(answer)).round(4)
        for name, values in whole.items():
            table[f"{title}, whole rate, {name}"] = values
        table[f"{title}, simulated"] = seen
    return table


def _poles(data: FrequencyResponse) -> dict[str, NDArray[np.complex128]]:
    """Poles of each loop in units of Schuler's frequency."""
    swing = np.sqrt(gravity(data.latitude) / EARTH_RADIUS)
    return {name: loop.poles() / swing for name, loop in data.loops.items()}


def _split_poles(data: FrequencyResponse) -> FloatArray:
    """Imaginary parts (2,) of the undamped pole where the Earth turns, over Schuler's frequency."""
    turning = EARTH_RATE * np.sin(data.latitude)
    upper, lower = next(iter(data.loops.values())).poles(turning)
    swing = np.sqrt(gravity(data.latitude) / EARTH_RADIUS)
    return np.array([upper.imag, -lower.imag]) / swing


@in_style
def draw(data: FrequencyResponse, sheet: Sheet) -> Figure:
    """The poles; then gains over the period, slow on the left."""
    figure, panels = sheet.mosaic(
        "abc;def", (10.5, 6.6), (0.06, 0.165, 0.985, 0.95), spaces=(0.24, 0.38),
        column="ab;cd;ef", column_height=7.4, page_height=5.0,
    )  # fmt: skip
    poles, *gains = panels.values()
    _draw_poles(poles, data, sheet)
    for panel, (title, kind) in zip(gains, PANELS.items(), strict=True):
        _draw_gains(panel, data, kind, sheet)
        if sheet.on_paper:
            first, second = title.split(", by ")
            words = f"{first}, by\n{second}"
            panel.set_title(words, fontsize="small" if sheet.narrow else "medium")
            panel.set_xticks(list(MARKS.values()), ["24 h", *list(MARKS)[1:]], fontsize="small")
        else:
            panel.set_title(title, fontsize=10)
    _legend(figure, poles, data, sheet)
    return figure


def _legend(figure: Figure, poles: Axes, data: FrequencyResponse, sheet: Sheet) -> None:
    styles = _styles(data)
    lines: list[Any] = [poles.plot([], [], **style)[0] for style in styles.values()]
    whole = [style for name, style in styles.items() if "log" not in name]
    thin = {"color": GREY, "linewidth": 0.9}
    lines.append(tuple(poles.plot([], [], **style | thin)[0] for style in whole))
    size = 3 if sheet.on_paper else 5
    lines.append(poles.plot([], [], "o", color=BLACK, markersize=size, fillstyle="none")[0])
    names = [*styles, "the same loops, whole rate", "simulated compass"]
    several = {tuple: HandlerTuple(ndivide=None, pad=0.4)}
    legend_below_all(figure, sheet, lines, 3, labels=names, handler_map=several,
                     handlelength=3 if sheet.on_paper else 4, columnspacing=1.2,
                     fontsize="small" if sheet.on_paper else None)  # fmt: skip


def _draw_poles(panel: Axes, data: FrequencyResponse, sheet: Sheet) -> None:
    """Poles in units of Schuler's frequency; on the circle they wander with the damping."""
    angle = np.linspace(np.pi / 2, 3 * np.pi / 2, 100)
    panel.plot(np.cos(angle), np.sin(angle), color=GREY, linewidth=0.9, label=GUIDE)
    title = (
        "poles, over\nSchuler's frequency" if sheet.on_paper else "poles, over Schuler's frequency"
    )
    panel.set(title=title, aspect="equal")
    panel.set(xlim=(-1.75, 0.75), ylim=(-1.3, 1.3), xlabel="real part", ylabel="imaginary part")
    styles = _styles(data)
    size = 5 if sheet.on_paper else 9
    for (name, found), marker in zip(_poles(data).items(), "xo+s", strict=True):
        if np.abs(found).max() < 2:
            style = {"color": styles[name]["color"], "marker": marker, "linestyle": "none"}
            panel.plot(found.real, found.imag, **style, markersize=size, fillstyle="none",
                       mew=0.2 * size, label=name)  # fmt: skip
        else:
            far = np.abs(found).max()
            for pole in found / far:
                start, end = 1.22 * pole, 1.55 * pole
                panel.annotate(
                    "", (end.real, end.imag), (start.real, start.imag),
                    arrowprops={"arrowstyle": "-|>", "color": styles[name]["color"]}, label=GUIDE,
                )  # fmt: skip
            place = -0.8 if sheet.on_paper else -1.7
            panel.text(place, 0.0, f"stiff:\n{far:.0f} times\nas far", va="center",
                       fontsize="small" if sheet.on_paper else 8.5)  # fmt: skip
    if not sheet.on_paper:
        _draw_splitting(panel, data)


def _draw_splitting(panel: Axes, data: FrequencyResponse) -> None:
    """The undamped pole on the turning Earth, enlarged."""
    heights = _split_poles(data)
    inset = panel.inset_axes((0.76, 0.1, 0.22, 0.42))
    inset.plot([0, 0], heights, "x", color=SERIES[0]["color"], markersize=7, mew=1.6)
    inset.set(xlim=(-0.05, 0.05), ylim=(0.94, 1.06))
    inset.set_xticks([])
    inset.set_yticks([heights[1], 1.0, heights[0]], [f"{heights[1]:.3f}", "1", f"{heights[0]:.3f}"])
    inset.tick_params(labelsize=7)
    inset.grid(visible=False)
    inset.set_title("enlarged", fontsize=8)


def _draw_gains(panel: Axes, data: FrequencyResponse, kind: Kind, sheet: Sheet) -> None:
    *_, reach = kind
    answers, whole, seen = _gains(data, kind)
    styles = _styles(data)
    for name, values in answers.items():
        panel.plot(data.periods, np.abs(values), **styles[name], label=name)
        if name in whole:
            style = styles[name] | {"linewidth": 0.9, "color": GREY}
            panel.plot(data.periods, whole[name], **style, zorder=1.5, label=f"{name}, whole rate")
    panel.plot(data.driven_periods, seen, "o", color=BLACK, markersize=3 if sheet.on_paper else 5,
               fillstyle="none", label="simulated compass")  # fmt: skip
    panel.set(xscale="log", yscale="log", xlim=(2 * DAY, 3.0), ylim=reach, xlabel="period")
    panel.xaxis.set_minor_locator(NullLocator())
    panel.set_xticks(list(MARKS.values()), list(MARKS))
    panel.grid(axis="x", color="#b0b0b0")

"""Plotnikov Fig. 2, simulated from its description: 26 restarts, and what their spread can say."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import degree, hour, minute

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray
from driftlab.gyrocompass.trials import most_range_over_deviation

from ..experiments import (
    PAPER_DEVIATION,
    PAPER_SPREAD,
    Restarts,
    rounded_ratio_range,
)

EVERY = slice(None, None, 5)
"""Samples of the noise that are drawn."""


def columns(data: Restarts) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    density, edges = _density(data)
    raw_times, times = _minutes(data)
    return {
        "restart": np.arange(1.0, len(data.heading) + 1),
        "heading_deg": np.degrees(data.heading),
        "sample_time_min": raw_times,
        "rate_deg_per_h": data.raw[EVERY] / (degree / hour),
        "mean_time_min": times,
        "mean_rate_deg_per_h": data.averaged[EVERY] / (degree / hour),
        "range_over_deviation": (edges[1:] + edges[:-1]) / 2,
        "density": density,
        "paper_range_over_deviation": np.array([PAPER_SPREAD / PAPER_DEVIATION]),
        "paper_ratio_rounded_from": np.array([rounded_ratio_range()[0]]),
        "paper_ratio_rounded_to": np.array([rounded_ratio_range()[1]]),
        "largest_possible_ratio": np.array([most_range_over_deviation(len(data.heading))]),
    }


def _minutes(data: Restarts) -> tuple[FloatArray, FloatArray]:
    """Times of the samples, and of the last sample of each mean, that are drawn."""
    step = data.noises[1].interval / minute
    return (
        step * np.arange(len(data.raw))[EVERY],
        step * (np.arange(len(data.averaged)) + data.window - 1)[EVERY],
    )


def _density(data: Restarts) -> tuple[FloatArray, FloatArray]:
    """Density of the ranges in classes, and the edges of these."""
    return np.histogram(data.ranges, min(120, 10 + len(data.ranges) // 100), density=True)


@in_style
def draw(data: Restarts, sheet: Sheet) -> Figure:
    """Restarts, noise before and after averaging, and the ratio of spread to deviation."""
    figure, panels = sheet.mosaic(
        "abc", (10.5, 3.8), (0.065, 0.14, 0.985, 0.91), spaces=(0.27, 0.2), page_height=2.8,
        column_height=6.2,
    )  # fmt: skip
    first, second, third = panels.values()
    heading, restarts, unit = np.degrees(data.heading), len(data.heading), degree / hour
    small = "small" if sheet.on_paper else 8
    reach = max(0.25, 1.2 * np.abs(heading).max())
    first.set(xlabel="restart", ylabel="heading, degrees", ylim=(-reach, reach))
    spread, deviation = f"{np.ptp(heading):.2f}°", f"{heading.std(ddof=1):.3f}°"
    if sheet.on_paper:
        first.set_title(f"spread {spread}, deviation {deviation}")
    else:
        first.set_title(f"{restarts} restarts: spread {spread}, deviation {deviation}", fontsize=9)
    first.plot(np.arange(1, restarts + 1), heading, **SERIES[0], marker="o",
               markersize=2.5 if sheet.on_paper else 4, label="restarts")  # fmt: skip
    second.set(title="gyro noise, one restart", xlabel="time, minutes", ylabel="deg/h")
    raw_times, times = _minutes(data)
    second.plot(raw_times, data.raw[EVERY] / unit, color=GREY, linewidth=0.3,
                label="every fifth sample")  # fmt: skip
    second.plot(times, data.averaged[EVERY] / unit, color=BLACK, label=f"mean of {data.window}")
    second.legend(loc="upper right", fontsize=small)
    density, edges = _density(data)
    most = most_range_over_deviation(restarts)
    third.set(title=f"range over deviation of {restarts}" if sheet.on_paper else
              f"range of {restarts} values over deviation", xlabel="ratio")  # fmt: skip
    third.set(ylabel="probability density", ylim=(0, max(1.6, 1.6 * density.max())))
    third.set(xlim=(min(2.5, edges[0] - 0.1), max(7.3, most + 0.2)))
    third.bar(edges[:-1], density, np.diff(edges), align="edge", color=SERIES[6]["color"],
              label="normal samples")  # fmt: skip
    third.axvline(PAPER_SPREAD / PAPER_DEVIATION, **SERIES[1],
                  label="0.3 over 0.054, as a range")  # fmt: skip
    third.axvspan(*rounded_ratio_range(), color=SERIES[1]["color"], alpha=0.15,
                  label="within rounding")  # fmt: skip
    third.axvline(most, **SERIES[4], label="largest possible")
    third.legend(loc="upper right", fontsize="small" if sheet.on_paper else 7)
    return figure

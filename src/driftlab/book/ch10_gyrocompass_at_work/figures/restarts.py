"""Plotnikov Fig. 2, simulated from its description: 26 restarts, and what their spread can say."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import degree, hour, minute

from driftlab.book.ch09_aligning_a_gyrocompass.experiments import (
    MOVING_AVERAGE,
    WHITE,
    gyro_noise,
)
from driftlab.book.machinery.picture import BLACK, GREY, SERIES, in_style, long_table
from driftlab.book.machinery.sheet import Sheet
from driftlab.gyrocompass.trials import most_range_over_deviation

from ..experiments import (
    PAPER_DEVIATION,
    PAPER_SPREAD,
    RESTARTS,
    Restarts,
    rounded_ratio_range,
)


def columns(data: Restarts) -> dict[str, Any]:
    """Columns of the figure's CSV."""
    density, edges = np.histogram(data.ranges, np.arange(2.5, 7.3, 0.1), density=True)
    unit, rows = degree / hour, slice(None, None, 125)
    return long_table(
        {
            "heading, degrees over restart": (
                np.arange(1.0, RESTARTS + 1),
                np.degrees(data.heading).round(8),
            ),
            "mean rate, deg/h over last sample": (
                np.arange(len(data.averaged))[rows] + MOVING_AVERAGE - 1,
                (data.averaged[rows] / unit).round(8),
            ),
            "density over range in deviations": ((edges[1:] - 0.05).round(4), density.round(6)),
        }
    )


@in_style
def draw(data: Restarts, sheet: Sheet) -> Figure:
    """Restarts, noise before and after averaging, and the ratio of spread to deviation."""
    figure = Figure(figsize=(10.5, 3.8))
    first, second, third = figure.subplots(1, 3)
    figure.subplots_adjust(0.065, 0.14, 0.985, 0.91, wspace=0.27)
    heading, unit = np.degrees(data.heading), degree / hour
    first.set(xlabel="restart", ylabel="heading, degrees", ylim=(-0.25, 0.25))
    first.set_title(
        f"{RESTARTS} restarts: spread {np.ptp(heading):.2f}°, deviation {heading.std(ddof=1):.3f}°",
        fontsize=9,
    )
    first.plot(np.arange(1, RESTARTS + 1), heading, **SERIES[0], marker="o",
               markersize=4)  # fmt: skip
    second.set(title="gyro noise, one restart", xlabel="time, minutes", ylabel="deg/h")
    step = gyro_noise(WHITE[1]).interval / minute
    second.plot(step * np.arange(0, len(data.raw), 5), data.raw[::5] / unit, color=GREY,
                linewidth=0.3, label="every fifth sample")  # fmt: skip
    second.plot(step * (np.arange(len(data.averaged)) + MOVING_AVERAGE - 1), data.averaged / unit,
                color=BLACK, label=f"mean of {MOVING_AVERAGE}")  # fmt: skip
    second.legend(loc="upper right", fontsize=8)
    third.set(title=f"range of {RESTARTS} values over deviation", xlabel="ratio")
    third.set(ylabel="probability density", xlim=(2.5, 7.3), ylim=(0, 1.6))
    third.hist(data.ranges, 120, density=True, color=SERIES[6]["color"], label="normal samples")
    third.axvline(PAPER_SPREAD / PAPER_DEVIATION, **SERIES[1],
                  label="0.3 over 0.054, as a range")  # fmt: skip
    third.axvspan(*rounded_ratio_range(), color=SERIES[1]["color"], alpha=0.15,
                  label="within rounding")  # fmt: skip
    third.axvline(most_range_over_deviation(RESTARTS), **SERIES[4],
                  label="largest possible")  # fmt: skip
    third.legend(loc="upper right", fontsize=7)
    return figure

"""A laser gyro unit on a parked car: the heading of a damped compass, read in two ways."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import minute

from driftlab.book.machinery.picture import SERIES, VERMILION, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import CountedPulses


def columns(data: CountedPulses) -> dict[str, FloatArray]:
    """Columns of the figure's CSV; a pulse and what it is worth in one row."""
    return {
        "time_min": data.times / minute,
        "by_whole_rate_deg": np.degrees(data.by_whole),
        "by_integrals_deg": np.degrees(data.by_integrals),
        "pulse_m_per_s": np.atleast_1d(data.pulse),
        "pulse_over_earth_rate": np.atleast_1d(data.pulse_rate),
    }


def restore(table: Mapping[str, Sequence[str]]) -> CountedPulses:
    """Return what a CSV holds."""
    times, whole, integrals, pulse, rate = (
        np.array([float(word) for word in column if word]) for column in table.values()
    )
    return CountedPulses(
        times * minute, np.radians(whole), np.radians(integrals), pulse[0], rate[0]
    )


@in_style
def draw(data: CountedPulses, sheet: Sheet) -> Figure:
    """Both readings; and the one from the integrals, three hundred times larger."""
    figure, panels = sheet.mosaic(
        "ab", (10.5, 3.6), (0.065, 0.15, 0.985, 0.91), spaces=(0.17, 0.2), page_height=3.0
    )
    both, near = panels["a"], panels["b"]
    minutes = data.times / minute
    whole, read = np.degrees(data.by_whole), np.degrees(data.by_integrals)
    both.set(title="heading of a parked car, degrees", ylim=(-180, 180))
    both.set_yticks(range(-180, 181, 90))
    both.plot(minutes, whole, ".", color=VERMILION, markersize=2 if sheet.on_paper else 4,
              label="from the whole rate")  # fmt: skip
    both.plot(minutes, read, **SERIES[0], label="from the integrals")
    if sheet.on_paper:
        legend_below_all(figure, sheet, both, 2)
    else:
        both.legend(loc="upper right")
    middle = read.mean()
    near.set(title="from the integrals, degrees", ylim=(middle - 0.3, middle + 0.3))
    near.plot(minutes, read, **SERIES[0], label="from the integrals")
    for panel in (both, near):
        panel.set(xlabel="time, minutes", xlim=(0, minutes[-1]))
    return figure

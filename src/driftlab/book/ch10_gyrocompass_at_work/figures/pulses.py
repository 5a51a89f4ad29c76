"""A laser gyro unit on a parked car: the heading of a damped compass, read in two ways."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import minute

from driftlab.book.machinery.picture import SERIES, VERMILION, in_style
from driftlab.book.machinery.sheet import Sheet

from ..experiments import CountedPulses


@in_style
def draw(data: CountedPulses, sheet: Sheet) -> Figure:
    """Both readings; and the one from the integrals, three hundred times larger."""
    figure = Figure(figsize=(10.5, 3.6))
    both, near = figure.subplots(1, 2)
    figure.subplots_adjust(0.065, 0.15, 0.985, 0.91, wspace=0.17)
    minutes = data.times / minute
    whole, read = np.degrees(data.by_whole), np.degrees(data.by_integrals)
    both.set(title="heading of a parked car, degrees", ylim=(-180, 180))
    both.set_yticks(range(-180, 181, 90))
    both.plot(minutes, whole, ".", color=VERMILION, markersize=4, label="from the whole rate")
    both.plot(minutes, read, **SERIES[0], label="from the integrals")
    both.legend(loc="upper right")
    middle = read.mean()
    near.set(title="from the integrals, degrees", ylim=(middle - 0.3, middle + 0.3))
    near.plot(minutes, read, **SERIES[0])
    for panel in (both, near):
        panel.set(xlabel="time, minutes", xlim=(0, minutes[-1]))
    return figure

"""A misaligned triad against an ideal one that starts wrong; Wu (16)-(36), not linearised."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import arcsecond, minute

from driftlab.book.machinery.picture import GREY, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import EquivalentStart

TILTS = ("scale", "non-orthogonality", "misalignment", "$C\\kappa - C(0)\\kappa$")
SPEEDS = ("gyros turned", "accelerometers", "both", "both and the start")
LEFT = ("attitude, skew", "attitude, turned", "velocity, skew")


def columns(data: EquivalentStart) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the right panel."""
    names = ("skew_triad_rad", "turned_triad_rad", "two_skew_triads_m_s")
    # Rounding is not the same everywhere: what a turned triad leaves is nothing else, and a
    # velocity inherits it from positions of millions of metres.
    rounded = (left.round(digits) for left, digits in zip(data.left, (10, 10, 5), strict=True))
    return {"size_rad": data.sizes, **dict(zip(names, rounded, strict=True))}


@in_style
def draw(data: EquivalentStart, sheet: Sheet) -> Figure:
    """Draw attitude and velocity error over time, and what the first order leaves out."""
    figure = Figure(figsize=(10.5, 4.0))
    tilt, speed, left = panels = figure.subplots(1, 3)
    figure.subplots_adjust(0.06, 0.3, 0.985, 0.91, wspace=0.27)
    tilt.set(title="attitude error", xlabel="time, minutes", ylabel="arc seconds")
    speed.set(title="velocity error", xlabel="time, minutes", ylabel="m/s")
    left.set(title="left by first order", xscale="log", yscale="log", ylim=(1e-17, 1e2))
    left.set(xlabel="misalignment, rad", ylabel="rad, or m/s")
    left.plot(data.sizes, 1e-3 * data.sizes**2, color=GREY, linewidth=0.8)
    left.text(data.sizes[-1], 3e-8, "slope 2", color=GREY, ha="right")
    minutes = data.times / minute
    for label, style, values in zip(TILTS, SERIES, data.tilts / arcsecond, strict=False):
        tilt.plot(minutes, values, **style, label=label)
    tilt.lines[-1].set(linewidth=3.5, alpha=0.5)
    for label, style, values in zip(SPEEDS, SERIES, data.speeds, strict=False):
        speed.plot(minutes, values, **style, label=label)
    for label, style, marker, values in zip(LEFT, SERIES, "os^", data.left, strict=False):
        shown = np.maximum(values, 1e-17)
        left.plot(data.sizes, shown, **style, marker=marker, markersize=4, label=label)
    for panel in panels:
        panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.17), ncols=2)
    return figure

"""A misaligned triad against an ideal one that starts wrong; Wu (16)-(36), not linearised."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import arcsecond, minute

from driftlab.book.machinery.picture import GREY, GUIDE, SERIES, decades, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import EquivalentStart

TILTS = ("scale", "non-orthogonality", "misalignment", "$C\\kappa - C(0)\\kappa$")
SPEEDS = ("gyros turned", "accelerometers", "both", "both and the start")
LEFT = ("attitude, skew", "attitude, turned", "velocity, skew")


LEAST = 1e-17
"""Where nothing is left, on a logarithmic axis."""
POINTS = 700
"""Of a curve over time that are drawn, about."""


def _thin(data: EquivalentStart) -> slice:
    """Which moments are drawn: they lie close together."""
    return slice(None, None, max(len(data.times) // POINTS, 1))


def columns(data: EquivalentStart) -> dict[str, FloatArray]:
    """Columns of the figure's CSV; what a turned triad leaves is nothing but rounding."""
    rows = _thin(data)
    table = {"time_min": data.times[rows] / minute}
    names = ("scale", "non-orthogonality", "misalignment", "misalignment by its derivative")
    for name, values in zip(names, data.tilts, strict=True):
        table[f"attitude_error_arcsec, {name}"] = values[rows] / arcsecond
    for name, values in zip(SPEEDS, data.speeds, strict=True):
        table[f"velocity_error_m_s, {name}"] = values[rows]
    table["size_rad"] = data.sizes
    for name, values in zip(
        ("skew_triad_rad", "turned_triad_rad", "two_skew_triads_m_s"), data.left, strict=True
    ):
        table[name] = np.maximum(values, LEAST)
    return table


@in_style
def draw(data: EquivalentStart, sheet: Sheet) -> Figure:
    """Draw attitude and velocity error over time, and what the first order leaves out."""
    figure, panels = sheet.mosaic(
        "abc", (10.5, 4.0), (0.06, 0.3, 0.985, 0.91), spaces=(0.27, 0.2), column_height=8.2,
        page_height=3.4,
    )  # fmt: skip
    tilt, speed, left = panels.values()
    tilt.set(title="attitude error", xlabel="time, minutes", ylabel="arc seconds")
    speed.set(title="velocity error", xlabel="time, minutes", ylabel="m/s")
    top = decades(data.left, LEAST, 1e2)[1]
    left.set(title="left by first order", xscale="log", yscale="log", ylim=(LEAST, top))
    left.set(xlabel="misalignment, rad", ylabel="rad, or m/s")
    left.plot(data.sizes, 1e-3 * data.sizes**2, color=GREY, linewidth=0.8, label=GUIDE)
    left.text(data.sizes[-1], 3e-8, "slope 2", color=GREY, ha="right")
    rows = _thin(data)
    minutes = data.times[rows] / minute
    for label, style, values in zip(TILTS, SERIES, data.tilts[:, rows] / arcsecond, strict=False):
        tilt.plot(minutes, values, **style, label=label)
    tilt.lines[-1].set(linewidth=3.5, alpha=0.5)
    for label, style, values in zip(SPEEDS, SERIES, data.speeds[:, rows], strict=False):
        speed.plot(minutes, values, **style, label=label)
    for label, style, marker, values in zip(LEFT, SERIES, "os^", data.left, strict=False):
        shown = np.maximum(values, LEAST)
        left.plot(data.sizes, shown, **style, marker=marker, markersize=4, label=label)
    for panel in panels.values():
        below = {None: -0.17, True: -0.3, False: -0.2}[sheet.narrow if sheet.on_paper else None]
        panel.legend(
            loc="upper center",
            bbox_to_anchor=(0.5, below),
            ncols=1 if sheet.on_paper and not sheet.narrow else 2,
        )
    return figure

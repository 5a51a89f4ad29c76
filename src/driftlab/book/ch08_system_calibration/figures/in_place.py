"""A calibrated unit navigates in place, with two choices of body axes; Wu Figs. 3-5."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import arcsecond, degree, hour, kilo

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.calibration.schuler_pair import static_error_rates
from driftlab.checks import FloatArray

from ..experiments import FRAMES, InPlaceErrors

PANELS = (
    ("attitude East", "attitude", 0, arcsecond, "arc seconds"),
    ("attitude North", "attitude", 1, arcsecond, "arc seconds"),
    ("attitude Up", "attitude", 2, arcsecond, "arc seconds"),
    ("velocity East", "velocity", 0, 1.0, "m/s"),
    ("velocity North", "velocity", 1, 1.0, "m/s"),
    ("position East", "position", 0, kilo, "km"),
    ("position North", "position", 1, kilo, "km"),
)
SHORT = {"arc seconds": "″"}


def columns(data: InPlaceErrors) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    first = next(iter(data.runs.values()))
    table = {"time_h": first.times / hour}
    for words, runs in (("", data.runs), ("analytic ", data.curves)):
        for (frame, start), run in runs.items():
            for title, quantity, axis, unit, name in PANELS:
                column = f"{words}{title} in {name}, {FRAMES[frame]}, start from {start}"
                table[column] = getattr(run, quantity)[:, axis] / unit
    for (title, *_, unit, name), slow in zip(PANELS, data.slow.T, strict=True):
        table[f"without its swing, {title} in {name}"] = slow / unit
    return table


def caption(data: InPlaceErrors) -> str:
    """Say what is seen, and how far the analytic curves are from the simulated ones."""
    gaps = {key: data.gap(key).max() for key in data.runs}
    worst = max(gaps, key=gaps.__getitem__)
    way = np.linalg.norm(data.runs[worst].position, axis=-1).max()
    times = data.runs[worst].times
    turned = abs(static_error_rates(data.latitude).foucault) * times[-1] / degree
    return (
        "The paper's Figs. 3 to 5, simulated from its description; published for the typical "
        "unit of this chapter. A unit calibrated with either choice of body axes "
        "navigates at rest. If both "
        "computers start from one attitude, each in its own axes, the curves are one. If both "
        "start from the table's axes, each has its own distance to them as initial error. "
        "Thin black: the analytic curves, from what each calibration left over; their position is "
        f"within {gaps[worst]:.0f} m of the simulated one, which goes {way / kilo:.1f} km away. "
        "Dashed and thin: the first of them without its swing, which is the beginning of the "
        f"terms of 24 hours. The swing's plane turns by {turned:.0f} degrees, Foucault's exchange "
        "between East and North."
    )


@in_style
def draw(data: InPlaceErrors, sheet: Sheet) -> Figure:
    """Draw seven panels: three of attitude, two of velocity, two of position."""
    slow = dict(zip((title for title, *_ in PANELS), data.slow.T, strict=True))
    figure, panels = sheet.mosaic(
        "abcx;defg", (10.5, 5.4), (0.055, 0.1, 0.99, 0.94), column="ab;cx;de;fg",
        column_height=7.6, page_height=4.6, spaces=(0.27, 0.25), sharex=True,
    )  # fmt: skip
    corner = panels.pop("x")
    corner.axis("off")
    thick, thin, middle = (1.6, 0.5, 0.9) if sheet.on_paper else (2.6, 0.7, 1.4)
    for panel, (title, quantity, axis, unit, name) in zip(panels.values(), PANELS, strict=True):
        panel.set_title(f"{title}, {SHORT.get(name, name) if sheet.on_paper else name}",
                        fontsize="medium" if sheet.on_paper else 9)  # fmt: skip
        for ((frame, start), run), style in zip(data.runs.items(), SERIES, strict=False):
            values = getattr(run, quantity)[:, axis] / unit
            label = f"{FRAMES[frame]},\nstart: {start}"
            panel.plot(run.times / hour, values, **style, label=label, linewidth=thick)
        for key, curve in data.curves.items():
            values = getattr(curve, quantity)[:, axis] / unit
            label = "analytic" if key == next(iter(data.curves)) else "_"
            panel.plot(curve.times / hour, values, color=BLACK, linewidth=thin, label=label)
        hours = curve.times / hour
        panel.plot(hours, slow[title] / unit, color=GREY, dashes=(6, 3), linewidth=middle,
                   zorder=1, label="first one, without\nits swing: 24 hours")  # fmt: skip
        panel.set_xlim(0, hours[-1])
    for letter in "fg" if sheet.narrow else "defg":
        panels[letter].set_xlabel("time, hours")
    handles, labels = panels["a"].get_legend_handles_labels()
    corner.legend(handles, labels, loc="center", labelspacing=0.4 if sheet.on_paper else 0.8,
                  fontsize="small" if sheet.on_paper else None)  # fmt: skip
    return figure

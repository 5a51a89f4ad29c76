"""A body turned right over: what its heading loses in the vertical, and what its attitude keeps."""

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import OverTheVertical


def columns(data: OverTheVertical) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, in degrees."""
    rows = {
        "angle": data.angles,
        "heading": data.heading,
        "roll": data.roll,
        "pitch": data.pitch,
        "heading_error": data.heading_error,
        "roll_error": data.roll_error,
        "attitude_error": data.attitude_error,
        "heading_and_roll_error": data.together_error,
    }
    # Where the bow points up, roundings differ by machine.
    return {f"{name}_deg": np.degrees(row).round(7) + 0.0 for name, row in rows.items()}


@in_style
def draw(data: OverTheVertical, sheet: Sheet) -> Figure:
    """The angles on the left, their errors on the right."""
    figure, panels = sheet.mosaic(
        "ab", (10.5, 3.6), (0.07, 0.14, 0.985, 0.91), spaces=(0.2, 0.2), column_height=4.6,
        page_height=2.8,
    )  # fmt: skip
    left, right = panels["a"], panels["b"]
    for panel in (left, right):
        panel.set(xlabel="turned about the right axis, degrees", xlim=(0, 180))
        panel.set_xticks([0, 30, 60, 90, 120, 150, 180])
    left.set(title="one smooth turn, told in angles", ylabel="degrees", ylim=(-190, 190))
    left.set_yticks([-180, -90, 0, 90, 180])
    right.set(title="errors after alignment, root mean square", ylabel="degrees", yscale="log")
    angles = np.degrees(data.angles)
    for label, values, style in (
        ("heading", data.heading, SERIES[0]),
        # Half a turn is both 180 and -180 degrees; the jump at the vertical is what matters.
        ("roll", data.roll, SERIES[1]),
        ("pitch", data.pitch, SERIES[2]),
    ):
        left.plot(angles, np.degrees(values), **style, label=label)
    errors = (
        ("heading", data.heading_error, SERIES[0]),
        ("roll", data.roll_error, SERIES[1]),
        ("heading + roll", data.together_error, SERIES[3]),
        ("attitude", data.attitude_error, SERIES[4]),
    )
    for label, values, style in errors:
        right.plot(angles, np.degrees(values), **style, label=label)
    every = np.degrees([values for _, values, _ in errors])
    right.set_ylim(min(0.05, every.min() / 1.2), max(30.0, 1.2 * every.max()))
    left.legend(loc="lower left")
    right.legend(loc="upper left")
    return figure

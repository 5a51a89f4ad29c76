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
        "heading_error": data.heading_error,
        "roll_error": data.roll_error,
        "attitude_error": data.attitude_error,
        "heading_and_roll_error": data.together_error,
    }
    return {f"{name}_deg": np.degrees(row).round(7) for name, row in rows.items()}


@in_style
def draw(data: OverTheVertical, sheet: Sheet) -> Figure:
    """The angles on the left, their errors on the right."""
    figure = Figure(figsize=(10.5, 3.6))
    left, right = figure.subplots(1, 2)
    figure.subplots_adjust(0.07, 0.14, 0.985, 0.91, wspace=0.2)
    for panel in (left, right):
        panel.set(xlabel="turned about the right axis, degrees", xlim=(0, 180))
        panel.set_xticks([0, 30, 60, 90, 120, 150, 180])
    left.set(title="one smooth turn, told in angles", ylabel="degrees", ylim=(-190, 190))
    left.set_yticks([-180, -90, 0, 90, 180])
    right.set(title="errors after alignment, root mean square", ylabel="degrees")
    right.set(yscale="log", ylim=(0.05, 30))
    angles = np.degrees(data.angles)
    left.plot(angles, np.degrees(data.heading), **SERIES[0], label="heading")
    # Half a turn is both 180 and -180 degrees; the jump at the vertical is what matters.
    left.plot(angles, np.abs(np.degrees(data.roll)), **SERIES[1], label="roll")
    left.plot(angles, np.minimum(angles, 180 - angles), **SERIES[2], label="pitch")
    for label, errors, style in (
        ("heading", data.heading_error, SERIES[0]),
        ("roll", data.roll_error, SERIES[1]),
        ("heading + roll", data.together_error, SERIES[3]),
        ("attitude", data.attitude_error, SERIES[4]),
    ):
        right.plot(angles, np.degrees(errors), **style, label=label)
    left.legend(loc="lower left")
    right.legend(loc="upper left")
    return figure

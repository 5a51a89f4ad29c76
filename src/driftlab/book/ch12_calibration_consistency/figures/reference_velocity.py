"""Standard deviations against the reference velocity, on both schemes."""

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import SERIES, legend_below_all
from driftlab.motion.scheme import SCHEMES

SHOWN = {
    "gyro_scale": "gyro scale factor, ppm",
    "acc_bias": "accelerometer bias, µg",
    "pair": "non-orthogonality, ″",
    "gyro_bias": "gyro bias, °/h",
}


def caption(table: DataTable) -> str:
    """Say what becomes better known on a table that is known to be still, and what does not."""
    bias = table.gyro_bias[0, 0] / table.gyro_bias[0, -1]
    push = table.acc_bias[0, 0] / table.acc_bias[0, -1]
    return (
        "Largest standard deviation of each kind of sensor error after a calibration, against the "
        "reference velocity that the filter assumes. On the nineteen positions the gyro bias at "
        f"the left end is {bias:.2f} of the one at the right end, the accelerometer bias "
        f"{push:.2f}. Defaults: 10 µm/s to 1 cm/s. Below 0.1 mm/s the noise of the sensors decides."
    )


@from_table
def draw(drawing: Drawing) -> None:
    """Draw one panel for each scheme."""
    panels = drawing.mosaic(
        "ab", (9.6, 4.2), (0.075, 0.28, 0.985, 0.91), spaces=(0.15, 0.2), page_height=3.2,
        column_height=5.4, sharey=True,
    )  # fmt: skip
    for panel, scheme in zip(panels.values(), SCHEMES, strict=True):
        for (name, label), style in zip(SHOWN.items(), SERIES, strict=False):
            drawing.curve(
                panel, "reference_velocity", f"{name}, {scheme}", **style, marker="o",
                markersize=3, label=label,
            )  # fmt: skip
        panel.set(title=scheme, xscale="log", yscale="log", xlabel="reference velocity, mm/s")
    panels["a"].set(ylabel="1σ, in its unit")
    legend_below_all(drawing.figure, drawing.sheet, panels["a"], ncols=2)

"""All 21 sensor errors of one calibration: what is left, and three standard deviations."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import minute

from driftlab.book.machinery.picture import SERIES, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import CalibrationErrors, unit_of

WIDE = "abc;def;ghi;jkl;mno;pqr;stu"
SHORT = {"arc seconds": "″", "deg/h": "°/h"}


def columns(data: CalibrationErrors) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, in engineering units."""
    table = {"time_min": data.times / minute}
    for i, name in enumerate(data.names):
        size, unit = unit_of(name)
        table[f"size of the error of {name}, {unit}"] = np.abs(data.errors[:, i]) / size
        table[f"three deviations of {name}, {unit}"] = 3 * data.deviations[:, i] / size
    return table


@in_style
def draw(data: CalibrationErrors, sheet: Sheet) -> Figure:
    """Draw seven rows of three small panels."""
    figure, panels = sheet.mosaic(
        WIDE, (10.5, 10.5), (0.065, 0.085, 0.99, 0.975), column=WIDE, column_height=8.0,
        page_height=8.5, spaces=(0.18, 0.36), sharex=True,
    )  # fmt: skip
    minutes = data.times / minute
    thick = 0.8 if sheet.on_paper else None
    for panel, name, error, deviation in zip(
        panels.values(), data.names, data.errors.T, data.deviations.T, strict=True
    ):
        size, unit = unit_of(name)
        panel.plot(minutes, np.abs(error) / size, **SERIES[0], linewidth=thick,
                   label="size of the error")  # fmt: skip
        panel.plot(
            minutes,
            3 * deviation / size,
            **SERIES[1],
            linewidth=thick,
            label="three standard deviations that the filter states",
        )
        bottom, top = deviation[-1] / size / 10, 6 * deviation[0] / size
        panel.set(yscale="log", ylim=(bottom, top), xlim=(0, minutes[-1]))
        panel.minorticks_off()
        if sheet.on_paper:
            words = name.replace("accelerometer", "acc.").replace("orthogonality", "orth.")
            kind, which = words.rsplit(" ", 1)
            between = "\n" if sheet.narrow else " "
            words = f"{kind}{between}{which}, {SHORT.get(unit, unit)}"
            panel.set_title(words, fontsize="small" if sheet.narrow else "medium")
        else:
            panel.set_title(f"{name}, {unit}", fontsize=9)
    for letter in WIDE.split(";")[-1]:
        panels[letter].set_xlabel("time, minutes")
    legend_below_all(figure, sheet, panels["a"], ncols=2, column=1)
    return figure

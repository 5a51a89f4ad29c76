"""What a rotation scheme shows: eigenvalues of the Gramian, and the accuracy to expect."""

import numpy as np

from driftlab.book.machinery.picture import BLACK, BLUE, GREY, VERMILION, Picture
from driftlab.calibration.error_model import FULL
from driftlab.checks import FloatArray

from ..experiments import TableObservability

DARK_GREY = "#5c5c5c"
FLOOR = 1e-21
"""Below it an eigenvalue, relative to the largest, is drawn as zero."""

DRAWN_ZERO = 1e-13
"""Where zero is drawn: below all eigenvalues that are none, so that these have the room."""


def columns(data: TableObservability) -> dict[str, FloatArray | list[str]]:
    """Columns of the figure's CSV; eigenvalues as logarithms, zero as the floor."""
    return {
        "log10 of eigenvalue": np.log10(np.maximum(data.eigenvalues, FLOOR)).round(3),
        "state": list(data.names),
        "after_over_before": _ratios(data).round(5),
    }


def _ratios(data: TableObservability) -> FloatArray:
    """Deviation after the scheme over that before; one where nothing was known or to be known."""
    known = data.before > 0
    return np.where(known, data.after / np.where(known, data.before, 1.0), 1.0)


class TableObservabilityPicture(Picture[TableObservability]):
    """Eigenvalues on the left, accuracy of each sensor error on the right."""

    size = (10.5, 4.0)

    def build(self) -> None:
        values, ratios = self.figure.subplots(1, 2, gridspec_kw={"width_ratios": [0.62, 1.0]})
        self.figure.subplots_adjust(0.065, 0.27, 0.99, 0.91, wspace=0.16)
        values.set(
            title="how strongly each direction shows",
            xlabel="eigenvalue of the Gramian, by size",
            yscale="log",
        )
        values.set(xlim=(0, 31), ylim=(DRAWN_ZERO / 10, 10), ylabel="relative to the largest")
        values.set_yticks([1e-12, 1e-9, 1e-6, 1e-3, 1])
        values.axhline(DRAWN_ZERO, color=GREY, linewidth=0.8)
        values.text(
            30.5,
            1.7 * DRAWN_ZERO,
            "zero: not observable",
            color=DARK_GREY,
            ha="right",
            fontsize=8.5,
        )
        self.bright = self.line(values, color=BLUE, marker="o", linestyle="none", markersize=4)
        self.unobservable = self.line(
            values, color=VERMILION, marker="X", linestyle="none", markersize=7
        )
        ratios.set(
            title="deviation after the scheme, over that before: lower is better", yscale="log"
        )
        ratios.set(xlim=(-0.7, len(SLOTS) - 0.3), ylim=(5e-4, 2))
        self.ratio_axes = ratios
        ratios.axhline(1.0, color=BLACK, linewidth=0.8)
        ratios.set_xticks(range(len(SLOTS)), SLOTS, rotation=55, ha="right", fontsize=7.5)
        self.ratios = self.line(ratios, color=BLUE, marker="o", linestyle="none", markersize=5)

    def update(self, data: TableObservability) -> None:
        numbers = np.arange(1, len(data.eigenvalues) + 1)
        values = np.maximum(data.eigenvalues, DRAWN_ZERO)
        self.unobservable.set_data(
            numbers[: data.unobservable], np.full(data.unobservable, DRAWN_ZERO)
        )
        self.bright.set_data(numbers[data.unobservable :], values[data.unobservable :])
        low = 5e-4 if _ratios(data)[6:].min() >= 5e-4 else 1e-5
        self.set_limits(self.ratio_axes, "y", low, 2.0)
        self.ratios.set_data(
            [SLOTS.index(_slot(name)) for name in data.names[6:]], _ratios(data)[6:]
        )


def _slot(name: str) -> str:
    """Place of a sensor error on the axis, the same for all choices of states."""
    words = name.replace("accelerometer", "acc.").split()
    return " ".join(word for word in words if word not in ("installation", "non-orthogonality"))


SLOTS = [_slot(name) for name in FULL.names[6:]]

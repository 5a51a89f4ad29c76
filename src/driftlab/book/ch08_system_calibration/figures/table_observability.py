"""What a rotation scheme shows: eigenvalues of the Gramian, and the accuracy to expect."""

import numpy as np

from driftlab.book.machinery.picture import BLACK, BLUE, GREY, GUIDE, VERMILION, Picture
from driftlab.calibration.error_model import FULL
from driftlab.checks import FloatArray

from ..experiments import TableObservability

DARK_GREY = "#5c5c5c"
DRAWN_ZERO = 1e-13
"""Where zero is drawn: below all eigenvalues that are none, so that these have the room."""


def columns(data: TableObservability) -> dict[str, FloatArray | list[str]]:
    """Columns of the figure's CSV; zero as it is drawn."""
    values = _drawn(data)
    count = len(values)
    return {
        "direction": np.arange(1.0, count + 1),
        "eigenvalue_relative": values,
        "direction_is": ["not observable" if k < data.unobservable else "observable"
                         for k in range(count)],
        "sensor_error": list(data.names[6:]),
        "deviation_after_over_before": _ratios(data)[6:],
    }  # fmt: skip


def caption(data: TableObservability) -> str:
    """Say how many eigenvalues are zero, and how many sensor errors become known."""
    zeros = "1 eigenvalue of the Gramian is" if data.unobservable == 1 else (
        f"{data.unobservable} eigenvalues of the Gramian are"
    )  # fmt: skip
    ratios = _ratios(data)[6:]
    return (
        f"{len(data.names)} states on {data.positions} positions. Left: {zeros} zero but for "
        "rounding (crosses). Right: what is left of the deviation of each sensor error; "
        f"{np.count_nonzero(ratios < 0.1)} of {len(ratios)} become known to a tenth or better. "
        "Published for all 30 states on the nineteen positions: there biases and scale errors "
        "still become known; of the off-diagonal entries only combinations do."
    )


def _drawn(data: TableObservability) -> FloatArray:
    """Eigenvalues, those of directions that are not observable as `DRAWN_ZERO`."""
    values = np.maximum(data.eigenvalues, DRAWN_ZERO)
    values[: data.unobservable] = DRAWN_ZERO
    return values


def _ratios(data: TableObservability) -> FloatArray:
    """Deviation after the scheme over that before; one where nothing was known or to be known."""
    known = data.before > 0
    return np.where(known, data.after / np.where(known, data.before, 1.0), 1.0)


class TableObservabilityPicture(Picture[TableObservability]):
    """Eigenvalues on the left, accuracy of each sensor error on the right."""

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic(
            "ab", (10.5, 4.0), (0.065, 0.27, 0.99, 0.91), spaces=(0.16, 0.2),
            width_ratios=(0.62, 1.0), page_height=3.3, column_height=5.0,
        )  # fmt: skip
        values, ratios = panels["a"], panels["b"]
        values.set(
            title="how strongly each direction shows",
            xlabel="eigenvalue of the Gramian, by size",
            yscale="log",
        )
        values.set(xlim=(0, 31), ylim=(DRAWN_ZERO / 10, 10), ylabel="relative to the largest")
        values.set_yticks([1e-12, 1e-9, 1e-6, 1e-3, 1])
        values.axhline(DRAWN_ZERO, color=GREY, linewidth=0.8, label=GUIDE)
        values.text(
            30.5,
            1.7 * DRAWN_ZERO,
            "zero: not observable",
            color=DARK_GREY,
            ha="right",
            fontsize="medium" if self.sheet.on_paper else 8.5,
        )
        small, large = (2.5, 4) if self.sheet.on_paper else (4, 7)
        self.bright = self.line(values, color=BLUE, marker="o", linestyle="none", markersize=small,
                                label="observable")  # fmt: skip
        self.unobservable = self.line(
            values, color=VERMILION, marker="X", linestyle="none", markersize=large,
            label="not observable",
        )  # fmt: skip
        narrow = "deviation after the scheme, over that before"
        ratios.set(title=narrow if self.sheet.narrow else f"{narrow}: lower is better")
        ratios.set(yscale="log")
        ratios.set(xlim=(-0.7, len(SLOTS) - 0.3), ylim=(5e-4, 2))
        self.ratio_axes = ratios
        ratios.axhline(1.0, color=BLACK, linewidth=0.8, label=GUIDE)
        if self.sheet.narrow:
            ratios.set_xticks(range(len(SLOTS)), SLOTS, rotation=90, fontsize=5.6)
        else:
            size = 6.5 if self.sheet.on_paper else 7.5
            ratios.set_xticks(range(len(SLOTS)), SLOTS, rotation=55, ha="right", fontsize=size)
        self.ratios = self.line(ratios, color=BLUE, marker="o", linestyle="none",
                                markersize=3 if self.sheet.on_paper else 5,
                                label="sensor errors")  # fmt: skip

    def update(self, data: TableObservability) -> None:
        numbers = np.arange(1, len(data.eigenvalues) + 1)
        values = _drawn(data)
        self.unobservable.set_data(numbers[: data.unobservable], values[: data.unobservable])
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

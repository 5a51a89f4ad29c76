"""Attitude algorithms on one motion: the error over time, and against the sample rate."""

from collections.abc import Iterable, Sequence
from itertools import cycle
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from driftlab.attitude.coning_algorithms import ALGORITHMS
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.picture import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    GUIDE,
    ORANGE,
    PURPLE,
    SERIES,
    Picture,
    legend_below_all,
)
from driftlab.book.machinery.figure.sheet import SCREEN, Sheet

from ..experiments import DURATION, SAMPLE_RATES

MARKERS = "osD^vPX*"
STYLES = {
    name: {**style, "marker": marker, "markersize": 4.5}
    for name, style, marker in zip(ALGORITHMS, SERIES, MARKERS, strict=False)
}
"""Line style of each algorithm, the same in every figure."""
OWN_STYLES = tuple(
    {"color": color, "linestyle": dashes, "marker": marker, "markersize": 6, "linewidth": 2.2}
    for color, dashes, marker in zip(
        (BLACK, ORANGE, PURPLE, GREEN, BLUE), ("-", "--", "-.", ":", (0, (6, 1))), "phd<8",
        strict=True,
    )
)  # fmt: skip
"""For algorithms of a reader's own, thicker than the others."""

TICKS = {
    1e-9: "10⁻⁹″", 1e-6: "10⁻⁶″", 1e-3: "0.001″", 1.0: "1″", 60.0: "1′", 3600.0: "1°",
    360000.0: "100°",
}  # fmt: skip
"""Errors in seconds of arc, and how they are called at the axis."""
BOTTOMS = (1e-2, 1e-4, 1e-7, 1e-10)
TOPS = (1.0, 100.0, 1e4, 1e6)
"""Where the axis of the errors may begin and end, seconds of arc."""
ORDERS = (2, 3, 4)
CROWDED = 1e8
"""On an axis of the errors over more than this, the names of the orders would touch on paper."""


def styles(names: Iterable[str], sheet: Sheet = SCREEN) -> dict[str, dict[str, Any]]:
    """Return a line style for each algorithm, of the book's own or not, by name."""
    own = cycle(OWN_STYLES)
    looks = {name: dict(STYLES[name] if name in STYLES else next(own)) for name in names}
    if sheet.on_paper:
        for look in looks.values():
            del look["markersize"]
            if "linewidth" in look:
                look["linewidth"] = 1.6
    return looks


def draw_slopes(
    panel: Axes, rate: float, top: float, named: Sequence[int] = ORDERS, **words: Any
) -> None:
    """Draw lines of order 2, 3 and 4 that begin at a sample rate in Hz and the error `top`."""
    rates = np.array([rate, 9.0 * rate])
    for order in ORDERS:
        errors = top * (rates / rates[0]) ** -float(order)
        panel.plot(rates, errors, color=GREY, linewidth=0.8, label=GUIDE)
        if order in named:
            place = 1.05 * rates[1], errors[1]
            panel.text(*place, f"order {order}", color=GREY, va="center", **words)


class AlgorithmLaboratoryPicture(Picture):
    """Error over time at one rate, and the largest error at all rates."""

    size = (10.5, 4.4)

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic(
            "ab", self.size, (0.06, 0.21, 0.985, 0.92), spaces=(0.05, 0.2), column_height=5.6,
            page_height=3.5, sharey=True,
        )  # fmt: skip
        history, order = panels["a"], panels["b"]
        self.order_axes = order
        history.set(title="error of attitude after each step", xlabel="time, s")
        history.set(xlim=(0, DURATION), yscale="log")
        order.set(title=f"largest error in {DURATION:g} s: steeper is better", xscale="log")
        order.set(xlabel="sample rate, Hz", xlim=(10.5, 220))
        order.set_xticks(SAMPLE_RATES, [str(rate) for rate in SAMPLE_RATES])
        order.minorticks_off()
        history.set_yticks(list(TICKS), list(TICKS.values()))
        history.set_yticks([], minor=True)
        self.slopes = [self.line(order, color=GREY, linewidth=0.8) for _ in ORDERS]
        size = "small" if self.sheet.on_paper else None
        self.slope_names = [
            self.words(order, color=GREY, va="center", fontsize=size) for _ in ORDERS
        ]
        looks = styles(STYLES, self.sheet)
        self.here = self.line(order, color=BLACK, linewidth=0.8, linestyle=(0, (2, 2)))
        self.histories = {
            name: self.line(history, **{**style, "marker": ""}) for name, style in looks.items()
        }
        self.orders = {name: self.line(order, **style, label=name) for name, style in looks.items()}
        most = 4 if self.sheet.on_paper else len(STYLES)
        legend_below_all(self.figure, self.sheet, order, most, points=8, frameon=False)

    def update(self, table: DataTable) -> None:
        for name in STYLES:
            for lines, x, y in (
                (self.histories, f"time, {name}", f"error, {name}"),
                (self.orders, "rate", f"largest_error, {name}"),
            ):
                ticked = name in table.orders
                at, error = (table.shown(each) if ticked else np.empty(0) for each in (x, y))
                # No error at all has no place on a logarithmic axis.
                lines[name].set_data(at, np.where(error > 0, error, np.nan))
        self._scale(table)
        self.here.set_data([table.at_rate, table.at_rate], self.order_axes.get_ylim())

    def _scale(self, table: DataTable) -> None:
        """Fit the axes, and let the lines of known order begin below the middle of them."""
        # What is far below rounding says nothing; the first steps of a history may be exact.
        told = table.shown("largest_error")[np.isfinite(table.largest_error)]
        least = told.min(initial=TOPS[-1], where=told > 0.02 * table.shown("rounding"))
        low = next(step for step in BOTTOMS if step <= 0.3 * least or step == BOTTOMS[-1])
        high = next(step for step in TOPS if told.max() <= step or step == TOPS[-1])
        self.set_limits(self.order_axes, "y", low, high)
        rates = SAMPLE_RATES[0] * np.array([1.0, 3.0])
        top = low * (high / low) ** 0.36
        crowded = self.sheet.on_paper and high > CROWDED * low
        for order, line, name in zip(ORDERS, self.slopes, self.slope_names, strict=True):
            errors = top * (rates / rates[0]) ** -float(order)
            line.set_data(rates, errors)
            name.set_position((1.05 * rates[1], errors[1]))
            told = errors[1] > 1.5 * low and not (crowded and order == 3)
            name.set_text(f"order {order}" if told else "")

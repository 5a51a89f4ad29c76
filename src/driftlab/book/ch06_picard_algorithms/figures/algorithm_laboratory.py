"""Attitude algorithms on one motion: the error over time, and against the sample rate."""

import numpy as np
from matplotlib.axes import Axes
from scipy.constants import arcsecond

from driftlab.attitude.coning_algorithms import ALGORITHMS
from driftlab.book.machinery.picture import BLACK, GREY, SERIES, Picture

from ..experiments import DURATION, SAMPLE_RATES, AlgorithmLaboratory

MARKERS = "osD^vPX*"
STYLES = {
    name: {**style, "marker": marker, "markersize": 4.5}
    for name, style, marker in zip(ALGORITHMS, SERIES, MARKERS, strict=False)
}
"""Line style of each algorithm, the same in every figure."""


def draw_slopes(panel: Axes, rate: float, top: float) -> None:
    """Draw lines of order 2, 3 and 4 that begin at a sample rate in Hz and the error `top`."""
    rates = np.array([rate, 9.0 * rate])
    for order in (2, 3, 4):
        errors = top * (rates / rates[0]) ** -float(order)
        panel.plot(rates, errors, color=GREY, linewidth=0.8)
        panel.text(1.05 * rates[1], errors[1], f"order {order}", color=GREY, va="center")


class AlgorithmLaboratoryPicture(Picture[AlgorithmLaboratory]):
    """Error over time at one rate, and the largest error at all rates."""

    size = (10.5, 4.4)

    def build(self) -> None:
        history, order = self.figure.subplots(1, 2, sharey=True)
        self.figure.subplots_adjust(0.075, 0.21, 0.985, 0.92, wspace=0.08)
        history.set(title="error after each step", xlabel="time, s", xlim=(0, DURATION))
        history.set(ylabel="error of attitude, arc seconds", yscale="log", ylim=(1e-10, 1e6))
        order.set(title=f"largest error in {DURATION:g} s", xscale="log", yscale="log")
        order.set(xlabel="sample rate, Hz", xlim=(10.5, 220))
        order.set_xticks(SAMPLE_RATES, [str(rate) for rate in SAMPLE_RATES])
        order.minorticks_off()
        draw_slopes(order, SAMPLE_RATES[0], 5e-6)
        self.here = self.line(order, color=BLACK, linewidth=0.8, linestyle=(0, (2, 2)))
        self.histories = {
            name: self.line(history, **{**style, "marker": ""}) for name, style in STYLES.items()
        }
        self.orders = {
            name: self.line(order, **style, label=name) for name, style in STYLES.items()
        }
        self.figure.legend(
            handles=list(self.orders.values()), loc="lower center", ncols=len(STYLES), fontsize=8
        )

    def update(self, data: AlgorithmLaboratory) -> None:
        for name in STYLES:
            shown = data.names.index(name) if name in data.names else None
            if shown is None:
                self.histories[name].set_data([], [])
                self.orders[name].set_data([], [])
                continue
            # No error at all has no place on a logarithmic axis.
            history, worst = (
                np.where(error > 0, error / arcsecond, np.nan)
                for error in (data.histories[shown], data.worst[shown])
            )
            self.histories[name].set_data(data.times[shown], history)
            self.orders[name].set_data(data.rates, worst)
        self.here.set_data([data.rate, data.rate], [1e-10, 1e6])

"""Attitude algorithms on one motion: the error over time, and against the sample rate."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes

from driftlab.attitude.coning_algorithms import ALGORITHMS, attitude_algorithm
from driftlab.attitude.finite_precision import integrate_in_word
from driftlab.attitude.integration import step_quaternions
from driftlab.book.machinery.picture import BLACK, GREY, SERIES, Picture
from driftlab.checks import FloatArray
from driftlab.motion.profiles import Coning, FixedAxis, Motion, Sway
from driftlab.quaternion import conjugate, cumulative_product, multiply, rotation_angle

DURATION = 2.0
"""Seconds of motion."""
RATES = (12, 24, 48, 96, 192)
"""Sample rates in Hz: each gives a multiple of six increments, so all algorithms can be tried."""
MOTIONS: dict[str, type[Coning] | type[Sway] | type[FixedAxis]] = {
    "coning": Coning,
    "swaying ship": Sway,
    "fixed axis": FixedAxis,
}
MARKERS = "osD^vPX"
STYLES = {
    name: {**style, "marker": marker, "markersize": 4.5}
    for name, style, marker in zip(ALGORITHMS, SERIES, MARKERS, strict=False)
}
"""Line style of each algorithm, the same in every figure."""


class AlgorithmLaboratory(NamedTuple):
    """Errors are angles in rad, by algorithm in the order of `names`."""

    names: tuple[str, ...]
    rate: int  # Hz
    times: list[FloatArray]  # s, ends of the steps
    histories: list[FloatArray]  # error at these times
    rates: FloatArray  # (m,), Hz
    worst: FloatArray  # (algorithm, m): largest error during the motion for each rate
    rounding: float  # below this an error is not told from rounding


def compute(
    motion: Motion,
    rate: int,
    names: Sequence[str],
    *,
    rates: Sequence[int] = RATES,
    short_word: bool = False,
) -> AlgorithmLaboratory:
    """Try the algorithms `names` on a motion, at one sample rate in Hz and at all `rates`."""
    if rate not in rates:
        raise ValueError(f"rate: expected one of {', '.join(map(str, rates))} Hz, got {rate!r}.")
    samples = [attitude_algorithm(name).samples for name in names]
    worst = np.empty((len(names), len(rates)))
    histories: dict[int, FloatArray] = {}
    for j, sample_rate in enumerate(rates):
        count = round(DURATION * sample_rate)
        increments = motion.increments(1 / sample_rate, count)
        moments = np.arange(count + 1) / sample_rate
        exact = motion.attitude(moments)
        # Algorithms whose steps are equally long go together: each call has its price.
        for step in sorted(set(samples)):
            group = [i for i, length in enumerate(samples) if length == step]
            chosen = [names[i] for i in group]
            found = _attitudes(increments, chosen, exact[0], short_word=short_word)
            errors = rotation_angle(multiply(conjugate(exact[step::step]), found))
            worst[group, j] = errors.max(axis=-1)
            if sample_rate == rate:
                histories |= dict(zip(group, errors, strict=True))
    times = [step * np.arange(1.0, len(histories[i]) + 1) / rate for i, step in enumerate(samples)]
    rounding = 1e-5 if short_word else 1e-12
    return AlgorithmLaboratory(
        tuple(names),
        rate,
        times,
        [histories[i] for i in range(len(names))],
        np.array(rates, dtype=np.float64),
        worst,
        rounding,
    )


def _attitudes(
    increments: FloatArray, names: Sequence[str], start: FloatArray, *, short_word: bool
) -> FloatArray:
    """Attitudes (algorithm, n // samples, 4) of algorithms with equally many samples a step."""
    if short_word:
        attitudes = [integrate_in_word(increments, name, start=start) for name in names]
        return np.array(attitudes, dtype=np.float64)
    steps = [step_quaternions(increments, name) for name in names]
    return multiply(start, cumulative_product(np.stack(steps)))


def fitted_orders(data: AlgorithmLaboratory) -> list[float | None]:
    """Slope of each algorithm's error over the sample interval; None where rounding hides it.

    Fitted to the errors below 1e-2 rad, where they are small, and above the level of rounding.
    """
    orders: list[float | None] = []
    for errors in data.worst:
        used = (errors < 1e-2) & (errors > data.rounding)
        if used.sum() < 3:
            orders.append(None)
        else:
            slope = np.polyfit(np.log(data.rates[used]), np.log(errors[used]), 1)[0]
            orders.append(float(-slope))
    return orders


def columns(data: AlgorithmLaboratory) -> dict[str, FloatArray]:
    """Columns of a CSV: the largest error for each rate, in rad."""
    return {"rate_hz": data.rates, **dict(zip(data.names, data.worst, strict=True))}


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
        order.set_xticks(RATES, [str(rate) for rate in RATES])
        order.minorticks_off()
        draw_slopes(order, RATES[0], 5e-6)
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
        arc_seconds = 3600 * np.degrees(1.0)
        for name in STYLES:
            shown = data.names.index(name) if name in data.names else None
            if shown is None:
                self.histories[name].set_data([], [])
                self.orders[name].set_data([], [])
                continue
            # No error at all has no place on a logarithmic axis.
            history, worst = (
                np.where(error > 0, arc_seconds * error, np.nan)
                for error in (data.histories[shown], data.worst[shown])
            )
            self.histories[name].set_data(data.times[shown], history)
            self.orders[name].set_data(data.rates, worst)
        self.here.set_data([data.rate, data.rate], [1e-10, 1e6])

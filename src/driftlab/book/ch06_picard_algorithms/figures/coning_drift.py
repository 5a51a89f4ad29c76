"""Apparent drift on a coning motion: measured, and by the closed formula."""

from typing import NamedTuple

import numpy as np

from driftlab.attitude.coning_algorithms import ALGORITHMS, coning_drift
from driftlab.attitude.integration import integrate
from driftlab.book.machinery.picture import Picture, long_table
from driftlab.checks import FloatArray
from driftlab.motion.profiles import Coning
from driftlab.quaternion import conjugate, multiply, to_rotation_vector

from .algorithm_laboratory import STYLES

HALF_ANGLE = float(np.radians(1.0))
FREQUENCY = 5.0
"""Coning of the second panel, Hz."""
RATE = 100.0
"""Sample rate of the first panel, Hz."""
FREQUENCIES: FloatArray = np.array([1.0, 2, 3, 5, 8, 12, 18, 25, 33])
RATES: FloatArray = np.array([15.0, 20, 30, 50, 100, 200, 400, 800])
CURVES = {
    "picard-1": "picard-1",
    "two-step-4": "one-step-3, two-step-3, two-step-4 and rotation-vector-2, which are equal",
    "memory-4": "memory-4",
    "rotation-vector-3": "rotation-vector-3",
}
"""What is drawn, with its label: four algorithms have the same formula."""
DEGREES_PER_HOUR = 3600 * float(np.degrees(1.0))
STEPS = 60


class ConingDrift(NamedTuple):
    """Sizes of the drift in rad/s, by algorithm in the order of `ALGORITHMS`."""

    frequencies: FloatArray  # (m,), Hz, at `RATE`
    by_frequency: FloatArray  # (algorithm, m)
    rates: FloatArray  # (n,), Hz, at `FREQUENCY`
    by_rate: FloatArray  # (algorithm, n)


def measured_drift(algorithm: str, half_angle: float, frequency: float, rate: float) -> float:
    """Drift in rad/s of an algorithm that runs for `STEPS` steps.

    Seen from the axis of the cone all steps are alike, so the error's component along that axis
    grows by the same amount at each: a few steps tell the drift as well as many.
    """
    motion, chosen = Coning(half_angle, frequency), ALGORITHMS[algorithm]
    count = STEPS * chosen.samples
    increments = motion.increments(1 / rate, chosen.memory + count)
    # A past of its own keeps the start formulas of algorithms with memory out of the measurement.
    found = integrate(
        increments[chosen.memory :],
        algorithm,
        start=motion.attitude(chosen.memory / rate),
        history=increments[: chosen.memory] if chosen.memory else None,
    )
    # Apparent minus true attitude, in the reference frame, whose third axis is the cone's.
    end = motion.attitude((chosen.memory + count) / rate)
    error = multiply(found[-1], conjugate(end))
    return float(to_rotation_vector(error)[2] * rate / count)


def compute() -> ConingDrift:
    """Measure the drift over frequencies and over sample rates."""
    by_frequency = [
        [abs(measured_drift(name, HALF_ANGLE, float(frequency), RATE)) for frequency in FREQUENCIES]
        for name in ALGORITHMS
    ]
    by_rate = [
        [abs(measured_drift(name, HALF_ANGLE, FREQUENCY, float(rate))) for rate in RATES]
        for name in ALGORITHMS
    ]
    return ConingDrift(FREQUENCIES, np.array(by_frequency), RATES, np.array(by_rate))


def columns(data: ConingDrift) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    curves = {}
    for i, name in enumerate(ALGORITHMS):
        curves[f"{name}, rad/s over coning frequency in Hz"] = (
            data.frequencies,
            data.by_frequency[i],
        )
        curves[f"{name}, rad/s over sample rate in Hz"] = (data.rates, data.by_rate[i])
    return long_table(curves)


class ConingDriftPicture(Picture[ConingDrift]):
    """Drift over coning frequency and over sample rate."""

    size = (10.5, 4.6)

    def build(self) -> None:
        by_frequency, by_rate = self.figure.subplots(1, 2, sharey=True)
        self.figure.subplots_adjust(0.075, 0.2, 0.985, 0.92, wspace=0.06)
        angle = f"half angle {np.degrees(HALF_ANGLE):g}°"
        by_frequency.set(title=f"sampled at {RATE:g} Hz, {angle}", xlabel="coning frequency, Hz")
        by_frequency.set(xscale="log", yscale="log", xlim=(0.8, 40), ylim=(1e-9, 1e5))
        by_frequency.set(ylabel="apparent drift, deg/h")
        by_frequency.set_xticks([1, 2, 5, 10, 20, 40], ["1", "2", "5", "10", "20", "40"])
        by_rate.set(title=f"coning at {FREQUENCY:g} Hz, {angle}", xlabel="sample rate, Hz")
        by_rate.set(xscale="log", xlim=(12, 1000))
        by_rate.set_xticks([20, 50, 100, 200, 500], ["20", "50", "100", "200", "500"])
        for panel in (by_frequency, by_rate):
            panel.minorticks_off()
        frequencies, rates = np.geomspace(0.8, 40, 200), np.geomspace(12, 1000, 200)
        self.by_frequency, self.by_rate, handles = {}, {}, []
        for name, label in CURVES.items():
            style = dict(STYLES[name])
            dots = {"color": style["color"], "linestyle": "none", "marker": style.pop("marker")}
            dots["markersize"] = style.pop("markersize")
            for panel, x, drift in (
                (by_frequency, frequencies, coning_drift(name, HALF_ANGLE, frequencies, 1 / RATE)),
                (by_rate, rates, coning_drift(name, HALF_ANGLE, FREQUENCY, 1 / rates)),
            ):
                panel.plot(x, DEGREES_PER_HOUR * np.abs(drift), **style)
            self.by_frequency[name] = self.line(by_frequency, **dots)
            self.by_rate[name] = self.line(by_rate, **dots)
            handles += by_frequency.plot([], [], **STYLES[name], label=label)
        self.figure.legend(handles=handles, loc="lower center", ncols=len(CURVES), fontsize=8)

    def update(self, data: ConingDrift) -> None:
        for name, by_frequency, by_rate in zip(
            ALGORITHMS, data.by_frequency, data.by_rate, strict=True
        ):
            if name in CURVES:
                self.by_frequency[name].set_data(data.frequencies, DEGREES_PER_HOUR * by_frequency)
                self.by_rate[name].set_data(data.rates, DEGREES_PER_HOUR * by_rate)

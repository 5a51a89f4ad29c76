"""What a word of 32 bits does to the quaternion of a step, and to the sum of many steps."""

from typing import NamedTuple

import numpy as np
from scipy.constants import day
from scipy.spatial.transform import Rotation

from ..checks import FloatArray
from ..quaternion import conjugate, from_rotation_vector, multiply, rotation_angle
from ..word_length import UPDATES, Update, integrate_in_word, step_in_word
from .picture import GREY, SERIES, Picture

EARTH_RATE = 2 * np.pi / (day * 365.2422 / 366.2422)
"""Rate of the Earth against the stars, rad/s: one turn more in a year than there are days."""
STEPS = 1000
STARTS = 16
ANGLES: FloatArray = np.geomspace(1e-6, 1.0, 61)
RATES: FloatArray = np.array([1.0, 3, 10, 30, 100, 300, 1000, 3000, 10000])
DEGREES_PER_HOUR = 3600 * float(np.degrees(1.0))


class ShortWord(NamedTuple):
    """Errors of arithmetic in float32."""

    angles: FloatArray  # (m,), rad: angle of one step
    subtracted: FloatArray  # (m,): relative error of 1 minus the stored l0
    carried: FloatArray  # (m,): relative error of 1 - l0 computed by itself
    rates: FloatArray  # (n,), Hz
    earth: FloatArray  # (update, n), rad/s: error of the Earth's rate, rms over the starts


def compute(seed: int = 2014) -> ShortWord:
    """One step of many sizes, and a body that stands on the turning Earth."""
    k = -np.tan(ANGLES[:, np.newaxis] / 4) * np.array([0.6, 0.0, 0.8])
    step = step_in_word(k.astype(np.float32)).astype(np.float64)
    true = 2 * np.sin(ANGLES / 4) ** 2
    return ShortWord(
        ANGLES,
        np.abs(1 - step[:, 3] - true) / true,
        np.abs(step[:, 4] - true) / true,
        RATES,
        np.array([[_earth_error(rate, update, seed) for rate in RATES] for update in UPDATES]),
    )


def _earth_error(rate: float, update: Update, seed: int) -> float:
    start = Rotation.random(STARTS, rng=np.random.default_rng(seed)).as_quat()
    turn = EARTH_RATE * np.array([0.6, 0.0, 0.8])
    found = integrate_in_word(
        np.tile(turn / rate, (STEPS, 1)), "picard-1", start=start, update=update
    )[:, -1].astype(np.float64)
    true = multiply(start, from_rotation_vector(turn * STEPS / rate))
    errors = rotation_angle(multiply(conjugate(true), found))
    return float(np.sqrt(np.mean(errors**2)) * rate / STEPS)


def columns(data: ShortWord) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the second panel, in rad/s."""
    return {"rate_hz": data.rates, **dict(zip(UPDATES, data.earth, strict=True))}


class ShortWordPicture(Picture[ShortWord]):
    """Digits of 1 - l0, and the error on the turning Earth."""

    size = (10.5, 4.0)

    def build(self) -> None:
        step, earth = self.figure.subplots(1, 2)
        self.figure.subplots_adjust(0.075, 0.14, 0.985, 0.9, wspace=0.2)
        step.set(
            title=r"one step: relative error of $1-\lambda_0$", xlabel="angle of the step, rad"
        )
        step.set(xscale="log", yscale="log", xlim=(1e-6, 1), ylim=(1e-9, 10))
        earth.set(title="standing on the turning Earth", xlabel="sample rate, Hz")
        earth.set(xscale="log", yscale="log", xlim=(0.8, 12500), ylim=(1e-6, 100))
        earth.set(ylabel="error of the rate, deg/h")
        self.subtracted = self.line(step, **SERIES[1], label=r"$\lambda_0$ stored, then subtracted")
        self.carried = self.line(step, **SERIES[0], label=r"$1-\lambda_0$ computed by itself")
        step.legend(loc="upper right")
        earth.axhline(DEGREES_PER_HOUR * EARTH_RATE, color=GREY, linewidth=4, alpha=0.5)
        earth.text(1, 1.4 * DEGREES_PER_HOUR * EARTH_RATE, "the Earth's whole rate", va="bottom")
        labels = (r"product with $\lambda_0$", r"sum, with $1-\lambda_0$", "the same, compensated")
        self.earth = [
            self.line(earth, **style, marker=marker, label=label)
            for style, marker, label in zip(
                (SERIES[1], SERIES[0], SERIES[2]), "sov", labels, strict=True
            )
        ]
        earth.legend(loc="lower right")

    def update(self, data: ShortWord) -> None:
        self.subtracted.set_data(data.angles, data.subtracted)
        # No error at all has no place on a logarithmic axis.
        self.carried.set_data(data.angles, np.where(data.carried > 0, data.carried, np.nan))
        for line, error in zip(self.earth, data.earth, strict=True):
            line.set_data(data.rates, DEGREES_PER_HOUR * error)

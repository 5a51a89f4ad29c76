"""What a word of 32 bits does to the quaternion of a step, and to an attitude of many steps."""

from typing import NamedTuple

import numpy as np
from scipy.constants import day

from driftlab.attitude.finite_precision import UPDATES, Update, integrate_in_word, step_in_word
from driftlab.book.machinery.picture import GREY, SERIES, Picture, long_table
from driftlab.checks import FloatArray
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, rotation_angle

EARTH_RATE = 2 * np.pi / (day * 365.2422 / 366.2422)
"""Rate of the Earth against the stars, rad/s: one turn more in a year than there are days."""
AXIS = np.array([0.6, 0.0, 0.8])
SECONDS = 1.0
"""How long the body stands on the Earth."""
STEPS = 2000
"""Steps of the panel on the norm."""
STARTS = 16
ANGLES: FloatArray = np.geomspace(1e-6, 1.0, 61)
STEP_ANGLES: FloatArray = np.geomspace(1e-4, 0.1, 7)
RATES: FloatArray = np.array([10.0, 30, 100, 300, 1000, 3000, 10000])
ARC_SECONDS = 3600 * float(np.degrees(1.0))
LABELS = (
    r"product with $\lambda_0$",
    "small terms first",
    r"sum, with $1-\lambda_0$",
    "compensated",
)
STYLES = tuple(
    {**style, "marker": marker, "markersize": 5}
    for style, marker in zip((SERIES[1], SERIES[3], SERIES[0], SERIES[2]), "sDov", strict=True)
)


class ShortWord(NamedTuple):
    """Errors of arithmetic in float32, by update in the order of `UPDATES`."""

    angles: FloatArray  # (m,), rad: angle of one step
    subtracted: FloatArray  # (m,): relative error of 1 minus the stored l0
    carried: FloatArray  # (m,): relative error of 1 - l0 computed by itself
    rates: FloatArray  # (n,), Hz
    earth: FloatArray  # (update, n), rad: error after `SECONDS` on the Earth, rms over the starts
    step_angles: FloatArray  # (p,), rad
    norms: FloatArray  # (update, p): change of the norm over `STEPS` steps, rms over the starts


def compute(seed: int = 2014) -> ShortWord:
    """One step of many sizes; a body that stands on the turning Earth; the norm of a fast one."""
    k = -np.tan(ANGLES[:, np.newaxis] / 4) * AXIS
    step = step_in_word(k.astype(np.float32)).astype(np.float64)
    true = 2 * np.sin(ANGLES / 4) ** 2
    # Four normal deviates have no preferred direction: uniform over all rotations.
    starts = np.random.default_rng(seed).normal(size=(STARTS, 4))
    starts /= np.linalg.norm(starts, axis=-1, keepdims=True)
    # Attitudes that the word can hold, so that what is measured is the arithmetic alone.
    starts = starts.astype(np.float32).astype(np.float64)
    return ShortWord(
        ANGLES,
        np.abs(1 - step[:, 3] - true) / true,
        np.abs(step[:, 4] - true) / true,
        RATES,
        np.array([[_earth_error(starts, rate, update) for rate in RATES] for update in UPDATES]),
        STEP_ANGLES,
        np.array([[_norm_error(starts, x, update) for x in STEP_ANGLES] for update in UPDATES]),
    )


def _earth_error(starts: FloatArray, rate: float, update: Update) -> float:
    steps = round(SECONDS * rate)
    found = _end(starts, EARTH_RATE / rate, steps, update)
    true = multiply(starts, from_rotation_vector(EARTH_RATE * steps / rate * AXIS))
    return _rms(rotation_angle(multiply(conjugate(true), found)))


def _norm_error(starts: FloatArray, angle: float, update: Update) -> float:
    found = _end(starts, angle, STEPS, update)
    return _rms(np.linalg.norm(found, axis=-1) / np.linalg.norm(starts, axis=-1) - 1)


def _end(starts: FloatArray, angle: float, steps: int, update: Update) -> FloatArray:
    """Last attitude (STARTS, 4) after equal steps by `angle` in rad."""
    # Picard's third iterate; about a fixed axis it has no other error than that of its series.
    increments = np.tile(angle / 2 * AXIS, (2 * steps, 1))
    found = integrate_in_word(increments, "two-step-4", start=starts, update=update)[:, -1]
    return found.astype(np.float64)


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def columns(data: ShortWord) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    curves = {
        "1-l0 subtracted, over rad": (data.angles, data.subtracted),
        "1-l0 carried, over rad": (data.angles, data.carried),
    }
    for i, update in enumerate(UPDATES):
        curves[f"earth {update}, rad over Hz"] = (data.rates, data.earth[i])
    for i, update in enumerate(UPDATES):
        curves[f"norm {update}, over rad"] = (data.step_angles, data.norms[i])
    return long_table(curves)


class ShortWordPicture(Picture[ShortWord]):
    """Digits of 1 - l0, the error on the turning Earth, and the norm."""

    size = (10.5, 4.4)

    def build(self) -> None:
        step, earth, norm = self.figure.subplots(1, 3)
        self.figure.subplots_adjust(0.065, 0.22, 0.985, 0.91, wspace=0.3)
        step.set(title=r"one step: $1-\lambda_0$", xlabel="angle of the step, rad")
        step.set(xscale="log", yscale="log", xlim=(1e-6, 1), ylim=(1e-10, 10))
        step.set_ylabel("relative error")
        earth.set(title=f"{SECONDS:g} s on the turning Earth", xlabel="sample rate, Hz")
        earth.set(xscale="log", yscale="log", xlim=(8, 12500), ylim=(1e-3, 100))
        earth.set(ylabel="error of attitude, arc seconds")
        norm.set(title=f"norm after {STEPS} steps", xlabel="angle of the step, rad")
        norm.set(xscale="log", yscale="log", xlim=(7e-5, 0.14), ylim=(1e-9, 1e-2))
        norm.set(ylabel="relative error")
        turn = ARC_SECONDS * EARTH_RATE * SECONDS
        self.subtracted = self.line(step, **SERIES[1], label=r"$\lambda_0$ stored, subtracted")
        self.carried = self.line(step, **SERIES[0], label="computed by itself")
        step.legend(loc="lower left", bbox_to_anchor=(0.0, 0.3))
        earth.axhline(turn, color=GREY, linewidth=4, alpha=0.5)
        earth.text(9, 1.4 * turn, "what the Earth has turned", va="bottom")
        self.earth = [self.line(earth, **style) for style in STYLES]
        self.norms = [
            self.line(norm, **style, label=label)
            for style, label in zip(STYLES, LABELS, strict=True)
        ]
        self.figure.legend(
            handles=self.norms, loc="lower center", ncols=4, bbox_to_anchor=(0.66, 0)
        )

    def update(self, data: ShortWord) -> None:
        self.subtracted.set_data(data.angles, data.subtracted)
        # No error at all has no place on a logarithmic axis.
        self.carried.set_data(data.angles, np.where(data.carried > 0, data.carried, np.nan))
        for line, error in zip(self.earth, data.earth, strict=True):
            line.set_data(data.rates, ARC_SECONDS * error)
        for line, error in zip(self.norms, data.norms, strict=True):
            line.set_data(data.step_angles, error)

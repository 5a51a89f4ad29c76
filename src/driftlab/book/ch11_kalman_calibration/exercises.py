"""Exercises of chapter 11: calibrating an IMU with a Kalman filter."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np

from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import (
    NOTHING_SAID,
    Exercise,
    Objection,
    Said,
    Verdict,
)
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.exercise.reading import UnreadableError
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.checks import FloatArray
from driftlab.imu import ImuNoise
from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme
from driftlab.motion.turntable import segments

from .experiments import table_observability

MODEL = ERROR_MODELS["averaged"]
SHOWN = [
    MODEL.names.index(name)
    for name in ("gyro bias x", "gyro non-orthogonality xy", "accelerometer bias x")
]


def _deviations(scheme: Scheme, noise: ImuNoise) -> FloatArray:
    """Standard deviations (27,) of the states that are expected after a scheme."""
    return table_observability(scheme, MODEL, noise).after


@cache
def _growth() -> FloatArray:
    """Factors (2, 3) for ten times the gyro noise, and for ten times that of the velocity."""
    noise = ImuNoise()
    louder = (
        replace(noise, angle_random_walk=10 * noise.angle_random_walk),
        replace(noise, reference_velocity=10 * noise.reference_velocity),
    )
    before, *after = (_deviations(NINETEEN_POSITIONS, each) for each in (noise, *louder))
    return np.stack([each / before for each in after])[:, SHOWN]


def _duration(scheme: Scheme) -> float:
    return sum(segment.duration for segment in segments(scheme, 1e-3))


@cache
def _compared(scheme: Scheme) -> tuple[float, str]:
    """Largest deviation of a sensor error over that of the nineteen positions, and its name.

    The pauses are made as long as the whole time of the nineteen positions allows.
    """
    turning = _duration(scheme) - scheme.positions * scheme.dwell
    pause = (_duration(NINETEEN_POSITIONS) - turning) / scheme.positions
    if pause < 1:
        raise UnreadableError("The turns alone take longer than all the nineteen positions.")
    timed = replace(scheme, dwell=pause)
    ratios = _deviations(timed, ImuNoise()) / _deviations(NINETEEN_POSITIONS, ImuNoise())
    worst = 6 + int(ratios[6:].argmax())
    return float(ratios[worst]), MODEL.names[worst]


@dataclass(frozen=True, kw_only=True, eq=False)
class _Positions(Exercise):
    """A scheme of a few positions that shows all states, and none of them too badly."""

    positions: int
    most: float

    def __post_init__(self) -> None:
        told = (
            "How many positions the scheme has, if not as many as asked.",
            "Which states it leaves unobservable.",
            "Which sensor error is known worst, if it is far worse than with nineteen positions.",
        )
        self._seal("a scheme; see the solutions", dict.fromkeys(told))

    def verdict(self, answer: Any, said: Said = NOTHING_SAID) -> Verdict:
        found = super().verdict(answer, said)
        if not found.right:
            return found
        ratio, name = _compared(_scheme(answer))
        return found._replace(
            says=f"{found.says} The worst of yours is {name}: {ratio:.1f} times the deviation."
        )

    def _objection(self, answer: Any, said: Said) -> Objection | None:
        scheme = _scheme(answer)
        if scheme.positions != self.positions:
            return Objection(
                f"This scheme has {scheme.positions} positions: one more than there are rotations."
            )
        try:
            unobservable = table_observability(scheme, MODEL).descriptions
        except ValueError as error:
            raise UnreadableError(str(error)) from None
        if unobservable:
            return Objection(f"Unobservable stay {'; '.join(unobservable)}.")
        ratio, name = _compared(scheme)
        if ratio > self.most:
            return Objection(
                f"Nothing stays unobservable. But {name} has {ratio:.0f} times the deviation that "
                "the nineteen positions reach. Ask which pair of positions, or which turn, "
                "would show it."
            )
        return None


def _scheme(answer: Any) -> Scheme:
    """The answer as a scheme; text stands for the rotations of one."""
    if isinstance(answer, Scheme):
        return answer
    if not isinstance(answer, str):
        raise UnreadableError("Expected a Scheme, or its rotations as text.")
    try:
        return Scheme(answer)
    except ValueError as error:
        raise UnreadableError(str(error)) from None


EXERCISES: dict[str, Exercise] = {
    "11.1": Choice(
        kind="predict",
        right="ade",
        wrong={
            "b": "is found in the turns, and the turns are the same. A pause only has to show the "
            "level before and after each, and half a minute does.",
            "c": "leaves a tilt after a turn about another axis. The tilt shows in a part of a "
            "minute.",
            "f": "is an angle between an accelerometer and the gyros. What finds it is how often "
            "the table turns, more than how long it rests.",
        },
        remark="What shows as a constant rate or acceleration needs time; what shows as an angle "
        "needs turns.",
    ),
    "11.2": Value(
        kind="slide",
        right=_growth,
        absolute=0.5,
        mistakes={
            "The two rows are exchanged: the gyro noise comes first.": lambda: _growth()[::-1],
            "This is the old deviation over the new one.": lambda: 1 / _growth(),
            "These are ratios of variances; deviations are their roots.": lambda: _growth() ** 2,
            "This would hold if each error had one noise alone. Look at the non-orthogonality "
            "under both.": lambda: np.array([[10, 10, 1], [1, 1, 10]]),
            "These are roots of the ratios. The panel shows deviations already.": (
                lambda: np.sqrt(_growth())
            ),
        },
        remark="The non-orthogonality has both noises, and neither alone makes it ten times as "
        "large.",
    ),
    "11.3": Formula(
        kind="compute",
        arguments=("q", "T"),
        draw=lambda rng: (rng.uniform(1e-6, 1e-4), rng.uniform(10, 4000)),
        right=lambda q, T: q / np.sqrt(T),
        mistakes={
            "This is the deviation of the angle after that time. The bias is an angle over the "
            "time.": lambda q, T: q * np.sqrt(T),
            "The deviation of the angle was taken to grow like the time. What grows so is the "
            "effect of a bias; white noise is slower.": lambda q, T: q,
            "The angle was taken to have the same deviation at all times. It is a random walk.": (
                lambda q, T: q / T
            ),
            "This is the variance.": lambda q, T: q**2 / T,
        },
        remark="Four times the time halves it, and no filter and no scheme can do better.",
    ),
    "11.4": _Positions(
        kind="compute",
        positions=6,
        most=20.0,
        remark="Every direction is seen, and none too badly.",
    ),
    "11.5": Choice(
        kind="explain",
        right="ade",
        wrong={
            "b": "would need a velocity that depends on them, if only a little. Noise hides; it "
            "does not show.",
            "c": "takes them for something that is measured, only badly. Set the pauses to 300 s "
            "and look.",
            "f": "finds nothing out. These axes are chosen so that three numbers are zero; how "
            "they lie in the case of the unit remains as unknown.",
        },
        remark="A filter that knows something before may be sure of what it never sees.",
    ),
}

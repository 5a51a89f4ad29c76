"""The Riccati equation integrated through whole turns, with and without the shadow switch."""

from typing import NamedTuple

import numpy as np

from ..cayley import (
    RiccatiSolution,
    integrate_riccati,
    riccati_rate,
    rotation_quaternion,
    shadow,
)
from ..checks import FloatArray
from ..quaternion import conjugate, from_rotation_vector, multiply, rotation_angle
from .picture import BLACK, GREY, SERIES, Picture

TURNS = 3
STEPS = 200
"""Steps a turn of the integrator with a fixed step."""
MISSES = np.radians([30.0, 10.0, 3.0, 1.0, 0.3])
"""How far from a whole turn the attitude passes at the end of the first turn, rad."""


class RiccatiTurns(NamedTuple):
    """Times are in turns; the body turns once a second."""

    miss: float  # rad
    ended: RiccatiSolution  # about a fixed axis, without the switch
    plain: RiccatiSolution  # past the singularity by `miss`, without the switch
    switched: RiccatiSolution  # the same with it
    fixed_times: FloatArray  # (f,)
    fixed_errors: FloatArray  # (2, f), rad: with a fixed step, without and with the switch
    misses: FloatArray  # (n,), rad
    evaluations: FloatArray  # (2, n): of the integrator with a variable step, likewise
    errors: FloatArray  # (2, n), rad: its attitude errors after `TURNS` turns


class _TwoSpins(NamedTuple):
    """Steady rotation about axis 3 of a body that is mounted on a slowly tumbling table."""

    spin: FloatArray  # (3,), rad/s, in body axes
    tumble: FloatArray  # (3,), rad/s, in the reference frame

    def attitude(self, time: FloatArray) -> FloatArray:
        about = [from_rotation_vector(time[..., np.newaxis] * w) for w in (self.tumble, self.spin)]
        return multiply(*about)

    def rate(self, time: float) -> FloatArray:
        """spin + tumble in body axes; both are normal to each other."""
        angle = time * self.spin[2]
        cosine, sine = np.cos(angle), np.sin(angle)
        return self.spin + self.tumble[0] * np.array([cosine, -sine, 0.0])


def compute(miss: float = float(np.radians(3.0)), tolerance: float = 1e-8) -> RiccatiTurns:
    """Integrate `TURNS` turns that miss the singular attitude by the angle `miss`, in rad."""
    spin = np.array([0.0, 0.0, 2 * np.pi])
    times = np.linspace(0.0, TURNS, 240 * TURNS + 1)

    def motion(miss: float) -> _TwoSpins:
        # After one turn the table has tumbled by miss, and the attitude is that far from the turn.
        return _TwoSpins(spin, np.array([miss, 0.0, 0.0]))

    def solve(miss: float, switch: bool) -> RiccatiSolution:
        rate = motion(miss).rate
        return integrate_riccati(rate, times, shadow_switch=switch, tolerance=tolerance)

    by_miss = [[solve(float(m), switch) for m in MISSES] for switch in (False, True)]
    errors = [
        [_error(motion(float(m)), a.time, a.attitude)[-1] for m, a in zip(MISSES, row, strict=True)]
        for row in by_miss
    ]
    steps = np.linspace(0.0, TURNS, STEPS * TURNS + 1)
    fixed = [
        _error(motion(miss), steps, _fixed_step(motion(miss), steps, switch))
        for switch in (False, True)
    ]
    return RiccatiTurns(
        miss,
        solve(0.0, False),
        solve(miss, False),
        solve(miss, True),
        steps,
        np.array(fixed),
        MISSES,
        np.array([[answer.evaluations for answer in row] for row in by_miss], dtype=np.float64),
        np.array(errors),
    )


def _fixed_step(motion: _TwoSpins, times: FloatArray, switch: bool) -> FloatArray:
    """Attitude (m, 4) up to its sign, by the classical Runge-Kutta method."""
    k, h = np.zeros(3), times[1] - times[0]
    vectors = [k]
    for time in times[:-1]:
        middle = motion.rate(time + h / 2)
        first = riccati_rate(k, motion.rate(time))
        second = riccati_rate(k + h / 2 * first, middle)
        third = riccati_rate(k + h / 2 * second, middle)
        fourth = riccati_rate(k + h * third, motion.rate(time + h))
        k = k + h / 6 * (first + 2 * second + 2 * third + fourth)
        if switch and k @ k > 1:
            k = shadow(k)
        vectors.append(k)
    return rotation_quaternion(vectors)


def _error(motion: _TwoSpins, times: FloatArray, attitude: FloatArray) -> FloatArray:
    return rotation_angle(multiply(conjugate(motion.attitude(times)), attitude))


def columns(data: RiccatiTurns) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the length of the vector over time."""
    names = {"without_switch": data.plain, "with_switch": data.switched}
    return {
        "turns": data.switched.time,
        **{name: np.linalg.norm(answer.vector, axis=-1) for name, answer in names.items()},
    }


class RiccatiTurnsPicture(Picture[RiccatiTurns]):
    """Length of k, error of the attitude, and work against the miss."""

    size = (10.5, 4.0)

    def build(self) -> None:
        length, error, work = self.figure.subplots(1, 3)
        self.figure.subplots_adjust(0.065, 0.14, 0.985, 0.9, wspace=0.32)
        length.set(title="length of the vector k", xlabel="turns", ylabel="|k|")
        length.set(xlim=(0, TURNS), yscale="log", ylim=(1e-2, 1e4))
        error.set(title=f"fixed step, {STEPS} a turn", xlabel="turns")
        error.set(
            xlim=(0, TURNS), yscale="log", ylim=(1e-11, 1e-1), ylabel="error of attitude, rad"
        )
        work.set(title=f"variable step, {TURNS} turns", ylabel="evaluations of the rate")
        work.set(xlabel="passes the singularity by, degrees", xscale="log", yscale="log")
        work.set(xlim=(0.07, 45), ylim=(100, 10000))
        work.set_xticks([0.1, 1, 10], ["0.1", "1", "10"])
        names = ("fixed axis, no switch", "near miss, no switch", "near miss, with switch")
        styles = ({"color": GREY, "linewidth": 3.5}, SERIES[1], SERIES[0])
        self.lengths = [
            self.line(length, **style, label=name)
            for style, name in zip(styles, names, strict=True)
        ]
        self.end = self.line(length, color=BLACK, marker="x", linestyle="none")
        self.end.set_label("end of the integration")
        self.errors = [
            self.line(error, **style, label=name)
            for style, name in zip(styles[1:], names[1:], strict=True)
        ]
        self.work = [
            self.line(work, **style, marker=marker, label=name)
            for style, name, marker in zip(
                styles[1:], ("no switch", "with switch"), "so", strict=True
            )
        ]
        length.legend(loc="upper right", fontsize=8)
        error.legend(loc="upper left")
        work.legend(loc="upper right")

    def update(self, data: RiccatiTurns) -> None:
        answers = (data.ended, data.plain, data.switched)
        for line, answer in zip(self.lengths, answers, strict=True):
            line.set_data(answer.time, np.linalg.norm(answer.vector, axis=-1))
        last = np.linalg.norm(data.ended.vector[-1])
        self.end.set_data([data.ended.time[-1]], [last])
        for line, error in zip(self.errors, data.fixed_errors, strict=True):
            line.set_data(data.fixed_times[1:], error[1:])
        for line, evaluations in zip(self.work, data.evaluations, strict=True):
            line.set_data(np.degrees(data.misses), evaluations)

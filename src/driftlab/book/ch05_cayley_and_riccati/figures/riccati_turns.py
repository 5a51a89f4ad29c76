"""The Riccati equation integrated through whole turns, with and without the shadow switch."""

from typing import NamedTuple

import numpy as np

from driftlab.attitude.cayley import rotation_quaternion, shadow
from driftlab.attitude.riccati import SWITCH, RiccatiSolution, integrate_riccati, riccati_rate
from driftlab.book.machinery.picture import BLACK, GREY, SERIES, Picture, long_table
from driftlab.checks import FloatArray
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, rotation_angle

TURNS = 3
STEPS = 200
"""Steps a turn of the integrator with a fixed step."""
MISSES: FloatArray = np.radians([3.0, 0.1])
"""How far from a whole turn the attitude passes at the end of the first turn, rad."""
TOLERANCES: FloatArray = np.array([1e-5, 1e-7, 1e-9, 1e-11])
"""Of the integrator with a variable step."""


class RiccatiTurns(NamedTuple):
    """Times are in turns; the body turns once a second."""

    miss: float  # rad
    ended: RiccatiSolution  # about a fixed axis, without the switch
    plain: RiccatiSolution  # past the singularity by `miss`, without the switch
    switched: RiccatiSolution  # the same with it
    fixed_times: FloatArray  # (f,)
    fixed_errors: FloatArray  # (2, f), rad: with a fixed step, without and with the switch
    misses: FloatArray  # (n,), rad
    evaluations: FloatArray  # (2, n, tolerance): of an integrator with a variable step, likewise
    worst: FloatArray  # (2, n, tolerance), rad: its largest error of attitude


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


def compute() -> RiccatiTurns:
    """Integrate `TURNS` turns that pass the singular attitude at the distances `MISSES`."""
    spin = np.array([0.0, 0.0, 2 * np.pi])
    times = np.linspace(0.0, TURNS, 40 * TURNS + 1)

    def motion(miss: float) -> _TwoSpins:
        # After one turn the table has tumbled by miss, and the attitude is that far from the turn.
        return _TwoSpins(spin, np.array([miss, 0.0, 0.0]))

    def solve(
        miss: float, switch: bool, tolerance: float = 1e-9, times: FloatArray = times
    ) -> RiccatiSolution:
        rate = motion(miss).rate
        return integrate_riccati(rate, times, shadow_switch=switch, tolerance=tolerance)

    # Few times, as they limit the step.
    few = times[::10]
    trials = [
        [[(m, solve(m, switch, tolerance, few)) for tolerance in TOLERANCES] for m in MISSES]
        for switch in (False, True)
    ]
    miss = float(MISSES[0])
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
        np.array([[[float(a.evaluations) for _, a in row] for row in rows] for rows in trials]),
        np.array([
            [[_error(motion(m), a.time, a.attitude).max() for m, a in row] for row in rows]
            for rows in trials
        ]),
    )  # fmt: skip


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
        if switch and k @ k > SWITCH**2:
            k = shadow(k)
        vectors.append(k)
    return rotation_quaternion(vectors)


def _error(motion: _TwoSpins, times: FloatArray, attitude: FloatArray) -> FloatArray:
    return rotation_angle(multiply(conjugate(motion.attitude(times)), attitude))


def columns(data: RiccatiTurns) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the first panel's lengths and the second one's errors."""
    names = ("fixed axis, no switch", "no switch", "with switch")
    answers = (data.ended, data.plain, data.switched)
    curves = {
        f"|k| {name}, over turns": (answer.time, np.linalg.norm(answer.vector, axis=-1))
        for name, answer in zip(names, answers, strict=True)
    }
    for name, error in zip(names[1:], data.fixed_errors, strict=True):
        curves[f"fixed step {name}, rad over turns"] = (data.fixed_times, error)
    return long_table(curves)


class RiccatiTurnsPicture(Picture[RiccatiTurns]):
    """Length of k, error of the attitude, and work against the miss."""

    size = (10.5, 4.0)

    def build(self) -> None:
        length, error, work = self.figure.subplots(1, 3)
        self.figure.subplots_adjust(0.065, 0.14, 0.985, 0.9, wspace=0.32)
        length.set(title="length of the vector k", xlabel="turns", ylabel="|k|")
        length.set(xlim=(0, TURNS), yscale="log", ylim=(1e-2, 1e10))
        error.set(title=f"fixed step, {STEPS} a turn", xlabel="turns")
        error.set(
            xlim=(0, TURNS), yscale="log", ylim=(1e-11, 1e-1), ylabel="error of attitude, rad"
        )
        work.set(title=f"variable step, {TURNS} turns", xlabel="evaluations of the rate")
        work.set(xscale="log", yscale="log", xlim=(100, 20000), ylim=(1e-12, 1e-1))
        work.set(ylabel="largest error of attitude, rad")
        names = ("fixed axis, no switch", "near miss, no switch", "near miss, with switch")
        styles = ({"color": GREY, "linewidth": 3.5}, SERIES[1], SERIES[0])
        self.lengths = [
            self.line(length, **style, label=name)
            for style, name in zip(styles, names, strict=True)
        ]
        self.end = self.line(length, color=BLACK, marker="x", linestyle="none")
        self.end.set_label("given up")
        self.errors = [
            self.line(error, **style, label=name)
            for style, name in zip(styles[1:], names[1:], strict=True)
        ]
        self.work = [
            self.line(work, **style, marker=marker, label=f"{np.degrees(miss):g}°, {name}")
            for name, styles in (("no switch", SERIES[1:]), ("with switch", SERIES[0::4]))
            for miss, style, marker in zip(MISSES, styles, "so", strict=False)
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
        for line, evaluations, worst in zip(
            self.work, data.evaluations.reshape(-1, 4), data.worst.reshape(-1, 4), strict=True
        ):
            line.set_data(evaluations, worst)

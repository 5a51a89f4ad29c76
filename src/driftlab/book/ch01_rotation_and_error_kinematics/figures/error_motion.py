"""The error quaternion in time, by closed form and by a numerical integrator; Larin (1.4)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp

from driftlab.book.machinery.picture import SERIES, Picture
from driftlab.checks import FloatArray, finite_array
from driftlab.drift.error_kinematics import error_quaternion, error_rate_matrix

COMPONENTS = (r"$\lambda_{1e}$", r"$\lambda_{2e}$", r"$\lambda_{3e}$", r"$\lambda_{0e}$")


class ErrorMotion(NamedTuple):
    """Error quaternion over time."""

    time: FloatArray  # (m,), s
    exact: FloatArray  # (m, 4)
    integrated_time: FloatArray  # (n,), s: the integrator's own steps
    integrated: FloatArray  # (n, 4)
    tolerance: float


def compute(
    rate: ArrayLike, measured_rate: ArrayLike, duration: float = 60.0, tolerance: float = 1e-2
) -> ErrorMotion:
    """Solve (1.4) twice from [0, 0, 0, 1].

    Parameters
    ----------
    rate, measured_rate : array_like, shape (3,)
        Constant rates, rad/s.
    duration : float
        Length of the history in s, above 0.
    tolerance : float
        Relative and absolute tolerance of `scipy.integrate.solve_ivp` (RK45), above 0.
    """
    for name, value in (("duration", duration), ("tolerance", tolerance)):
        if not finite_array(value, name) > 0:
            raise ValueError(f"{name}: expected a number above 0, got {value!r}.")
    matrix = error_rate_matrix(rate, measured_rate)
    time = np.linspace(0.0, duration, 601)
    solution = solve_ivp(
        lambda _, error: 0.5 * matrix @ error,
        (0.0, duration),
        [0.0, 0.0, 0.0, 1.0],
        rtol=tolerance,
        atol=tolerance,
    )
    exact = error_quaternion(rate, measured_rate, time)
    return ErrorMotion(time, exact, solution.t, solution.y.T, tolerance)


def integration_error(data: ErrorMotion, rate: ArrayLike, measured_rate: ArrayLike) -> FloatArray:
    """Distance (n,) of the integrated quaternion from the exact one at the integrator's steps."""
    exact = error_quaternion(rate, measured_rate, data.integrated_time)
    return np.linalg.norm(data.integrated - exact, axis=-1)


def columns(data: ErrorMotion) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    names = ("error_1", "error_2", "error_3", "error_0")
    return {"time_s": data.time, **dict(zip(names, data.exact.T, strict=True))}


class ErrorMotionPicture(Picture[ErrorMotion]):
    """Four components: lines for the closed form, dots for the integrator."""

    size = (9.0, 3.8)

    def build(self) -> None:
        axes = self.figure.subplots()
        self.figure.subplots_adjust(0.08, 0.14, 0.86, 0.9)
        axes.set(title="error quaternion: lines closed form, dots RK45", xlabel="time, s")
        axes.set(ylabel="component", xlim=(0, 60), ylim=(-1.1, 1.1))
        self.lines, self.dots = [], []
        for name, style, marker in zip(COMPONENTS, SERIES, "osD^", strict=False):
            self.lines.append(self.line(axes, **style, label=name))
            dot = {"linestyle": "none", "marker": marker, "markersize": 3.5}
            self.dots.append(self.line(axes, color=style["color"], **dot))
        axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))

    def update(self, data: ErrorMotion) -> None:
        for i, (line, dot) in enumerate(zip(self.lines, self.dots, strict=True)):
            line.set_data(data.time, data.exact[:, i])
            dot.set_data(data.integrated_time, data.integrated[:, i])

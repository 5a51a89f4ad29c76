"""The error quaternion in time, by closed form and by a numerical integrator; Larin (1.4)."""

from driftlab.book.machinery.picture import SERIES, Picture
from driftlab.checks import FloatArray

from ..experiments import DURATION, ErrorMotion

COMPONENTS = (r"$\lambda_{1e}$", r"$\lambda_{2e}$", r"$\lambda_{3e}$", r"$\lambda_{0e}$")


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
        axes.set(ylabel="component", xlim=(0, DURATION), ylim=(-1.1, 1.1))
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

"""The levelling loop as a block diagram: what turns the horizon, and where North is read."""

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyBboxPatch, Polygon

from driftlab.book.machinery.picture import BLACK, BLUE, GREEN, VERMILION, in_style
from driftlab.book.machinery.sheet import Sheet

SIZE = (10.5, 5.0)
BOXES: dict[str, tuple[float, float, float, str]] = {
    "way": (3.5, 4.3, 0.9, r"$\dfrac{1}{R\,s}$"),
    "log": (2.75, 3.15, 0.6, r"$s$"),
    "damping": (5.2, 3.15, 0.8, r"$k_1$"),
    "integral": (5.2, 2.0, 0.8, r"$\dfrac{k_2}{s}$"),
    "horizon": (9.1, 2.0, 0.8, r"$\dfrac{1}{s}$"),
    "gravity": (5.2, 0.25, 0.8, r"$g$"),
    "compass": (6.5, 1.15, 1.15, r"$\dfrac{1}{U\cos\varphi}$"),
}
"""Middle, width and words of each."""
SUMS = {"felt": (2.15, 2.0), "explained": (3.75, 3.15), "rate": (7.2, 2.0), "turn": (8.15, 2.0)}
_BOX_HEIGHT, _RADIUS = 0.66, 0.15


def _wire(axes: Axes, colour: str, *corners: tuple[float, float], head: bool = True) -> None:
    """A line along its corners, with an arrow's head at the end."""
    axes.plot(*zip(*corners, strict=True), color=colour, linewidth=1.6, solid_joinstyle="miter")
    if not head:
        return
    (x0, y0), (x, y) = corners[-2:]
    size = max(abs(x - x0), abs(y - y0))
    dx, dy = (x - x0) / size, (y - y0) / size
    back, side = 0.17, 0.065
    tip = [(x, y), (x - back * dx - side * dy, y - back * dy + side * dx)]
    tip.append((x - back * dx + side * dy, y - back * dy - side * dx))
    axes.add_patch(Polygon(tip, closed=True, color=colour, linewidth=0))


def _sign(axes: Axes, x: float, y: float, sign: str) -> None:
    axes.text(x, y, sign, ha="center", va="center", fontsize=11)


@in_style
def draw(_: object, sheet: Sheet) -> Figure:
    """Black is the loop, red what disturbs it, green the log, blue what is read."""
    figure = Figure(figsize=SIZE)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0.0, 10.5), ylim=(-0.2, 4.8))
    axes.axis("off")
    _draw_loop(axes)
    _draw_disturbances(axes)
    _draw_log(axes)
    _draw_reading(axes)
    for x, y, width, words in BOXES.values():
        box = FancyBboxPatch(
            (x - width / 2, y - _BOX_HEIGHT / 2), width, _BOX_HEIGHT, boxstyle="round,pad=0.02",
            linewidth=1.4, facecolor="white", edgecolor=BLACK, zorder=3,
        )  # fmt: skip
        axes.add_patch(box)
        axes.text(x, y, words, ha="center", va="center", fontsize=13, zorder=4)
    for place in SUMS.values():
        axes.add_patch(Circle(place, _RADIUS, facecolor="white", edgecolor=BLACK, lw=1.4, zorder=3))
        axes.text(*place, "+", ha="center", va="center", fontsize=10, zorder=4)
    return figure


def _draw_loop(axes: Axes) -> None:
    (x0, y), (x1, y1) = SUMS["felt"], SUMS["explained"]
    rate, turn = SUMS["rate"][0], SUMS["turn"][0]
    _wire(axes, BLACK, (x0 + _RADIUS, y), (4.8, y))
    axes.text(2.75, y + 0.1, r"$W_1$", fontsize=12)
    axes.plot(x1, y, "o", color=BLACK, markersize=4)
    _wire(axes, BLACK, (x1, y), (x1, y1 - _RADIUS))
    _wire(axes, BLACK, (x1 + _RADIUS, y1), (4.8, y1))
    _wire(axes, BLACK, (5.6, y1), (rate, y1), (rate, y + _RADIUS))
    _wire(axes, BLACK, (5.6, y), (rate - _RADIUS, y))
    _wire(axes, BLACK, (rate + _RADIUS, y), (turn - _RADIUS, y))
    axes.text(rate + 0.45, y + 0.12, r"$-\omega_{\eta3}$", fontsize=12, ha="center")
    _sign(axes, turn - 0.27, y - 0.17, "−")
    _wire(axes, BLACK, (turn + _RADIUS, y), (8.7, y))
    _wire(axes, BLACK, (9.5, y), (10.3, y))
    axes.text(9.72, y + 0.12, r"tilt $\chi$", fontsize=11)
    axes.plot(9.75, y, "o", color=BLACK, markersize=4)
    bottom = BOXES["gravity"][1]
    _wire(axes, BLACK, (9.75, y), (9.75, bottom), (5.6, bottom))
    _wire(axes, BLACK, (4.8, bottom), (x0, bottom), (x0, y - _RADIUS))
    axes.text(3.1, bottom + 0.1, "gravity on a tilt", fontsize=11)
    axes.text(5.2, y - 0.58, "integral", fontsize=11, ha="center")
    axes.text(5.2, y1 - 0.58, "damping", fontsize=11, ha="center")
    axes.text(9.1, y + 0.43, "horizon", fontsize=11, ha="center")


def _draw_disturbances(axes: Axes) -> None:
    (x0, y), turn, way = SUMS["felt"], SUMS["turn"][0], BOXES["way"][1]
    _wire(axes, VERMILION, (0.25, y), (x0 - _RADIUS, y))
    axes.text(0.22, y + 0.1, "acceleration\n$\\dot v$ North ($a$)", fontsize=11, color=BLACK)
    axes.plot(1.4, y, "o", color=VERMILION, markersize=4)
    _wire(axes, VERMILION, (1.4, y), (1.4, way), (3.05, way))
    _wire(axes, VERMILION, (3.95, way), (turn, way), (turn, y + _RADIUS))
    axes.text(4.15, way + 0.1, "the way turns the true horizon", fontsize=11)
    _wire(axes, VERMILION, (0.95, 1.2), (x0 - 0.11, y - 0.11))
    axes.text(0.22, 0.88, "error of the\naccelerometer ($n$)", fontsize=11, va="center")
    _wire(axes, VERMILION, (turn, 1.2), (turn, y - _RADIUS))
    axes.text(turn, 1.0, r"drift $\Delta\omega_3$ ($d$)", fontsize=11, ha="center", va="center")
    _sign(axes, turn + 0.17, y - 0.3, "−")


def _draw_log(axes: Axes) -> None:
    x1, y1 = SUMS["explained"]
    _wire(axes, GREEN, (1.6, y1), (2.45, y1))
    _wire(axes, GREEN, (3.05, y1), (x1 - _RADIUS, y1))
    axes.text(1.58, y1 + 0.1, r"log, $v_{\log}$", fontsize=11)
    axes.text(1.58, y1 - 0.25, r"(error $e$)", fontsize=11)
    axes.text(3.12, y1 + 0.1, r"$\dot v_{\log}$", fontsize=11)
    _sign(axes, x1 - 0.27, y1 - 0.17, "−")


def _draw_reading(axes: Axes) -> None:
    y, (x, middle, *_) = SUMS["felt"][1], BOXES["compass"]
    axes.plot(x, y, "o", color=BLUE, markersize=4, zorder=4)
    _wire(axes, BLUE, (x, y), (x, middle + _BOX_HEIGHT / 2 + 0.02))
    _wire(axes, BLUE, (x, middle - _BOX_HEIGHT / 2), (x, 0.4))
    axes.text(x + 0.12, 0.43, "read here: the heading", fontsize=11)

"""The levelling loop as a block diagram: what turns the horizon, and where North is read."""

from typing import Any, NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyBboxPatch, Polygon

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, BLUE, GREEN, VERMILION

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


_LEAST_TYPE = 5.7
"""Points, in a narrow column."""


class _Board(NamedTuple):
    """Axes with what is drawn on them, smaller on paper."""

    axes: Axes
    scale: float  # of type and lines, to those of a screen
    narrow: bool  # whether words must be broken

    def wire(self, colour: str, *corners: tuple[float, float]) -> None:
        """A line along its corners, with an arrow's head at the end."""
        width = 1.6 * max(self.scale, 0.5)
        self.axes.plot(
            *zip(*corners, strict=True), color=colour, linewidth=width, solid_joinstyle="miter"
        )
        (x0, y0), (x, y) = corners[-2:]
        size = max(abs(x - x0), abs(y - y0))
        dx, dy = (x - x0) / size, (y - y0) / size
        back, side = 0.17, 0.065
        tip = [(x, y), (x - back * dx - side * dy, y - back * dy + side * dx)]
        tip.append((x - back * dx + side * dy, y - back * dy - side * dx))
        self.axes.add_patch(Polygon(tip, closed=True, color=colour, linewidth=0))

    def dot(self, x: float, y: float, colour: str = BLACK, **style: Any) -> None:
        """A branch of a wire."""
        size = 4 * max(self.scale, 0.5)
        self.axes.plot(x, y, "o", color=colour, markersize=size, **style)

    def say(self, x: float, y: float, words: str, size: float = 11, **style: Any) -> None:
        """Words of a size that is meant for the screen."""
        self.axes.text(x, y, words, fontsize=max(size * self.scale, _LEAST_TYPE), **style)

    def sign(self, x: float, y: float, sign: str) -> None:
        """The sign with which something comes into a sum."""
        self.say(x, y, sign, ha="center", va="center")


@from_table
def draw(drawing: Drawing) -> None:
    """Black is the loop, red what disturbs it, green the log, blue what is read."""
    sheet = drawing.sheet
    scale = 1.0 if sheet.width is None else sheet.width / SIZE[0]
    drawing.figure = Figure(figsize=(scale * SIZE[0], scale * SIZE[1]))
    axes = drawing.figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0.0, 10.5), ylim=(-0.2, 4.8))
    axes.axis("off")
    board = _Board(axes, scale, sheet.narrow)
    _draw_loop(board)
    _draw_disturbances(board)
    _draw_log(board)
    _draw_reading(board)
    line = 1.4 * max(scale, 0.5)
    for x, y, width, words in BOXES.values():
        box = FancyBboxPatch(
            (x - width / 2, y - _BOX_HEIGHT / 2), width, _BOX_HEIGHT, boxstyle="round,pad=0.02",
            linewidth=line, facecolor="white", edgecolor=BLACK, zorder=3,
        )  # fmt: skip
        axes.add_patch(box)
        board.say(x, y, words, 13, ha="center", va="center", zorder=4)
    for place in SUMS.values():
        circle = Circle(place, _RADIUS, facecolor="white", edgecolor=BLACK, lw=line, zorder=3)
        axes.add_patch(circle)
        board.say(*place, "+", 10, ha="center", va="center", zorder=4)


def _draw_loop(board: _Board) -> None:
    (x0, y), (x1, y1) = SUMS["felt"], SUMS["explained"]
    rate, turn = SUMS["rate"][0], SUMS["turn"][0]
    board.wire(BLACK, (x0 + _RADIUS, y), (4.8, y))
    board.say(2.75, y + 0.1, r"$W_1$", 12)
    board.dot(x1, y)
    board.wire(BLACK, (x1, y), (x1, y1 - _RADIUS))
    board.wire(BLACK, (x1 + _RADIUS, y1), (4.8, y1))
    board.wire(BLACK, (5.6, y1), (rate, y1), (rate, y + _RADIUS))
    board.wire(BLACK, (5.6, y), (rate - _RADIUS, y))
    board.wire(BLACK, (rate + _RADIUS, y), (turn - _RADIUS, y))
    board.say(rate + 0.45, y + 0.12, r"$-\omega_{\eta3}$", 12, ha="center")
    board.sign(turn - 0.27, y - 0.17, "−")
    board.wire(BLACK, (turn + _RADIUS, y), (8.7, y))
    board.wire(BLACK, (9.5, y), (10.3, y))
    board.say(9.72, y + 0.12, r"tilt $\chi$")
    board.dot(9.75, y)
    bottom = BOXES["gravity"][1]
    board.wire(BLACK, (9.75, y), (9.75, bottom), (5.6, bottom))
    board.wire(BLACK, (4.8, bottom), (x0, bottom), (x0, y - _RADIUS))
    board.say(3.5, bottom + 0.1, "gravity on a tilt", ha="center")
    board.say(5.2, y - 0.58, "integral", ha="center")
    board.say(5.2, y1 - 0.58, "damping", ha="center")
    board.say(9.1, y + 0.43, "horizon", ha="center")


def _draw_disturbances(board: _Board) -> None:
    (x0, y), turn, way = SUMS["felt"], SUMS["turn"][0], BOXES["way"][1]
    board.wire(VERMILION, (0.25, y), (x0 - _RADIUS, y))
    words = "acceleration\n$\\dot v$ North ($a$)"
    if board.narrow:
        words = "accele-\nration $\\dot v$\nNorth ($a$)"
    board.say(0.08 if board.narrow else 0.22, y + 0.1, words)
    board.dot(1.4, y, VERMILION)
    board.wire(VERMILION, (1.4, y), (1.4, way), (3.05, way))
    board.wire(VERMILION, (3.95, way), (turn, way), (turn, y + _RADIUS))
    board.say(4.15, way + 0.1, "the way turns the true horizon")
    board.wire(VERMILION, (0.95, 1.2), (x0 - 0.11, y - 0.11))
    words = "accelero-\nmeter" if board.narrow else "accelerometer"
    board.say(0.22, 0.72 if board.narrow else 0.88, f"error of the\n{words} ($n$)", va="center")
    board.wire(VERMILION, (turn, 1.2), (turn, y - _RADIUS))
    board.say(turn, 1.0, r"drift $\Delta\omega_3$ ($d$)", ha="center", va="center")
    board.sign(turn + 0.17, y - 0.3, "−")


def _draw_log(board: _Board) -> None:
    x1, y1 = SUMS["explained"]
    board.wire(GREEN, (1.6, y1), (2.45, y1))
    board.wire(GREEN, (3.05, y1), (x1 - _RADIUS, y1))
    above, below = (0.42, -0.6) if board.narrow else (0.1, -0.25)
    board.say(1.58, y1 + above, r"log, $v_{\log}$")
    board.say(1.58, y1 + below, r"(error $e$)")
    board.say(3.12, y1 + 0.1, r"$\dot v_{\log}$")
    board.sign(x1 - 0.27, y1 - 0.17, "−")


def _draw_reading(board: _Board) -> None:
    y, (x, middle, *_) = SUMS["felt"][1], BOXES["compass"]
    board.dot(x, y, BLUE, zorder=4)
    board.wire(BLUE, (x, y), (x, middle + _BOX_HEIGHT / 2 + 0.02))
    board.wire(BLUE, (x, middle - _BOX_HEIGHT / 2), (x, 0.4))
    board.say(x + 0.12, 0.43, "read here: the heading")

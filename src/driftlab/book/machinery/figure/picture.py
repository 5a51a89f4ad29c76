"""A drawing made once, whose artists then only move; colours, legends and limits of all figures.

A slider panel and the published figure of it are the same picture. `Picture.draw(table)` makes the
figure for a page; an explorer keeps one `Picture` and calls `update` at each move of a slider. A
figure that no panel moves is one function; see `drawing.from_table`.
"""

from collections.abc import Sequence
from typing import Any, ClassVar, Self

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.text import Text
from matplotlib.transforms import ScaledTranslation
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray

from .drawing import GUIDE as GUIDE, Drawing, Place
from .sheet import SCREEN, Sheet, drawn_in

# Okabe and Ito's colours, orange and sky darkened until their contrast to white is above 3 to 1;
# each line also has a dash pattern or a marker of its own.
BLACK, BLUE, ORANGE, GREEN = "#000000", "#0072B2", "#BF8400", "#009E73"
VERMILION, PURPLE, SKY, GREY = "#D55E00", "#CC79A7", "#3A97D3", "#767676"
SERIES: tuple[dict[str, Any], ...] = (
    {"color": BLUE, "linestyle": "-"},
    {"color": VERMILION, "linestyle": "--"},
    {"color": GREEN, "linestyle": "-."},
    {"color": PURPLE, "linestyle": ":"},
    {"color": BLACK, "linestyle": (0, (5, 1, 1, 1, 1, 1))},
    {"color": ORANGE, "linestyle": (0, (8, 2))},
    {"color": SKY, "linestyle": (0, (1, 1))},
    {"color": GREY, "linestyle": (0, (3, 2))},
)

REACHES = tuple(k * 10.0**power for power in range(-6, 4) for k in (1, 2, 5))
"""How far axes may reach, if nothing else is said."""


class Picture(Drawing):
    """A drawing with artists made once; subclasses make axes in `build`, move them in `update`."""

    size: ClassVar[tuple[float, float]] = (9.0, 3.8)

    def __init__(self, sheet: Sheet = SCREEN) -> None:
        super().__init__(None, sheet)
        self.moving: list[Artist] = []  # what `update` changes; all else is drawn once and kept
        # whether `update` has changed the axes as well, so that everything must be drawn again
        self.rescaled = False
        with drawn_in(sheet.style):
            self.figure = Figure(figsize=self.size)
            self.build()
            FigureCanvasAgg(self.figure)

    def build(self) -> None:
        """Make axes and artists."""
        raise NotImplementedError

    def update(self, data: Any) -> None:
        """Move the artists to a table; its curves need no more than `show`."""
        self.show(data)

    @classmethod
    def draw(cls, data: Any, sheet: Sheet = SCREEN) -> Self:
        """Return a picture of `data`, for a page or a file."""
        picture = cls(sheet)
        picture.update(data)
        return picture

    def curve(self, axes: Axes, x: Place, y: Place, **settings: Any) -> Any:
        """Draw a column over another, as `Drawing.curve`; each update moves the line."""
        line = super().curve(axes, x, y, **settings)
        self.moving.append(line)
        return line

    def set_reach(
        self, axes: Axes, direction: str, values: ArrayLike, steps: Sequence[float] = REACHES
    ) -> None:
        """Let axes reach from zero as far as the smallest step that holds all values.

        To both sides, or to one if nothing is on the other. Few steps keep pictures comparable, and
        what is large does not leave them.
        """
        shown = np.asarray(values, float)
        shown = shown[np.isfinite(shown)]
        low, high = min(shown.min(initial=0.0), 0.0), max(shown.max(initial=0.0), 0.0)
        step = next((step for step in steps if max(-low, high) <= step), steps[-1])
        # What is small on the other side of zero has a little room there.
        below, above = (step if size > 0.1 * step else 0.12 * step for size in (-low, high))
        if below == above:
            below = above = step
        self.set_limits(axes, direction, -below, above)

    def set_limits(self, axes: Axes, direction: str, low: float, high: float) -> None:
        """Set the limits of axes; if they are new, everything is drawn anew."""
        if getattr(axes, f"get_{direction}lim")() != (low, high):
            getattr(axes, f"set_{direction}lim")(low, high)
            self.rescaled = True

    def words(self, axes: Axes, **style: Any) -> Text:
        """Add an empty text that `update` will place and fill."""
        text = axes.text(0.0, 0.0, "", **style)
        self.moving.append(text)
        return text

    def line(self, axes: Axes, **style: Any) -> Line2D:
        """Add an empty line that `update` will move."""
        (line,) = axes.plot([], [], **style)
        self.moving.append(line)
        return line


def project(points: FloatArray, azimuth: float = -60.0, elevation: float = 24.0) -> FloatArray:
    """Parallel projection (..., 2) of points (..., 3), seen from azimuth and elevation in degrees.

    The third axis points up on the page. It is all that three arrows need.
    """
    a, e = np.radians([azimuth, elevation])
    right = np.array([-np.sin(a), np.cos(a), 0.0])
    up = np.array([-np.sin(e) * np.cos(a), -np.sin(e) * np.sin(a), np.cos(e)])
    return points @ np.stack([right, up], axis=-1)


def legend_above(axes: Axes, ncols: int = 4, **style: Any) -> None:
    """Put the legend into the line of the title, where no data can come to lie under it.

    On paper, where a panel is too narrow for both, it stands below the panel.
    """
    if isinstance(axes.figure, Figure) and axes.figure.get_layout_engine() is not None:
        legend_below(axes, ncols, **style)
        return
    axes.legend(
        loc="lower right",
        bbox_to_anchor=(1.0, 0.985),
        ncols=ncols,
        frameon=False,
        borderaxespad=0.0,
        **{"handlelength": 1.8, "columnspacing": 1.1, "handletextpad": 0.5, **style},
    )


def legend_below_all(
    figure: Figure,
    sheet: Sheet,
    shown: Axes | Sequence[Any],
    ncols: int = 4,
    column: int = 2,
    *,
    points: float | None = None,
    **style: Any,
) -> None:
    """Put one legend below all panels, of the curves of some axes or of these artists.

    On a screen the figure's margins leave room for it, and its type may have a size in `points` of
    its own. On paper the layout finds the room; there are `column` columns in a narrow column.
    """
    handles = shown.get_legend_handles_labels()[0] if isinstance(shown, Axes) else shown
    place = (
        {"loc": "outside lower center", "frameon": False}
        if sheet.on_paper
        else {"loc": "lower center", "fontsize": points}
    )
    columns = column if sheet.narrow else ncols
    figure.legend(handles=handles, ncols=columns, **{**place, **style})


def legend_below(axes: Axes, ncols: int = 4, below: float = 31.0, **style: Any) -> None:
    """Put the legend under a panel of a figure on paper, so many points below it.

    The layout makes room for it.
    """
    figure = axes.figure
    assert isinstance(figure, Figure)
    under = ScaledTranslation(0, -below / 72, figure.dpi_scale_trans)
    axes.legend(
        loc="upper center",
        bbox_to_anchor=(0.5, 0.0),
        bbox_transform=axes.transAxes + under,
        ncols=ncols,
        frameon=False,
        borderaxespad=0.0,
        **{"handlelength": 1.8, "columnspacing": 1.1, "handletextpad": 0.5, **style},
    )


def decades(values: ArrayLike, low: float, high: float) -> tuple[float, float]:
    """Limits of a logarithmic axis: `low` and `high`, or whole decades where values leave them."""
    shown = np.asarray(values, float)
    shown = shown[np.isfinite(shown) & (shown > 0)]
    least, most = shown.min(initial=low), shown.max(initial=high)
    return (
        low if least >= low else float(10.0 ** np.floor(np.log10(least))),
        high if most <= high else float(10.0 ** np.ceil(np.log10(most))),
    )


def plain_axes(axes: Axes, reach: float = 1.25) -> None:
    """Turn axes into an empty square sheet for a projected drawing."""
    axes.set_aspect("equal")
    axes.set_xlim(-reach, reach)
    axes.set_ylim(-reach, reach)
    axes.axis("off")

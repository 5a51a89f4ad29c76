"""What a scene shows, as arrays: things in space, curves beside them, one time for both.

An experiment computes the arrays; `Stage` says which of them is drawn how. The script in the page
and the stills draw the same stage, so that every place on a screen is a number of the package.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray

from .spans import ticks_between

GROUND = -1e6
"""The `lift` of what everything else stands on: it is drawn first."""
KINDS = ("line", "arrow", "face", "dot", "label", "trace")
"""What a part can be. A face shows its front only; a trace is drawn up to the present moment."""


@dataclass(frozen=True)
class Part:
    """One thing in space."""

    kind: str  # one of `KINDS`
    # (p, 3) or (n, p, 3), its corners, counter-clockwise from outside for a face; with a leading
    # axis, at each of the n moments. A trace has (n, 3): where its point is at each moment
    points: FloatArray
    style: str  # a class of ``scene.css``: what it is, and so how it looks
    track: str = ""  # name of the attitude with which it turns; "" if it stands still
    text: str = ""  # what a label says
    fill: str = ""  # a colour of its own, for a face whose colour is a number
    # name under which a dot can be dragged, over a sphere about the origin; "" if it cannot
    handle: str = ""
    # by how much it is drawn as if it were nearer to the reader, so that a line on a surface is not
    # covered by the faces beside it
    lift: float = 0.0
    since: int = 0  # the moment from which on it is there

    @property
    def nearness(self) -> float:
        """What is added to its depth before the parts are sorted: names are drawn last."""
        return self.lift - GROUND if self.kind == "label" else self.lift


@dataclass(frozen=True)
class View:
    """A window into space."""

    title: str  # says what is seen, and how much it is magnified
    parts: tuple[Part, ...]
    azimuth: float = -60.0  # from where the reader looks at first, degrees
    elevation: float = 24.0  # likewise
    reach: float = 1.6  # what lies so far from the origin is at the window's edge


@dataclass(frozen=True)
class Curve:
    """A curve over the scene's time."""

    name: str  # stands at its end, instead of a legend
    values: FloatArray  # (n,), in the unit of the plot's axis; NaN leaves a gap
    style: str  # a class of ``scene.css``
    moments: NDArray[np.integer] | None = None  # only these moments, as dots


@dataclass(frozen=True)
class Plot:
    """Curves over the scene's time."""

    title: str  # with the unit
    curves: tuple[Curve, ...]
    low: float  # what the ordinate spans
    high: float
    # whether curves and span are given as decimal logarithms; the ticks show the numbers
    decades: bool = False

    @property
    def ticks(self) -> list[tuple[float, str]]:
        """Places between `low` and `high`, and what is written at them."""
        places = ticks_between(self.low, self.high, 4)
        if self.decades:
            return [(place, f"{10.0**place:g}") for place in places if place == round(place)]
        return [(place, f"{place:g}".replace("-", "−")) for place in places]


@dataclass(frozen=True)
class Readout:
    """A number that follows the time."""

    name: str
    values: FloatArray  # (n,)
    decimals: int = 0
    unit: str = ""
    # what is said instead of the numbers 0, 1, 2, ...; then `values` are such numbers
    words: tuple[str, ...] = ()

    def said(self, moment: int) -> str:
        """What stands in the table at a moment."""
        value = self.values[moment]
        if np.isnan(value):
            return "–"
        if self.words:
            return self.words[int(value)]
        number = f"{value:.{self.decimals}f}"
        # What rounds to zero has no sign.
        return number.replace("-", "−" if float(number) else "") + self.unit


@dataclass(frozen=True)
class Stage:
    """A scene at all its moments."""

    times: FloatArray  # (n,), evenly spaced, two at least, in `time_unit`
    time_unit: str  # "turns", "s", "min"
    seconds: float  # how long it plays
    # (n, 4) each, attitudes by name, quaternions from the body to space, scalar last
    tracks: dict[str, FloatArray]
    views: tuple[View, ...]
    plots: tuple[Plot, ...] = ()
    readouts: tuple[Readout, ...] = ()  # the first one is the number that matters

    def __post_init__(self) -> None:
        n = len(self.times)
        for view in self.views:
            for part in view.parts:
                if part.kind not in KINDS:
                    raise ValueError(
                        f"kind: expected one of {', '.join(KINDS)}, got {part.kind!r}."
                    )
                if part.track and part.track not in self.tracks:
                    known = ", ".join(self.tracks)
                    raise ValueError(f"track: expected one of {known}, got {part.track!r}.")
                moving = part.kind == "trace" or np.ndim(part.points) == 3
                if moving and len(part.points) != n:
                    raise ValueError(
                        f"points: expected {n} moments of {part.style}, got {len(part.points)}."
                    )
        arrays = [
            *self.tracks.values(),
            *(part.points for view in self.views for part in view.parts),
        ]
        if not all(np.isfinite(array).all() for array in arrays):
            raise ValueError("stage: expected finite points and tracks, got NaN or infinity.")

    def message(self) -> dict[str, Any]:
        """The stage as the script in the page takes it: text as text, arrays as bytes."""
        return {
            "times": _packed(self.times),
            "timeUnit": self.time_unit,
            "timeTicks": ticks_between(self.times[0], self.times[-1], 6),
            "seconds": self.seconds,
            "tracks": {name: _packed(track) for name, track in self.tracks.items()},
            "views": [
                {
                    "title": view.title,
                    "azimuth": view.azimuth,
                    "elevation": view.elevation,
                    "reach": view.reach,
                    "parts": [
                        {
                            "kind": part.kind,
                            "points": _packed(part.points),
                            "shape": list(np.shape(part.points)),
                            "style": part.style,
                            "track": part.track,
                            "text": part.text,
                            "fill": part.fill,
                            "handle": part.handle,
                            "lift": part.nearness,
                            "since": part.since,
                        }
                        for part in view.parts
                    ],
                }
                for view in self.views
            ],
            "plots": [
                {
                    "title": plot.title,
                    "low": plot.low,
                    "high": plot.high,
                    "ticks": plot.ticks,
                    "curves": [
                        {
                            "name": curve.name,
                            "values": _packed(curve.values),
                            "style": curve.style,
                            "moments": None if curve.moments is None else _packed(curve.moments),
                        }
                        for curve in plot.curves
                    ],
                }
                for plot in self.plots
            ],
            "readouts": [
                {
                    "name": readout.name,
                    "values": _packed(readout.values),
                    "decimals": readout.decimals,
                    "unit": readout.unit,
                    "words": list(readout.words),
                }
                for readout in self.readouts
            ],
        }


def _packed(array: Any) -> memoryview:
    return np.ascontiguousarray(array, dtype=np.float64).data.cast("B")

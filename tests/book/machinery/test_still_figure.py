"""A scene on paper: the parts of the stage, in the places, the order and the looks of its SVG."""

import numpy as np
import pytest
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Polygon
from matplotlib.text import Text

from driftlab.book.machinery.figure.sheet import COLUMN, Sheet
from driftlab.book.machinery.scene.look import colour, look
from driftlab.book.machinery.scene.solids import arrow, box, pin
from driftlab.book.machinery.scene.stage import Part, Stage, View
from driftlab.book.machinery.scene.still_figure import artists, still_figure
from driftlab.book.machinery.scene.svg import VIEW, flat_corners, from_behind


def a_stage() -> Stage:
    times = np.linspace(0.0, 2.0, 5)
    half = np.pi * times / 4
    zero = np.zeros(5)
    late = Part("line", np.array([[0.0, 0, 0], [0, 0, 1]]), "soft", since=3)
    trace = Part("trace", np.stack([times, zero, zero], axis=-1), "trace")
    parts = (*box((0.5, 0.4, 0.3), "block", "body"), *pin([1.0, 0, 0], "gyro", "body", "1"),
             *arrow([0, 0, 1.0], "rate"), late, trace)  # fmt: skip
    attitude = np.stack([zero, zero, np.sin(half), np.cos(half)], axis=-1)
    return Stage(times, "turns", 4.0, {"body": attitude}, (View("a block, turning", parts),))


@pytest.mark.parametrize("moment", [0, 2, 4])
def test_everything_is_where_the_svg_has_it_and_the_nearest_is_drawn_last(moment: int) -> None:
    stage = a_stage()
    (view,) = stage.views
    shown = list(artists(view, stage, moment))
    heights = [artist.get_zorder() for artist in shown]
    assert heights == sorted(heights)
    ordered = from_behind(view, stage, [moment])
    for artist in shown:
        part = ordered[int(artist.get_zorder()) - 2]
        corners = flat_corners(view, part, stage, moment)
        assert part.since <= moment
        if isinstance(artist, Polygon):
            np.testing.assert_array_equal(artist.get_xy()[:-1], corners)
        elif isinstance(artist, Circle):
            np.testing.assert_array_equal(artist.get_center(), corners[0])
        elif isinstance(artist, Text):
            np.testing.assert_array_equal(artist.get_position(), corners[0])
        elif isinstance(artist, Line2D) and part.kind != "arrow":
            np.testing.assert_array_equal(artist.get_xydata(), corners)
    faces = [artist for artist in shown if isinstance(artist, Polygon)]
    assert 1 <= len(faces) <= 3  # of six; no more look at the reader
    assert len([artist for artist in shown if isinstance(artist, Text)]) == 1


def test_looks_are_those_of_the_style_sheet() -> None:
    ghost = look("line", "ghost")
    assert ghost["stroke"] == "#b84f00"
    assert ghost["dashes"] == (4.0, 2.5)
    assert look("dot", "ghost")["fill"] == "#b84f00"
    block = look("face", "block")
    assert (block["fill"], block["alpha"], block["width"]) == ("#eef0f2", 0.88, 0.9)
    assert look("label", "letter")["bold"]
    assert look("face", "globe")["stroke"] == "none"


def test_colours_are_mixed_as_a_browser_mixes_them() -> None:
    assert colour("color-mix(in srgb, #ff0000 25%, var(--dl-paper))") == "#ffbfbf"
    assert colour("none") == "none"


def test_moments_stand_beside_each_other_and_say_when_they_are() -> None:
    figure = still_figure(a_stage(), Sheet(COLUMN), [0, 2, 4])
    shown = [panel for panel in figure.axes if panel.get_visible()]
    assert [panel.get_title("left") for panel in shown] == ["0 turns", "1 turn", "2 turns"]
    (alone,) = still_figure(a_stage(), Sheet(COLUMN), [4]).axes
    assert alone.get_title("left") == "a block, turning"
    assert alone.get_xlim()[1] <= VIEW

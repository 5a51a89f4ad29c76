"""What a stage refuses, what its plots span, and what its still draws."""

import numpy as np
import pytest

from driftlab.book.machinery.scene.solids import (
    FACES,
    arrow,
    box,
    box_corners,
    circle,
    globe,
    raised,
    sea,
    ship,
)
from driftlab.book.machinery.scene.spans import reach, span, ticks_between
from driftlab.book.machinery.scene.stage import Part, Readout, Stage, View
from driftlab.book.machinery.scene.svg import part_path, still

TIMES = np.arange(3.0)
STANDING = np.tile([0.0, 0, 0, 1], (3, 1))


def stage(*parts: Part, tracks: dict | None = None) -> Stage:
    return Stage(TIMES, "s", 1.0, tracks or {"body": STANDING}, (View("", parts),))


def test_a_stage_refuses_what_cannot_be_drawn() -> None:
    with pytest.raises(ValueError, match=r"^kind: expected one of line, .* got 'ball'\.$"):
        stage(Part("ball", np.zeros((1, 3)), "axis"))
    with pytest.raises(ValueError, match=r"^track: expected one of body, got 'ghost'\.$"):
        stage(Part("line", np.zeros((2, 3)), "axis", "ghost"))
    with pytest.raises(ValueError, match=r"^points: expected 3 moments of axis, got 2\.$"):
        stage(Part("line", np.zeros((2, 2, 3)), "axis"))
    with pytest.raises(ValueError, match=r"^stage: expected finite .* got NaN or infinity\.$"):
        stage(Part("line", np.array([[0.0, 0, np.nan]]), "axis"))


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ([0.0, 108.0], (-150, 150)),
        ([-3.0, 1.0], (-5, 5)),  # 3 is too near to its own edge
        ([0.0, np.nan], (-1, 1)),
        ([9.9e-4], (-1.5e-3, 1.5e-3)),
    ],
)
def test_reach_is_round_and_holds_all(values, expected) -> None:
    assert reach(np.array(values)) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("values", "least", "expected"),
    [
        ([0.0, 108.0], 0, (0, 150)),
        ([-108.0, 0.0], 0, (-150, 0)),
        ([-1.0, 108.0], 0, (-1, 150)),
        ([-50.0, 108.0], 0, (-150, 150)),
        ([0.0, 0.0], 0, (-1, 1)),
        ([0.0, 0.1], 1.0, (0, 1.5)),
    ],
)
def test_span_has_one_side_where_one_is_enough(values, least, expected) -> None:
    assert span(np.array(values), least) == pytest.approx(expected)


def test_ticks_are_round_and_inside() -> None:
    assert ticks_between(-150, 150, 4) == [-100, 0, 100]
    assert ticks_between(0, 5, 6) == [0, 1, 2, 3, 4, 5]


def test_readouts_have_a_true_minus_and_no_sign_on_zero() -> None:
    said = Readout("", np.array([-0.001, -1.5, np.nan]), 2, "°")
    assert [said.said(k) for k in range(3)] == ["0.00°", "−1.50°", "–"]


def test_faces_of_a_box_look_outward() -> None:
    corners = box_corners((1, 2, 3))
    for face in FACES:
        a, b, c, d = corners[list(face)]
        assert np.cross(c - a, d - b) @ (a + c) > 0
    assert len(box((1, 2, 3), "block")) == 6


def test_a_globe_is_covered_once() -> None:
    """The areas of its flat faces come near to that of the sphere, from below."""
    areas = []
    for part in globe([["#000000"] * 24] * 12):
        a, b, c, d = part.points
        areas.append(np.linalg.norm(np.cross(c - a, d - b)) / 2)
    assert 0.97 < sum(areas) / (4 * np.pi) < 1


def test_a_circle_is_where_it_should_be() -> None:
    points = circle([0, 3, 4], radius=2.0, height=1.0)
    assert points @ [0, 0.6, 0.8] == pytest.approx(1.0)
    assert np.linalg.norm(points, axis=1) == pytest.approx(np.sqrt(5))
    assert points[0] == pytest.approx(points[-1])


def test_an_arrow_that_points_at_the_reader_has_no_barbs() -> None:
    (part,) = arrow([1.0, 0, 0], "axis")
    assert part_path(part, np.array([[0.0, 0.0], [0.5, 0.0]])).count("M") == 1
    shaft, barbs = part_path(part, np.array([[0.0, 0.0], [50.0, 0.0]]))[1:].split("M")
    assert shaft == "0.00,0.00L50.00,0.00"
    assert barbs == "42.00,3.20L50.00,0.00L42.00,-3.20"


@pytest.mark.parametrize("azimuth", [-150.0, -60.0, 30.0, 120.0])
def test_the_ship_stands_on_the_sea_from_wherever_one_looks(azimuth: float) -> None:
    parts = (*ship(), *sea(1.4))
    stage = Stage(np.arange(2.0), "s", 1.0, {}, (View("", parts, azimuth, 30.0),))
    picture = still(stage)
    assert picture.index('"dl-face dl-sea"') < picture.index('"dl-face dl-hull"')
    assert picture.index('"dl-face dl-sea"') < picture.index('"dl-label dl-letter"')


def test_the_hull_and_the_bridge_show_their_outside() -> None:
    faces = [part.points for part in ship() if part.kind == "face"]
    hull, bridge = faces[:6], faces[6:]
    for solid in (hull, bridge):
        middle = np.mean([face.mean(axis=0) for face in solid], axis=0)
        for face in solid:
            normal = np.cross(face[1] - face[0], face[2] - face[1])
            assert normal @ (face.mean(axis=0) - middle) > 0


def test_lifted_parts_keep_their_shape() -> None:
    for low, high in zip(ship(), raised(ship(), 0.5), strict=True):
        assert np.allclose(high.points - low.points, [0.0, 0.0, 0.5])

"""Solids of the living scenes: what stands on what, and which side is out."""

import numpy as np
import pytest

from driftlab.book.machinery.scene.solids import raised, sea, ship
from driftlab.book.machinery.scene.stage import Stage, View
from driftlab.book.machinery.scene.svg import still


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

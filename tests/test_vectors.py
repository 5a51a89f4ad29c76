"""Vectors: directions by their angles."""

import numpy as np
from hypothesis import given, strategies as st

from driftlab.vectors import direction_from_angles


@given(st.floats(-180, 180), st.floats(-90, 90))
def test_direction_is_a_unit_vector_with_its_angles(azimuth: float, elevation: float) -> None:
    x, y, z = direction_from_angles(np.radians(azimuth), np.radians(elevation))
    assert np.isclose(x**2 + y**2 + z**2, 1)
    assert np.isclose(np.degrees(np.arcsin(np.clip(z, -1, 1))), elevation, atol=1e-5)
    if abs(elevation) < 89:
        turned = np.radians(azimuth) - np.arctan2(y, x)
        assert np.isclose(np.cos(turned), 1)

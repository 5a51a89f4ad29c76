"""The scene of chapter 10: what a bracket changes of a report, and what it does not."""

import numpy as np
from scipy.constants import arcsecond

from driftlab.body_frames import misalignment_vector
from driftlab.book.ch10_misalignment.laboratories import two_laboratories
from driftlab.book.ch10_misalignment.scenes import MAGNIFICATION, TwoTables
from driftlab.imu import TYPICAL_ERRORS
from driftlab.quaternion import rotate
from grouped import opened
from support import EPS

BRACKET = np.array([30.0, -15.0, 25.0]) * arcsecond
SECOND_ORDER = 10 * (90 * arcsecond) ** 2
"""A few products of two angles, none of which is larger than 90 arc seconds."""
ROUNDING = 16 * EPS
"""Of arrows of length one, turned and multiplied."""


def test_angles_between_the_arrows_do_not_change() -> None:
    data = two_laboratories(TYPICAL_ERRORS.gyro_error_matrix, BRACKET)
    assert np.ptp(data.lack_of_square, axis=0).max() < ROUNDING
    assert np.abs(data.lack_of_square - 2 * data.non_orthogonality).max() < SECOND_ORDER
    assert np.ptp(data.non_orthogonality, axis=0).max() < SECOND_ORDER


def test_misalignment_changes_by_the_bracket() -> None:
    data = two_laboratories(TYPICAL_ERRORS.gyro_error_matrix, BRACKET)
    assert np.abs(data.reported[0] - TYPICAL_ERRORS.gyro_error_matrix).max() < ROUNDING
    gap = data.misalignment - data.misalignment[0] - data.share[:, np.newaxis] * BRACKET
    assert np.abs(gap).max() < SECOND_ORDER


def test_the_bracket_that_suits_hides_the_misalignment() -> None:
    in_a = TYPICAL_ERRORS.gyro_error_matrix
    data = two_laboratories(in_a, -misalignment_vector(in_a))
    assert np.abs(data.misalignment[-1]).max() < SECOND_ORDER
    scene = opened(TwoTables)
    scene.preset.value = "The bracket that suits"
    assert (
        np.abs(scene.compute(scene.values).misalignment[-1]).max() < 1e-3 * arcsecond + SECOND_ORDER
    )


def test_the_arrows_are_drawn_as_laboratory_b_reports_them() -> None:
    """Drawn too large, so that only the first order agrees: try it with a thousandth of both."""
    scene = opened(TwoTables)
    small = two_laboratories(1e-3 * scene.compute(scene.values).gyro_error_matrix, 1e-3 * BRACKET)
    stage = scene.view.stage(small)
    unit = [p for p in stage.views[1].parts if p.style == "gyro" and p.kind == "dot"]
    drawn = np.array([rotate(stage.tracks["unit"][-1], p.points[0]) for p in unit])
    leans = drawn / np.linalg.norm(drawn, axis=1, keepdims=True) - np.eye(3)
    expected = MAGNIFICATION * small.reported[-1]
    largest = MAGNIFICATION * 90e-3 * arcsecond
    assert np.abs(leans - expected).max() < 10 * largest**2
    assert np.abs(expected).max() > 0.3 * largest

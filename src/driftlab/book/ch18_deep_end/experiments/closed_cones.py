"""Closed cones of any shape: the solid angle that an axis goes round, and what its gyro sums up."""

import numpy as np

from driftlab.attitude.spherical_area import solid_angle
from driftlab.core.coning import cone_increments
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, rotate

CORNERS = 4096
"""Points on a closed cone; with so many the great circles between them leave 1e-6 of the area."""


def closed_cone(first: float, second: float, loops: int = 1) -> tuple[float, float]:
    """Take a body round a cone that is not round, and back: what its gyro sums up, and the area.

    The first is the integral of the rate about the third body axis, which goes round the cone, rad;
    the second is the solid angle inside the cone, positive to the left of the way. The rotation
    vector of the body runs round an ellipse in the plane of the first two axes or, with several
    loops about the second axis in one about the first, a Lissajous figure.
    """
    phase = 2 * np.pi * np.arange(CORNERS) / CORNERS
    swing = np.stack([first * np.cos(phase), second * np.sin(loops * phase), 0 * phase], axis=-1)
    attitude = from_rotation_vector(swing)
    # The body comes back, so its quaternion is a trigonometric series, and so is its derivative.
    turns = np.fft.fftfreq(CORNERS, 1 / CORNERS)[:, np.newaxis]
    derivative = np.fft.ifft(1j * turns * np.fft.fft(attitude, axis=0), axis=0).real
    rate = 2 * multiply(conjugate(attitude), derivative)[..., :3]
    axis = rotate(attitude, np.array([0.0, 0.0, 1.0]))
    return float(2 * np.pi * rate[:, 2].mean()), float(solid_angle(axis))


def swept_in_a_sample(half_angle: float, sample_angle: float) -> tuple[float, float]:
    """Solid angles that the third axis sweeps in one sample on a cone, computed and true, sr.

    Their difference is the drift of a sample. The computer takes each increment for a rotation
    about a fixed axis, so that its third axis runs along a row of small arcs. Each is seen from the
    axis about which the computed attitude goes round: from there all are alike.
    """
    third = np.array([0.0, 0.0, 1.0])
    sample = np.asarray(sample_angle)
    increment = cone_increments(np.asarray(half_angle), sample, sample / 2)
    turned = multiply(from_rotation_vector(increment), from_rotation_vector(sample_angle * third))
    middle = turned[:3] / np.linalg.norm(turned[:3])
    nodes, weights = np.polynomial.legendre.leggauss(20)
    along = rotate(from_rotation_vector((nodes[:, np.newaxis] + 1) / 2 * increment), third)
    # (1 - cos θ) dψ about the middle, on the arc.
    moved = np.cross(along, np.cross(increment, along)) @ middle / (1 + along @ middle)
    return float(weights @ moved / 2), float(2 * sample_angle * np.sin(half_angle / 2) ** 2)

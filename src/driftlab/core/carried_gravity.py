"""Gravity carried into inertial axes: the arithmetic of `driftlab.gyrocompass.inertial_alignment`.

Inertial axes are twice the same line of thought: those in which the body stood at the start, and
those in which North, Up, East pointed then. In the first the accelerometers and gyros give the
velocity that the body would have gained; in the second the turning Earth gives it.
"""

from __future__ import annotations

import numpy as np

from driftlab.checks import FloatArray

from .coning import ConingSteps
from .earth import EARTH_RATE
from .loops import attitudes
from .quaternion import from_rotation_vector, multiply, rotate
from .sculling import velocity_of_steps
from .vectors import cross_matrix, stacked


def carried_velocity(
    algorithm: ConingSteps, angle: FloatArray, velocity: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Attitude (..., 4) at the end, and integrals (..., m, 3) of the specific force after each
    step, both in the body axes of the start."""
    attitude = attitudes(algorithm, angle)
    start = np.broadcast_to([0.0, 0.0, 0.0, 1.0], (*attitude.shape[:-2], 1, 4))
    before = np.concatenate([start, attitude[..., :-1, :]], axis=-2)
    pushes = rotate(before, velocity_of_steps(algorithm, angle, velocity))
    return attitude[..., -1, :], np.cumsum(pushes, axis=-2)


def cone_velocity(latitude: FloatArray, times: FloatArray) -> FloatArray:
    """Integrals (..., m, 3) of the direction Up, s, in the North, Up, East of the time zero.

    Up goes round the Earth's axis on a cone. Shapes are (...) and (m,).
    """
    cosine, sine = np.cos(latitude)[..., np.newaxis], np.sin(latitude)[..., np.newaxis]
    angle = EARTH_RATE * times
    across = np.sin(angle) / EARTH_RATE
    return stacked(
        cosine * sine * (times - across),
        sine**2 * times + cosine**2 * across,
        cosine * 2 * np.sin(angle / 2) ** 2 / EARTH_RATE,
    )


def earth_turn(latitude: FloatArray, time: float) -> FloatArray:
    """Quaternion (..., 4) from North, Up, East of the time zero to those of a time."""
    half = -0.5 * EARTH_RATE * time
    size = np.sin(half) * np.ones_like(latitude)
    return stacked(
        size * np.cos(latitude), size * np.sin(latitude), 0.0 * size, np.cos(half) + 0.0 * size
    )


def centred(rows: FloatArray, weights: FloatArray) -> FloatArray:
    """Vectors (..., m, 3) less their weighted mean; `weights` (m,) have the sum 1."""
    return rows - (weights @ rows)[..., np.newaxis, :]


def wahba_rotation(given: FloatArray, wanted: FloatArray, weights: FloatArray) -> FloatArray:
    """Unit quaternion (..., 4) that turns vectors (..., m, 3) into others as well as can be.

    Davenport's q-method for Wahba's problem: the eigenvector of the largest eigenvalue. Velocities
    are nearly parallel, and its sums of products lose half of the digits of what is not. A step of
    Gauss and Newton with an orthogonal basis, which forms no such sums, brings them back.
    """
    products = np.swapaxes(given * weights[:, np.newaxis], -1, -2) @ wanted
    trace = np.trace(products, axis1=-2, axis2=-1)
    matrix = np.empty((*products.shape[:-2], 4, 4))
    matrix[..., :3, :3] = products + np.swapaxes(products, -1, -2)
    matrix[..., :3, :3] -= trace[..., np.newaxis, np.newaxis] * np.eye(3)
    for i, (j, k) in enumerate(((1, 2), (2, 0), (0, 1))):
        matrix[..., i, 3] = matrix[..., 3, i] = products[..., j, k] - products[..., k, j]
    matrix[..., 3, 3] = trace
    quaternion = np.linalg.eigh(matrix)[1][..., -1]
    quaternion = quaternion * np.where(quaternion[..., 3:] < 0, -1.0, 1.0)
    root = np.sqrt(weights)[:, np.newaxis]
    basis, short = np.linalg.qr(root * wanted)
    turned = rotate(quaternion[..., np.newaxis, :], root * given)
    seen = np.swapaxes(basis, -1, -2) @ turned
    size = (seen * short).sum(axis=(-2, -1)) / (short * short).sum(axis=(-2, -1))
    gap = seen - size[..., np.newaxis, np.newaxis] * short
    design = cross_matrix(seen).reshape(*seen.shape[:-2], -1, 3)
    rest = np.linalg.pinv(design) @ gap.reshape(*gap.shape[:-2], -1, 1)
    return multiply(from_rotation_vector(rest[..., 0]), quaternion)

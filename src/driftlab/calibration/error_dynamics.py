"""How the errors of `error_model` grow while a unit navigates on a table: Wu (6), (49), (50)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray
from driftlab.core.quaternion import to_matrix
from driftlab.core.vectors import cross_matrix
from driftlab.earth import curvature_radii, earth_rate
from driftlab.imu import Noise

from .error_model import ErrorModel


def free_growth(latitude: float, duration: ArrayLike) -> FloatArray:
    """Transition (..., 6, 6) of attitude and velocity errors without sensor errors and force.

    What is left of Wu (6) on a table at rest at a `latitude` in rad, over a `duration` (...) in s
    much shorter than a day: the local axes turn with the Earth, a velocity error turns them as
    well, and there is Coriolis's force.
    """
    earth = earth_rate(latitude)
    meridian, across = curvature_radii(latitude)
    rates = np.zeros((6, 6))
    rates[:3, :3] = -cross_matrix(earth)
    rates[0, 4] = -1 / meridian
    rates[1:3, 3] = 1 / across, np.tan(latitude) / across
    rates[3:, 3:] = -2 * cross_matrix(earth)
    change = np.asarray(duration)[..., np.newaxis, np.newaxis] * rates
    square = change @ change
    return np.eye(6) + change + square / 2 + square @ change / 6


def transition(
    model: ErrorModel,
    free: FloatArray,
    attitude: FloatArray,
    times: FloatArray,
    angle: FloatArray,
    velocity: FloatArray,
    passed: FloatArray,
) -> FloatArray:
    """Transition matrix (..., size, size) of the errors over an interval; Wu (49), (50).

    What arises within the interval grows on as if it had been there from the beginning: an error
    of the order of the Earth's turn in that time.

    Parameters
    ----------
    model : ErrorModel
    free : ndarray, shape (..., 6, 6)
        `free_growth` over the interval.
    attitude : ndarray, shape (..., n, 3, 3)
        Body axes at n places in the interval, to the local axes of its *beginning*.
    times, angle, velocity : ndarray, shapes (..., n), (..., n, 3), (..., n, 3)
        Shares of the integrals over the interval that stand for the n places: of time (s), of the
        angular rate (rad) and of the specific force (m/s) in body axes.
    passed : ndarray, shape (n, n)
        How much of each share (column) has passed at each place (row).
    """
    gyro = slice(6, 9 + len(model.gyro_basis))
    accelerometer = slice(gyro.stop, model.size)
    tilts = attitude @ _effects(model.gyro_basis, times, angle)
    pushes = attitude @ _effects(model.accelerometer_basis, times, velocity)
    force = cross_matrix((attitude @ velocity[..., np.newaxis])[..., 0])
    tilted = (passed @ tilts.reshape(*tilts.shape[:-2], -1)).reshape(tilts.shape)
    moved = np.zeros((*angle.shape[:-2], 6, model.size))
    moved[..., :6] = np.eye(6)
    moved[..., 3:, :3] = force.sum(axis=-3)
    moved[..., :3, gyro] = -tilts.sum(axis=-3)
    moved[..., 3:, gyro] = -(force @ tilted).sum(axis=-3)
    moved[..., 3:, accelerometer] = pushes.sum(axis=-3)
    matrix = np.empty((*angle.shape[:-2], model.size, model.size))
    matrix[..., 6:, :] = np.eye(model.size)[6:]
    matrix[..., :6, :] = free @ moved
    return matrix


def transition_of_increments(
    model: ErrorModel,
    free: FloatArray,
    attitude: FloatArray,
    angle_increments: FloatArray,
    velocity_increments: FloatArray,
    interval: float,
) -> FloatArray:
    """Transition matrix (..., size, size) of the errors while a unit navigates for a short time.

    Parameters
    ----------
    model, free
        As in `transition`; `free` for the whole time.
    attitude : ndarray, shape (..., n + 1, 4)
        Computed attitudes before and after each pair of increments.
    angle_increments, velocity_increments : ndarray, shape (..., 2 n, 3)
        What the attitudes were computed from: increments without the errors known so far.
    interval : float
        Of one increment, s.
    """
    matrices = to_matrix(attitude)
    # Local axes turn by an arc second or so in a second; here they count as fixed.
    middle = 0.5 * (matrices[..., :-1, :, :] + matrices[..., 1:, :, :])
    angle = angle_increments[..., 0::2, :] + angle_increments[..., 1::2, :]
    velocity = velocity_increments[..., 0::2, :] + velocity_increments[..., 1::2, :]
    count = angle.shape[-2]
    # In the middle of a pair, half of it has passed.
    passed = np.tri(count) - 0.5 * np.eye(count)
    times = np.full(count, 2 * interval)
    return transition(model, free, middle, times, angle, velocity, passed)


def _effects(basis: FloatArray, times: FloatArray, values: FloatArray) -> FloatArray:
    """Errors (..., n, 3, 3 + m) in body axes per unit of the three biases and m coefficients."""
    effects = np.empty((*values.shape, 3 + len(basis)))
    effects[..., :3] = times[..., np.newaxis, np.newaxis] * np.eye(3)
    effects[..., 3:] = np.tensordot(values, basis, ([-1], [2])).swapaxes(-1, -2)
    return effects


def process_noise(noise: Noise, force: FloatArray, duration: FloatArray, size: int) -> FloatArray:
    """Covariance (..., size, size) that white sensor noise adds in `duration` (...) in s.

    `force` (..., 3, 3) carries an attitude error at the beginning into the velocity, m/s: a block
    of the transition matrix. It does so with the random walk of the attitude as well.
    """
    covariance = np.zeros((*force.shape[:-2], size, size))
    seconds = duration[..., np.newaxis, np.newaxis]
    tilt = noise.angle_random_walk**2 * seconds
    covariance[..., :3, :3] = tilt * np.eye(3)
    transposed = np.swapaxes(force, -1, -2)
    covariance[..., 3:6, :3] = tilt / 2 * force
    covariance[..., :3, 3:6] = tilt / 2 * transposed
    own = noise.velocity_random_walk**2 * seconds * np.eye(3)
    covariance[..., 3:6, 3:6] = own + tilt / 3 * force @ transposed
    return covariance

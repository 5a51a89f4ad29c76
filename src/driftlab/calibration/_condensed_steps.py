"""What a row of steps does to the covariance of a filter, condensed to three matrices.

``P -> Phi (P^-1 + J)^-1 Phi^T + M``: J is the information that the velocities of these steps hold
on the state before them, Phi carries on what is left unknown, M is what the noise adds. Two such
rows make one again, so a pause is worked out once and used as often as it occurs.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from driftlab.checks import FloatArray
from driftlab.imu import ImuNoise

from .error_dynamics import process_noise


class Condensed(NamedTuple):
    """Steps, condensed; only attitude and velocity change and gain noise.

    Attributes
    ----------
    carried : ndarray, shape (..., 6, n)
        Rows of Phi for attitude and velocity; the others are those of the unit matrix.
    information : ndarray, shape (..., n, n)
        J.
    added : ndarray, shape (..., 6, 6)
        M.
    """

    carried: FloatArray
    information: FloatArray
    added: FloatArray

    def after(self, covariance: FloatArray) -> FloatArray:
        """Covariances (..., n, n) after the steps, from those before them."""
        size = covariance.shape[-1]
        left = np.linalg.solve(np.eye(size) + covariance @ self.information, covariance)
        rows = self.carried @ left
        found = np.array(left, np.float64)
        found[..., :6, :] = rows
        found[..., :, :6] = np.swapaxes(rows, -1, -2)
        found[..., :6, :6] = rows @ np.swapaxes(self.carried, -1, -2) + self.added
        found += np.swapaxes(found, -1, -2)
        found *= 0.5
        return found

    def then(self, later: Condensed) -> Condensed:
        """These steps and later ones as one."""
        six = slice(0, 6)
        # What these steps add is looked at by the later ones.
        inner = np.eye(6) + self.added @ later.information[..., six, six]
        known = np.linalg.solve(inner, self.added)
        columns = later.information[..., six]
        information = later.information - columns @ known @ np.swapaxes(columns, -1, -2)
        shrunk = later.carried - later.carried[..., six] @ known @ np.swapaxes(columns, -1, -2)
        added = later.carried[..., six] @ known @ np.swapaxes(later.carried[..., six], -1, -2)
        back = _through(np.swapaxes(information, -1, -2), self.carried)
        return Condensed(
            _through(shrunk, self.carried),
            self.information + _through(np.swapaxes(back, -1, -2), self.carried),
            later.added + added,
        )

    def times(self, count: int) -> Condensed:
        """The same steps `count` times, one after the other."""
        if count == 1:
            return self
        half = self.times(count // 2)
        twice = half.then(half)
        return twice.then(self) if count % 2 else twice


def _through(matrix: FloatArray, carried: FloatArray) -> FloatArray:
    """The product of a matrix (..., m, n) and Phi."""
    found = matrix[..., :6] @ carried
    found[..., 6:] += matrix[..., 6:]
    return found


def condensed_steps(
    transitions: FloatArray, durations: FloatArray, noise: ImuNoise, update: float = 1.0
) -> Condensed:
    """Return steps (...) in which errors grow, noise is added and the velocity is measured.

    The velocity is measured every `update` seconds; the measurements of a step of the given
    duration, s, count as one at its end.
    """
    size = transitions.shape[-1]
    carried = transitions[..., :6, :]
    growth = Condensed(
        carried,
        np.zeros_like(transitions),
        process_noise(noise, carried[..., 3:, :3], durations),
    )
    look = np.zeros((*durations.shape, size, size))
    weight = durations / (noise.reference_velocity**2 * update)
    look[..., [3, 4, 5], [3, 4, 5]] = weight[..., np.newaxis]
    unit = np.broadcast_to(np.eye(6, size), carried.shape)
    return growth.then(Condensed(unit, look, np.zeros_like(growth.added)))

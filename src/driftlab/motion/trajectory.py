"""The true motion of a body near the Earth, and what ideal sensors deliver on the way."""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np

from driftlab.checks import FloatArray
from driftlab.increments import Increments


class Trajectory(NamedTuple):
    """True motion at n + 1 equally spaced times, and the increments of ideal sensors between them.

    Attributes
    ----------
    increments : Increments
        Of ideal gyros and accelerometers, arrays of shape (n, 3).
    attitude : ndarray, shape (n + 1, 4)
        Unit quaternions, body to local axes.
    latitude : ndarray, shape (n + 1,)
        rad.
    velocity : ndarray, shape (n + 1, 2)
        To the North and to the East, m/s.
    local_axes : str
        Order of the local axes: "East, North, Up" on a turntable (Part III), "North, Up, East" on
        a vehicle (Part IV), as in the papers.
    """

    increments: Increments
    attitude: FloatArray
    latitude: FloatArray
    velocity: FloatArray
    local_axes: Literal["East, North, Up", "North, Up, East"]

    @property
    def times(self) -> FloatArray:
        """Times (n + 1,) of the attitudes, s, counted from the start."""
        return np.asarray(self.increments.interval * np.arange(len(self.attitude)), np.float64)

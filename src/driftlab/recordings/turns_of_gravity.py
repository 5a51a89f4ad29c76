"""Does gravity turn in the body as the gyros say? The test that knows units and signs of a gyro.

Whatever was done with a unit, its accelerometers see gravity f whenever it is held fairly still,
and between two such moments f changes by the integral of f × ω. So the gyros' unit, their signs and
the order of their columns can be checked, but for what turns about the vertical only.
"""

from __future__ import annotations

from itertools import permutations, product
from typing import NamedTuple

import numpy as np

from driftlab.checks import FloatArray, checked_instance

from .recording import Recording

WINDOW = 0.25
"""Length of a moment in which the unit may be held still, s."""
_STEADY, _NEAR = 0.1, 0.2
"""Still is: specific force spreads less than this, and differs less from its median, in g."""
_TURN = 0.2
"""A turn of gravity that counts, in g: eleven degrees."""
_REST = 0.03
"""A change of gravity from one window to the next that is none, in g: seven degrees a second."""
_ENOUGH = 5
"""Turns from which something is concluded."""
_CHANCE = 1e-3
"""Of taking gravity's turns for explained where the gyros have nothing to do with them."""
_TIED = 0.01
"""Share of gravity's turns that a good triad may leave unexplained."""
_ORDERS = np.array(
    sorted(
        (
            np.eye(3)[list(order)] * np.array(signs)[:, None]
            for order in permutations(range(3))
            for signs in product((1, -1), repeat=3)
        ),
        key=np.trace,
        reverse=True,
    )
)
"""Ways (48, 3, 3) to take the columns of a triad in some order and with some signs; those that
change least stand first."""
_CROSS = np.cross(np.eye(3)[:, None], np.eye(3)[None])
"""Entries (j, k, i): component i of the product of unit vectors j and k."""


class GravityTurns(NamedTuple):
    """What gravity's turns in the body say about the gyros.

    Attributes
    ----------
    factor : float
        What the gyros should be multiplied with; 1 within some ten percent of a good record.
    order : ndarray, shape (3, 3)
        And which signed permutation of their columns is right; the identity of a good record.
    explained : float
        Share of gravity's turns, squared, that they account for then.
    needed : float
        Share that gyros which have nothing to do with it reach once in a thousand records.
    turns : int
        How often gravity turned between two still moments.

    Examples
    --------
    >>> GravityTurns(1.0, np.eye(3), 0.95, 0.3, 20).turns
    20
    """

    factor: float
    order: FloatArray
    explained: float
    needed: float
    turns: int


def gravity_turns(recording: Recording) -> GravityTurns | None:
    """Compare the turns of gravity in the body with those that the gyros tell.

    Parameters
    ----------
    recording : Recording
        Whatever its units: that of its accelerometers does not matter.

    Returns
    -------
    GravityTurns or None
        None if there are no accelerometers, or gravity did not turn five times.

    Notes
    -----
    The middle of what the gyros show where gravity rests is taken for their bias. All 48 orders and
    signs of the columns are tried, each with its best factor; the one that explains most is
    returned, or one that changes less and leaves not twice as much unexplained.
    How much 24 tries (signs of the factor apart) explain by chance of n components that are
    independent follows from the beta distribution of a squared correlation, bounded by
    (1 - explained)^((n - 1) / 2) a try; each turn of gravity has n = 2 components.

    Examples
    --------
    A unit is tilted to and fro, and its gyros are read in degrees instead of radians:

    >>> angle = 0.5 * (1 - np.cos(np.arange(3000) / 100))
    >>> force = 9.8 * np.stack([np.sin(angle), np.zeros(3000), np.cos(angle)], axis=1)
    >>> gyro = np.degrees(np.gradient(angle, 0.01))[:, None] * [0, -1, 0]
    >>> found = gravity_turns(Recording(gyro, force, 0.01, "rates"))
    >>> 55 < 1 / found.factor < 60, found.order[1]
    (True, array([0., 1., 0.]))
    """
    checked_instance(recording, Recording, "recording")
    if recording.accelerometer is None:
        return None
    force = recording.accelerometer
    angle = recording.gyro * (recording.interval if recording.kind == "rates" else 1.0)
    rows = max(round(WINDOW / recording.interval), 4)
    count = len(force) // rows
    if count < 4:
        return None
    forces = force[: count * rows].reshape(count, rows, 3)
    angles = angle[: count * rows].reshape(count, rows, 3)
    gravity = float(np.median(np.linalg.norm(force, axis=1)))
    mean = forces.mean(axis=1)
    spread = np.sqrt(forces.var(axis=1).sum(axis=-1))
    near = np.abs(np.linalg.norm(mean, axis=1) - gravity) < _NEAR * gravity
    still = np.flatnonzero(near & (spread < _STEADY * gravity))
    if len(still) < 4:
        return None
    # Where gravity stays for two windows the unit rests, and its gyros show their bias.
    pairs = still[:-1][np.diff(still) == 1]
    steps = np.linalg.norm(mean[pairs + 1] - mean[pairs], axis=1)
    resting = pairs[steps < _REST * gravity]
    if len(resting):
        angles = angles - np.median(angles[resting].mean(axis=1), axis=0)
    # Sums of f θ^T up to the middle of each window: all f × (A θ) follow from them.
    products = np.cumsum(forces.transpose(0, 2, 1) @ angles, axis=0)
    products[1:] = (products[1:] + products[:-1]) / 2
    ends = still[_apart(mean[still] / gravity)]
    turns = len(ends) - 1
    if turns < _ENOUGH:
        return None
    turned = np.diff(mean[ends], axis=0).ravel() / gravity
    products = np.diff(products[ends], axis=0) / gravity
    told = np.einsum("jki,pkl,sjl->psi", _CROSS, _ORDERS, products, optimize=True)
    told = told.reshape(len(_ORDERS), -1)
    common, size = told @ turned, np.sum(told**2, axis=1)
    share = np.divide(common**2, size, out=np.zeros(len(size)), where=(common > 0) & (size > 0))
    share /= np.sum(turned**2)
    if not share.any():
        return None
    # Turns about one axis say nothing of the others: of equals the one that changes least.
    best = int(np.argmax(1 - share <= 2 * max(1 - share.max(), _TIED)))
    needed = 1 - (_CHANCE / (len(_ORDERS) / 2)) ** (2 / (2 * turns - 1))
    return GravityTurns(
        float(common[best] / size[best]),
        _ORDERS[best],
        float(share[best]),
        float(needed),
        turns,
    )


def _apart(directions: FloatArray) -> list[int]:
    """Indices of moments, each the first with gravity turned enough since the one before."""
    rows = directions.tolist()
    found, (x, y, z) = [0], rows[0]
    for index, (a, b, c) in enumerate(rows):
        if (a - x) ** 2 + (b - y) ** 2 + (c - z) ** 2 > _TURN**2:
            found.append(index)
            x, y, z = a, b, c
    return found

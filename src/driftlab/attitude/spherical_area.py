"""The solid angle that an axis of a body goes round, and what the gyro along it sums up meanwhile.

Goodman and Robinson's theorem (1958): while an axis of a body describes a closed cone and the body
comes back, the gyro along the axis sums up minus the solid angle of the cone, but for whole turns.
"""

from __future__ import annotations

from itertools import product

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, nonzero_vectors

_OPPOSITE = 1e-12
"""One and the cosine between neighbours, below which they count as opposite: a microradian."""
_CANDIDATES = np.array([p for p in product((-1.0, 0.0, 1.0), repeat=3) if any(p)])
_CANDIDATES /= np.linalg.norm(_CANDIDATES, axis=-1, keepdims=True)


def solid_angle(directions: ArrayLike) -> FloatArray:
    """Solid angle inside a closed polygon on the sphere, its corners joined by great circles.

    Parameters
    ----------
    directions : array_like, shape (..., n, 3)
        Corners in their order, as vectors of any length. The last is joined to the first.

    Returns
    -------
    ndarray, shape (...)
        Steradians, from -2 pi to 2 pi, known up to the whole sphere, 4 pi; positive if the inside
        lies to the left of the path as seen from outside.

    Raises
    ------
    ValueError
        If a direction has no length, there are fewer than three of them, or two neighbours are
        opposite.

    References
    ----------
    - Goodman, Robinson, *Effect of finite rotations on gyroscopic sensing devices*, Journal of
      Applied Mechanics 25(2), 1958.
    - A. Yu. Ishlinskii, *Mechanics of Gyroscopic Systems*, Israel Program for Scientific
      Translations, 1965.

    Examples
    --------
    An eighth of the sphere:

    >>> float(solid_angle(np.eye(3)) / np.pi)
    0.5
    """
    corners, _ = nonzero_vectors(directions, "directions")
    if corners.ndim < 2 or corners.shape[-2] < 3:
        raise ValueError(
            "directions: expected shape (..., n, 3) with n of at least 3, "
            f"got shape {corners.shape}."
        )
    following = np.roll(corners, -1, axis=-2)
    if (1 + np.sum(corners * following, axis=-1) < _OPPOSITE).any():
        raise ValueError(
            "directions: expected neighbours that one great circle joins, got opposite ones."
        )
    # Triangles from a common apex, one for each edge; the tangent of half the solid angle of each
    # is a quotient (van Oosterom and Strackee), of numbers whose arguments add up. It is 0/0 for a
    # corner opposite to the apex, so the apex is the candidate farthest from all such.
    farthest = np.argmax(np.min(1 + corners @ _CANDIDATES.T, axis=-2), axis=-1)
    apex = _CANDIDATES[farthest][..., np.newaxis, :]
    volume = np.sum(apex * np.cross(corners, following), axis=-1)
    cosines = 1 + np.sum(apex * corners + corners * following + following * apex, axis=-1)
    whole = 2 * np.arctan2(volume, cosines).sum(axis=-1)
    return np.asarray(np.remainder(whole + 2 * np.pi, 4 * np.pi) - 2 * np.pi)[()]

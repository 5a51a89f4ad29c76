"""One step of a Kalman filter, predict and correct, and two tests of it: NIS and NEES.

NIS is the innovation, what was measured minus what was predicted, in units of its covariance.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, common_leading_axes, finite_array
from driftlab.core import kalman as core


class Update(NamedTuple):
    """What a measurement changes.

    Attributes
    ----------
    correction : ndarray, shape (..., size)
        To be added to the predicted state.
    covariance : ndarray, shape (..., size, size)
        Of the errors after the measurement. It does not depend on what was measured, and has no
        leading axes that the innovation alone has.
    nis : ndarray, shape (...)
        Normalised innovation squared (NIS): the innovation in units of its own covariance. Of a
        consistent filter the mean is the number of components measured.
    """

    correction: FloatArray
    covariance: FloatArray
    nis: FloatArray


def predict(covariance: ArrayLike, transition: ArrayLike, noise: ArrayLike) -> FloatArray:
    r"""Covariance of the errors after a step, before anything is measured.

    Parameters
    ----------
    covariance : array_like, shape (..., size, size)
        :math:`P` before the step, symmetric.
    transition : array_like, shape (..., k, size)
        :math:`\Phi`, or only its first k rows: the states after them stay as they are.
    noise : array_like, shape (..., k, k)
        :math:`Q`: what the step adds to the covariance of those k states.

    Returns
    -------
    ndarray, shape (..., size, size)
        :math:`\Phi P \Phi^T + Q`.

    Raises
    ------
    ValueError
        If shapes do not fit, or a number is not finite.

    See Also
    --------
    correct : The other half of a step, with the source.

    Examples
    --------
    A place and a speed, each known to 1; after two seconds the place is known to 4 + 1, in squares.
    The speed stays as it is, so the row of the place says the same:

    >>> predict(np.eye(2), [[1.0, 2.0], [0.0, 1.0]], np.zeros((2, 2)))
    array([[5., 2.],
           [2., 1.]])
    >>> predict(np.eye(2), [[1.0, 2.0]], [[0.0]])
    array([[5., 2.],
           [2., 1.]])
    """
    before, size = _square(covariance)
    moved, moving = _rows(transition, "transition", size)
    if moving > size:
        raise ValueError(f"transition: expected at most {size} rows, got {moving}.")
    added = finite_array(noise, "noise", moving, moving)
    common_leading_axes(
        covariance=before.shape[:-2], transition=moved.shape[:-2], noise=added.shape[:-2]
    )
    return core.predict(before, moved, added)


def correct(
    covariance: ArrayLike, innovation: ArrayLike, observation: ArrayLike, noise: ArrayLike
) -> Update:
    """Believe a measurement as far as it deserves.

    Parameters
    ----------
    covariance : array_like, shape (..., size, size)
        :math:`P` as predicted, symmetric.
    innovation : array_like, shape (..., m)
        :math:`z`: what is measured minus what was predicted of it.
    observation : array_like, shape (..., m, size)
        :math:`H`: what is measured of each state.
    noise : array_like, shape (..., m, m)
        :math:`R`: covariance of the noise of the measurement.

    Returns
    -------
    Update
        Correction, covariance and NIS.

    Raises
    ------
    ValueError
        If shapes do not fit, a number is not finite, or the innovation can have no spread.

    Notes
    -----
    With :math:`S = H P H^T + R` and the gain :math:`G = P H^T S^{-1}` the correction is
    :math:`G z`, the covariance :math:`P - G H P`, the NIS :math:`z^T S^{-1} z`; R. E. Kalman,
    *A new approach to linear filtering and prediction problems*, Journal of Basic Engineering 82,
    1960. With another gain take Joseph's form, :math:`(I - GH) P (I - GH)^T + G R G^T`. With this
    one both are the same but for rounding, and the short form, made symmetric at each step, needs a
    fraction of the work. It takes one number from another: variances that a measurement makes
    smaller by more than some twelve digits are lost in the rounding of what they were.

    Examples
    --------
    The place alone is measured. The speed goes with it, for the two are correlated:

    >>> update = correct([[5.0, 2.0], [2.0, 1.0]], [3.0], [[1.0, 0.0]], [[1.0]])
    >>> update.correction
    array([2.5, 1. ])
    >>> update.covariance.round(3)
    array([[0.833, 0.333],
           [0.333, 0.333]])
    """
    before, size = _square(covariance)
    seen, measured = _rows(observation, "observation", size)
    news = finite_array(innovation, "innovation", measured)
    spread = finite_array(noise, "noise", measured, measured)
    common_leading_axes(
        covariance=before.shape[:-2],
        innovation=news.shape[:-1],
        observation=seen.shape[:-2],
        noise=spread.shape[:-2],
    )
    try:
        with np.errstate(over="ignore", invalid="ignore"):  # refused below
            found = Update(*core.correct(before, news, seen, spread))
    except np.linalg.LinAlgError:
        found = None
    # A spread that is singular but for rounding has an inverse, by which squares are negative.
    if found is None or not (found.nis >= 0).all():
        raise ValueError(
            "noise: expected an innovation with a spread in every direction, got H P H^T + R "
            "without an inverse."
        )
    return found


def nees(errors: ArrayLike, covariance: ArrayLike) -> FloatArray:
    """Normalised estimation error squared (NEES): the errors in units of their covariance.

    Parameters
    ----------
    errors : array_like, shape (..., size)
        Of the estimated states.
    covariance : array_like, shape (..., size, size)
        As the filter states it. States that are known everywhere, with a variance of zero, do not
        count.

    Returns
    -------
    ndarray, shape (...)
        Of a consistent filter the mean over many runs is the number of states that count.

    Raises
    ------
    ValueError
        If shapes do not fit, a number is not finite, or the covariance of the states that count
        has no inverse.

    References
    ----------
    Y. Bar-Shalom, X. R. Li, T. Kirubarajan, *Estimation with Applications to Tracking and
    Navigation*, Wiley, 2001, section 5.4.

    Examples
    --------
    Two errors of two and one deviations; the third state was known from the beginning:

    >>> float(nees([2.0, 3.0, 0.0], np.diag([1.0, 9.0, 0.0])))
    5.0
    """
    stated, size = _square(covariance)
    error = finite_array(errors, "errors", size)
    common_leading_axes(errors=error.shape[:-1], covariance=stated.shape[:-2])
    variances = np.einsum("...ii->...i", stated)
    counted = np.flatnonzero(variances.reshape(-1, size).any(axis=0))
    error = error[..., counted]
    block = stated[..., counted[:, np.newaxis], counted]
    try:
        with np.errstate(over="ignore", invalid="ignore"):  # refused below
            found = np.vecdot(error, np.linalg.solve(block, error[..., np.newaxis])[..., 0])
    except np.linalg.LinAlgError:
        found = np.array(np.inf)
    if not np.isfinite(found).all():
        raise ValueError(
            "covariance: expected one with an inverse where variances are not zero, got one "
            "without."
        )
    return found


def _square(covariance: ArrayLike) -> tuple[FloatArray, int]:
    """A covariance as an array, and its number of states, refusing what is not square."""
    array = finite_array(covariance, "covariance")
    shape = array.shape
    if len(shape) < 2 or shape[-1] != shape[-2]:
        raise ValueError(f"covariance: expected shape (..., size, size), got shape {shape}.")
    return array, shape[-1]


def _rows(matrix: ArrayLike, name: str, size: int) -> tuple[FloatArray, int]:
    """A matrix as an array, and its number of rows, refusing what is not of so many states."""
    array = finite_array(matrix, name)
    shape = array.shape
    if len(shape) < 2 or shape[-1] != size:
        raise ValueError(f"{name}: expected shape (..., rows, {size}), got shape {shape}.")
    return array, shape[-2]

"""What a bent gyro triad leaves after a body has moved in any way and come back.

To first order the attitude error, seen in the reference frame, grows with C M rate, C being the
attitude and M the error of the triad. Over a closed motion the skew part of M leaves nothing: it
adds up to C kappa at the beginning less C kappa at the end. A motion is given as angle increments,
each of them a turn about a fixed axis; only the path counts, not the pace.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_array, plausible_error_matrix, positive_number
from driftlab.core.loops import cumulative_product
from driftlab.core.quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    rotate,
    to_rotation_vector,
)
from driftlab.core.vectors import left_jacobian, norms, transform
from driftlab.triad import checked_triad


def drift_per_cycle(
    increments: ArrayLike, error_matrix: ArrayLike, *, tolerance: float = 1e-4
) -> FloatArray:
    r"""Drift over a closed motion, to first order in the error matrix.

    Parameters
    ----------
    increments : array_like, shape (..., n, 3)
        True angle increments of the body over one closed motion, body axes, rad. Each is a turn
        about a fixed axis, of any size: ``[[0, 0, 2 * np.pi]]`` is one whole turn.
    error_matrix : array_like, shape (..., 3, 3)
        Matrix M of the errors of the triad, without unit.
    tolerance : float
        Largest angle, rad, by which the body may miss its first attitude. A gap g makes the drift
        uncertain by about g times the size of M. The Earth's rate has to be taken off first.

    Returns
    -------
    ndarray, shape (..., 3)
        Small rotation from the true to the apparent attitude, in the body axes at the start, rad.

    Raises
    ------
    ValueError
        Also if the motion does not close.

    See Also
    --------
    drift_per_revolution : A whole turn about one axis.
    driftlab.attitude.solid_angle : The motion's own part.

    Notes
    -----
    It is the integral of C M rate over the motion: linear in M, without a part from the skew part
    of M. Within an increment theta that begins at the attitude C the mean of the attitudes is
    C J(theta), with the left Jacobian J, so that

    .. math:: \oint C M \omega\,dt = \sum_i C_i J(\theta_i) M \theta_i

    without error of quadrature.

    The area law of a small motion with the rotation vector :math:`\theta` has a bound. With s the
    spectral norm of the symmetric part of M,

    .. math::
        \left| \oint C M \omega\,dt - (\mathrm{tr} M\,I - M - M^T)\,
        \tfrac12 \oint \theta \times d\theta \right| \le \tfrac76\,s \oint |\theta|^2 |d\theta| .

    For C is :math:`I + [\theta]` up to :math:`|\theta|^2/2`, and :math:`\omega\,dt` is
    :math:`d\theta - \theta \times d\theta/2` up to :math:`|\theta|^2|d\theta|/6` and no longer
    than :math:`d\theta`; what is of second order makes the law and a derivative. The exact error,
    as a matrix E, obeys :math:`\dot E = E\,[C M \omega]`. So it differs from I plus the matrix of
    the first order by at most :math:`(m \oint |d\theta|)^2/2`, m the spectral norm of M.

    Examples
    --------
    A quarter turn about x and one about y, three times, and a scale error of 1 % in gyro x:

    >>> tumble = np.pi / 2 * np.tile([[1, 0, 0], [0, 1, 0]], (3, 1))
    >>> drift_per_cycle(tumble, np.diag([0.01, 0, 0])).round(4) + 0
    array([0.0157, 0.0157, 0.0157])
    """
    turns, steps, _, error_matrix = _closed(increments, error_matrix, tolerance)
    after = cumulative_product(steps)
    first = np.broadcast_to([0.0, 0.0, 0.0, 1.0], (*after.shape[:-2], 1, 4))
    before = np.concatenate([first, after[..., :-1, :]], axis=-2)
    false_turns = transform(error_matrix[..., np.newaxis, :, :], turns)
    pieces = rotate(before, transform(left_jacobian(turns), false_turns))
    drift: FloatArray = pieces.sum(axis=-2)
    return drift


def exact_drift_per_cycle(
    increments: ArrayLike, error_matrix: ArrayLike, *, tolerance: float = 1e-4
) -> FloatArray:
    """Drift over a closed motion for an error matrix of any size: the motion is integrated.

    Parameters
    ----------
    increments : array_like, shape (..., n, 3)
        True angle increments of the body over one closed motion, as of `drift_per_cycle`, rad.
    error_matrix : array_like, shape (..., 3, 3)
        Matrix M of the errors of the triad, without unit, which measures I + M times the rate.
    tolerance : float
        Largest angle, rad, by which the body may miss its first attitude.

    Returns
    -------
    ndarray, shape (..., 3)
        Rotation vector from the true to the apparent attitude, in the body axes at the start, rad;
        its angle is at most pi.

    Raises
    ------
    ValueError
        Also if the motion does not close, or the triad is flat.

    Examples
    --------
    After a whole turn the angle is that of `drift_per_revolution`:

    >>> from driftlab.drift.systematic_drift import drift_per_revolution
    >>> bent = np.array([[0, 0.03, 0], [0.01, 0, 0], [0, 0, 0]])
    >>> drift = exact_drift_per_cycle([[0, 0, 2 * np.pi]], bent + 0.01)
    >>> print(f"{np.linalg.norm(drift):.6f} {drift_per_revolution([0, 0, 1], bent + 0.01):.6f}")
    0.063454 0.063454
    """
    turns, _, last, error_matrix = _closed(increments, error_matrix, tolerance)
    measured = transform(checked_triad(error_matrix)[..., np.newaxis, :, :], turns)
    apparent = cumulative_product(from_rotation_vector(measured))[..., -1, :]
    return to_rotation_vector(multiply(apparent, conjugate(last)))


def _closed(
    increments: ArrayLike, error_matrix: ArrayLike, tolerance: float
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Checked increments, their quaternions, the last attitude, and the error matrix."""
    turns = finite_array(increments, "increments", 3)
    if turns.ndim < 2:
        raise ValueError(f"increments: expected shape (..., n, 3), got shape {turns.shape}.")
    error_matrix = plausible_error_matrix(
        finite_array(error_matrix, "error_matrix", 3, 3), "error_matrix"
    )
    leading = turns.shape[:-2], error_matrix.shape[:-2]
    try:
        np.broadcast_shapes(*leading)
    except ValueError:
        raise ValueError(
            "increments, error_matrix: expected leading axes that broadcast, "
            f"got {leading[0]} and {leading[1]}."
        ) from None
    steps = from_rotation_vector(turns)
    last = cumulative_product(steps)[..., -1, :]
    gap = norms(to_rotation_vector(last)).max()
    if gap > positive_number(tolerance, "tolerance"):
        # A gap of a tenth of a radian is what the Earth leaves in 23 minutes.
        likely = "; on the Earth take its rate off first" if gap < 0.1 else ""
        raise ValueError(
            f"increments: expected a motion that closes to {tolerance:g} rad, "
            f"got one that ends {gap:.3g} rad from where it began{likely}."
        )
    return turns, steps, last, error_matrix

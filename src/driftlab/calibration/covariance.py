"""Expected accuracy along a rotation scheme: the filter's covariance, without any data."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator

import numpy as np

from driftlab.checks import FloatArray, checked_instance, positive_number, shown
from driftlab.core import loops
from driftlab.imu import ImuNoise, PriorDeviations

from .error_dynamics import process_noise
from .linearization import LinearizedErrors, checked_linearized


def covariance_analysis(
    linearized: LinearizedErrors, noise: ImuNoise, prior: PriorDeviations, update: float = 1.0
) -> FloatArray:
    """Covariance of the estimation errors at the end of a scheme, without any data.

    Parameters
    ----------
    linearized : LinearizedErrors
        The error equations along the scheme.
    noise : ImuNoise
        Of the sensors and of the reference velocity.
    prior : PriorDeviations
        Standard deviations of the errors before the calibration.
    update : float
        Time between two measurements of the velocity, s.

    Returns
    -------
    ndarray, shape (size, size)
        In the units of the states, squared.

    Raises
    ------
    ValueError
        If `update` or the noise of the velocity is not positive.

    See Also
    --------
    linearize_along : The error equations it needs.
    unobservable_subspace : What no measurement shows.
    design_scheme : A better scheme.

    Notes
    -----
    All measurements within a step are taken as one at its end. With pauses of minutes the standard
    deviations of the sensor errors come out about one per cent too small, those of the attitude
    about five, those of the velocity about ten; shorter pauses have shorter steps.

    References
    ----------
    - R. E. Kalman, *A new approach to linear filtering and prediction problems*, Journal of Basic
      Engineering 82(1), 1960.
    - Y. Bar-Shalom, X. R. Li, T. Kirubarajan, *Estimation with Applications to Tracking and
      Navigation*, Wiley, 2001.

    Examples
    --------
    How well the scheme of 19 positions finds the scale factor of a gyro, in ppm:

    >>> from driftlab.calibration import ERROR_MODELS, linearize_along
    >>> from driftlab.motion.scheme import NINETEEN_POSITIONS
    >>> linearized = linearize_along(NINETEEN_POSITIONS, 0.7, ERROR_MODELS["averaged"])
    >>> variances = np.diag(covariance_analysis(linearized, ImuNoise(), PriorDeviations()))
    >>> round(1e6 * float(np.sqrt(variances[linearized.model.names.index("gyro scale x")])), 2)
    3.55
    """
    return deque(_covariances(linearized, noise, prior, update), maxlen=1)[0]


def deviation_history(
    linearized: LinearizedErrors, noise: ImuNoise, prior: PriorDeviations, update: float = 1.0
) -> FloatArray:
    """Standard deviations of the estimation errors all along a scheme, without any data.

    Parameters
    ----------
    linearized : LinearizedErrors
        The error equations along the scheme, as s steps.
    noise : ImuNoise
        Of the sensors and of the reference velocity.
    prior : PriorDeviations
        Standard deviations of the errors before the calibration.
    update : float
        Time between two measurements of the velocity, s.

    Returns
    -------
    ndarray, shape (s + 1, size)
        Before the first step and after each one, in the units of the states.

    Raises
    ------
    ValueError
        If `update` or the noise of the velocity is not positive.

    Notes
    -----
    The last row belongs to `covariance_analysis`; what is said there of its accuracy holds here.

    Examples
    --------
    Three quarter turns about y tell the scale factor of the gyro y, and nothing of that of the
    gyro x. In ppm, before the turns and after them:

    >>> from driftlab.calibration import ERROR_MODELS, linearize_along
    >>> from driftlab.motion.scheme import Scheme
    >>> turns = Scheme("+90Y +90Y +90Y", ("Up", "East", "North"))
    >>> linearized = linearize_along(turns, 0.7, ERROR_MODELS["averaged"])
    >>> history = deviation_history(linearized, ImuNoise(), PriorDeviations())
    >>> scales = [linearized.model.names.index(f"gyro scale {axis}") for axis in "xy"]
    >>> (1e6 * history[[0, -1]][:, scales]).round()
    array([[100., 100.],
           [100.,   7.]])
    """
    steps = _covariances(linearized, noise, prior, update)
    # What is measured almost exactly has a variance of the size of the rounding, of either sign.
    return np.sqrt([np.maximum(np.diag(covariance), 0.0) for covariance in steps])


def _covariances(
    linearized: LinearizedErrors, noise: ImuNoise, prior: PriorDeviations, update: float
) -> Iterator[FloatArray]:
    """Covariance (size, size) before the first step and after each one."""
    checked_linearized(linearized)
    checked_instance(noise, ImuNoise, "noise")
    seconds = positive_number(update, "update")
    if not noise.reference_velocity > 0:
        raise ValueError(
            "noise: expected a deviation of the reference velocity above 0, "
            f"got {shown(noise.reference_velocity)} m/s."
        )
    checked_instance(prior, PriorDeviations, "prior")
    covariance = linearized.model.covariance(prior, linearized.start)
    yield covariance
    rows = linearized.transitions[:, :6]  # the sensor errors are constant
    added = process_noise(noise, rows[:, 3:, :3], linearized.durations)
    observed = np.eye(3, linearized.model.size, 3)  # the velocity
    variances = noise.reference_velocity**2 * seconds / linearized.durations
    spreads = variances[:, np.newaxis, np.newaxis] * np.eye(3)
    for matrix, more, spread in zip(rows, added, spreads, strict=True):
        covariance = loops.predict(covariance, matrix, more)
        covariance, _, _ = loops.correct_covariance(covariance, observed, spread)
        yield covariance

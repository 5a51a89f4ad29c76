"""From residual to mission: what a calibration leaves over, as errors of position and heading.

An error budget in the usual sense, in metres, nautical miles an hour and arc seconds: standard
deviations of independent causes, each carried through the linear error equations at rest, and their
root sum of squares. What a calibration leaves is not independent, so its whole covariance is
carried as well.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    finite_array,
    finite_number,
    one_quaternion,
    shown,
)
from driftlab.core.quaternion import to_matrix
from driftlab.earth import EARTH_RATE, checked_latitude, earth_rate, gravity

from .calibration_history import Calibration
from .error_dynamics import checked_model
from .error_model import ErrorModel
from .static_error_growth import STATIC_ERROR_SOURCES, checked_moments, static_error_modes


class MissionErrors(NamedTuple):
    """Standard deviations of the errors that causes make along a time at rest.

    Attributes
    ----------
    times : ndarray, shape (k,)
        Since the start, s.
    position : ndarray, shape (..., k, 2)
        East and North, m.
    heading : ndarray, shape (..., k)
        rad.
    """

    times: FloatArray
    position: FloatArray
    heading: FloatArray

    @property
    def distance(self) -> FloatArray:
        """Root mean square (..., k) of the distance from the true place, m.

        If East and North are independent, alike and normal, half of all missions end within 0.83 of
        it, the root of ln 2: the circular error probable, CEP (F. van Diggelen, *GNSS accuracy:
        lies, damn lies, and statistics*, GPS World 18(1), 2007). On a line, half end within 0.67.
        """
        return np.linalg.norm(self.position, axis=-1)

    @property
    def radial_error_rate(self) -> FloatArray:
        """Slope (...) of the line through the start that fits `distance` best, m/s."""
        squares = float((self.times**2).sum())
        if squares == 0:
            raise ValueError("times: expected some time after the start, got 0 s alone.")
        return np.asarray((self.distance * self.times).sum(axis=-1) / squares)


def mission_errors(times: ArrayLike, latitude: float, covariance: ArrayLike) -> MissionErrors:
    """Carry the covariance of causes to errors of position and heading.

    Parameters
    ----------
    times : array_like, shape (k,)
        Since the start, s.
    latitude : float
        rad; not a pole.
    covariance : array_like, shape (..., 12, 12)
        Of the causes, in the order of `STATIC_ERROR_SOURCES`.

    Returns
    -------
    MissionErrors
        Exact for the linear equations, whatever the distribution.

    Examples
    --------
    Gyros of 0.01 deg/h about all three axes, after an hour, in nautical miles:

    >>> standard_deviations = np.zeros(12)
    >>> standard_deviations[7:10] = np.radians(0.01) / 3600
    >>> errors = mission_errors([3600.0], np.radians(45.0), np.diag(standard_deviations**2))
    >>> round(float(errors.distance[0]) / 1852, 2)
    1.03
    """
    given = finite_array(
        covariance, "covariance", len(STATIC_ERROR_SOURCES), len(STATIC_ERROR_SOURCES)
    )
    moments = checked_moments(times)
    if moments.min() < 0:
        raise ValueError(f"times: expected times since the start, got {moments.min():g} s.")
    if np.einsum("...ii->...i", given).min() < 0:
        raise ValueError("covariance: expected squares of deviations, got negative ones.")
    wanted = static_error_modes(latitude).at(moments).sum(axis=0)[:, [2, 5, 6]]
    variances = np.einsum("kij,...jl,kil->...ki", wanted, given, wanted)
    standard_deviations = np.sqrt(np.maximum(variances, 0.0))
    return MissionErrors(moments, standard_deviations[..., 1:], standard_deviations[..., 0])


def mission_error_sources(
    model: ErrorModel | str, attitude: ArrayLike, latitude: float, turn: float = 0.0
) -> FloatArray:
    """Matrix from what a calibration leaves over to the causes of errors at rest.

    The unit stands level or not, aligns itself by gravity and the Earth's rate, turns about the
    vertical, and then rests again. Biases then point elsewhere than in the alignment, and what
    cancelled no longer does; and the turn is multiplied by scale and installation errors.

    Parameters
    ----------
    model : ErrorModel or str
        Of the calibration.
    attitude : array_like or Rotation, shape (4,)
        Of the body in the alignment, body to East, North, Up.
    latitude : float
        rad; not a pole.
    turn : float
        Of the vehicle about Up after its alignment, rad; it is taken to be quick.

    Returns
    -------
    ndarray, shape (12, size)
        To first order; rows in the order of `STATIC_ERROR_SOURCES`. Noise is not in it, nor what
        the model leaves out. The attitude and velocity that the calibration ended with do not
        matter.

    Examples
    --------
    A bias of an East gyro becomes a heading error; the two cancel, until the vehicle turns:

    >>> east = STATIC_ERROR_SOURCES.index("gyro bias East")
    >>> for turn in (0.0, np.pi):
    ...     causes = mission_error_sources("averaged", [0, 0, 0, 1], 0.0, turn)[:, 6]
    ...     heading = EARTH_RATE * causes[STATIC_ERROR_SOURCES.index("attitude Up")]
    ...     print(round(float(causes[east]), 3), round(float(heading), 3))
    1.0 -1.0
    -1.0 -1.0
    """
    model = checked_model(model)
    place = float(checked_latitude(finite_number(latitude, "latitude")))
    angle = finite_number(turn, "turn")
    if abs(angle) > 2 * np.pi:
        raise ValueError(f"turn: expected at most a whole turn, in rad, got {shown(turn)}.")
    body = to_matrix(one_quaternion(attitude, "attitude"))
    states = model.imu_errors(np.eye(model.size))
    rate, pull = earth_rate(place), float(gravity(place))
    up = np.array([0.0, 0.0, 1.0])

    def sensed(axes: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Sensor biases (size, 3) in local axes while the body has these axes."""
        gyro = states.gyro_bias + states.gyro_error_matrix @ (axes.T @ rate)
        accelerometer = states.accelerometer_bias + states.accelerometer_error_matrix @ (
            axes.T @ up * pull
        )
        return gyro @ axes.T, accelerometer @ axes.T

    drift, push = sensed(body)
    tilt = np.stack([-push[:, 1], push[:, 0]], axis=-1) / pull
    azimuth = np.tan(place) * tilt[:, 1] - drift[:, 0] / (EARTH_RATE * np.cos(place))
    # The turn: -C K w, integrated while C turns about Up.
    bent = states.gyro_error_matrix @ (body.T @ up) @ body.T
    sine, cosine = np.sin(angle), np.cos(angle)
    swept = np.array([[sine, cosine - 1, 0], [1 - cosine, sine, 0], [0, 0, angle]])
    phi = np.column_stack([tilt, azimuth]) - bent @ swept.T
    turned = np.array([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]])
    drift, push = sensed(turned @ body)
    return np.column_stack([phi, np.zeros((model.size, 4)), drift, push[:, :2]]).T


def calibration_error_budget(
    times: ArrayLike,
    latitude: float,
    model: ErrorModel | str,
    covariance: ArrayLike,
    attitude: ArrayLike,
    turn: float = 0.0,
) -> dict[str, MissionErrors]:
    """Error budget of a calibration: position and heading by kind of sensor error.

    Parameters
    ----------
    times : array_like, shape (k,)
        Since the end of the turn, s.
    latitude : float
        Of the mission, rad; not a pole.
    model : ErrorModel or str
        Of the calibration.
    covariance : array_like, shape (size, size)
        Of its errors, as ``calibration.covariance[-1]`` or `covariance_analysis` give it.
    attitude, turn : array_like or Rotation, shape (4,), and float
        See `mission_error_sources`.

    Returns
    -------
    dict of str to MissionErrors
        By kind, as if all others were known, and under "all" the whole with its correlations: no
        root sum of squares of the kinds, though usually near it.

    Examples
    --------
    What is known before any calibration, in km after four hours:

    >>> from driftlab.calibration import ERROR_MODELS
    >>> from driftlab.imu import PriorStandardDeviations
    >>> level, model = [0.0, 0.0, 0.0, 1.0], ERROR_MODELS["averaged"]
    >>> before = model.covariance(PriorStandardDeviations(), level)
    >>> budget = calibration_error_budget([4 * 3600.0], 0.7, model, before, level, turn=np.pi)
    >>> for kind in ("gyro bias", "gyro scale", "accelerometer bias", "all"):
    ...     print(kind, round(float(budget[kind].distance[0]) / 1e3))
    gyro bias 287
    gyro scale 2
    accelerometer bias 3
    all 287
    """
    model = checked_model(model)
    if isinstance(covariance, Calibration):
        raise ValueError(
            "covariance: expected a matrix, got a Calibration: hand in calibration.covariance[-1]."
        )
    given = finite_array(covariance, "covariance")
    if given.shape != (model.size, model.size):
        raise ValueError(
            f"covariance: expected shape ({model.size}, {model.size}), as "
            f"calibration.covariance[-1] has it, got shape {given.shape}."
        )
    if np.diag(given).min() < 0:
        raise ValueError("covariance: expected squares of deviations, got negative ones.")
    to_causes = mission_error_sources(model, attitude, latitude, turn)
    kinds = [name.rsplit(" ", 1)[0] for name in model.names]
    parts = {}
    for kind in [*dict.fromkeys(kinds[6:]), "all"]:
        chosen = np.array([kind in (each, "all") for each in kinds])
        columns = to_causes[:, chosen]
        part = columns @ given[np.ix_(chosen, chosen)] @ columns.T
        parts[kind] = mission_errors(times, latitude, part)
    return parts

"""What rotation schemes do with a unit on a turntable, and what they show of its errors."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration.covariance import covariance_analysis
from driftlab.calibration.error_model import FULL, ErrorModel
from driftlab.calibration.linearization import LinearizedErrors, checked_model, linearize_along
from driftlab.calibration.observability import (
    UnobservableSubspace,
    unobservable_subspace,
)
from driftlab.checks import FloatArray, finite_number
from driftlab.imu import ImuNoise, PriorDeviations
from driftlab.motion.scheme import NINETEEN_POSITIONS, SCHEMES, Scheme
from driftlab.motion.turntable import table_trajectory
from driftlab.quaternion import conjugate, rotate


class SchemeDirections(NamedTuple):
    """For each scheme, Up in body axes over time.

    Attributes
    ----------
    names : list of str
    times : list of ndarray, shape (n,)
        s.
    up : list of ndarray, shape (n, 3)
    """

    names: list[str]
    times: list[FloatArray]
    up: list[FloatArray]


class TableObservability(NamedTuple):
    """What one scheme shows of the states of one error model.

    Attributes
    ----------
    names : tuple of str
        Of the states.
    eigenvalues : ndarray, shape (size,)
        Of the Gramian, ascending, relative to the largest.
    unobservable : int
        How many of them are zero.
    descriptions : list of str
        Which directions they belong to.
    before, after : ndarray, shape (size,)
        Standard deviations of the states known before the scheme and expected after it, SI.
    """

    names: tuple[str, ...]
    eigenvalues: FloatArray
    unobservable: int
    descriptions: list[str]
    before: FloatArray
    after: FloatArray


def up_in_body_axes() -> SchemeDirections:
    """Compute which way is up in the body along `driftlab.motion.SCHEMES`, once a second."""
    times, up = [], []
    for scheme in SCHEMES.values():
        attitude = table_trajectory(scheme, 0.0, 1.0).attitude
        times.append(np.arange(len(attitude), dtype=np.float64))
        up.append(rotate(conjugate(attitude), [0.0, 0.0, 1.0]))
    return SchemeDirections(list(SCHEMES), times, up)


def table_observability(
    scheme: Scheme = NINETEEN_POSITIONS,
    model: ErrorModel = FULL,
    noise: ImuNoise | None = None,
    latitude: float = TABLE_LATITUDE,
) -> TableObservability:
    """Follow the error equations of a model along a scheme; units have the typical spread.

    Parameters
    ----------
    scheme : Scheme
    model : ErrorModel
    noise : ImuNoise, optional
        The typical one if not given.
    latitude : float
        Of the table, rad.

    Returns
    -------
    TableObservability

    Raises
    ------
    ValueError
        If `latitude` is not a number, or `model` is not an error model.
    """
    way, unobservable = _followed(scheme, finite_number(latitude, "latitude"), checked_model(model))
    prior = PriorDeviations()
    covariance = covariance_analysis(way, ImuNoise() if noise is None else noise, prior)
    return TableObservability(
        model.names,
        unobservable.eigenvalues / unobservable.eigenvalues[-1],
        len(unobservable.directions),
        list(unobservable.descriptions),
        np.sqrt(np.diag(model.covariance(prior, way.start))),
        np.sqrt(np.diag(covariance)),
    )


@lru_cache(maxsize=1)
def _followed(
    scheme: Scheme, latitude: float, model: ErrorModel
) -> tuple[LinearizedErrors, UnobservableSubspace]:
    """What does not depend on the noise: kept for a reader who moves only that."""
    way = linearize_along(scheme, latitude, model)
    return way, unobservable_subspace(way)

"""What rotation schemes do with a unit on a turntable, and what they show of its errors."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration.error_model import FULL, ErrorModel
from driftlab.calibration.observability import (
    Darkness,
    Passage,
    checked_model,
    expected_covariance,
    null_directions,
    passage,
)
from driftlab.checks import FloatArray, finite_number
from driftlab.imu import Noise, Spread
from driftlab.motion.turntable import NINETEEN_POSITIONS, SCHEMES, Scheme, simulate
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
    dark : int
        How many of them are zero.
    words : list of str
        Which directions they belong to.
    before, after : ndarray, shape (size,)
        Standard deviations of the states known before the scheme and expected after it, SI.
    """

    names: tuple[str, ...]
    eigenvalues: FloatArray
    dark: int
    words: list[str]
    before: FloatArray
    after: FloatArray


def up_in_body_axes() -> SchemeDirections:
    """Compute which way is up in the body along `driftlab.motion.SCHEMES`, once a second."""
    times, up = [], []
    for scheme in SCHEMES.values():
        attitude = simulate(scheme, 0.0, 1.0).attitude
        times.append(np.arange(len(attitude), dtype=np.float64))
        up.append(rotate(conjugate(attitude), [0.0, 0.0, 1.0]))
    return SchemeDirections(list(SCHEMES), times, up)


def table_observability(
    scheme: Scheme = NINETEEN_POSITIONS,
    model: ErrorModel = FULL,
    noise: Noise | None = None,
    latitude: float = TABLE_LATITUDE,
) -> TableObservability:
    """Follow the error equations of a model along a scheme; units have the typical spread.

    Parameters
    ----------
    scheme : Scheme
    model : ErrorModel
    noise : Noise, optional
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
    way, dark = _followed(scheme, finite_number(latitude, "latitude"), checked_model(model))
    spread = Spread()
    covariance = expected_covariance(way, Noise() if noise is None else noise, spread)
    return TableObservability(
        model.names,
        dark.eigenvalues / dark.eigenvalues[-1],
        len(dark.directions),
        list(dark.words),
        np.sqrt(np.diag(model.covariance(spread, way.start))),
        np.sqrt(np.diag(covariance)),
    )


@lru_cache(maxsize=1)
def _followed(scheme: Scheme, latitude: float, model: ErrorModel) -> tuple[Passage, Darkness]:
    """What does not depend on the noise: kept for a reader who moves only that."""
    way = passage(scheme, latitude, model)
    return way, null_directions(way)

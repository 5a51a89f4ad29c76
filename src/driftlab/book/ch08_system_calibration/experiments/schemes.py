"""What rotation schemes do with a unit on a turntable, and what they show of its errors."""

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration.covariance import covariance_analysis
from driftlab.calibration.error_model import FULL, ErrorModel, error_model_for
from driftlab.calibration.linearization import LinearizedErrors, checked_model, linearize_along
from driftlab.calibration.observability import (
    UnobservableSubspace,
    unobservable_subspace,
)
from driftlab.checks import FloatArray, checked_instance, finite_number
from driftlab.imu import ImuNoise, PriorDeviations
from driftlab.motion.scheme import NINETEEN_POSITIONS, SCHEMES, Scheme
from driftlab.motion.turntable import table_trajectory
from driftlab.quaternion import conjugate, rotate

TYPICAL_NOISE = ImuNoise()
"""Of the sensors and of the reference velocity."""


class SchemeDirections(NamedTuple):
    """For each scheme, Up in body axes over time."""

    names: list[str]
    schemes: list[Scheme]
    times: list[FloatArray]  # (n,) each, s
    up: list[FloatArray]  # (n, 3) each


class TableObservability(NamedTuple):
    """What one scheme shows of the states of one error model."""

    names: tuple[str, ...]  # of the states
    positions: int  # pauses of the scheme
    eigenvalues: FloatArray  # (size,), of the Gramian, ascending, relative to the largest
    unobservable: int  # how many of them are zero
    descriptions: list[str]  # which directions they belong to
    before: FloatArray  # (size,), standard deviations of the states known before the scheme, SI
    after: FloatArray  # (size,), expected after it, SI


def up_in_body_axes(schemes: Sequence[Scheme] = tuple(SCHEMES.values())) -> SchemeDirections:
    """Compute which way is up in the body along rotation schemes, once a second."""
    times, up = [], []
    for scheme in schemes:
        attitude = table_trajectory(scheme, 0.0, 1.0).attitude
        times.append(np.arange(len(attitude), dtype=np.float64))
        up.append(rotate(conjugate(attitude), [0.0, 0.0, 1.0]))
    return SchemeDirections([scheme_name(each) for each in schemes], [*schemes], times, up)


def scheme_name(scheme: Scheme) -> str:
    """Return the book's name of a scheme, whatever its pauses; else how many positions it has."""
    known = {(each.rotations, each.start): name for name, each in SCHEMES.items()}
    own = f"{scheme.positions} positions of one's own"
    return known.get((scheme.rotations, scheme.start), own)


def states_on_a_table(
    scheme: Scheme = NINETEEN_POSITIONS,
    frame: str | None = None,
    noise: ImuNoise = TYPICAL_NOISE,
    latitude: float = TABLE_LATITUDE,
) -> TableObservability:
    """Follow the error equations along a scheme, with all 30 states or those of some body axes."""
    checked_instance(scheme, Scheme, "scheme")
    checked_instance(noise, ImuNoise, "noise")
    model = FULL if frame is None else error_model_for(frame)
    return table_observability(scheme, model, noise, latitude)


def table_observability(
    scheme: Scheme = NINETEEN_POSITIONS,
    model: ErrorModel = FULL,
    noise: ImuNoise | None = None,
    latitude: float = TABLE_LATITUDE,
) -> TableObservability:
    """Follow the error equations of a model along a scheme; units have the typical spread."""
    way, unobservable = _followed(scheme, finite_number(latitude, "latitude"), checked_model(model))
    prior = PriorDeviations()
    covariance = covariance_analysis(way, ImuNoise() if noise is None else noise, prior)
    return TableObservability(
        model.names,
        scheme.positions,
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

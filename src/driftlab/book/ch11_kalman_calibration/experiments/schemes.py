"""What rotation schemes do with a unit on a turntable, and what they show of its errors."""

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration import (
    ERROR_MODELS,
    FULL,
    covariance_analysis,
    linearize_along,
    unobservable_subspace,
)
from driftlab.calibration.error_dynamics import LinearizedErrors, checked_model
from driftlab.calibration.error_model import ErrorModel
from driftlab.calibration.observability import UnobservableSubspace
from driftlab.checks import checked_instance, finite_number, one_of
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.motion.scheme import NINETEEN_POSITIONS, SCHEMES, Scheme
from driftlab.motion.turntable import turntable_trajectory
from driftlab.quaternion import conjugate, rotate

TYPICAL_NOISE = ImuNoise()
"""Of the sensors and of the reference velocity."""
VELOCITIES = np.geomspace(1e-5, 1e-2, 7)
"""Reference velocities for tables that stand more or less still, m/s."""
DRAWN_ZERO = 1e-13
"""Where zero is drawn: below all eigenvalues that are none, so that these have the room."""


def short_name(name: str) -> str:
    """Return the name of a sensor error as an axis has it, the same for all choices of states."""
    words = name.replace("accelerometer", "acc.").split()
    return " ".join(word for word in words if word not in ("installation", "non-orthogonality"))


SLOTS = [short_name(name) for name in FULL.names[6:]]
"""The sensor errors along an axis that has room for all of them."""


def up_in_body_axes(schemes: Sequence[Scheme] = tuple(SCHEMES.values())) -> DataTable:
    """Compute which way is up in the body along rotation schemes, once a second."""
    named = {scheme_name(each): each for each in schemes}
    columns: dict[str, tuple[Any, ...]] = {}
    for name, scheme in named.items():
        attitude = turntable_trajectory(scheme, 0.0, 1.0).attitude
        up = rotate(conjugate(attitude), [0.0, 0.0, 1.0]).T
        times = np.arange(len(attitude), dtype=np.float64)
        columns[f"time, {name}"] = (times, "min", "since the start")
        columns[f"up, {name}"] = (up, "", "along each body axis", ("x", "y", "z"), 6)
    return DataTable(columns, {
        "names": ([*named], "", "of the schemes"),
        "pauses": ([each.dwell for each in named.values()], "s", "length of each pause"),
        "rates": ([each.rate for each in named.values()], "deg_per_s", "of the turns"),
    })  # fmt: skip


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
) -> DataTable:
    """Follow the error equations along a scheme, with all 30 states or those of some body axes."""
    checked_instance(scheme, Scheme, "scheme")
    checked_instance(noise, ImuNoise, "noise")
    model = FULL if frame is None else ERROR_MODELS[one_of(frame, ERROR_MODELS, "frame")]
    return table_observability(scheme, model, noise, latitude)


def table_observability(
    scheme: Scheme = NINETEEN_POSITIONS,
    model: ErrorModel = FULL,
    noise: ImuNoise | None = None,
    latitude: float = TABLE_LATITUDE,
) -> DataTable:
    """Follow the error equations of a model along a scheme; units have the typical spread."""
    way, unobservable = _followed(scheme, finite_number(latitude, "latitude"), checked_model(model))
    prior = PriorStandardDeviations()
    covariance = covariance_analysis(way, ImuNoise() if noise is None else noise, prior)
    before = np.sqrt(np.diag(model.covariance(prior, way.start)))
    after = np.sqrt(np.diag(covariance))
    # One where nothing was known or to be known.
    ratios = np.divide(after, before, out=np.ones_like(after), where=before > 0)
    eigenvalues = unobservable.eigenvalues / unobservable.eigenvalues[-1]
    hidden = np.arange(len(eigenvalues)) < len(unobservable.directions)
    sensor_errors = list(model.names[6:])
    return DataTable(
        {
            "direction": (np.arange(1.0, len(eigenvalues) + 1), "", "by its eigenvalue"),
            "eigenvalue_relative": (
                np.where(hidden, DRAWN_ZERO, np.maximum(eigenvalues, DRAWN_ZERO)), "",
                "of the Gramian, over the largest; zero as it is drawn",
            ),
            "direction_is": (
                ["not observable" if each else "observable" for each in hidden], "",
                "of each direction",
            ),
            "sensor_error": (sensor_errors, "", "by name"),
            "deviation_after_over_before": (ratios[6:], "", "what is left of each sensor error"),
        },
        {
            "positions": (scheme.positions, "", "pauses of the scheme"),
            "unobservable": (len(unobservable.directions), "", "directions not observable"),
            "eigenvalues": (eigenvalues, "", "ascending, relative to the largest"),
            "descriptions": (list(unobservable.descriptions), "", "of what is not observable"),
            "names": (model.names, "", "of the states"),
            "after": (after, "", "standard deviations of the states after the scheme, SI units"),
            "place": ([SLOTS.index(short_name(name)) for name in sensor_errors], "", "in SLOTS"),
        },
    )  # fmt: skip


@lru_cache(maxsize=1)
def _followed(
    scheme: Scheme, latitude: float, model: ErrorModel
) -> tuple[LinearizedErrors, UnobservableSubspace]:
    """What does not depend on the noise: kept for a reader who moves only that."""
    way = linearize_along(scheme, latitude, model)
    return way, unobservable_subspace(way)

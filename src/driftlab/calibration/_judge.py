"""What a record looks like to the filter if something else is told: the judge over slips.

The filter runs over sums of neighbouring increments and looks at every tenth second only, so that
a slip costs a fraction of a second. The steps are such that a right record passes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.constants import degree

from driftlab.checks import FloatArray
from driftlab.imu import ImuNoise, PriorDeviations
from driftlab.increments import Increments

from ._earlier_pass import linearization_point
from ._evidence import thinned
from ._innovations import beyond_prior, contradiction
from .calibration_history import Calibration
from .consistency import innovation_test
from .error_model import ErrorModel

LOOSE = 5 * degree
"""How far the start may be off where a slip is looked for in it, rad."""
_STEP = 0.02
"""Increments are added up to turns of about this, rad, and"""
_LONGEST = 0.1
"""to so long a time, s: of a 100 Hz log that stands within 10 micrometres a second the innovations
then still are what they should be."""
_COARSE = 10.0
"""Interval of the updates, s,"""
_MOST = 250
"""and about their number at most."""
_FLOOR = 3e-3
"""Noise of the reference velocity that is enough for slips of some size, m/s."""
_SMALL = 2e-3
"""Latitudes this far apart make innovations that differ by a multiple of it, rad."""


class Told(NamedTuple):
    """What a calibration is told: increments (n, 3), start (4,), latitude."""

    increments: Increments
    start: FloatArray
    latitude: float
    loose: bool = False
    """Whether the start is a guess, within some degrees."""


@dataclass(frozen=True)
class Judge:
    """Runs the filter over what is told, and looks at innovations and errors found.

    Attributes
    ----------
    told : Told
        What was told.
    reference : ndarray, shape (k, 3)
        Velocities of the table.
    ends : ndarray, shape (k,)
        When, as numbers of increments.
    prior, noise, model
        As the filter was told.
    calibrate : callable
        The filter.
    """

    told: Told
    reference: FloatArray
    ends: NDArray[Any]
    prior: PriorDeviations
    noise: ImuNoise
    model: ErrorModel
    calibrate: Callable[..., Calibration]

    def accepts(self, other: Told, model: ErrorModel | None = None) -> FloatArray | None:
        """The start (4,) that is found, if nothing contradicts what is told now."""
        rows, found = self._run(other, model or self.model, *self._steps)
        if found is None or not _right(found, self.prior, other):
            return None
        return linearization_point(rows, other.latitude, found)[1]

    def latitude(self, other: Told) -> tuple[float, float]:
        """The latitude that fits best, near one, and its deviation, rad: the innovations are linear
        in a small error of it."""
        near = other._replace(latitude=other.latitude + _SMALL * (-1 if other.latitude > 0 else 1))
        here, there = (self._run(each, self.model, *self._steps)[1] for each in (other, near))
        if here is None or there is None:
            return other.latitude, np.inf
        slope = (there.innovations - here.innovations) / (near.latitude - other.latitude)
        square = float(np.sum(slope**2))
        if not 0 < square < np.inf:
            return other.latitude, np.inf
        step = -float(np.sum(slope * here.innovations)) / square
        return other.latitude + float(np.clip(step, -0.1, 0.1)), 1 / np.sqrt(square)

    @cached_property
    def _steps(self) -> tuple[float, float]:
        """Noise of the reference velocity and interval of the updates, the coarsest with which what
        was told is contradicted."""
        own, usual = self.noise.reference_velocity, self._seconds / len(self.ends)
        coarse = max(_COARSE, self._seconds / _MOST)
        *steps, last = dict.fromkeys([(max(own, _FLOOR), coarse), (own, coarse), (own, usual)])
        for each in steps:
            found = self._run(self.told, self.model, *each)[1]
            if found is None or not _right(found, self.prior, self.told):
                return each
        return last

    @property
    def _seconds(self) -> float:
        return float(self.ends[-1] * self.told.increments.interval)

    def _run(
        self, other: Told, model: ErrorModel, deviation: float, update: float
    ) -> tuple[Increments, Calibration | None]:
        """Increments and what the filter finds with them; a start that is a guess takes two
        passes."""
        rows = thinned(other.increments, _STEP, _LONGEST)
        # The same moments, whatever the interval is now.
        skip = max(round(update * len(self.ends) / self._seconds), 1)
        ends, pair = self.ends[skip - 1 :: skip] * other.increments.interval, 2 * rows.interval
        places = np.round(ends / pair).astype(int)
        kept = np.flatnonzero(np.diff(places, prepend=0) > 0)
        kept = kept[places[kept] <= len(rows.angle) // 2]
        if len(kept) == 0:
            return rows, None
        rows = rows.part(0, 2 * int(places[kept][-1]))
        attitude = max(self.prior.attitude, LOOSE * other.loose)
        told = {
            "reference_times": places[kept] * pair,
            "latitude": other.latitude,
            "start": other.start,
            "model": model,
            "prior": replace(self.prior, attitude=attitude),
            "noise": replace(self.noise, reference_velocity=deviation),
            "keep": len(self.ends),
            "check": False,
        }
        reference, found = self.reference[skip - 1 :: skip][kept], None
        try:
            with np.errstate(all="ignore"):
                for _ in range(1 + other.loose):
                    found = self.calibrate(rows, reference, about=found, **told)
        except (ValueError, np.linalg.LinAlgError):
            return rows, None
        return rows, found


def _right(found: Calibration, prior: PriorDeviations, told: Told) -> bool:
    """Whether nothing speaks against a result."""
    return (
        bool(np.isfinite(found.innovations).all())
        and contradiction(innovation_test(found)) is None
        and not beyond_prior(found, prior, told.start)
    )

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

from ._contradictions import beyond_prior, contradiction, thinned
from .calibration_history import Calibration, innovation_test
from .error_model import ErrorModel

LOOSE = 5 * degree
"""How far the start may be off where a slip is looked for in it, rad."""
_TURN = 0.02
"""Increments are added up to turns of about this, rad."""
_COARSE = 10.0
"""Interval of the updates, s,"""
_MOST = 250
"""and about their number at most."""
_LADDER = (3e-3, 0.1), (3e-4, 0.1), (0.0, 0.02)
"""Least noise of the reference velocity, m/s, and longest time, s, to which increments are added
up: a turn that begins in the midst of 0.1 s makes errors of some 1e-5 m/s."""
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
        if self.steps is None:
            return None
        rows, found = self._run(other, model or self.model, *self.steps)
        if found is None or not _right(found, self.prior, other):
            return None
        return found._linearization_point(rows, other.latitude)[1]

    def latitude(self, other: Told) -> tuple[float, float]:
        """The latitude that fits best, near one, and its deviation, rad: the innovations are linear
        in a small error of it."""
        near = other._replace(latitude=other.latitude + _SMALL * (-1 if other.latitude > 0 else 1))
        if self.steps is None:
            return other.latitude, np.inf
        here, there = (self._run(each, self.model, *self.steps)[1] for each in (other, near))
        if here is None or there is None:
            return other.latitude, np.inf
        slope = (there.innovations - here.innovations) / (near.latitude - other.latitude)
        square = float(np.sum(slope**2))
        if not 0 < square < np.inf:
            return other.latitude, np.inf
        step = -float(np.sum(slope * here.innovations)) / square
        return other.latitude + float(np.clip(step, -0.1, 0.1)), 1 / np.sqrt(square)

    @cached_property
    def steps(self) -> tuple[float, float] | None:
        """Noise of the reference velocity, m/s, and time to which increments are added up, s: the
        coarsest with which what was told is contradicted."""
        for least, longest in _LADDER:
            each = max(self.noise.reference_velocity, least), longest
            found = self._run(self.told, self.model, *each)[1]
            if found is None or not _right(found, self.prior, self.told):
                return each
        return None

    @property
    def _seconds(self) -> float:
        return float(self.ends[-1] * self.told.increments.interval)

    def _run(
        self, other: Told, model: ErrorModel, deviation: float, longest: float
    ) -> tuple[Increments, Calibration | None]:
        """Increments and what the filter finds with them; a start that is a guess takes two
        passes."""
        rows = thinned(other.increments, _TURN, longest)
        # The same moments, whatever the interval is now.
        update = max(_COARSE, self._seconds / _MOST)
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
        and not beyond_prior(found, prior, told.start)[1]
    )

"""What `calibrate` says if a record contradicts what it was told: the test, and likely slips."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.constants import degree

from driftlab.checks import FloatArray
from driftlab.imu import ImuNoise, PriorDeviations
from driftlab.increments import Increments

from ._earlier_pass import linearization_point
from ._evidence import Expected, evidence, thinned
from ._innovations import SECOND_ORDER, contradiction, second_order
from ._slips import FITS, Judge, Told, likely_slips
from .calibration_history import Calibration
from .consistency import InconsistentWarning, innovation_test
from .error_model import ErrorModel

_LOOSE = 5 * degree
"""How far the start may be off where a slip is looked for in it, rad."""
_COARSE = 10.0
"""Interval of the updates in which slips are tried, s."""


class Door(NamedTuple):
    """Arguments of a calibration, checked."""

    increments: Increments
    start: FloatArray
    latitude: float
    prior: PriorDeviations
    noise: ImuNoise
    reference: FloatArray
    ends: NDArray[Any]
    lead: tuple[int, ...]
    """Leading axes of the runs."""
    first: bool
    """Whether it is the first pass over the record."""


def warn_if_impossible(
    door: Door, model: ErrorModel, calibrate: Callable[..., Calibration]
) -> bool:
    """Warn before the filter if gravity or the Earth's rate contradict a record; tell whether."""
    expected = _expected(door)
    for run in range(int(np.prod(door.lead))):
        told = _told(run, door)
        shown = evidence(told.increments)
        size = np.inf
        if shown is not None:
            size = float(shown.misfit(told.start, told.latitude, expected))
        if size > FITS:
            _warn(
                "expected gravity and the Earth's rate to be where start, latitude and increments "
                f"have them within {FITS:g} deviations, got {size:.3g}",
                likely_slips(told, expected, _judge(run, door, model, calibrate)),
            )
            return True
    return False


def warn_if_inconsistent(
    found: Calibration, door: Door, calibrate: Callable[..., Calibration]
) -> None:
    """Warn if innovations contradict the filter's assumptions, or errors are too large for it."""
    doubt = contradiction(innovation_test(found))
    slips: list[str] = []
    if doubt is not None:
        run = doubt[0]
        judge = _judge(run, door, found.model, calibrate)
        slips = likely_slips(_told(run, door), _expected(door), judge)
    bend = second_order(found)
    if not slips and door.first and bend > SECOND_ORDER:
        doubt = 0, f"expected bends with squares below {SECOND_ORDER:g} deviations, got {bend:.3g}"
        slips = [
            "errors too large for first order, and deviations stated too small: go over the "
            "record again, about this result"
        ]
    if doubt is not None:
        _warn(doubt[1], slips)


def _warn(sentence: str, slips: list[str]) -> None:
    advice = (
        f": {'; or '.join(slips)}?"
        if slips
        else "; no slip is known that explains it. Perhaps the unit has errors that the model does "
        "not have, lever arms say: ErrorModel.with_states adds some."
    )
    warnings.warn(
        f"calibration: {sentence}{advice.replace('result?', 'result.')}",
        InconsistentWarning,
        stacklevel=4,
    )


def _told(run: int, door: Door) -> Told:
    """What one run was told."""
    interval, angle, velocity = door.increments
    return Told(
        Increments(interval, _own(angle, 2, run, door), _own(velocity, 2, run, door)),
        _own(door.start, 1, run, door),
        door.latitude,
    )


def _own(rows: FloatArray, core: int, run: int, door: Door) -> FloatArray:
    """The part of an array that belongs to one run."""
    shape = rows.shape[rows.ndim - core :]
    return np.broadcast_to(rows, (*door.lead, *shape)).reshape(-1, *shape)[run]


def _expected(door: Door) -> Expected:
    return Expected(door.prior, door.noise, float(np.abs(door.reference).max()))


def _judge(run: int, door: Door, model: ErrorModel, calibrate: Callable[..., Calibration]) -> Judge:
    """The filter, in coarse steps, and the test of its innovations."""
    reference = _own(door.reference, 2, run, door)

    def judge(other: Told) -> FloatArray | None:
        rows = thinned(other.increments)
        # The same moments, whatever the interval is now.
        times = door.ends * other.increments.interval
        skip = max(round(_COARSE / (times[-1] / len(times))), 1)
        pair = 2 * rows.interval
        places = np.round(times[skip - 1 :: skip] / pair)
        kept = np.flatnonzero(np.diff(places, prepend=0.0) > 0)
        kept = kept[places[kept] <= len(rows.angle) // 2]
        prior = replace(door.prior, attitude=max(door.prior.attitude, _LOOSE * other.loose))
        try:
            again = calibrate(
                rows,
                reference[skip - 1 :: skip][kept],
                reference_times=places[kept] * pair,
                latitude=other.latitude,
                start=other.start,
                model=model,
                prior=prior,
                noise=door.noise,
                keep=len(times),
                check=False,
            )
        except (ValueError, np.linalg.LinAlgError):
            return None
        if contradiction(innovation_test(again)) is not None:
            return None
        used = rows.part(0, 2 * int(places[kept][-1]))
        return linearization_point(used, other.latitude, again)[1]

    return judge

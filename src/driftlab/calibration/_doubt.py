"""What `calibrate` says if a record contradicts what it was told: the test, and likely slips."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray
from driftlab.imu import ImuNoise, PriorDeviations
from driftlab.increments import Increments

from ._contradictions import (
    BEYOND,
    LARGER,
    SECOND_ORDER,
    Expected,
    beyond_prior,
    contradiction,
    evidence,
    second_order,
    told_noise,
)
from ._judge import Judge, Told
from ._slips import FITS, likely_slips
from .calibration_history import Calibration, InconsistentWarning, innovation_test
from .error_model import ErrorModel

_ONCE_MORE = (
    "errors too large for first order, and deviations stated too small: go over the record again, "
    "about this result"
)

LARGE_BIAS = 1e-3
"""Deviation of the gyros' biases with which a filter that is linear in them may go astray, rad/s:
in a minute such a bias turns by three degrees."""
TAKE_THE_MEAN = (
    "Gyro biases as large as the prior says lead the filter astray: take the mean at rest out of "
    "the gyros first, then say in the prior what is left"
)


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
) -> InconsistentWarning | None:
    """Warn before the filter if gravity or the Earth's rate contradict a record."""
    expected = _expected(door)
    for run in range(int(np.prod(door.lead))):
        told = _told(run, door)
        shown = evidence(told.increments)
        size = np.inf
        if shown is not None:
            size = float(shown.misfit(told.start, told.latitude, expected))
        if size > FITS:
            slips = likely_slips(told, expected, _judge(run, door, door.noise, model, calibrate))
            noise = []
            if not slips:
                noise = told_noise(told.increments, shown, door.noise)[0]
            sentence = (
                "expected gravity and the Earth's rate to be where start, latitude and increments "
                f"have them within {FITS:g} deviations, got {size:.3g}"
            )
            return _warn(sentence + _advice(door.prior, slips, noise))
    return None


def warn_if_inconsistent(
    found: Calibration, door: Door, calibrate: Callable[..., Calibration]
) -> None:
    """Warn if innovations or errors found contradict what the filter was told, if the noise is
    another one, or if the errors are too large for one pass."""
    doubt = contradiction(innovation_test(found))
    run, beyond = beyond_prior(found, door.prior, door.start)
    if doubt is not None:
        run = doubt[0]
    told = _told(run, door)
    noise, right = told_noise(told.increments, evidence(told.increments), door.noise)
    said = []
    if doubt is not None:
        said.append(doubt[1])
    if beyond:
        said.append(
            f"expected errors within {BEYOND:g} deviations of the prior, got {'; '.join(beyond)}"
        )
    if said:
        judge = _judge(run, door, right, found.model, calibrate)
        # With the noise that it has, the record may be right.
        slips: list[str] = []
        if not noise or judge.steps is not None:
            slips = likely_slips(told, _expected(door), judge)
        if slips or noise:
            _warn(said[0] + _advice(door.prior, slips, noise))
            return
        said[0] += _advice(door.prior, []) if doubt is not None else ""
    elif noise:
        said.append(
            f"expected noise within a factor of {LARGER:g} of what was told, got "
            + "; ".join(noise)
        )
    largest = second_order(found)
    if door.first and largest > SECOND_ORDER:
        said.append(
            "expected scale and installation errors whose squares are below "
            f"{SECOND_ORDER:g} stated deviations, got {largest:.3g}: {_ONCE_MORE}"
        )
    if said:
        _warn(". Besides, ".join(part.rstrip(".?") for part in said) + ".")


def _warn(sentence: str) -> InconsistentWarning:
    warning = InconsistentWarning(f"calibration: {sentence}")
    warnings.warn(warning, stacklevel=4)
    return warning


def _advice(prior: PriorDeviations, slips: list[str], certain: list[str] | None = None) -> str:
    """The end of a sentence: what is certain, and slips of which one may be; or that none is."""
    parts = ["; or ".join(slip.rstrip("?") for slip in slips)] if slips else []
    parts = [*(part.rstrip("?") for part in certain or []), *parts]
    if parts:
        return f": {'; and '.join(parts)}?"
    if prior.gyro_bias > LARGE_BIAS:
        return f"; no slip is known that explains it. {TAKE_THE_MEAN}."
    return (
        "; no slip is known that explains it. Are the errors larger than the prior says? Then a "
        "larger prior, and a second pass about this result."
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


def _judge(
    run: int,
    door: Door,
    noise: ImuNoise,
    model: ErrorModel,
    calibrate: Callable[..., Calibration],
) -> Judge:
    """The filter over one run."""
    reference = _own(door.reference, 2, run, door)
    return Judge(_told(run, door), reference, door.ends, door.prior, noise, model, calibrate)

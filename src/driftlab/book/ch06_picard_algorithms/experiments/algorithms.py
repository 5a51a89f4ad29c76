"""Errors of the attitude algorithms on motions whose attitude is known, and their orders."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from driftlab.attitude.coning_algorithms import (
    CONING_ALGORITHMS,
    Algorithm,
    Algorithms,
    AnyAlgorithm,
    named_algorithms,
)
from driftlab.attitude.finite_precision import integrate_in_word
from driftlab.attitude.functional_iteration import FunctionalIteration
from driftlab.attitude.integration import step_quaternions
from driftlab.checks import FloatArray
from driftlab.motion.profiles import Coning, FixedAxis, Motion, Sway
from driftlab.quaternion import conjugate, cumulative_product, multiply, rotation_angle

DURATION = 2.0
"""Of the motion, s."""
SAMPLE_RATES = (12, 24, 48, 96, 192)
"""In Hz: each gives a multiple of six increments, so all algorithms can be tried."""
MOTIONS: dict[str, type[Coning] | type[Sway] | type[FixedAxis]] = {
    "coning": Coning,
    "swaying ship": Sway,
    "fixed axis": FixedAxis,
}
"""Kinds of motion; each takes an amplitude in rad and a frequency in Hz."""
SHIP = Sway(float(np.radians(30.0)), 0.5)
"""A motion without the symmetries that hide errors."""
ORDER_SAMPLE_RATES = (24, 48, 96, 192, 384, 768)
"""Sample rates in Hz over which the orders are measured."""
ORDER_MOTIONS: dict[str, Motion] = {
    "small cone, half angle 1°, 1 Hz": Coning(float(np.radians(1.0)), 1.0),
    "wide cone, half angle 60°, 1 Hz": Coning(float(np.radians(60.0)), 1.0),
    "swaying ship, roll 30°, 0.5 Hz": SHIP,
    "fixed axis, 57° and 57°/s, 0.5 Hz": FixedAxis(1.0, 0.5),
}
"""Motions that show the orders, and motions that hide them."""


class AlgorithmLaboratory(NamedTuple):
    """Errors of attitude algorithms on one motion."""

    names: tuple[str, ...]  # the algorithms
    rate: int  # sample rate of the histories, Hz
    times: list[FloatArray]  # (n,) each, for each algorithm, the ends of its steps, s
    # (n,) each, for each algorithm, the angle of its error at these times, rad; NaN where
    # functional iteration refuses increments that no polynomial fits
    histories: list[FloatArray]
    rates: FloatArray  # (m,), sample rates, Hz
    # (algorithm, m), largest error during the motion at each sample rate, rad; NaN as above
    worst: FloatArray
    rounding: float  # an error below it is not told from rounding, rad


class AlgorithmOrders(NamedTuple):
    """Largest errors and orders of algorithms on several motions."""

    rates: FloatArray  # (m,), sample rates, Hz
    worst: FloatArray  # (motion, algorithm, m), largest error during the motion, rad
    # fitted order by motion and algorithm; None where rounding hides it
    orders: list[list[float | None]]
    names: tuple[str, ...]  # the algorithms
    motions: tuple[str, ...]


def algorithm_errors(
    motion: Motion,
    rate: int,
    algorithms: Algorithms,
    *,
    rates: Sequence[int] = SAMPLE_RATES,
    short_word: bool = False,
) -> AlgorithmLaboratory:
    """Compute the errors of attitude algorithms on a motion of `DURATION` seconds.

    `rate` (Hz) is one of `rates`; with `short_word` the arithmetic has words of 32 bits.
    """
    if rate not in rates:
        raise ValueError(f"rate: expected one of {', '.join(map(str, rates))} Hz, got {rate!r}.")
    chosen = named_algorithms(algorithms)
    groups = _equally_long_steps(chosen)
    worst = np.empty((len(chosen), len(rates)))
    histories: dict[int, FloatArray] = {}
    for j, sample_rate in enumerate(rates):
        count = round(DURATION * sample_rate)
        increments = motion.increments(1 / sample_rate, count)
        moments = np.arange(count + 1) / sample_rate
        exact = motion.attitude(moments)
        for group in groups:
            of_group = [list(chosen.values())[i] for i in group]
            try:
                found = _attitudes(increments, of_group, exact[0], short_word=short_word)
            except ValueError:
                if not isinstance(of_group[0], FunctionalIteration):
                    raise
                errors = np.full((1, count), np.nan)
            else:
                step = count // found.shape[-2]
                errors = rotation_angle(multiply(conjugate(exact[step::step]), found))
            worst[group, j] = errors.max(axis=-1)
            if sample_rate == rate:
                histories |= dict(zip(group, errors, strict=True))
    ordered = [histories[i] for i in range(len(chosen))]
    rounding = 1e-5 if short_word else 1e-12
    return AlgorithmLaboratory(
        tuple(chosen),
        rate,
        [DURATION / len(history) * np.arange(1.0, len(history) + 1) for history in ordered],
        ordered,
        np.array(rates, dtype=np.float64),
        worst,
        rounding,
    )


def _equally_long_steps(algorithms: Mapping[str, AnyAlgorithm]) -> list[list[int]]:
    """Places of algorithms with cross products whose steps are equally long; others alone.

    Together they take less time: each call has its price.
    """
    groups: dict[int, list[int]] = {}
    for i, one in enumerate(algorithms.values()):
        groups.setdefault(one.samples if isinstance(one, Algorithm) else -i, []).append(i)
    return list(groups.values())


def _attitudes(
    increments: FloatArray, algorithms: Sequence[AnyAlgorithm], start: FloatArray, *,
    short_word: bool,
) -> FloatArray:  # fmt: skip
    """Attitudes (algorithm, n // samples, 4) of algorithms with equally many samples a step."""
    if short_word:
        attitudes = [integrate_in_word(increments, one, start=start) for one in algorithms]
        return np.array(attitudes, dtype=np.float64)
    steps = [step_quaternions(increments, one) for one in algorithms]
    return multiply(start, cumulative_product(np.stack(steps)))


def fitted_orders(data: AlgorithmLaboratory) -> list[float | None]:
    """Return the slope of each algorithm's error over the sample interval.

    Fitted to the errors below 1e-2 rad, where they are small, and above the level of rounding;
    None where fewer than three are left.
    """
    orders: list[float | None] = []
    for errors in data.worst:
        used = (errors < 1e-2) & (errors > data.rounding)
        if used.sum() < 3:
            orders.append(None)
        else:
            slope = np.polyfit(np.log(data.rates[used]), np.log(errors[used]), 1)[0]
            orders.append(float(-slope))
    return orders


def algorithm_orders(
    algorithms: Algorithms = tuple(CONING_ALGORITHMS),
    motions: Mapping[str, Motion] = ORDER_MOTIONS,
    sample_rates: Sequence[int] = ORDER_SAMPLE_RATES,
) -> AlgorithmOrders:
    """Measure the orders of algorithms on several motions of `DURATION` seconds.

    The sample rates (Hz) rise, and their increments must make whole steps.
    """
    chosen = named_algorithms(algorithms)
    if not isinstance(motions, Mapping):
        raise ValueError(f"motions: expected a mapping from names to motions, got {motions!r}.")
    for motion in motions.values():
        if not isinstance(motion, Motion):
            raise ValueError(f"motions: expected a Motion, as Coning or Sway, got {motion!r}.")
    trials = [
        algorithm_errors(motion, sample_rates[0], chosen, rates=sample_rates)
        for motion in motions.values()
    ]
    return AlgorithmOrders(
        trials[0].rates,
        np.array([trial.worst for trial in trials]),
        [fitted_orders(trial) for trial in trials],
        tuple(chosen),
        tuple(motions),
    )

"""Errors of the attitude algorithms on motions whose attitude is known, and their orders."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from driftlab.attitude.coning_algorithms import (
    CONING_ALGORITHMS,
    Algorithm,
    AnyAlgorithm,
    AttitudeAlgorithm,
    checked_algorithm,
)
from driftlab.attitude.finite_precision import integrate_finite_word
from driftlab.attitude.functional_iteration import FunctionalIteration
from driftlab.attitude.integration import step_quaternions
from driftlab.attitude.own_algorithms import OwnAlgorithm
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, shown
from driftlab.motion.profiles import Coning, FixedAxis, Motion, Sway
from driftlab.quaternion import conjugate, cumulative_product, multiply, rotation_angle

Algorithms = Mapping[str, AnyAlgorithm] | Iterable[str | AttitudeAlgorithm]
"""What may stand for several: algorithms by name, or keys of `ALGORITHMS` and algorithms."""

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
    "narrow cone, half angle 1°, 1 Hz": Coning(float(np.radians(1.0)), 1.0),
    "wide cone, half angle 60°, 1 Hz": Coning(float(np.radians(60.0)), 1.0),
    "swaying ship, roll 30°, 0.5 Hz": SHIP,
    "fixed axis, 57° and 57°/s, 0.5 Hz": FixedAxis(1.0, 0.5),
}
"""Motions that show the orders, and motions that hide them."""


def named_algorithms(algorithms: Algorithms) -> dict[str, AttitudeAlgorithm | OwnAlgorithm]:
    """Several algorithms by their names, in the same order; a function needs a name with it."""
    if isinstance(algorithms, Mapping):
        return {str(name): checked_algorithm(one, "algorithms") for name, one in algorithms.items()}
    if isinstance(algorithms, str) or not isinstance(algorithms, Iterable):
        raise ValueError(
            "algorithms: expected several names, or a mapping from names to algorithms, "
            f"got {shown(algorithms)}."
        )
    found: dict[str, AttitudeAlgorithm | OwnAlgorithm] = {}
    for one in algorithms:
        algorithm = checked_algorithm(one, "algorithms")
        if not isinstance(algorithm, AttitudeAlgorithm):
            raise ValueError('algorithms: expected a name with a function, as {"mine": function}.')
        found[algorithm.name] = algorithm
    return found


def algorithm_errors(
    motion: Motion,
    rate: int,
    algorithms: Algorithms,
    *,
    rates: Sequence[int] = SAMPLE_RATES,
    short_word: bool = False,
) -> DataTable:
    """Compute the errors of attitude algorithms on a motion of `DURATION` seconds.

    `rate` (Hz) is one of `rates`; with `short_word` the arithmetic has words of 32 bits. Errors are
    NaN where functional iteration refuses increments that no polynomial fits.
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
        exact = motion.attitude(np.arange(count + 1) / sample_rate)
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
    error = {name: histories[i] for i, name in enumerate(chosen)}
    time = {name: DURATION / len(e) * np.arange(1.0, len(e) + 1) for name, e in error.items()}
    sampled, rounding = np.array(rates, float), 1e-5 if short_word else 1e-12
    orders = {
        name: _fitted_order(sampled, each, rounding)
        for name, each in zip(chosen, worst, strict=True)
    }
    return DataTable(
        {
            "time": (time, "s", "at which a step ends"),
            "error": (error, "arcsec", "angle of the attitude error at these times"),
            "rate": (sampled, "Hz", "sample rate"),
            "largest_error": (worst, "arcsec", "during the motion, at each rate", [*chosen]),
        },
        {
            "at_rate": (rate, "Hz", "sample rate of the errors over time"),
            "rounding": (rounding, "arcsec", "what is smaller may be rounding"),
            "orders": (orders, "", "by algorithm; None where rounding hides it"),
        },
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
        attitudes = [integrate_finite_word(increments, one, start=start) for one in algorithms]
        return np.array(attitudes, dtype=np.float64)
    steps = [step_quaternions(increments, one) for one in algorithms]
    return multiply(start, cumulative_product(np.stack(steps)))


def _fitted_order(rates: FloatArray, errors: FloatArray, rounding: float) -> float | None:
    """Return the slope of an algorithm's error over the sample interval.

    Fitted to the errors below 1e-2 rad, where they are small, and above the level of rounding;
    None where fewer than three are left.
    """
    used = (errors < 1e-2) & (errors > rounding)
    if used.sum() < 3:
        return None
    return float(-np.polyfit(np.log(rates[used]), np.log(errors[used]), 1)[0])


def algorithm_orders(
    algorithms: Algorithms = tuple(CONING_ALGORITHMS),
    motions: Mapping[str, Motion] = ORDER_MOTIONS,
    sample_rates: Sequence[int] = ORDER_SAMPLE_RATES,
) -> DataTable:
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
    errors = np.array([trial.largest_error for trial in trials])
    shown = np.where(errors > 0, errors, np.nan)  # zero has no place on a logarithmic axis
    orders = {name: trial.orders for name, trial in zip(motions, trials, strict=True)}
    return DataTable(
        {
            "rate": (trials[0].rate, "Hz", "sample rate"),
            "largest_error": (shown, "rad", "during the motion", [[*motions], [*chosen]]),
        },
        {"orders": (orders, "", "by motion and algorithm; None where rounding hides it")},
    )

"""What a word of 32 bits does to an attitude of many steps, on four motions."""

from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.constants import day

from driftlab.attitude.finite_precision import UPDATES, Update, integrate_finite_word
from driftlab.attitude.integration import integrate
from driftlab.book.ch07_coning.experiments import BRACKET, SHIP
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, whole_number
from driftlab.core.coning import cone_increments
from driftlab.motion.profiles import Motion
from driftlab.quaternion import conjugate, multiply, rotation_angle

EARTH_RATE = 2 * np.pi / (day * 365.2422 / 366.2422)
"""Rate of the Earth against the stars, rad/s: one turn more in a year than there are days."""
WAVES = 6
"""Sines in each component of the rate."""
FREQUENCIES = (0.1, 1.0)
"""Lowest and highest of these sines, Hz."""
WAVE_RATE = 0.5
"""Standard deviation of the amplitude of one sine, rad/s."""
AXIS = np.array([0.6, 0.0, 0.8])
"""Of the steady turn, in the body."""
WORD_MOTIONS: dict[str, Motion | None] = {
    "cone of 1°, 5 Hz": BRACKET,
    "ship, roll 30°, 0.5 Hz": SHIP,
    "steady turn": None,
    "random motion": None,
}
"""Motions by name. The last two are no `Motion`: equal steps about `AXIS`, and a random motion for
each attitude at the start."""


class Arithmetic(NamedTuple):
    """How a processor adds products, and what is done with the length."""

    fused: bool
    normalise: bool


ARITHMETICS = {
    "rounded": Arithmetic(fused=False, normalise=False),
    "rounded, normalised": Arithmetic(fused=False, normalise=True),
    "fused": Arithmetic(fused=True, normalise=False),
    "fused, normalised": Arithmetic(fused=True, normalise=True),
}
"""Kinds of arithmetic by name: each product and each sum rounded, or fused multiply-add; the length
mended after each step, or not."""
STEP_ANGLES: FloatArray = np.geomspace(1e-6, 1e-2, 17)
"""Wanted angles of a step, rms over the run, rad."""
STORED_AS_ONE = float(np.sqrt(8 * np.finfo(np.float32).epsneg / 2))
"""Angle of a step, in rad, below which a word of 32 bits stores the scalar part cos(angle/2) as 1:
where angle²/8 is half of its last digit."""


def rows_of(table: DataTable, **words: str) -> NDArray[np.intp]:
    """Rows (n,) of the table of `short_word_errors` in which columns have these words."""
    there = [np.asarray(getattr(table, name)) == word for name, word in words.items()]
    return np.flatnonzero(np.all(there, axis=0))


def advice_gains(
    table: DataTable, arithmetic: str, motion: str, other: Update, *, above: bool
) -> FloatArray:
    """How many times smaller the error is with 1 - l0 than with another update.

    At each step that is above `STORED_AS_ONE`, or below it.
    """
    rows, advised = (
        rows_of(table, arithmetic=arithmetic, motion=motion, update=update)
        for update in (other, "complement")
    )
    chosen = (table.step[rows] > STORED_AS_ONE) == above
    return (table.error[rows] / table.error[advised])[chosen]


def short_word_errors(
    motions: Sequence[str] = tuple(WORD_MOTIONS),
    steps: int = 1000,
    starts: int = 24,
    seed: int = 2014,
) -> DataTable:
    """Integrate motions at many sample rates, in 32 bits and in 64.

    The attitude is compared after so many steps; errors are averaged over attitudes at the start.
    """
    for name in motions:
        if name not in WORD_MOTIONS:
            raise ValueError(f"motions: expected some of {', '.join(WORD_MOTIONS)}, got {name!r}.")
    count, many = whole_number(steps, "steps"), whole_number(starts, "starts")
    # Four normal deviates have no preferred direction: uniform over all rotations.
    begin = np.random.default_rng(seed).normal(size=(many, 4))
    begin /= np.linalg.norm(begin, axis=-1, keepdims=True)
    # Attitudes that the word can hold, so that what is measured is the arithmetic alone.
    begin = begin.astype(np.float32).astype(np.float64)
    shape = (len(motions), len(ARITHMETICS), len(UPDATES), len(STEP_ANGLES))
    angles, errors, lengths = np.empty(shape), np.empty(shape), np.full(shape, np.nan)
    for j, name in enumerate(motions):
        # The same holds for the increments.
        runs = np.stack(
            [_increments(name, float(angle), count, many, seed) for angle in STEP_ANGLES]
        )
        runs = runs.astype(np.float32).astype(np.float64)
        turns = runs[..., 0::2, :] + runs[..., 1::2, :]
        angles[j] = np.sqrt((turns**2).sum(axis=-1).mean(axis=(-1, -2)))
        true = integrate(runs, start=begin)[..., -1, :]
        for i, arithmetic in enumerate(ARITHMETICS.values()):
            for u, update in enumerate(UPDATES):
                kind = arithmetic._asdict()
                found = integrate_finite_word(runs, start=begin, update=update, **kind)
                end = found[..., -1, :].astype(np.float64)
                # Its angle does not depend on the length of the quaternion.
                wrong = rotation_angle(multiply(conjugate(true), end))
                errors[j, i, u] = np.sqrt(np.mean(wrong**2, axis=-1))
                if not arithmetic.fused and not arithmetic.normalise:
                    length = np.linalg.norm(end, axis=-1)
                    change = length / np.linalg.norm(begin, axis=-1) - 1
                    lengths[j, i, u] = np.sqrt(np.mean(change**2, axis=-1))
    words = [each for each in product(motions, ARITHMETICS, UPDATES) for _ in STEP_ANGLES]
    of_motion, of_arithmetic, of_update = map(list, zip(*words, strict=True))
    shown = np.where(errors > 0, errors, np.nan)  # zero has no place on a logarithmic axis
    line = np.array([STORED_AS_ONE])
    return DataTable(
        {
            "motion": (of_motion, "", "by name"),
            "arithmetic": (of_arithmetic, "", "how products are added, and the length mended"),
            "update": (of_update, "", "how the attitude is advanced"),
            "step": (angles.ravel(), "rad", "angle of a step, rms over the run"),
            "error": (shown.ravel(), "arcsec", "of the attitude at the end, rms over the starts"),
            "length_error": (lengths.ravel(), "", "of the quaternion, if it is not normalised"),
            "stored_as_one": (line, "rad", "below this angle λ0 is 1 in a word of 32 bits"),
        },
        {
            "steps": (count, "", "steps of a run"),
            "starts": (many, "", "attitudes at the start"),
        },
    )


def random_increments(
    rng: np.random.Generator, motions: int, count: int, interval: float
) -> FloatArray:
    """Integrals (motions, count, 3) of random body rates over equal intervals, rad."""
    shape = (motions, 1, WAVES, 3)
    lowest, highest = np.log(FREQUENCIES)
    frequency = 2 * np.pi * np.exp(rng.uniform(lowest, highest, size=shape))
    amplitude = WAVE_RATE * rng.standard_normal(shape)
    phase = rng.uniform(0, 2 * np.pi, size=shape)
    middle = interval * (np.arange(count) + 0.5)[:, np.newaxis, np.newaxis]
    # Each sine is integrated over the interval around its middle, exactly.
    chord = 2 * np.sin(frequency * interval / 2) / frequency
    increments: FloatArray = (amplitude * chord * np.sin(frequency * middle + phase)).sum(axis=-2)
    return increments


def _increments(name: str, step_angle: float, steps: int, starts: int, seed: int) -> FloatArray:
    """Two increments a step (1 or starts, 2 * steps, 3), at the rate that makes them."""
    count, motion = 2 * steps, WORD_MOTIONS[name]
    if motion is not None:
        typical = motion.rate(np.linspace(0, 20, 20_001))
        rms = np.sqrt((typical**2).sum(axis=-1).mean())
        return motion.increments(float(step_angle / 2 / rms), count)[np.newaxis]
    if name == "steady turn":
        return np.tile(step_angle / 2 * AXIS, (1, count, 1))
    # Three components, each a sum of sines.
    rms = np.sqrt(3 * WAVES / 2) * WAVE_RATE
    interval = step_angle / 2 / rms
    return random_increments(np.random.default_rng(seed), starts, count, interval)


def errors_by_step(
    half_angle: float, step_angles: FloatArray, *, steps: int = 1000, starts: int = 24
) -> dict[Update, FloatArray]:
    """Errors in words of 32 bits (n,), rad, by update, at steps of these angles (n,) on a cone.

    Each product and each sum is rounded. Without a half angle it is a steady turn about `AXIS`.
    """
    increments = np.tile(AXIS / 2, (2 * steps, 1)) * step_angles[:, np.newaxis, np.newaxis]
    if half_angle:
        # The rate of a cone is 2 sin(a/2) times the rate at which it goes round.
        x = step_angles[:, np.newaxis] / (4 * np.sin(half_angle / 2))
        increments = cone_increments(np.asarray(half_angle), x, x * (np.arange(2 * steps) + 0.5))
    attitudes = np.random.default_rng(6).normal(size=(starts, 4)).astype(np.float32)
    true_end = integrate(increments[:, np.newaxis], start=attitudes)[..., -1, :]
    errors = {}
    for update in UPDATES:
        found = integrate_finite_word(increments[:, np.newaxis], start=attitudes, update=update)
        turned = multiply(conjugate(true_end), found[..., -1, :].astype(float))
        errors[update] = np.sqrt(np.mean(rotation_angle(turned) ** 2, axis=-1))
    return errors

"""Last stages of an algorithm side by side: what each errs, and what it costs.

All begin with the same two increments and the same coning correction. What is measured is carried
out by the programs whose operations are counted.
"""

import numpy as np

import driftlab
from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS
from driftlab.attitude.integration import integrate
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, whole_number
from driftlab.core.coning import cone_increments, step_drift
from driftlab.quaternion import conjugate, cumulative_product, multiply, rotation_angle

from .random_motion import FREQUENCIES, WAVE_RATE, random_increments

PAIR = CONING_ALGORITHMS["two-step-4"]
"""The increments and the coning correction that all last stages start from."""
STAGE_LABELS = {
    "third iterate": "cubic term of γ",
    "tangent": "tangent, of γ + c",
    "tangent, dimension 3": "tangent, dimension 3",
    "series": "series of sine, cosine",
    "series, normalised": "the same, normalised",
    "sine series and root": "series of sine, root",
    "rotation vector": "sine and cosine",
}
"""Of `driftlab.symbolic.LAST_STAGES`, those of fourth order, and what figures call them."""
COMPARED_STAGES = tuple(STAGE_LABELS)
SAMPLES_A_ROUND = 24
HALF_ANGLES: FloatArray = np.radians(np.geomspace(1.0, 90.0, 25))
"""Of the cones, rad."""
STEP_ANGLES: FloatArray = np.geomspace(0.02, 1.0, 18)
"""Of steps about a fixed axis, rad."""
RANDOM_KINDS = {"no steady turn": 0.0, "turning by 1 rad/s": 1.0, "turning by 3 rad/s": 3.0}
"""Kinds of random motion, with the deviation of each component of the constant rate that is
added, rad/s."""
RANDOM_MOTIONS = 300
"""Motions of each kind."""
RANDOM_RATE, RANDOM_SECONDS = 24, 4
"""Sample rate in Hz, and how long a motion lasts, s."""
FINER = 8
"""By how much more often the increments are read from which the true attitude is computed; it errs
by the fourth power of this less."""
QUANTILES = (0.1, 0.5, 0.9)
"""Of the errors on random motions, over those of the rotation vector."""


def last_stage_errors(
    samples_a_round: int = SAMPLES_A_ROUND, motions: int = RANDOM_MOTIONS, seed: int = 6
) -> DataTable:
    """Try the last stages on cones, about a fixed axis and on random motions; count operations."""
    samples = whole_number(samples_a_round, "samples_a_round", least=3)
    count = whole_number(motions, "motions")
    rng = np.random.default_rng(seed)
    drifts, fixed_axis, stretched = [], [], []
    halves = STEP_ANGLES[:, np.newaxis, np.newaxis] / 2 * np.array([[0.0, 0, 1], [0, 0, 1]])
    for stage in COMPARED_STAGES:
        drifts.append(stage_drift(stage, HALF_ANGLES, samples))
        step = _step(stage, halves)
        fixed_axis.append(2 * np.arctan2(step[:, 2], step[:, 3]) - STEP_ANGLES)
        stretched.append(np.linalg.norm(step, axis=-1) - 1)
    random = np.array([random_errors(rng, turning, count) for turning in RANDOM_KINDS.values()])
    ratios = np.quantile(random[:, :-1] / random[:, -1:], QUANTILES, axis=-1).swapaxes(0, 1)
    quantiles = [[*RANDOM_KINDS], [f"{100 * part:g} %" for part in QUANTILES]]
    error, labels = np.abs(fixed_axis), [*STAGE_LABELS.values()]
    shown = np.where(error > 1e-12, error, np.nan)  # what is smaller is rounding
    return DataTable(
        {
            "half_angle": (HALF_ANGLES, "deg", "of the cones"),
            "drift": (np.abs(drifts), "arcsec", "size of the drift in one round", labels),
            "step": (STEP_ANGLES, "rad", "angle of a step about a fixed axis"),
            "error": (shown, "arcsec", "of the angle of a step", labels),
            "length_less_one": (np.array(stretched), "", "of the step's quaternion", labels),
            "stage": (labels, "", "last stage"),
            "ratio": (ratios, "", "quantiles of random errors, over sine and cosine", quantiles),
            "operations": ([*map(_cost, COMPARED_STAGES)], "", "of a step"),
        },
        {
            "samples_a_round": (samples, "", "samples a round"),
            "motions": (count, "", "random motions of each kind"),
            "fixed_axis": (np.array(fixed_axis), "rad", "error of a step, with its sign"),
            "random": (random, "rad", "errors after random motions, by kind and stage"),
        },
    )


def stage_drift(stage: str, half_angles: FloatArray, samples_a_round: int) -> FloatArray:
    """Drift (...) in one round of cones of given half angles (...), rad."""
    sample = np.asarray(2 * np.pi / samples_a_round)
    middle = sample * (np.arange(PAIR.samples) + 0.5)
    increments = cone_increments(half_angles[..., np.newaxis], sample, middle)
    step = _step(stage, increments)
    step /= np.linalg.norm(step, axis=-1, keepdims=True)
    steps = samples_a_round / PAIR.samples
    return steps * step_drift(step, half_angles, np.asarray(PAIR.samples * sample))


# SymPy comes with the first call of these two, so that the panels of the chapter do without it.
def _step(stage: str, increments: FloatArray) -> FloatArray:
    """Quaternions of steps by a last stage, from pairs of increments (..., 2, 3)."""
    return driftlab.symbolic.run_program(driftlab.symbolic.step_program(PAIR, stage), increments)


def _cost(stage: str) -> int:
    """Operations of a step with a last stage."""
    program = driftlab.symbolic.step_program(PAIR, stage)
    return sum(driftlab.symbolic.operations(program).values())


def random_errors(
    rng: np.random.Generator,
    turning: float,
    motions: int,
    *,
    frequencies: tuple[float, float] = FREQUENCIES,
    wave_rate: float = WAVE_RATE,
) -> FloatArray:
    """Errors (stage, motion) at the end of random motions, rad."""
    count = RANDOM_RATE * RANDOM_SECONDS
    fine = random_increments(
        rng,
        motions,
        FINER * count,
        1 / (FINER * RANDOM_RATE),
        turning,
        frequencies=frequencies,
        wave_rate=wave_rate,
    )
    true = integrate(fine, "rotation-vector-2")[:, -1]
    pairs = fine.reshape(motions, -1, PAIR.samples, FINER, 3).sum(axis=-2)
    errors = []
    for stage in COMPARED_STAGES:
        steps = _step(stage, pairs)
        steps /= np.linalg.norm(steps, axis=-1, keepdims=True)
        found = cumulative_product(steps)[:, -1]
        errors.append(rotation_angle(multiply(conjugate(true), found)))
    return np.array(errors)

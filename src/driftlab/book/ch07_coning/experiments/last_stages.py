"""Last stages of an algorithm side by side: what each errs, and what it costs.

All begin with the same two increments and the same coning correction. What is measured is carried
out by the programs whose operations are counted.
"""

import numpy as np

import driftlab
from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, whole_number
from driftlab.core.coning import cone_increments, step_drift

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
TURNS: FloatArray = np.linspace(-2.5, 2.5, 61)
"""Of a body in one cycle of a vibration in a circle across the axis about which it turns."""
AMPLITUDES: FloatArray = np.geomspace(0.02, 5.0, 45)
"""Of the vibration, rad."""


def last_stage_errors(samples_a_round: int = SAMPLES_A_ROUND) -> DataTable:
    """Try the last stages on cones and about a fixed axis, count operations, and draw a map."""
    samples = whole_number(samples_a_round, "samples_a_round", least=3)
    drifts, fixed_axis, stretched = [], [], []
    halves = STEP_ANGLES[:, np.newaxis, np.newaxis] / 2 * np.array([[0.0, 0, 1], [0, 0, 1]])
    for stage in COMPARED_STAGES:
        drifts.append(stage_drift(stage, HALF_ANGLES, samples))
        step = _step(stage, halves)
        fixed_axis.append(2 * np.arctan2(step[:, 2], step[:, 3]) - STEP_ANGLES)
        stretched.append(np.linalg.norm(step, axis=-1) - 1)
    error, labels = np.abs(fixed_axis), [*STAGE_LABELS.values()]
    shown = np.where(error > 1e-12, error, np.nan)  # what is smaller is rounding
    turns, amplitudes = (each.ravel() for each in np.meshgrid(TURNS, AMPLITUDES))
    shared, added = leading_errors(turns, amplitudes)
    gain = np.clip(np.log2(np.abs(1 + added / shared)), -2, 2)  # the map ends at 4 times
    return DataTable(
        {
            "half_angle": (HALF_ANGLES, "deg", "of the cones"),
            "drift": (np.abs(drifts), "arcsec", "size of the drift in one round", labels),
            "step": (STEP_ANGLES, "rad", "angle of a step about a fixed axis"),
            "error": (shown, "arcsec", "of the angle of a step", labels),
            "length_less_one": (np.array(stretched), "", "of the step's quaternion", labels),
            "stage": (labels, "", "last stage"),
            "operations": ([*map(_cost, COMPARED_STAGES)], "", "of a step"),
            "turns": (turns, "", "of the body in a cycle of the vibration"),
            "amplitude": (amplitudes, "rad", "of the vibration"),
            "gain": (gain, "", "power of 2: error of the tangent over that of sine and cosine"),
        },
        {
            "samples_a_round": (samples, "", "samples a round"),
            "fixed_axis": (np.array(fixed_axis), "rad", "error of a step, with its sign"),
        },
    )


def leading_errors(turns: FloatArray, amplitude: FloatArray) -> tuple[FloatArray, FloatArray]:
    """First terms of two errors of a step: of all last stages, and what the tangent adds.

    The body turns steadily, `turns` times in a cycle of a vibration in a circle across its axis,
    whose angle has the `amplitude` in rad. What counts is the part about the axis that stays. The
    unit is the same: the error of k for a step in which the circle goes round by 1 rad, times the
    whole rate. The tangent of dimension 3 adds 16 times as much.
    """
    square = turns**2 + amplitude**2
    shared = amplitude**2 / 11520 * (3 - 12 * turns - 8 * square)
    return shared, square**2 / 7680 * (square + turns)


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

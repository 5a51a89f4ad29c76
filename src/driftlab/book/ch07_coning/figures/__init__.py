"""The published figures of chapter 07, with their captions."""

from driftlab.attitude.drift_on_cones import SIMULATED_STEPS
from driftlab.book.machinery.figure.publish import FigureDefinition

from .. import experiments
from . import (
    algorithm_orders,
    coning_area,
    coning_drift,
    last_stages,
    polynomials,
    trap_on_a_cone,
)

FIGURES = (
    FigureDefinition(
        "07-coning-area",
        experiments.coning_area,
        coning_area.draw,
        lambda table: (
            "The increments across the axis that runs round add up to a closed curve. On a narrow "
            "cone the rotation about the cone's axis is the area inside; increments that are "
            "multiplied one by one make the area of the polygon and miss the slivers "
            f"({table.samples} samples a round are drawn). "
            "On the right, a pair of samples with their triangle."
        ),
    ),
    FigureDefinition(
        "07-polynomials",
        experiments.polynomials_through_increments,
        polynomials.draw,
        lambda _: (
            "One step (shaded) of one component of the rate. The computer has the increments only, "
            "the areas of the steps. Left: a straight line with the increments of the two halves. "
            "Right: a parabola with the increment of the step and the two before it."
        ),
    ),
    FigureDefinition(
        "07-trap-on-a-cone",
        experiments.trap_on_a_cone,
        trap_on_a_cone.draw,
        lambda table: (
            "Error of an algorithm (two-step-3, of third order, if you choose no other) on a cone "
            f"with a half angle of {table.words('half_angle', 'g')} that is sampled "
            f"{' or '.join(table.samples)} times a round. "
            "Its error of third order goes round in a circle, eight times smaller with twice as "
            "many samples. Only the error about the cone's axis grows, and it is of fourth order: "
            "sixteen times smaller."
        ),
    ),
    FigureDefinition(
        "07-algorithm-orders",
        experiments.algorithm_orders,
        algorithm_orders.draw,
        lambda _: (
            "Largest error of each algorithm in "
            f"{experiments.DURATION:g} s against the rate at which the gyros are read, on four "
            "motions if you choose no others. The narrow cone and the fixed axis hide the "
            "third-order errors that the ship shows; "
            "on the wide cone they show as a wobble that does not grow. On a fixed "
            "axis the rotation vectors have no error but rounding. The Picard algorithms are "
            "reconstructed from an abstract."
        ),
    ),
    FigureDefinition(
        "07-coning-drift",
        experiments.drift_by_frequency_and_rate,
        coning_drift.draw,
        lambda _: (
            "Apparent drift of a body that does not turn on the whole: marks measured over "
            f"{SIMULATED_STEPS} steps of each algorithm, lines from a single step. The "
            "Picard algorithms are reconstructed from an abstract."
        ),
    ),
    FigureDefinition(
        "07-last-stages",
        experiments.last_stage_errors,
        last_stages.draw,
        lambda table: (
            f"{len(table.stage)} ways from the corrected sum of two increments to a quaternion. "
            f"Drift on a cone that is sampled {table.samples_a_round} times a round; error of one "
            "step about a fixed axis, where the rotation vector has none but rounding; the error "
            "that a steady turn with a vibration across it leaves, tangent over sine and cosine, "
            "by the first terms; and operations of a step, a sine counted as one. Where the "
            "vibration makes the error (white), all stages err alike. The stages are "
            "reconstructed: the paper's own comparison is not in our text of it."
        ),
    ),
)

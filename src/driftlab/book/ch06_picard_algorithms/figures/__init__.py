"""The published figures of chapter 06, with their captions."""

from driftlab.book.machinery.publish import FigureDefinition

from .. import experiments
from . import algorithm_orders, coning_area, coning_drift, short_word

FIGURES = (
    FigureDefinition(
        "06-coning-area",
        experiments.coning_area,
        coning_area.draw,
        coning_area.columns,
        lambda data: (
            "Across the axis of the cone the increments add up to a closed way. On a narrow cone "
            "the rotation about that axis is the area inside; sums of increments enclose a polygon "
            "and miss the "
            f"slivers ({data.samples} samples a round are drawn). On the right, a pair of samples "
            "with their triangle."
        ),
    ),
    FigureDefinition(
        "06-algorithm-orders",
        experiments.algorithm_orders,
        algorithm_orders.draw,
        algorithm_orders.columns,
        lambda _: (
            "Largest error of each algorithm in "
            f"{experiments.DURATION:g} s against the rate at which the gyros are read. "
            "The small cone and the fixed axis hide the third-order errors that the ship shows; on "
            "the wide cone they show as a wobble that does not grow. On a fixed axis rotation "
            "vectors leave rounding only."
        ),
    ),
    FigureDefinition(
        "06-coning-drift",
        experiments.drift_by_frequency_and_rate,
        coning_drift.draw,
        coning_drift.columns,
        lambda _: (
            "Apparent drift of a body that does not turn on the whole: dots measured over "
            f"{experiments.DRIFT_STEPS} steps, lines by the closed formula for small cones."
        ),
    ),
    FigureDefinition(
        "06-short-word",
        experiments.short_word_errors,
        short_word.draw,
        short_word.columns,
        lambda _: (
            "Arithmetic in 32 bits. Left: 1 - λ0 of one step. Middle: a body stands on the turning "
            "Earth and λ0 is stored as 1; carrying 1 - λ0 does as adding the small terms first "
            "does, and a compensated sum far better. Right: at larger steps 1 - λ0 keeps the norm. "
            f"Root mean square of {experiments.STARTS} attitudes."
        ),
    ),
)

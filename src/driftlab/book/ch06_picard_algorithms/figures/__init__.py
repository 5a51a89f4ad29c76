"""The published figures of chapter 06, with their captions."""

from driftlab.book.machinery.publish import FigureDefinition

from . import algorithm_laboratory, algorithm_orders, coning_area, coning_drift, short_word

FIGURES = (
    FigureDefinition(
        "06-coning-area",
        coning_area.compute,
        coning_area.ConingAreaPicture,
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
        algorithm_orders.compute,
        algorithm_orders.AlgorithmOrdersPicture,
        algorithm_orders.columns,
        lambda _: (
            "Largest error of each algorithm in "
            f"{algorithm_laboratory.DURATION:g} s against the rate at which the gyros are read. "
            "The small cone and the fixed axis hide the third-order errors that the ship shows; on "
            "the wide cone they show as a wobble that does not grow. On a fixed axis rotation "
            "vectors leave rounding only."
        ),
    ),
    FigureDefinition(
        "06-coning-drift",
        coning_drift.compute,
        coning_drift.ConingDriftPicture,
        coning_drift.columns,
        lambda _: (
            "Apparent drift of a body that does not turn on the whole: dots measured over "
            f"{coning_drift.STEPS} steps, lines by the closed formula for small cones."
        ),
    ),
    FigureDefinition(
        "06-short-word",
        short_word.compute,
        short_word.ShortWordPicture,
        short_word.columns,
        lambda _: (
            "Arithmetic in 32 bits. Left: 1 - λ0 of one step. Middle: a body stands on the turning "
            "Earth and λ0 is stored as 1; carrying 1 - λ0 does as adding the small terms first "
            "does, and a compensated sum far better. Right: at larger steps 1 - λ0 keeps the norm. "
            f"Root mean square of {short_word.STARTS} attitudes."
        ),
    ),
)

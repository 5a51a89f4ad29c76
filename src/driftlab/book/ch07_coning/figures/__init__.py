"""The published figures of chapter 07, with their captions."""

import numpy as np

from driftlab.attitude.drift_on_cones import SIMULATED_STEPS
from driftlab.book.machinery.figure.publish import FigureDefinition

from .. import experiments
from . import (
    algorithm_orders,
    coning_area,
    coning_drift,
    functional_iteration,
    last_stages,
    noise_and_band,
    short_word,
)

FIGURES = (
    FigureDefinition(
        "07-coning-area",
        experiments.coning_area,
        coning_area.draw,
        lambda table: (
            "At right angles to the axis of the cone the increments add up to a closed curve. On a "
            "narrow cone the rotation about that axis is the area inside; sums of increments "
            f"enclose a polygon and miss the slivers ({table.samples} samples a round are drawn). "
            "On the right, a pair of samples with their triangle."
        ),
    ),
    FigureDefinition(
        "07-algorithm-orders",
        experiments.algorithm_orders,
        algorithm_orders.draw,
        lambda _: (
            "Largest error of each algorithm in "
            f"{experiments.DURATION:g} s against the rate at which the gyros are read; published "
            "for four motions. The small cone and the fixed axis hide the third-order errors that "
            "the ship shows; on the wide cone they show as a wobble that does not grow. On a fixed "
            "axis the rotation vectors have no error but rounding. The algorithms of Perelyaev "
            "and Chelnokov are reconstructed."
        ),
    ),
    FigureDefinition(
        "07-coning-drift",
        experiments.drift_by_frequency_and_rate,
        coning_drift.draw,
        lambda _: (
            "Apparent drift of a body that does not turn on the whole: marks measured over "
            f"{SIMULATED_STEPS} steps of each algorithm, lines from a single step. The "
            "algorithms of Perelyaev and Chelnokov are reconstructed."
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
    FigureDefinition(
        "07-noise-and-band",
        experiments.noise_and_band,
        noise_and_band.draw,
        lambda table: (
            "First the part of a narrow cone's coning that an algorithm misses. Thin lines are the "
            "first terms of the series, too large where samples are few. Then the drift on a cone "
            f"of {table.words('half_angle', 'g')} at {table.words('frequency', 'g')} in "
            f"{table.words('seconds', 'g')}, and the floors under it: gyros that round to "
            f"{table.shown('quantum'):g} arc second, and white noise of "
            f"{table.words('angle_random_walk', 'g')}. As published, for the "
            "bracket, a remainder that is lost spoils what the corrections gain; one that is "
            "carried costs about as much as the noise."
        ),
    ),
    FigureDefinition(
        "07-functional-iteration",
        experiments.window_errors,
        functional_iteration.draw,
        lambda table: (
            "Functional iteration with windows of several widths, beside algorithms with cross "
            f"products, on a cone of {table.words('half_angle', 'g')} at "
            f"{table.words('frequency', 'g')}. First the drift, by samples a round: where a "
            "window's points are missing, its iterations do not settle and the package refuses. "
            f"Then the error after {table.words('seconds', 'g')} at {table.words('rate', 'g')}, "
            f"root mean square of {table.runs} runs, if every increment has noise. As published, "
            f"for windows of {experiments.WINDOWS[0]} to {experiments.WINDOWS[-1]} increments on a "
            "cone of "
            f"{np.degrees(experiments.WIDE_BRACKET.half_angle):g}°: with many samples a round the "
            "wider window errs less, below some five it does not; the widest is down to rounding, "
            "magnified; noise hides what the wider windows gain, and the widest magnifies it. "
            "`two-step-4` is reconstructed."
        ),
    ),
    FigureDefinition(
        "07-short-word",
        experiments.short_word_errors,
        short_word.draw,
        lambda table: (
            "Arithmetic in 32 bits: error of the attitude after "
            f"{table.steps} steps, its length divided out, by the angle of a step. "
            "Where each product is rounded, 1 - λ0 errs several times less than the two updates "
            "with λ0 as soon as λ0 differs from 1 in the word, right of the dotted line. A "
            f"compensated sum errs least. Root mean square of {table.starts} attitudes. Steps up "
            "to 0.01 rad, of the reconstructed algorithm; the update with 1 - λ0 is our reading of "
            "the paper's advice."
        ),
        kept=True,
    ),
)

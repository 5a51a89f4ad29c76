"""The published figures of chapter 18, with their captions."""

import numpy as np

from driftlab.book.machinery.figure.publish import FigureDefinition

from .. import experiments
from . import functional_iteration, rod, short_word, start

FIGURES = (
    FigureDefinition(
        "18-rod",
        experiments.rod_round_the_sphere,
        rod.draw,
        lambda table: (
            f"A rod is led from the East along the horizon, {table.words('along', 'g')} round, up "
            "to the zenith and straight back. It never turns about itself on the way; the strokes "
            "are a mark on it. At the end the mark (thick, as at the start) has turned by the "
            "solid angle inside the way."
        ),
    ),
    FigureDefinition(
        "18-functional-iteration",
        experiments.window_errors,
        functional_iteration.draw,
        lambda table: (
            "Functional iteration with windows of several widths, beside algorithms with cross "
            f"products, on a cone of {table.words('half_angle', 'g')} at "
            f"{table.words('frequency', 'g')}. First the drift, by samples a round: where a "
            "window's points are missing, its iterations do not settle and the package refuses. "
            f"Then the error after {table.words('seconds', 'g')} at {table.words('rate', 'g')}, "
            f"root mean square of {table.runs} runs, if every increment has noise. Defaults: "
            f"windows of {experiments.WINDOWS[0]} to {experiments.WINDOWS[-1]} increments, a cone "
            f"of {np.degrees(experiments.WIDE_BRACKET.half_angle):g}°. With many samples a round "
            "the wider window errs less, below some five it does not. The widest is down to "
            "rounding, magnified. Noise hides the gain of the wider windows, and the widest "
            "magnifies it. `two-step-4` is reconstructed."
        ),
    ),
    FigureDefinition(
        "18-first-steps",
        experiments.first_steps,
        start.draw,
        lambda table: (
            "Error of the attitude after each of the first steps of `memory-4` on the ship, with "
            f"the gyros read at {table.words('rate', 'g')}, started in three ways. With a past of "
            "zeros the second step compensates the first; steps without a correction leave an "
            "error that remains."
        ),
    ),
    FigureDefinition(
        "18-short-word",
        experiments.short_word_errors,
        short_word.draw,
        lambda table: (
            "Arithmetic in 32 bits: error of the attitude after "
            f"{table.steps} steps, its length divided out, by the angle of a step. "
            "Where each product is rounded and λ0 differs from 1 in the word, right of the dotted "
            "line, 1 - λ0 errs less than the two updates with λ0: several times at short steps, "
            "hardly at the longest but for the narrow cone. A "
            f"compensated sum errs least. Root mean square of {table.starts} attitudes. Steps up "
            "to 0.01 rad, of the reconstructed algorithm; the update with 1 - λ0 is our reading of "
            "the paper's advice."
        ),
        kept=True,
    ),
)

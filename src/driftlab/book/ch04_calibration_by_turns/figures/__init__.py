"""The published figures of chapter 04, with their captions."""

import numpy as np

from driftlab.book.machinery.publish import FigureDefinition
from driftlab.book.scenarios import LARIN_TRIAD
from driftlab.drift.turn_calibration import TurnExperiment

from .. import experiments
from . import larin_digits, turn_bias, turn_estimates, weighing_designs

FIGURES = (
    FigureDefinition(
        "04-turn-bias",
        lambda: experiments.turn_bias(LARIN_TRIAD),
        turn_bias.draw,
        turn_bias.columns,
        lambda data: (
            "Size of the error of sigma2 of Larin's triad. With many steps what remains is the "
            f"bias of the method itself, {data.bias:.1e}; a dip on the way is where the error of "
            "the integrator has the opposite sign and cancels it. More turns lower the noise only "
            f"({data.runs} runs for each dot)."
        ),
    ),
    FigureDefinition(
        "04-turn-estimates",
        lambda: experiments.turn_estimates(
            LARIN_TRIAD,
            experiment=TurnExperiment(step_formula="taylor-4", angle_noise=experiments.ANGLE_NOISE),
        ),
        turn_estimates.TurnEstimatesPicture.draw,
        turn_estimates.columns,
        lambda data: (
            f"Larin's triad calibrated {len(data.runs)} times by one turn about each of three "
            "axes, with gyro noise of "
            f"{3600 * np.degrees(experiments.ANGLE_NOISE):.1f} arc seconds "
            "a turn. On the left the runs can hardly be told apart; on the right their errors can."
        ),
    ),
    FigureDefinition(
        "04-larin-digits",
        experiments.larin_digits,
        larin_digits.draw,
        larin_digits.columns,
        lambda data: (
            f"Of {data.agrees[..., 0].size} candidates (reading of the triad, step formula, number "
            f"of steps), {data.winners} give all seven printed numbers, digit for digit. For each, "
            "the most favourable forming of sigma4* and the more favourable of rounding and "
            "cutting off is shown."
        ),
    ),
    FigureDefinition(
        "04-weighing-designs",
        experiments.weighing_designs,
        weighing_designs.draw,
        weighing_designs.columns,
        lambda data: (
            f"Monte Carlo of {data.runs} runs; the bars are 95 % intervals, the strokes "
            "closed forms. Without an offset least squares is best; with one, only the estimate "
            "that solves for the offset is unharmed."
        ),
    ),
)

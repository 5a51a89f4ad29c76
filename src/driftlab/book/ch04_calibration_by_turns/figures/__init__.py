"""The published figures of chapter 04, with their captions."""

import numpy as np

from driftlab.book.machinery.publish import FigureDefinition
from driftlab.book.scenarios import LARIN_TRIAD
from driftlab.drift.turn_calibration import TurnExperiment

from .. import experiments
from . import free_numbers, larin_digits, real_table, turn_bias, turn_estimates, weighing_designs

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
            f"A row is a reading of the triad and a step formula; {data.winners} of "
            f"{data.agrees[..., 0].size} marks in all seven columns. This is less than seven "
            "confirmations: sigma1* chose the step formula and sigma4* the factor (open circles), "
            "and the last three numbers are sums of the first four. Below each column stands how "
            f"many of all {data.candidates} candidates give the number. Shown is the most "
            "favourable factor, and the more favourable of rounding and cutting off."
        ),
    ),
    FigureDefinition(
        "04-larin-free-numbers",
        experiments.free_numbers,
        free_numbers.draw,
        free_numbers.columns,
        lambda data: (
            "Two numbers left free: the angle error of the integrator in a hundredth of a turn and "
            "the factor in sigma4*. Filled is where a number comes out, rounded or cut off; dots "
            f"are {len(data.formulas)} step formulas with three factors each. With an axis of "
            "unit length the digits of sigma1* pin the error, those of sigma4* and sigma1** "
            "pin the factor; the other four come out everywhere here and say nothing about either. "
            "With the other readings of the triad sigma2* and sigma3* come out nowhere."
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
    FigureDefinition(
        "04-real-table",
        experiments.real_table,
        real_table.draw,
        real_table.columns,
        lambda data: (
            "Turns on the Earth, with all errors of a real table. Lines: the budget to first "
            f"order; marks: simulations of {data.runs} calibrations with 95 % intervals. In one "
            "sense the Earth covers everything else; both senses leave the scale factor, and a "
            "common offset solved for leaves the gyro bias. Both together leave "
            f"{3600 * np.degrees(data.budget.total[-1]):.1f} arc seconds at "
            f"{np.degrees(experiments.RealTable().rate):g} deg/s. On the right a row is a source; "
            f"a mark that is not there is below {real_table.LOWEST:g} arc seconds."
        ),
    ),
)

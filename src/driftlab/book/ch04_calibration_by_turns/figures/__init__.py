"""The published figures of chapter 04, with their captions."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.publish import FigureDefinition

from .. import experiments
from ..experiment_numbers import NAMES, TRIADS
from . import free_numbers, larin_digits, turn_bias, turn_estimates, weighing_designs


def _free_caption(data: DataTable) -> str:
    extent = dict(zip(NAMES, data.extent[TRIADS.index("unit third axis")], strict=True))
    others = [data.extent[i] for i, triad in enumerate(TRIADS) if triad != "unit third axis"]
    nowhere = [name for i, name in enumerate(NAMES) if all(each[i] == "nowhere" for each in others)]
    pinned, everywhere = (
        listed([name for name, where in extent.items() if where == kind])
        for kind in ("in part", "everywhere")
    )
    return (
        "Two numbers left free: the angle error of the integrator in a hundredth of a turn and "
        "the factor in sigma4*. Filled is where a number comes out, rounded or cut off; dots "
        f"are {data.formulas} step formulas with three factors each. With an axis of unit "
        f"length the digits of {pinned} pin the error or the factor; {everywhere} come out "
        "everywhere here and say nothing about either. With both other readings of the triad "
        f"{listed(nowhere)} come out nowhere."
    )


def listed(names: list[str]) -> str:
    """Names as a sentence has them; "none" if there are none."""
    return " and ".join(filter(None, [", ".join(names[:-1]), *names[-1:]])) or "none"


FIGURES = (
    FigureDefinition(
        "04-turn-bias",
        experiments.turn_bias,
        turn_bias.draw,
        lambda data: (
            "Size of the error of sigma2, for a misaligned triad (default: Larin's). With many "
            f"steps only the bias of the method remains, {data.bias:.1e}; at a dip on the way the "
            "error of the integrator has the opposite sign and cancels it. More turns lower only "
            f"the noise ({data.runs} runs per dot)."
        ),
    ),
    FigureDefinition(
        "04-turn-estimates",
        experiments.turn_estimates,
        turn_estimates.TurnEstimatesPicture.draw,
        lambda data: (
            f"A misaligned triad (default: Larin's), calibrated {len(data.runs)} times by turns "
            f"about each of {len(data.axes)} axes, with gyro noise of "
            f"{3600 * np.degrees(data.angle_noise):.1f} arc seconds per turn. On the left the "
            "three sigmas by formula (3.3). On the right all nine numbers of the error matrix by "
            "the summed increments of turns in both directions, with their standard deviations: "
            "three scale factors s, three sigmas, and the rotation κ of the triad as a whole."
        ),
    ),
    FigureDefinition(
        "04-larin-digits",
        experiments.larin_digits,
        larin_digits.draw,
        lambda data: (
            f"A row is a reading of the triad and a step formula; {data.winners} of "
            f"{data.agrees[:, 0].size} marks in all seven columns. This is less than seven "
            "confirmations: sigma1* chose the step formula and sigma4* the factor (open circles), "
            "and the last three numbers are sums of the first four. Below each column stands how "
            f"many of all {data.candidates} candidates give the number. Shown is the most "
            "favourable factor, and the more favourable of rounding and cutting off."
        ),
    ),
    FigureDefinition(
        "04-larin-free-numbers", experiments.free_numbers, free_numbers.draw, _free_caption
    ),
    FigureDefinition(
        "04-weighing-designs",
        experiments.weighing_designs,
        weighing_designs.draw,
        lambda data: (
            f"Monte Carlo of {data.runs} runs; the bars are 95 % intervals, the strokes "
            "closed forms. Without an offset least squares is best; with one, only the estimate "
            "that solves for the offset is unharmed."
        ),
    ),
)

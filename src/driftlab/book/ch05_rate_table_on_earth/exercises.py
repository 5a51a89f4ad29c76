"""Exercises of chapter 05: a real rate table on a turning Earth."""

import numpy as np
from scipy.constants import arcsecond, degree

from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.machinery.exercise.given_numbers import GivenNumbers
from driftlab.checks import FloatArray
from driftlab.drift.turn_calibration import earth_rate_offset
from driftlab.drift.weighing_designs import PAIR_AXES, fit_turns
from driftlab.earth import EARTH_RATE

EDGES = np.array([[1.0, 1, 0], [1, -1, 0], [1, 0, 1], [1, 0, -1], [0, 1, 1], [0, 1, -1]])
BODY_AND_PAIRS = np.vstack([PAIR_AXES, np.eye(3)])
WHOLE_TURNS = 2
"""Of exercise 5.1."""


def _earth_alone(latitude: float, table_rate: float) -> float:
    """Estimate of a triad without error, in arc seconds, from degrees and degrees a second."""
    return float(earth_rate_offset(latitude * degree, table_rate * degree)) / arcsecond


def _other_part(latitude: float, table_rate: float, share: float | None = None) -> float:
    """The same with the Earth's level rate, or a share of its rate, taken as positive."""
    told = np.cos(latitude * degree) if share is None else share
    return float(EARTH_RATE * told / abs(table_rate * degree)) / arcsecond


def _southern_table(rng: np.random.Generator) -> dict[str, float]:
    # South and clockwise, as what is said of the mistakes has it.
    latitude, table_rate = rng.integers(315, 400) / 10, rng.choice([8.0, 12.0, 15.0, 25.0])
    return {"latitude": -float(latitude), "table_rate": -float(table_rate)}


def _twelve_turns(*, scale_factor: str = "each", senses: int = 2) -> list[float]:
    """Mean variance of the sigmas by both plans of exercise 5.3."""
    variances = []
    for axes in (EDGES, BODY_AND_PAIRS):
        rates = np.repeat([1.0, -1.0][:senses], len(axes))
        turns = np.tile(axes, (senses, 1))
        fit = fit_turns(
            np.zeros(len(turns)), turns, scale_factor, table_rates=rates, gyro_bias=senses == 2
        )
        variances.append(float(np.diag(fit.covariance)[:3].mean()))
    return variances


def _nine(*variances: float, turns: int = 9) -> FloatArray:
    return np.array([turns, *variances])


EXERCISES: dict[str, Exercise] = {
    "5.1": Value(
        kind="predict",
        unit="arc seconds",
        given=GivenNumbers(
            book={"latitude": -33.9, "table_rate": -20.0},
            draw=_southern_table,
            units={"latitude": "degrees", "table_rate": "degrees a second"},
        ),
        right=_earth_alone,
        accuracy=0.01,
        mistakes={
            "The sign. In the South the Earth turns clockwise, seen from above, and so does the "
            "table: the Earth adds to the turn.": lambda **table: -_earth_alone(**table),
            "That is with the level part of the Earth's rate, the cosine of the latitude. It goes "
            "round and sums to zero; the part along the table's axis counts.": _other_part,
            "Two slips: that is with the level part of the Earth's rate, the cosine of the "
            "latitude, and with the other sign. Which part adds up, and which way does the table "
            "turn?": lambda **table: -_other_part(**table),
            "That is the whole rate of the Earth. Only its part along the table's axis adds up.": (
                lambda **table: _other_part(**table, share=1.0)
            ),
            "That is the angle by which the Earth turns about the table's axis meanwhile. (3.3) "
            "divides it by the angle of the turns.": (
                lambda **table: 2 * np.pi * WHOLE_TURNS * _earth_alone(**table)
            ),
            "By that angle the Earth turns about the table's axis in one of the two turns. (3.3) "
            "divides by the angle of the turns, and is a plain number before it is one of arc "
            "seconds.": lambda **table: 2 * np.pi * _earth_alone(**table),
            "Two turns take twice the time, and (3.3) divides by twice the number: the number of "
            "turns does not matter.": lambda **table: WHOLE_TURNS * _earth_alone(**table),
        },
        remark="The same for every axis in the body, and reversed for the other direction.",
    ),
    "5.2": Choice(
        kind="explain",
        right="abd",
        wrong={
            "c": "has only the part of the bias along the axis. The rest of it turns with the "
            "body and comes back to zero after a whole turn.",
            "e": "forgets that the triad error adds up at the same pace: the angle of the bias "
            "grows with the time, and so does what it is divided by.",
            "f": "takes two different things for one. The bias of the method is quadratic in M, "
            "and the same in both directions.",
        },
        remark="The Earth's rate goes the way of the bias. So turn both ways, as fast as the table "
        "and the gyros bear.",
    ),
    "5.3": Value(
        kind="compute",
        right=lambda: _nine(*_twelve_turns()),
        absolute=5e-3,
        mistakes={
            "Six axes are needed for sigmas and scale factors, but in one direction each they say "
            "nothing of the biases apart. Count all unknowns.": (
                lambda: _nine(*_twelve_turns(), turns=6)
            ),
            "Eight were enough in the text, where the three gyros shared one scale factor. Count "
            "the unknowns anew.": lambda: _nine(*_twelve_turns(), turns=8),
            "Twelve turns do determine the nine, but fewer do: three axes turned both ways tell "
            "the biases.": lambda: _nine(*_twelve_turns(), turns=12),
            "The Earth's rate is known here, so it is no tenth unknown.": (
                lambda: _nine(*_twelve_turns(), turns=10)
            ),
            "These variances belong to one direction only. Each axis is turned twice.": (
                lambda: _nine(*_twelve_turns(senses=1))
            ),
            'These variances are without unknown scale factors: use `scale_factor="each"`.': (
                lambda: _nine(*_twelve_turns(scale_factor="none"))
            ),
            "That is for one common scale factor; each gyro has its own here.": (
                lambda: _nine(*_twelve_turns(scale_factor="common"))
            ),
            "The two plans do not weigh alike. About the pair axes a scale factor looks like a "
            "sigma until the turns about the body axes take it off, and these have noise.": (
                lambda: _nine(*2 * _twelve_turns()[:1])
            ),
            "These are standard deviations.": lambda: _nine(*np.sqrt(_twelve_turns())),
            "The two plans are exchanged.": lambda: _nine(*_twelve_turns()[::-1]),
        },
        remark="About the edges the scale factors drop out of the difference of two estimates. "
        "About the body axes they have to be taken off, with the noise of two more turns.",
    ),
}

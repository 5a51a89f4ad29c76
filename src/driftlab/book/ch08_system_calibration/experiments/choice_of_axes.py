"""Which choice of body axes leaves out least? Five choices, two schemes, units bent more and more.

What a filter leaves out shows in its squared normalised errors: they are larger than they should
be. A pass more over the same record, linearised about what the first has found, takes it away.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.constants import arcsecond

from driftlab.body_frames import BODY_FRAMES
from driftlab.checks import FloatArray, positive_number, whole_number
from driftlab.monte_carlo import sweep
from driftlab.motion.scheme import SCHEMES

from .consistency import QUICK_TRIAL, quick_trial
from .verdicts import Verdict, verdict

SIZES = (40, 100, 200, 400)
"""Spreads of the installation errors, arc seconds."""
UNITS = 300
"""Units in each case: the same ones, with the same noise, for each choice of axes. Twice as many
where there is most to see, after one pass over units that are bent most."""
BATCH = 50
"""Units calibrated at once; the first batch is the same however many follow."""
SEED = 2018


class Case(NamedTuple):
    """One set-up of the study."""

    scheme: str  # one of `driftlab.motion.scheme.SCHEMES`, here with short pauses
    size: float  # spread of the installation errors, arc seconds
    frame: str  # choice of body axes
    passes: int  # over the record


def cases(sizes: Sequence[float] = SIZES) -> tuple[Case, ...]:
    """All that is compared. Twice over the record go only the units that are bent most."""
    return tuple(
        Case(scheme, size, frame, passes)
        for passes, some in ((1, sizes), (2, sizes[-1:]))
        for scheme in SCHEMES
        for size in some
        for frame in BODY_FRAMES
    )


CASES = cases()
"""All that the published study compares."""


class ChoiceOfAxes(NamedTuple):
    """Squared errors of the 27 states at the end, normalised; 1 is what they should be."""

    squares: Mapping[Case, FloatArray]  # (units,) or (2 units,) each

    @property
    def sizes(self) -> tuple[float, ...]:
        """Spreads of the installation errors, arc seconds, ascending."""
        return tuple(dict.fromkeys(case.size for case in self.squares))

    def compared(self, scheme: str, size: float, rival: str, passes: int = 1) -> Verdict:
        """How often averaged axes err less than a rival choice, unit by unit; see `Case`."""
        averaged = self.squares[Case(scheme, size, BODY_FRAMES[0], passes)]
        return verdict(averaged / self.squares[Case(scheme, size, rival, passes)])

    def excess(self, scheme: str, size: float, rival: str) -> tuple[float, float]:
        """By how much the mean is larger in averaged axes, and the standard error of that.

        After one pass; the units are paired.
        """
        averaged, other = (
            self.squares[Case(scheme, size, frame, 1)] for frame in (BODY_FRAMES[0], rival)
        )
        more = averaged - other
        return float(more.mean()), float(more.std(ddof=1) / np.sqrt(more.size))


def choice_of_axes(
    units: int = UNITS,
    sizes: Sequence[float] = tuple((arcsecond * np.array(SIZES)).tolist()),
    dwell: float = QUICK_TRIAL.scheme.dwell,
    seed: int = SEED,
) -> ChoiceOfAxes:
    """Run the whole study: some four minutes.

    `sizes` are in rad. Where there is most to see there are twice as many units.
    """
    units = whole_number(units, "units", least=2)
    bent = [round(positive_number(size, "sizes") / arcsecond, 6) for size in sorted(sizes)]
    most = (bent[-1], 1)
    return ChoiceOfAxes({
        case: normalised_errors(
            case, units * (2 if (case.size, case.passes) == most else 1), dwell, seed
        )
        for case in cases(bent)
    })  # fmt: skip


def normalised_errors(
    case: Case, units: int, dwell: float = QUICK_TRIAL.scheme.dwell, seed: int = SEED
) -> FloatArray:
    """Mean squared normalised error of the states of random units after calibration, (units,)."""
    table = quick_trial(case.scheme, case.size, dwell)
    trial = replace(table, frame=case.frame, passes=case.passes)
    found = sweep(trial.run, units, seed=seed, batch=BATCH)
    size = found[0].calibration.model.size
    return np.concatenate([batch.nees[:, -1] for batch in found]) / size

"""Which choice of body axes leaves out least? Five choices, two schemes, units bent more and more.

What a filter leaves out shows in its squared normalised errors: they are larger than they should
be. A pass more over the same record, linearised about what the first has found, takes it away.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.constants import arcsecond

from driftlab.body_frames import BODY_FRAMES
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, positive_number, whole_number
from driftlab.monte_carlo import run_batches
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
PASSES = {1: "one pass", 2: "two passes"}
MORE = ", more units"
"""End of a column's name with the second half of twice as many units."""


class Case(NamedTuple):
    """One set-up of the study."""

    scheme: str  # one of `driftlab.motion.scheme.SCHEMES`, here with short pauses
    size: float  # spread of the installation errors, arc seconds
    frame: str  # choice of body axes
    passes: int  # over the record

    def __str__(self) -> str:
        """Words for a column of its units."""
        return f"{self.scheme}, {self.size:g} arc seconds, {self.frame}, {PASSES[self.passes]}"


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


def choice_of_axes(
    units: int = UNITS,
    sizes: Sequence[float] = tuple((arcsecond * np.array(SIZES)).tolist()),
    dwell: float = QUICK_TRIAL.scheme.dwell,
    seed: int = SEED,
) -> DataTable:
    """Run the whole study: some four minutes.

    `sizes` are in rad. Where there is most to see there are twice as many units.
    """
    units = whole_number(units, "units", least=2)
    bent = [round(positive_number(size, "sizes") / arcsecond, 6) for size in sorted(sizes)]
    most = (bent[-1], 1)
    squares = {
        case: normalised_errors(
            case, units * (2 if (case.size, case.passes) == most else 1), dwell, seed
        )
        for case in cases(bent)
    }
    means = np.array([values.mean() for values in squares.values()])
    errors = [values.std(ddof=1) / np.sqrt(len(values)) for values in squares.values()]
    rivals = [(s, p, rival) for p in PASSES for s in SCHEMES for rival in BODY_FRAMES[1:]]
    parts = []
    for scheme, passes, rival in rivals:
        pair = (Case(scheme, bent[-1], frame, passes) for frame in (BODY_FRAMES[0], rival))
        parts.append(verdict(np.divide(*map(squares.__getitem__, pair))).part)
    part, low, high = np.transpose(parts)
    return DataTable(
        {
            "squares": (
                {
                    str(case) + i * MORE: half
                    for case, values in squares.items()
                    for i, half in enumerate(values.reshape(-1, units))
                },
                "", "squared errors of the 27 states at the end, normalised, of each unit", (), 6,
            ),
            "mean_of": ([f"{case.scheme}; {PASSES[case.passes]}" for case in squares], "",
                "scheme and passes"),
            "axes": ([case.frame for case in squares], "", "body axes"),
            # Choices of axes are drawn side by side, or they would hide each other.
            "drawn_at": (arcsecond * np.array([
                case.size * 1.04 ** (BODY_FRAMES.index(case.frame) - 2) for case in squares
            ]), "arcsec", "spread of the installation errors, or close to it"),
            "mean": (means, "", "of the units; 1 is what it should be"),
            "mean_low": (means - errors, "", "mean less its standard error"),
            "mean_high": (means + errors, "", "mean plus its standard error"),
            "part_of": ([f"{scheme}; {PASSES[passes]}" for scheme, passes, _ in rivals], "",
                "scheme and passes"),
            "rival": ([rival for *_, rival in rivals], "", "body axes"),
            "part": (part, "", "of the units bent most in which averaged axes err less"),
            "part_low": (low, "", "95 % interval"),
            "part_high": (high, "", "likewise"),
        },
        {"sizes": (bent, "", "spreads of the installation errors, arc seconds")},
    )  # fmt: skip


def squares_of(study: DataTable, case: Case) -> FloatArray:
    """Return the squared normalised errors of a case, (units,) or (2 units,)."""
    halves = [str(case), f"{case}{MORE}"]
    return np.concatenate([study.squares[half] for half in halves if half in study.squares])


def compared(study: DataTable, scheme: str, size: float, rival: str, passes: int = 1) -> Verdict:
    """How often averaged axes err less than a rival choice, unit by unit; see `Case`."""
    cases = (Case(scheme, size, frame, passes) for frame in (BODY_FRAMES[0], rival))
    return verdict(np.divide(*(squares_of(study, case) for case in cases)))


def excess(study: DataTable, scheme: str, size: float, rival: str) -> tuple[float, float]:
    """By how much the mean is larger in averaged axes, and the standard error of that.

    After one pass; the units are paired.
    """
    cases = (Case(scheme, size, frame, 1) for frame in (BODY_FRAMES[0], rival))
    more = np.subtract(*(squares_of(study, case) for case in cases))
    return float(more.mean()), float(more.std(ddof=1) / np.sqrt(more.size))


def normalised_errors(
    case: Case, units: int, dwell: float = QUICK_TRIAL.scheme.dwell, seed: int = SEED
) -> FloatArray:
    """Mean squared normalised error of the states of random units after calibration, (units,)."""
    table = quick_trial(case.scheme, case.size, dwell)
    trial = replace(table, frame=case.frame, passes=case.passes)
    found = run_batches(trial.run, units, seed=seed, batch_size=BATCH)
    size = found[0].calibration.model.size
    return np.concatenate([batch.nees[:, -1] for batch in found]) / size

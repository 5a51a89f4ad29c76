"""Do averaged axes deviate less in place? The claim after Wu Figs. 3-5, over many units.

The copy says neither which scheme calibrated the paper's unit, nor which triangle was the usual
method's, nor with which attitude each computer began; so all of them are tried.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import product
from typing import NamedTuple

import numpy as np
from scipy.constants import arcsecond

from driftlab.body_frames import GYRO_FRAMES
from driftlab.book.ch11_kalman_calibration.experiments import QUICK_TRIAL, quick_trial
from driftlab.book.ch11_kalman_calibration.experiments.starts import (
    ALL_STARTS,
    TABLE_ATTITUDE,
    one_attitude,
    own_axes,
    self_aligned,
)
from driftlab.book.ch11_kalman_calibration.experiments.verdicts import Verdict, verdict
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration import navigate_static
from driftlab.calibration.simulation import Trial
from driftlab.checks import FloatArray, positive_number
from driftlab.imu import ImuErrors
from driftlab.monte_carlo import run_batches
from driftlab.motion.scheme import SCHEMES

from .at_rest import REST_DURATION

AT_REST_SIZES = (40, 400)
"""Spreads of the installation errors of the units at rest, arc seconds."""
AVERAGED, *TRIANGLES = GYRO_FRAMES
"""The paper's choice of body axes, and the two that its usual method may have meant."""
QUANTITIES = ("attitude", "velocity", "position")
UNITS = 200
"""Units of each size: the same ones, with the same noise, for each choice of axes."""
SEED = 345


class Comparison(NamedTuple):
    """One comparison of the averaged axes with a rival."""

    scheme: str  # one of `driftlab.motion.scheme.SCHEMES`, here with short pauses
    size: float  # spread of the installation errors, arc seconds
    rival: str  # choice of body axes, one of `TRIANGLES`
    start: str  # one of `ALL_STARTS`
    quantity: str  # one of `QUANTITIES`

    def __str__(self) -> str:
        """Words for a column of its units."""
        where = f"{self.scheme}, {self.size:g} arc seconds, {self.rival}"
        return f"{where}, start from {self.start}, {self.quantity}"


def error_ratios_at_rest(
    units: int = UNITS,
    sizes: Sequence[float] = tuple((arcsecond * np.array(AT_REST_SIZES)).tolist()),
    duration: float = REST_DURATION,
    dwell: float = QUICK_TRIAL.scheme.dwell,
    seed: int = SEED,
) -> DataTable:
    """Calibrate random units on both schemes, and let them navigate: about a minute.

    `sizes` are in rad, and the duration is at least 300 s.
    """
    bent = [round(positive_number(size, "sizes") / arcsecond, 6) for size in sorted(sizes)]
    ratios: dict[Comparison, FloatArray] = {}
    for scheme in SCHEMES:
        for size in bent:
            ratios |= error_ratios(
                scheme, size, units=units, duration=duration, dwell=dwell, seed=seed
            )
    part, low, high = np.transpose([verdict(values).part for values in ratios.values()])
    return DataTable(
        {
            "ratio": (
                {str(key): values for key, values in ratios.items()}, "",
                "error with averaged axes over that with a rival's, of each unit", (), 7,
            ),
            "at_rest_for": (np.array([duration]), "h", "of navigating"),
            "case": ([f"{key.scheme}; {key.rival}; {key.size:g}″" for key in ratios], "",
                "scheme, rival and spread"),
            "start": ([key.start for key in ratios], "", "of the navigation"),
            "quantity": ([key.quantity for key in ratios], "", "that is compared"),
            "part": (part, "", "of the units in which averaged axes err less"),
            "part_low": (low, "", "95 % interval"),
            "part_high": (high, "", "likewise"),
        },
        {
            "sizes": (bent, "", "spreads of the installation errors, arc seconds"),
            # Bonferroni, 5 % for all together
            "certain": (0.05 / len(ratios), "", "chance below which one comparison counts"),
        },
    )  # fmt: skip


def comparisons(study: DataTable) -> dict[Comparison, Verdict]:
    """How often averaged axes err less, unit by unit, in every comparison."""
    keys = product(SCHEMES, study.sizes, TRIANGLES, ALL_STARTS, QUANTITIES)
    return {key: verdict(study.ratio[str(key)]) for key in (Comparison(*each) for each in keys)}


def error_ratios(
    scheme: str,
    size: float,
    rivals: Sequence[str] = tuple(TRIANGLES),
    units: int = UNITS,
    duration: float = REST_DURATION,
    dwell: float = QUICK_TRIAL.scheme.dwell,
    seed: int = SEED,
) -> dict[Comparison, FloatArray]:
    """Compare averaged axes with rivals on the same data, from all starts and in all quantities.

    Each ratio (units,) is the root mean square error with averaged axes over that with the rival's.
    `size` is in arc seconds.
    """
    table = quick_trial(scheme, size, dwell)
    averaged, *others = (
        run_batches(replace(table, frame=frame).run, units, seed=seed, batch_size=units)[0]
        for frame in (AVERAGED, *rivals)
    )
    known = averaged.calibration.imu_errors
    errors = _errors(averaged, known, AVERAGED, duration)
    ratios = {}
    for rival, trial in zip(rivals, others, strict=True):
        for key, theirs in _errors(trial, known, rival, duration).items():
            ratios[Comparison(scheme, size, rival, *key)] = errors[key] / theirs
    return ratios


def _errors(
    trial: Trial, known: ImuErrors, frame: str, duration: float
) -> dict[tuple[str, str], FloatArray]:
    """Root mean square errors (units,) at rest, by start and quantity.

    `known` are the errors that the calibration in averaged axes found.
    """
    true, found = trial.imu_errors, trial.calibration.imu_errors
    one = one_attitude(true, known, frame)
    own = own_axes(true, frame)
    table_axes = np.broadcast_to(TABLE_ATTITUDE, own.shape)
    begins = (one, self_aligned(true, found), own, table_axes)
    references = (one, own, own, table_axes)
    errors = {}
    for start, begin, axes in zip(ALL_STARTS, begins, references, strict=True):
        run = navigate_static(
            true, found, TABLE_ATTITUDE, start=begin, reference=axes,
            latitude=TABLE_LATITUDE, duration=duration, interval=5.0, output_interval=300.0,
        )  # fmt: skip
        for quantity in QUANTITIES:
            squares = (getattr(run, quantity) ** 2).sum(axis=-1)
            errors[start, quantity] = np.sqrt(squares.mean(axis=-1))
    return errors

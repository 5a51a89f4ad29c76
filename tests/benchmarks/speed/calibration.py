"""Whole calibrations on a turntable: one, many in one batch, and many on two processes."""

from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor

import numpy as np

from driftlab.calibration import TableTrial
from driftlab.calibration.trial import Trial
from driftlab.monte_carlo import sweep

from .measuring import Contender, Row, Target

BATCH = 64
_SPREAD = "off from one, of the mean squared error in units of the filter's covariance"


def rows() -> Iterator[Row]:
    trial = TableTrial()
    alone = f"{BATCH} alone, from one of them"
    yield Row(
        "calibration",
        f"{BATCH} calibrations of 27 states in one batch",
        Contender("driftlab, one batch", lambda: trial.run(1, BATCH), inconsistency),
        [],
        [Contender(alone, lambda: trial.run(1), None, 1 / BATCH)],
        [Target(0.25, alone)],
        error_in=_SPREAD,
    )
    yield Row(
        "calibration",
        "one calibration of 27 states",
        Contender("driftlab", lambda: trial.run(1)),
        left_out=["No peer calibrates on a turntable with a filter."],
    )
    yield Row(
        "calibration",
        "50 calibrations on two processes, which start, in batches of 25",
        Contender("driftlab", lambda: _on_two_processes(trial)),
    )


def inconsistency(found: Trial) -> float:
    """How far the filter's errors are from what it says of them, on average over the batch."""
    return abs(float(np.mean(found.nees)) / found.calibration.model.size - 1)


def _on_two_processes(trial: TableTrial) -> object:
    with ProcessPoolExecutor(2) as pool:
        return sweep(trial.run, 50, seed=1, batch=25, executor=pool)

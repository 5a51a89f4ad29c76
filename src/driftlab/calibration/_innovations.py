"""Innovations and what they contradict: the arithmetic behind `consistency`."""

from __future__ import annotations

import numpy as np

from driftlab.checks import FloatArray

from .calibration_history import Calibration
from .consistency import InnovationTest

_KNOWN_NOISE = 1.25
"""No noise is known better; the squares may be so many times as large as their bound."""
SECOND_ORDER = 2.0
"""Square of the largest bend over the least stated deviation, from which on one pass is too few."""


def contradiction(test: InnovationTest) -> tuple[int, str] | None:
    """The run (its number) that the test finds worst, and a sentence on it; None if none is wrong.

    As noise is not known exactly, squares count from a quarter above their bound on.
    """
    squares = np.ravel(test.squares) / (_KNOWN_NOISE * test.upper)
    means = np.ravel(test.mean) / test.mean_upper
    worst = int(np.argmax(np.maximum(squares, means)))
    if squares[worst] > 1 and squares[worst] >= means[worst]:
        name, size, bound = "squared innovations (NIS / 3)", np.ravel(test.squares), test.upper
        low = test.lower
    elif means[worst] > 1:
        name, size, bound = "squared mean of the innovations", np.ravel(test.mean), test.mean_upper
        low = 0.0
    else:
        return None
    return worst, f"expected {name} from {low:.3g} to {bound:.3g}, got {size[worst]:.3g}"


def second_order(calibration: Calibration) -> float:
    """Square of the largest bend found over the least deviation stated of any, worst run."""
    model = calibration.model
    places = [
        index
        for index, name in enumerate(model.names)
        if " scale " in name or " installation " in name
    ]
    bends = np.abs(calibration.state[..., -1, places]).max(axis=-1)
    known = calibration.deviations[..., -1, places]
    least = np.where(known > 0, known, np.inf).min(axis=-1)
    return float(np.max(bends**2 / least))


def normalised_innovations(
    innovation: FloatArray, predicted: FloatArray, variance: float
) -> FloatArray:
    """Innovations (..., 3) with covariance I, so that the sum of their squares is the NIS.

    `predicted` (..., 3, 3) is the covariance of the velocity before the update, and `variance` that
    of the measurement.
    """
    root = np.linalg.cholesky(predicted + variance * np.eye(3))
    return np.linalg.solve(root, innovation[..., np.newaxis])[..., 0]

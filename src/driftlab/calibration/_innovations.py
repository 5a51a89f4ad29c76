"""Innovations and what they contradict: the arithmetic behind `consistency`."""

from __future__ import annotations

import numpy as np
from scipy.constants import arcsecond, degree, g, hour, micro

from driftlab.checks import FloatArray
from driftlab.imu import PriorDeviations

from .calibration_history import Calibration
from .consistency import InnovationTest

_KNOWN_NOISE = 1.25
"""No noise is known better; the squares may be so many times as large as their bound."""
SECOND_ORDER = 2.0
"""Square of the largest scale or installation error over the least stated deviation, from which on
one pass is too few."""
BEYOND = 6.0
"""Prior deviations that no error is expected to have: one of 10^7 right units has one of 21."""
_UNITS = {
    "gyro bias": (float(hour / degree), "deg/h"),
    "accelerometer bias": (1 / (micro * g), "µg"),
    "scale": (1e6, "ppm"),
    "installation": (float(1 / arcsecond), "arc seconds"),
    "non-orthogonality": (float(1 / arcsecond), "arc seconds"),
}


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
    """Square of the largest scale or installation error found over the least deviation stated of
    any, worst run."""
    model = calibration.model
    places = [
        index
        for index, name in enumerate(model.names)
        if " scale " in name or " installation " in name
    ]
    errors = np.abs(calibration.state[..., -1, places]).max(axis=-1)
    known = calibration.deviations[..., -1, places]
    least = np.where(known > 0, known, np.inf).min(axis=-1)
    return float(np.max(errors**2 / least))


def beyond_prior(
    calibration: Calibration, prior: PriorDeviations, start: FloatArray
) -> tuple[int, list[str]]:
    """The worst run (its number), and sentences on errors found in it that the prior does not
    allow, the largest of each kind."""
    model = calibration.model
    known = np.sqrt(np.diag(model.covariance(prior, start.reshape(-1, 4)[0])))
    found = calibration.state[..., -1, :].reshape(-1, model.size)
    ratios = np.divide(np.abs(found), known, out=np.zeros_like(found), where=known > 0)
    ratios[:, :6] = 0.0
    run = int(np.argmax(ratios.max(axis=-1)))
    places = np.flatnonzero(ratios[run] > BEYOND)
    worst: dict[str, str] = {}
    for place in places[np.argsort(-ratios[run, places], kind="stable")]:
        kind = model.names[place].rsplit(" ", 1)[0]
        size, unit = next(
            ((size, f" {unit}") for end, (size, unit) in _UNITS.items() if kind.endswith(end)),
            (1.0, " in SI units"),
        )
        worst.setdefault(
            kind,
            f"{model.names[place]}: found {size * found[run, place]:.3g}{unit} where the prior "
            f"says {size * known[place]:.3g}",
        )
    return run, list(worst.values())


def normalised_innovations(
    innovation: FloatArray, predicted: FloatArray, variance: float
) -> FloatArray:
    """Innovations (..., 3) with covariance I, so that the sum of their squares is the NIS.

    `predicted` (..., 3, 3) is the covariance of the velocity before the update, and `variance` that
    of the measurement.
    """
    root = np.linalg.cholesky(predicted + variance * np.eye(3))
    return np.linalg.solve(root, innovation[..., np.newaxis])[..., 0]

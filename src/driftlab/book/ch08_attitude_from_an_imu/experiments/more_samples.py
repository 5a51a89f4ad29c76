"""Three samples a step or four: it depends on how wide the cone is."""

from collections.abc import Sequence

import numpy as np

from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, positive_number

from .four_samples import COMPARED

HALF_ANGLES: FloatArray = np.radians(np.geomspace(0.5, 30.0, 121))
"""Half angles of the cones, rad."""


def three_against_four(samples_a_round: Sequence[float] = (5, 8, 12, 20)) -> DataTable:
    """Divide the drift of three samples a step by the drift of four, over the half angle."""
    gains = {}
    for each in samples_a_round:
        interval = 1 / positive_number(each, "samples_a_round")
        three, four = (
            np.abs(coning_drift(COMPARED[name], HALF_ANGLES, 1.0, interval))
            for name in ("rotation-vector-3", "four, spread")
        )
        gains[f"{each:g}"] = three / four
    return DataTable(
        {
            "half_angle": (HALF_ANGLES, "deg", "half angle of the cone"),
            "gain": (gains, "", "drift of three samples a step, divided by that of four, spread"),
        },
        {"samples": (tuple(gains), "", "samples a round")},
    )

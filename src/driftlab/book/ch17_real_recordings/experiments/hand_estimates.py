"""Scale-factor errors from turns by hand, each estimated in four ways."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable

from .hand_turns import STOP, hand_turns

ESTIMATES = ("Larin, whole turn", "Larin, cut as theirs", "Ferraris", "Larin, bias left in")
"""Ways to estimate, of which the first has a standard deviation."""


def hand_estimates(stop_standard_deviation: float = STOP) -> DataTable:
    """Estimates by `hand_turns` beside each other; the deviation is that of the whole turn."""
    hand = hand_turns(stop_standard_deviation)
    found = np.array([hand.estimate, hand.by_sections, hand.ferraris, hand.with_bias]).T
    reach = np.zeros_like(found)
    reach[:, 0] = hand.deviation
    turns = [f"turn about {axis}" for axis in "xyz"]
    apart = np.abs(found[:, 1] - found[:, 2]).max()
    return DataTable(
        {
            "way": (ESTIMATES, "", "to estimate"),
            "scale_error": (found, "1e-3", "scale-factor error", turns),
            "low": (found - reach, "1e-3", "one standard deviation less", turns),
            "high": (found + reach, "1e-3", "one standard deviation more", turns),
        },
        {
            "apart": (apart, "1e-3", "largest difference of Larin and Ferraris, one cut"),
            "moved": (np.abs(found[:, 0] - found[:, 1]).max(), "1e-3", "most by another cut"),
            "bias": (np.abs(found[:, 0] - found[:, 3]).max(), "1e-3", "most by the bias"),
            "stop_standard_deviation": (
                hand.stop_standard_deviation, "deg", "deviation of the final heading, assumed"
            ),
        },
    )  # fmt: skip

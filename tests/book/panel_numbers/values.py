"""The values of a panel's controls, and the rows beside its picture."""

from collections.abc import Mapping

import numpy as np

from driftlab.vectors import direction_from_angles

Values = Mapping[str, float | int | bool | str]
Rows = list[tuple[str, str]]
"""Names and what stands after them, in the order of the panel."""
ABSENT = "–"


def three_digits(value: float) -> str:
    """A number as panels write it: powers of ten below 1e-4 and from 1e5 on."""
    if value == 0:
        return "0"
    power = int(f"{value:.2e}".partition("e")[2])
    if power in range(-4, 5):
        rounded = np.round(value, 2 - power)
        return f"{rounded:.{max(2 - power, 0)}f}"
    raised = "".join("⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".index(digit)] for digit in str(power))
    return f"{value / 10.0**power:.2f}·10{raised}"


def angle(radians: float) -> str:
    """An angle in degrees, minutes or seconds, by its size; none below the rounding of a double."""
    if np.isnan(radians):
        return ABSENT
    if abs(radians) < 2.0**-52:
        return "0″"
    seconds = 3600 * np.degrees(radians)
    for unit, sign in ((3600, "°"), (60, "′")):
        if abs(seconds) >= unit:
            return three_digits(seconds / unit) + sign
    return three_digits(seconds) + "″"


def listed(values: Values, names: str) -> np.ndarray:
    return np.array([values[name] for name in names.split()], dtype=float)


def axis_of(values: Values) -> np.ndarray:
    return direction_from_angles(*np.radians(listed(values, "azimuth elevation")))

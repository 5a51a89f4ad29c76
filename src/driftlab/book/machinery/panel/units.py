"""How panels write numbers: signs for words, three digits or more, no powers of ten by e."""

import numpy as np
from scipy.constants import arcminute, arcsecond, degree

from .results import ABSENT

ROUNDING = float(np.finfo(float).eps)
"""An angle below, rad, is what a computer leaves of zero: a quaternion has no finer steps."""
SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def degrees_text(angle: float) -> str:
    """Return an angle, rad, in degrees; NaN is an angle that does not exist."""
    return ABSENT if np.isnan(angle) else f"{np.degrees(angle):.4f}°"


def number_text(value: float) -> str:
    """Return a number to three digits; a power of ten only for what is small or large indeed."""
    mantissa, exponent = f"{value:.2e}".split("e")
    power = int(exponent)
    if value == 0:
        return "0"
    if -5 < power < 5:
        return f"{float(f'{value:.2e}'):.{max(0, 2 - power)}f}"
    return f"{mantissa}·10{str(power).translate(SUPERSCRIPT)}"


def angle_text(angle: float) -> str:
    """Return an angle, rad, to three digits in degrees, minutes or seconds of arc."""
    if np.isnan(angle):
        return ABSENT
    if abs(angle) < ROUNDING:
        angle = 0.0
    unit, sign = next(
        ((unit, sign) for unit, sign in ((degree, "°"), (arcminute, "′")) if abs(angle) >= unit),
        (arcsecond, "″"),
    )
    return number_text(float(angle / unit)) + sign

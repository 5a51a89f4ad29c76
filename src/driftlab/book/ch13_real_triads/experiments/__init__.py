"""What chapter 13 makes of published recordings: numbers, not yet pictures."""

from .five_units import ODD, QUIET, WAY_NAMES, WAYS, FiveUnits, five_units
from .hand_turns import SOURCES, TURNS, HandTurns, hand_turns
from .publishers_numbers import BIAS_STEP, IMU_TK_COSTS, TRIANGLES, UNITS
from .two_calibrations import TwoCalibrations, two_calibrations

__all__ = [
    "BIAS_STEP",
    "IMU_TK_COSTS",
    "ODD",
    "QUIET",
    "SOURCES",
    "TRIANGLES",
    "TURNS",
    "UNITS",
    "WAYS",
    "WAY_NAMES",
    "FiveUnits",
    "HandTurns",
    "TwoCalibrations",
    "five_units",
    "hand_turns",
    "two_calibrations",
]

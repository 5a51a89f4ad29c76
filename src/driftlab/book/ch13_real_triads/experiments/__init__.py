"""What chapter 13 makes of published recordings: numbers, not yet pictures."""

from .five_units import ODD, PAUSE, QUIET, WAY_NAMES, WAYS, FiveUnits, five_units
from .hand_turns import SOURCES, STOP, TURNS, HandTurns, hand_turns
from .parked_car import (
    METHODS,
    ParkedCar,
    Spread,
    chance_of_paired_ratio,
    chance_of_ratio,
    parked_car,
    spread,
)
from .publishers_numbers import BIAS_STEP, IMU_TK_COSTS, TRIANGLES, UNITS
from .two_calibrations import TwoCalibrations, two_calibrations

__all__ = [
    "BIAS_STEP",
    "IMU_TK_COSTS",
    "METHODS",
    "ODD",
    "PAUSE",
    "QUIET",
    "SOURCES",
    "STOP",
    "TRIANGLES",
    "TURNS",
    "UNITS",
    "WAYS",
    "WAY_NAMES",
    "FiveUnits",
    "HandTurns",
    "ParkedCar",
    "Spread",
    "TwoCalibrations",
    "chance_of_paired_ratio",
    "chance_of_ratio",
    "five_units",
    "hand_turns",
    "parked_car",
    "spread",
    "two_calibrations",
]

"""What chapter 17 makes of published recordings: numbers, not yet pictures."""

from .five_units import (
    ODD as ODD,
    PAUSE as PAUSE,
    QUIET as QUIET,
    UNIT_NAMES as UNIT_NAMES,
    WAY_NAMES as WAY_NAMES,
    WAYS as WAYS,
    five_units as five_units,
)
from .hand_turns import (
    ESTIMATES as ESTIMATES,
    ROWS as ROWS,
    SOURCES as SOURCES,
    STOP as STOP,
    hand_estimates as hand_estimates,
    hand_turns as hand_turns,
)
from .parked_car import METHODS as METHODS, parked_car as parked_car, spread as spread
from .publishers_numbers import (
    BIAS_STEP as BIAS_STEP,
    IMU_TK_COSTS as IMU_TK_COSTS,
    TRIANGLES as TRIANGLES,
    UNITS as UNITS,
)
from .two_calibrations import two_calibrations as two_calibrations

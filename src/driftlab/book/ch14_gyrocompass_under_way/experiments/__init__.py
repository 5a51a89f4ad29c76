"""Experiments of chapter 14: a pendulum, and a ship's compass on voyages."""

from .pendulum import schuler_pendulum as schuler_pendulum
from .ship import ship_with_compass as ship_with_compass
from .voyages import (
    DAMPING as DAMPING,
    GYRO_BIAS as GYRO_BIAS,
    TERMS as TERMS,
    TUNING_FACTORS as TUNING_FACTORS,
    ballistic_errors as ballistic_errors,
    error_table as error_table,
    errors_under_way as errors_under_way,
    operating_formula as operating_formula,
    several_horizons as several_horizons,
)

"""Experiments of chapter 11: what a turntable shows, calibrations, and designed schemes."""

from .calibration import (
    PARAMETERS as PARAMETERS,
    QUICK_TRIAL as QUICK_TRIAL,
    calibration_errors as calibration_errors,
    calibration_history as calibration_history,
    quick_trial as quick_trial,
    state_unit as state_unit,
    typical_trial as typical_trial,
    unit_of as unit_of,
)
from .designed_schemes import (
    BEST as BEST,
    LOOSE as LOOSE,
    MEAN as MEAN,
    RANDOM as RANDOM,
    STANDING as STANDING,
    TASKS as TASKS,
    UNIT as UNIT,
    designed_schemes as designed_schemes,
    expected_covariance as expected_covariance,
    rows_of as rows_of,
    scheme_of as scheme_of,
)
from .error_growth import CAUSES as CAUSES, error_growth as error_growth
from .scheme_run import scheme_run as scheme_run
from .schemes import (
    DRAWN_ZERO as DRAWN_ZERO,
    SLOTS as SLOTS,
    TYPICAL_NOISE as TYPICAL_NOISE,
    VELOCITIES as VELOCITIES,
    short_name as short_name,
    states_on_a_table as states_on_a_table,
    table_observability as table_observability,
    up_in_body_axes as up_in_body_axes,
)
from .starts import ALL_STARTS as ALL_STARTS, STARTS as STARTS, self_aligned as self_aligned
from .verdicts import verdict as verdict

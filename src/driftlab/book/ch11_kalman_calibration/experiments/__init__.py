"""Experiments of chapter 11: what a turntable shows, calibrations, and what they are good for."""

from .at_rest import FRAMES as FRAMES, SHOWN as SHOWN, errors_at_rest as errors_at_rest
from .calibration import (
    PARAMETERS as PARAMETERS,
    calibration_errors as calibration_errors,
    calibration_history as calibration_history,
    state_unit as state_unit,
    typical_trial as typical_trial,
    unit_of as unit_of,
)
from .consistency import QUICK_TRIAL as QUICK_TRIAL, filter_consistency as filter_consistency
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
from .in_place_claim import (
    AT_REST_SIZES as AT_REST_SIZES,
    QUANTITIES as QUANTITIES,
    TRIANGLES as TRIANGLES,
    Comparison as Comparison,
    comparisons as comparisons,
    error_ratios as error_ratios,
    error_ratios_at_rest as error_ratios_at_rest,
)
from .left_out import left_out as left_out
from .mission import SETTABLE as SETTABLE, mission as mission
from .neglected_terms import (
    COMPARISONS as COMPARISONS,
    EQUATIONS as EQUATIONS,
    MOUNTINGS as MOUNTINGS,
    RIVALS as RIVALS,
    WAYS as WAYS,
    error_equations as error_equations,
    neglected as neglected,
    neglected_terms as neglected_terms,
    on_the_computed_path as on_the_computed_path,
)
from .reference_velocity import (
    TWELVE_TURNS as TWELVE_TURNS,
    on_reference_velocity as on_reference_velocity,
)
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
from .size_effect import (
    ARM as ARM,
    ARM_SIZES as ARM_SIZES,
    FILTERS as FILTERS,
    RATES as RATES,
    on_tables as on_tables,
    size_effect as size_effect,
)
from .starts import ALL_STARTS as ALL_STARTS, STARTS as STARTS, self_aligned as self_aligned
from .verdicts import verdict as verdict

"""Experiments of chapter 12: is a calibration as good as it says, and what does it leave out?"""

from .at_rest import FRAMES as FRAMES, SHOWN as SHOWN, errors_at_rest as errors_at_rest
from .consistency import filter_consistency as filter_consistency
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
from .many_runs import MOST_RUNS as MOST_RUNS, squared_errors as squared_errors
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
from .own_log import assumed_noise as assumed_noise
from .reference_velocity import (
    TWELVE_TURNS as TWELVE_TURNS,
    on_reference_velocity as on_reference_velocity,
)
from .size_effect import (
    ARM as ARM,
    ARM_SIZES as ARM_SIZES,
    FILTERS as FILTERS,
    RATES as RATES,
    arms_alone as arms_alone,
    on_tables as on_tables,
    size_effect as size_effect,
)
from .varying_biases import TABLES as TABLES, varying_biases as varying_biases

"""Experiments of chapter 07: attitude algorithms on motions whose truth is known."""

from .algorithms import (
    DURATION as DURATION,
    MOTIONS as MOTIONS,
    ORDER_MOTIONS as ORDER_MOTIONS,
    SAMPLE_RATES as SAMPLE_RATES,
    SHIP as SHIP,
    algorithm_errors as algorithm_errors,
    algorithm_orders as algorithm_orders,
)
from .bracket import bracket_run as bracket_run, square_of_turns as square_of_turns
from .closed_cones import closed_cone as closed_cone, swept_in_a_sample as swept_in_a_sample
from .coning import (
    BRACKET as BRACKET,
    BRACKET_SAMPLE_RATE as BRACKET_SAMPLE_RATE,
    coning_area as coning_area,
    drift_by_frequency_and_rate as drift_by_frequency_and_rate,
)
from .four_samples import (
    COMPARED as COMPARED,
    FOUR_SAMPLES as FOUR_SAMPLES,
    weights_by_distance as weights_by_distance,
    weights_of_polynomial as weights_of_polynomial,
)
from .functional_iteration import (
    WIDE_BRACKET as WIDE_BRACKET,
    WIDE_BRACKET_RATE as WIDE_BRACKET_RATE,
    WINDOWS as WINDOWS,
    precession as precession,
    precession_error as precession_error,
    precession_error_of_peer as precession_error_of_peer,
    turned_by_fit as turned_by_fit,
    window_errors as window_errors,
    window_noise_growth as window_noise_growth,
)
from .last_stages import (
    COMPARED_STAGES as COMPARED_STAGES,
    STAGE_LABELS as STAGE_LABELS,
    last_stage_errors as last_stage_errors,
    leading_errors as leading_errors,
    stage_drift as stage_drift,
)
from .noise_and_band import (
    ANGLE_RANDOM_WALK as ANGLE_RANDOM_WALK,
    FLOOR_RATES as FLOOR_RATES,
    FLOOR_SECONDS as FLOOR_SECONDS,
    QUANTUM as QUANTUM,
    SAMPLES_A_ROUND as SAMPLES_A_ROUND,
    carried_floor as carried_floor,
    missed_part as missed_part,
    noise_and_band as noise_and_band,
)
from .rounding import rounded as rounded
from .sculling import SHAKER as SHAKER, sculling_error as sculling_error
from .symmetry import (
    drift_orders as drift_orders,
    order_on_ship as order_on_ship,
    random_algorithm as random_algorithm,
)
from .word_length import (
    ARITHMETICS as ARITHMETICS,
    EARTH_RATE as EARTH_RATE,
    STEP_ANGLES as STEP_ANGLES,
    STORED_AS_ONE as STORED_AS_ONE,
    WORD_MOTIONS as WORD_MOTIONS,
    advice_gains as advice_gains,
    errors_by_step as errors_by_step,
    rows_of as rows_of,
    short_word_errors as short_word_errors,
)

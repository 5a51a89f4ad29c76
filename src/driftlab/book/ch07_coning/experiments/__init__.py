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
from .coning import (
    BRACKET as BRACKET,
    BRACKET_SAMPLE_RATE as BRACKET_SAMPLE_RATE,
    coning_area as coning_area,
    drift_by_frequency_and_rate as drift_by_frequency_and_rate,
)
from .last_stages import (
    COMPARED_STAGES as COMPARED_STAGES,
    STAGE_LABELS as STAGE_LABELS,
    last_stage_errors as last_stage_errors,
    leading_errors as leading_errors,
    stage_drift as stage_drift,
)
from .polynomials import polynomials_through_increments as polynomials_through_increments
from .symmetry import (
    drift_orders as drift_orders,
    order_on_ship as order_on_ship,
    random_algorithm as random_algorithm,
)
from .trap import trap_on_a_cone as trap_on_a_cone

"""Experiments of chapter 08: bandwidth, noise and rounding, sculling."""

from .four_samples import (
    COMPARED as COMPARED,
    FOUR_SAMPLES as FOUR_SAMPLES,
    weights_by_distance as weights_by_distance,
    weights_of_polynomial as weights_of_polynomial,
)
from .more_samples import three_against_four as three_against_four
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
from .pseudo_coning import (
    LATE as LATE,
    SHAKING_FREQUENCY as SHAKING_FREQUENCY,
    SWING as SWING,
    late_increments as late_increments,
    pseudo_coning as pseudo_coning,
    pseudo_drift as pseudo_drift,
)
from .rates import (
    between_samples as between_samples,
    increments_made as increments_made,
)
from .rounding import rounded as rounded
from .sculling import (
    SHAKER as SHAKER,
    sculling_error as sculling_error,
    sculling_run as sculling_run,
)

"""Experiments of chapter 15: a damped horizon, a published prototype, and trials of a compass."""

from .at_sea import settling_at_sea as settling_at_sea
from .damping import (
    CURRENT as CURRENT,
    LOG_SCALE as LOG_SCALE,
    damping_at_sea as damping_at_sea,
)
from .dial import (
    DIAL as DIAL,
    LEVELLING as LEVELLING,
    PAPER_LARGEST as PAPER_LARGEST,
    STOPS as STOPS,
    TURNED as TURNED,
    static_characteristic as static_characteristic,
)
from .loop import (
    DAY as DAY,
    GAINS as GAINS,
    SWELL as SWELL,
    frequency_response as frequency_response,
)
from .pulses import counted_pulses as counted_pulses
from .restarts import (
    PAPER_DEVIATION as PAPER_DEVIATION,
    PAPER_SPREAD as PAPER_SPREAD,
    RESTARTS as RESTARTS,
    TRIALS as TRIALS,
    restart_series as restart_series,
    spread_readings as spread_readings,
)
from .settling import settling_and_swing as settling_and_swing
from .trials import (
    largest_range_over_standard_deviation as largest_range_over_standard_deviation,
    range_over_standard_deviation as range_over_standard_deviation,
    turntable_heading_error as turntable_heading_error,
)
from .type_tests import (
    HIGH as HIGH,
    LOW as LOW,
    PAPER_COMPASS as PAPER_COMPASS,
    type_tests as type_tests,
)

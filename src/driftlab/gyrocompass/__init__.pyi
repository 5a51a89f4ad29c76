from . import (
    alignment as alignment,
    gains as gains,
    heading_error as heading_error,
    levelling as levelling,
    noise as noise,
    simulation as simulation,
    trials as trials,
)
from .alignment import (
    align as align,
    alignment_attitude_error as alignment_attitude_error,
    alignment_errors as alignment_errors,
)
from .gains import (
    Gains as Gains,
    damped_gains as damped_gains,
    schuler_gains as schuler_gains,
)
from .heading_error import (
    OperatingHeadingError as OperatingHeadingError,
    coriolis_correction as coriolis_correction,
    heading_error_of_attitude as heading_error_of_attitude,
    operating_heading_error as operating_heading_error,
    speed_error as speed_error,
)
from .levelling import (
    LevelFrame as LevelFrame,
    LevellingHistory as LevellingHistory,
    initial_level_frame as initial_level_frame,
    propagate_level_frame as propagate_level_frame,
)
from .noise import (
    GyroNoise as GyroNoise,
    moving_average as moving_average,
)
from .simulation import (
    HeadingErrors as HeadingErrors,
    simulate_compass as simulate_compass,
)
from .trials import (
    most_range_over_deviation as most_range_over_deviation,
    normal_ranges as normal_ranges,
    range_over_deviation as range_over_deviation,
    table_heading_error as table_heading_error,
)

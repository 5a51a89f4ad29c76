from . import (
    alignment as alignment,
    alignment_deviations as alignment_deviations,
    heading_error as heading_error,
    inertial_alignment as inertial_alignment,
    levelling as levelling,
    levelling_loop as levelling_loop,
    noise as noise,
    noise_fit as noise_fit,
    simulation as simulation,
    two_position_alignment as two_position_alignment,
    type_test as type_test,
)
from .alignment import (
    InconsistentAlignmentWarning as InconsistentAlignmentWarning,
    align as align,
    alignment_attitude_error as alignment_attitude_error,
    alignment_errors as alignment_errors,
)
from .alignment_deviations import (
    alignment_standard_deviation as alignment_standard_deviation,
    two_position_standard_deviation as two_position_standard_deviation,
)
from .heading_error import (
    coriolis_correction as coriolis_correction,
    operating_heading_error as operating_heading_error,
    speed_error as speed_error,
)
from .inertial_alignment import (
    align_in_inertial_frame as align_in_inertial_frame,
    inertial_alignment_standard_deviation as inertial_alignment_standard_deviation,
)
from .levelling import (
    LevelFrame as LevelFrame,
    initial_level_frame as initial_level_frame,
    propagate_level_frame as propagate_level_frame,
)
from .levelling_loop import (
    Gains as Gains,
    damped_gains as damped_gains,
    level_loop as level_loop,
    schuler_gains as schuler_gains,
)
from .noise import (
    GyroNoise as GyroNoise,
)
from .noise_fit import (
    fit_gyro_noise as fit_gyro_noise,
)
from .simulation import (
    simulate_gyrocompass as simulate_gyrocompass,
)
from .two_position_alignment import (
    align_multi_position as align_multi_position,
)
from .type_test import (
    COARSE as COARSE,
    LIMITS as LIMITS,
    Gyrocompass as Gyrocompass,
    marine_type_test as marine_type_test,
)

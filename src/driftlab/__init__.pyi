from . import (
    allan as allan,
    attitude as attitude,
    axes as axes,
    body_frames as body_frames,
    book as book,
    calibration as calibration,
    checks as checks,
    conventions as conventions,
    diagnosis as diagnosis,
    drift as drift,
    earth as earth,
    frames as frames,
    gyrocompass as gyrocompass,
    higher_order_errors as higher_order_errors,
    imu as imu,
    increments as increments,
    monte_carlo as monte_carlo,
    motion as motion,
    noise_terms as noise_terms,
    quaternion as quaternion,
    recordings as recordings,
    sampled_rates as sampled_rates,
    strapdown as strapdown,
    symbolic as symbolic,
    triad as triad,
    vectors as vectors,
)
from .allan import allan_deviation as allan_deviation
from .attitude.integration import integrate as integrate
from .axes import convert_attitude as convert_attitude, convert_vectors as convert_vectors
from .book.figures import figure as figure
from .calibration.filter import calibrate as calibrate
from .calibration.simulation import TableTrial as TableTrial
from .drift.recorded_turns import recorded_turn_estimate as recorded_turn_estimate
from .drift.systematic_drift import (
    drift_coefficient as drift_coefficient,
    drift_per_turn as drift_per_turn,
    principal_drifts as principal_drifts,
)
from .drift.turn_calibration import (
    TurnExperiment as TurnExperiment,
    turn_estimate as turn_estimate,
)
from .drift.weighing_designs import fit_turns as fit_turns
from .gyrocompass.alignment import align as align, alignment_errors as alignment_errors
from .higher_order_errors import (
    NO_HIGHER_ORDER_ERRORS as NO_HIGHER_ORDER_ERRORS,
    HigherOrderErrors as HigherOrderErrors,
)
from .imu import (
    NO_ERRORS as NO_ERRORS,
    TYPICAL_ERRORS as TYPICAL_ERRORS,
    ImuErrors as ImuErrors,
    ImuNoise as ImuNoise,
    PriorDeviations as PriorDeviations,
)
from .increments import (
    Increments as Increments,
    compensate as compensate,
    measure as measure,
)
from .motion.scheme import Scheme as Scheme
from .motion.table_turn import TableTurn as TableTurn
from .noise_terms import fit_noise_terms as fit_noise_terms
from .sampled_rates import increments_from_rates as increments_from_rates
from .strapdown import (
    at_rest as at_rest,
    last_of as last_of,
    navigate as navigate,
)
from .triad import measured_rate as measured_rate

__version__: str

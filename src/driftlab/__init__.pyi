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
from .attitude.drift_on_cones import coning_drift as coning_drift
from .attitude.integration import integrate as integrate
from .book.figures import figure as figure
from .calibration.filter import calibrate as calibrate
from .calibration.observability import unobservable_subspace as unobservable_subspace
from .drift.characteristic_equation import (
    asymptotic_roots as asymptotic_roots,
    characteristic_polynomial as characteristic_polynomial,
    exact_roots as exact_roots,
)
from .drift.error_kinematics import error_quaternion as error_quaternion
from .drift.systematic_drift import (
    drift_per_revolution as drift_per_revolution,
    principal_drifts as principal_drifts,
)
from .drift.turn_calibration import turn_estimate as turn_estimate
from .drift.weighing_designs import fit_turns as fit_turns
from .gyrocompass.alignment import align as align, alignment_errors as alignment_errors
from .gyrocompass.heading_error import (
    operating_heading_error as operating_heading_error,
    speed_error as speed_error,
)
from .imu import ImuErrors as ImuErrors, ImuNoise as ImuNoise
from .increments import (
    Increments as Increments,
    compensate as compensate,
    measure as measure,
)
from .strapdown import navigate as navigate, stationary_state as stationary_state
from .triad import measured_rate as measured_rate, split_error_matrix as split_error_matrix

__version__: str

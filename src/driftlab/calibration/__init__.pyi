from . import (
    body_axes as body_axes,
    calibration_history as calibration_history,
    covariance as covariance,
    error_budget as error_budget,
    error_dynamics as error_dynamics,
    error_model as error_model,
    filter as filter,
    interchange as interchange,
    kalman as kalman,
    matrix_conventions as matrix_conventions,
    multi_position as multi_position,
    observability as observability,
    scheme_design as scheme_design,
    simulation as simulation,
    static_error_growth as static_error_growth,
    static_navigation as static_navigation,
)
from .body_axes import (
    attitude_error as attitude_error,
    attitude_of_axes as attitude_of_axes,
    imu_errors_in_frame as imu_errors_in_frame,
)
from .calibration_history import (
    InconsistentCalibrationWarning as InconsistentCalibrationWarning,
    innovation_test as innovation_test,
)
from .covariance import (
    covariance_analysis as covariance_analysis,
    standard_deviation_history as standard_deviation_history,
)
from .error_budget import (
    calibration_error_budget as calibration_error_budget,
    mission_error_sources as mission_error_sources,
    mission_errors as mission_errors,
)
from .error_dynamics import (
    free_transition as free_transition,
    linearize_along as linearize_along,
    process_noise as process_noise,
    transition_of_increments as transition_of_increments,
)
from .error_model import (
    ERROR_MODELS as ERROR_MODELS,
    FULL as FULL,
)
from .filter import calibrate as calibrate
from .interchange import (
    from_json as from_json,
    to_json as to_json,
)
from .kalman import (
    correct as correct,
    nees as nees,
    predict as predict,
)
from .matrix_conventions import (
    ImucalMatrices as ImucalMatrices,
    ImuTkMatrices as ImuTkMatrices,
    KalibrMatrices as KalibrMatrices,
    NominalReadings as NominalReadings,
    PsinsMatrices as PsinsMatrices,
    RosMatrices as RosMatrices,
)
from .multi_position import calibrate_multi_position as calibrate_multi_position
from .observability import (
    gramian_ranks as gramian_ranks,
    observability_matrix as observability_matrix,
    stripped_observability as stripped_observability,
    unobservable_subspace as unobservable_subspace,
)
from .scheme_design import (
    DesignTask as DesignTask,
    design_scheme as design_scheme,
)
from .simulation import TurntableTrial as TurntableTrial
from .static_error_growth import (
    STATIC_ERROR_SOURCES as STATIC_ERROR_SOURCES,
    schuler_position_error as schuler_position_error,
    static_error_modes as static_error_modes,
    static_error_sources as static_error_sources,
    static_errors as static_errors,
)
from .static_navigation import navigate_static as navigate_static

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
    observability as observability,
    poses as poses,
    scheme_design as scheme_design,
    simulation as simulation,
    static_error_growth as static_error_growth,
    static_navigation as static_navigation,
)
from .body_axes import (
    attitude_error as attitude_error,
    attitude_of_axes as attitude_of_axes,
    imu_errors_in_accelerometer_axes as imu_errors_in_accelerometer_axes,
    imu_errors_in_frame as imu_errors_in_frame,
)
from .calibration_history import (
    Calibration as Calibration,
    InconsistentWarning as InconsistentWarning,
    InnovationTest as InnovationTest,
    innovation_test as innovation_test,
)
from .covariance import (
    covariance_analysis as covariance_analysis,
    deviation_history as deviation_history,
)
from .error_budget import (
    MissionErrors as MissionErrors,
    calibration_budget as calibration_budget,
    mission_causes as mission_causes,
    mission_errors as mission_errors,
)
from .error_dynamics import (
    LinearizedErrors as LinearizedErrors,
    checked_model as checked_model,
    free_rates as free_rates,
    free_transition as free_transition,
    linearize_along as linearize_along,
    process_noise as process_noise,
    transition as transition,
    transition_of_increments as transition_of_increments,
)
from .error_model import (
    AXES as AXES,
    ERROR_MODELS as ERROR_MODELS,
    FULL as FULL,
    LOCAL_AXES as LOCAL_AXES,
    ErrorModel as ErrorModel,
    error_model_for as error_model_for,
)
from .filter import (
    FilterFailure as FilterFailure,
    calibrate as calibrate,
)
from .interchange import (
    SCHEMA as SCHEMA,
    KeptCalibration as KeptCalibration,
    calibration_document as calibration_document,
    from_json as from_json,
    to_json as to_json,
)
from .kalman import (
    Update as Update,
    correct as correct,
    nees as nees,
    predict as predict,
)
from .matrix_conventions import (
    SI_READINGS as SI_READINGS,
    ImucalMatrices as ImucalMatrices,
    ImuTkMatrices as ImuTkMatrices,
    KalibrMatrices as KalibrMatrices,
    NominalReadings as NominalReadings,
    PsinsMatrices as PsinsMatrices,
    RosMatrices as RosMatrices,
)
from .observability import (
    TURN_TREATMENTS as TURN_TREATMENTS,
    StrippedObservability as StrippedObservability,
    UnobservableSubspace as UnobservableSubspace,
    UnobservableWarning as UnobservableWarning,
    error_rates as error_rates,
    gramian_ranks as gramian_ranks,
    observability_matrix as observability_matrix,
    stripped_observability as stripped_observability,
    unobservable_subspace as unobservable_subspace,
    warn_if_unobservable as warn_if_unobservable,
)
from .poses import (
    POSE_AXES as POSE_AXES,
    Consistency as Consistency,
    PoseCalibration as PoseCalibration,
    calibrate_by_poses as calibrate_by_poses,
)
from .scheme_design import (
    CRITERIA as CRITERIA,
    Climb as Climb,
    DesignTask as DesignTask,
    SchemeDesign as SchemeDesign,
    design_scheme as design_scheme,
)
from .simulation import (
    TableTrial as TableTrial,
    Trial as Trial,
    estimation_errors as estimation_errors,
)
from .static_error_growth import (
    STATIC_CAUSES as STATIC_CAUSES,
    STATIC_MODES as STATIC_MODES,
    StaticErrorModes as StaticErrorModes,
    StaticErrorRates as StaticErrorRates,
    schuler_position as schuler_position,
    static_causes as static_causes,
    static_error_matrix as static_error_matrix,
    static_error_modes as static_error_modes,
    static_error_rates as static_error_rates,
    static_errors as static_errors,
)
from .static_navigation import (
    StaticNavigationErrors as StaticNavigationErrors,
    navigate_static as navigate_static,
)

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
    imu_errors_in_frame as imu_errors_in_frame,
)
from .calibration_history import (
    InconsistentWarning as InconsistentWarning,
    innovation_test as innovation_test,
)
from .covariance import (
    covariance_analysis as covariance_analysis,
    deviation_history as deviation_history,
)
from .error_budget import (
    calibration_budget as calibration_budget,
    mission_causes as mission_causes,
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
from .observability import (
    gramian_ranks as gramian_ranks,
    observability_matrix as observability_matrix,
    stripped_observability as stripped_observability,
    unobservable_subspace as unobservable_subspace,
)
from .poses import calibrate_by_poses as calibrate_by_poses
from .scheme_design import (
    DesignTask as DesignTask,
    design_scheme as design_scheme,
)
from .simulation import TableTrial as TableTrial
from .static_error_growth import (
    STATIC_CAUSES as STATIC_CAUSES,
    schuler_position as schuler_position,
    static_causes as static_causes,
    static_error_modes as static_error_modes,
    static_errors as static_errors,
)
from .static_navigation import navigate_static as navigate_static

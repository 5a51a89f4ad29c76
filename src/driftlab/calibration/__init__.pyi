from . import (
    body_axes as body_axes,
    error_dynamics as error_dynamics,
    error_model as error_model,
    filter as filter,
    kalman as kalman,
    linearization as linearization,
    observability as observability,
    simulation as simulation,
    static_navigation as static_navigation,
)
from .body_axes import (
    attitude_error as attitude_error,
    attitude_of_axes as attitude_of_axes,
    imu_errors_in_accelerometer_axes as imu_errors_in_accelerometer_axes,
    imu_errors_in_frame as imu_errors_in_frame,
)
from .error_model import (
    AXES as AXES,
    ERROR_MODELS as ERROR_MODELS,
    ErrorModel as ErrorModel,
    FULL as FULL,
    LOCAL_AXES as LOCAL_AXES,
    error_model_for as error_model_for,
)
from .error_dynamics import (
    free_rates as free_rates,
    free_transition as free_transition,
    process_noise as process_noise,
    transition as transition,
    transition_of_increments as transition_of_increments,
)
from .kalman import (
    Update as Update,
    correct as correct,
    nees as nees,
    predict as predict,
)
from .filter import (
    Calibration as Calibration,
    calibrate as calibrate,
)
from .linearization import (
    LinearizedErrors as LinearizedErrors,
    STEP as STEP,
    checked_model as checked_model,
    linearize_along as linearize_along,
)
from .observability import (
    UnobservableSubspace as UnobservableSubspace,
    UnobservableWarning as UnobservableWarning,
    gramian_ranks as gramian_ranks,
    observability_matrix as observability_matrix,
    unobservable_subspace as unobservable_subspace,
    warn_if_unobservable as warn_if_unobservable,
)
from .simulation import (
    TableTrial as TableTrial,
    Trial as Trial,
    estimation_errors as estimation_errors,
)
from .static_navigation import (
    StaticNavigationErrors as StaticNavigationErrors,
    navigate_static as navigate_static,
)

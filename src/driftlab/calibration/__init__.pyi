from . import (
    error_dynamics as error_dynamics,
)
from . import (
    error_model as error_model,
)
from . import (
    filter as filter,
)
from . import (
    kalman as kalman,
)
from . import (
    observability as observability,
)
from . import (
    simulation as simulation,
)
from . import (
    static_navigation as static_navigation,
)
from .error_dynamics import (
    free_growth as free_growth,
)
from .error_dynamics import (
    process_noise as process_noise,
)
from .error_dynamics import (
    transition as transition,
)
from .error_dynamics import (
    transition_of_increments as transition_of_increments,
)
from .error_model import (
    AXES as AXES,
)
from .error_model import (
    ERROR_MODELS as ERROR_MODELS,
)
from .error_model import (
    FULL as FULL,
)
from .error_model import (
    LOCAL_AXES as LOCAL_AXES,
)
from .error_model import (
    ErrorModel as ErrorModel,
)
from .error_model import (
    attitude_error as attitude_error,
)
from .error_model import (
    attitude_of_axes as attitude_of_axes,
)
from .error_model import (
    error_model_for as error_model_for,
)
from .filter import (
    Calibration as Calibration,
)
from .filter import (
    calibrate as calibrate,
)
from .kalman import (
    Update as Update,
)
from .kalman import (
    covariance_step as covariance_step,
)
from .kalman import (
    kalman_step as kalman_step,
)
from .observability import (
    STEP as STEP,
)
from .observability import (
    Darkness as Darkness,
)
from .observability import (
    Passage as Passage,
)
from .observability import (
    UnobservableWarning as UnobservableWarning,
)
from .observability import (
    checked_model as checked_model,
)
from .observability import (
    expected_covariance as expected_covariance,
)
from .observability import (
    null_directions as null_directions,
)
from .observability import (
    observability_matrix as observability_matrix,
)
from .observability import (
    passage as passage,
)
from .observability import (
    warn_if_unobservable as warn_if_unobservable,
)
from .simulation import (
    TableTrial as TableTrial,
)
from .simulation import (
    Trial as Trial,
)
from .simulation import (
    estimation_errors as estimation_errors,
)
from .simulation import (
    unit_in_axes as unit_in_axes,
)
from .static_navigation import (
    InPlace as InPlace,
)
from .static_navigation import (
    navigate_in_place as navigate_in_place,
)

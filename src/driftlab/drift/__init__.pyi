from . import (
    characteristic_equation as characteristic_equation,
)
from . import (
    error_kinematics as error_kinematics,
)
from . import (
    step_formulas as step_formulas,
)
from . import (
    systematic_drift as systematic_drift,
)
from . import (
    turn_calibration as turn_calibration,
)
from .characteristic_equation import (
    asymptotic_roots as asymptotic_roots,
)
from .characteristic_equation import (
    characteristic_polynomial as characteristic_polynomial,
)
from .characteristic_equation import (
    exact_roots as exact_roots,
)
from .characteristic_equation import (
    split_error_rate_matrix as split_error_rate_matrix,
)
from .error_kinematics import (
    attitude_quaternion as attitude_quaternion,
)
from .error_kinematics import (
    error_composition_matrix as error_composition_matrix,
)
from .error_kinematics import (
    error_quaternion as error_quaternion,
)
from .error_kinematics import (
    error_rate_matrix as error_rate_matrix,
)
from .error_kinematics import (
    error_transition_matrix as error_transition_matrix,
)
from .error_kinematics import (
    rate_matrix as rate_matrix,
)
from .step_formulas import (
    STEP_FORMULAS as STEP_FORMULAS,
)
from .step_formulas import (
    StepFormula as StepFormula,
)
from .step_formulas import (
    step_formula as step_formula,
)
from .systematic_drift import (
    drift_coefficient as drift_coefficient,
)
from .systematic_drift import (
    drift_per_turn as drift_per_turn,
)
from .systematic_drift import (
    exact_drift_coefficient as exact_drift_coefficient,
)
from .systematic_drift import (
    principal_drifts as principal_drifts,
)
from .turn_calibration import (
    PAIR_AXES as PAIR_AXES,
)
from .turn_calibration import (
    YATES_AXES as YATES_AXES,
)
from .turn_calibration import (
    TurnExperiment as TurnExperiment,
)
from .turn_calibration import (
    TurnFit as TurnFit,
)
from .turn_calibration import (
    exact_turn_estimate as exact_turn_estimate,
)
from .turn_calibration import (
    fit_turns as fit_turns,
)
from .turn_calibration import (
    turn_estimate as turn_estimate,
)
from .turn_calibration import (
    weighing as weighing,
)

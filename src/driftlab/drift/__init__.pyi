from . import (
    characteristic_equation as characteristic_equation,
    closed_motion as closed_motion,
    error_kinematics as error_kinematics,
    recorded_turns as recorded_turns,
    step_formulas as step_formulas,
    systematic_drift as systematic_drift,
    turn_calibration as turn_calibration,
    turns_by_hand as turns_by_hand,
    weighing_designs as weighing_designs,
)
from .characteristic_equation import (
    asymptotic_roots as asymptotic_roots,
    characteristic_polynomial as characteristic_polynomial,
    exact_roots as exact_roots,
    split_error_rate_matrix as split_error_rate_matrix,
)
from .closed_motion import (
    drift_per_cycle as drift_per_cycle,
    exact_drift_per_cycle as exact_drift_per_cycle,
)
from .error_kinematics import (
    error_composition_matrix as error_composition_matrix,
    error_quaternion as error_quaternion,
    error_rate_matrix as error_rate_matrix,
    rate_matrix as rate_matrix,
)
from .recorded_turns import (
    fit_error_matrix as fit_error_matrix,
    recorded_turn_estimate as recorded_turn_estimate,
)
from .step_formulas import STEP_FORMULAS as STEP_FORMULAS
from .systematic_drift import (
    drift_coefficient as drift_coefficient,
    drift_per_revolution as drift_per_revolution,
    principal_drifts as principal_drifts,
)
from .turn_calibration import (
    TurnExperiment as TurnExperiment,
    earth_rate_offset as earth_rate_offset,
    exact_turn_estimate as exact_turn_estimate,
    turn_estimate as turn_estimate,
)
from .turns_by_hand import (
    HandTurn as HandTurn,
    fit_hand_turns as fit_hand_turns,
    hand_turns as hand_turns,
    near_turns as near_turns,
)
from .weighing_designs import (
    PAIR_AXES as PAIR_AXES,
    YATES_AXES as YATES_AXES,
    fit_turns as fit_turns,
    weighing_estimate as weighing_estimate,
)

"""The experiments of chapter 04: single turns, calibrations, ways to weigh, printed digits."""

from .calibrations import (
    AS_DERIVED as AS_DERIVED,
    AS_PRINTED as AS_PRINTED,
    PLANS as PLANS,
    Plan as Plan,
    TurnEstimates as TurnEstimates,
    triad_error as triad_error,
    turn_estimates as turn_estimates,
    yates_sigma as yates_sigma,
)
from .digits import LarinDigits as LarinDigits, larin_digits as larin_digits
from .turns import (
    ANGLE_NOISE as ANGLE_NOISE,
    FORMULAS as FORMULAS,
    TurnBias as TurnBias,
    estimate_errors as estimate_errors,
    expected_noise as expected_noise,
    method_bias as method_bias,
    turn_bias as turn_bias,
)
from .weighings import (
    METHODS as METHODS,
    NOISE as NOISE,
    OFFSET as OFFSET,
    SIGMA as SIGMA,
    WeighingDesigns as WeighingDesigns,
    weighing_designs as weighing_designs,
)

"""The experiments of chapter 04: turns, calibrations, ways to weigh, the digits of the copy."""

from .calibrations import (
    AS_COPIED as AS_COPIED,
    AS_DERIVED as AS_DERIVED,
    NINE as NINE,
    PLANS as PLANS,
    SENSES as SENSES,
    error_matrix as error_matrix,
    turn_estimates as turn_estimates,
    yates_sigma as yates_sigma,
)
from .digits import CHOSEN_BY as CHOSEN_BY, larin_digits as larin_digits
from .free_numbers import (
    FACTORS as FACTORS,
    OF_SIGMA1 as OF_SIGMA1,
    factor_bounds as factor_bounds,
    free_numbers as free_numbers,
    step_error as step_error,
)
from .mountings import (
    LATITUDE as LATITUDE,
    TABLE_RATE as TABLE_RATE,
    mountings as mountings,
)
from .turns import (
    FORMULAS as FORMULAS,
    SEED as SEED,
    estimate_errors as estimate_errors,
    expected_noise as expected_noise,
    method_bias as method_bias,
    turn_bias as turn_bias,
)
from .weighings import METHODS as METHODS, weighing_designs as weighing_designs

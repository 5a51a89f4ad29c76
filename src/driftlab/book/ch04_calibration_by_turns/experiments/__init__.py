"""The experiments of chapter 04: single turns, calibrations, ways to weigh, printed digits."""

from .calibrations import AS_DERIVED as AS_DERIVED
from .calibrations import AS_PRINTED as AS_PRINTED
from .calibrations import PLANS as PLANS
from .calibrations import Plan as Plan
from .calibrations import TurnEstimates as TurnEstimates
from .calibrations import triad_error as triad_error
from .calibrations import turn_estimates as turn_estimates
from .calibrations import yates_sigma as yates_sigma
from .digits import LarinDigits as LarinDigits
from .digits import larin_digits as larin_digits
from .turns import ANGLE_NOISE as ANGLE_NOISE
from .turns import FORMULAS as FORMULAS
from .turns import TurnBias as TurnBias
from .turns import estimate_errors as estimate_errors
from .turns import expected_noise as expected_noise
from .turns import method_bias as method_bias
from .turns import turn_bias as turn_bias
from .weighings import METHODS as METHODS
from .weighings import NOISE as NOISE
from .weighings import OFFSET as OFFSET
from .weighings import SIGMA as SIGMA
from .weighings import WeighingDesigns as WeighingDesigns
from .weighings import weighing_designs as weighing_designs

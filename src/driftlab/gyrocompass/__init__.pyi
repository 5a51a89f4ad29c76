from . import (
    alignment as alignment,
)
from . import (
    heading_error as heading_error,
)
from . import (
    levelling as levelling,
)
from . import (
    noise as noise,
)
from . import (
    simulation as simulation,
)
from . import (
    trials as trials,
)
from .alignment import (
    Alignment as Alignment,
)
from .alignment import (
    AlignmentErrors as AlignmentErrors,
)
from .alignment import (
    align as align,
)
from .alignment import (
    alignment_attitude_error as alignment_attitude_error,
)
from .alignment import (
    alignment_errors as alignment_errors,
)
from .heading_error import (
    OperatingHeadingError as OperatingHeadingError,
)
from .heading_error import (
    heading_error_of_attitude as heading_error_of_attitude,
)
from .heading_error import (
    level_coriolis as level_coriolis,
)
from .heading_error import (
    operating_heading_error as operating_heading_error,
)
from .heading_error import (
    speed_deviation as speed_deviation,
)
from .levelling import (
    Horizon as Horizon,
)
from .levelling import (
    Operation as Operation,
)
from .levelling import (
    Tuning as Tuning,
)
from .levelling import (
    damped_tuning as damped_tuning,
)
from .levelling import (
    horizon_of as horizon_of,
)
from .levelling import (
    operate as operate,
)
from .levelling import (
    schuler_tuning as schuler_tuning,
)
from .noise import (
    GyroNoise as GyroNoise,
)
from .noise import (
    moving_average as moving_average,
)
from .noise import (
    settled_deviation as settled_deviation,
)
from .noise import (
    swing_deviation as swing_deviation,
)
from .simulation import (
    ErrorsUnderWay as ErrorsUnderWay,
)
from .simulation import (
    take_along as take_along,
)
from .trials import (
    most_range_over_deviation as most_range_over_deviation,
)
from .trials import (
    normal_ranges as normal_ranges,
)
from .trials import (
    range_over_deviation as range_over_deviation,
)
from .trials import (
    table_heading_error as table_heading_error,
)

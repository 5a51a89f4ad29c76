from . import (
    profiles as profiles,
    scheme as scheme,
    table_turn as table_turn,
    trajectory as trajectory,
    turntable as turntable,
    vehicle as vehicle,
)
from .profiles import (
    Coning as Coning,
    FixedAxis as FixedAxis,
    Sway as Sway,
)
from .scheme import (
    EIGHTEEN_ROTATIONS as EIGHTEEN_ROTATIONS,
    NINETEEN_POSITIONS as NINETEEN_POSITIONS,
    SCHEMES as SCHEMES,
    Scheme as Scheme,
)
from .table_turn import (
    TableTurn as TableTurn,
)
from .turntable import (
    segments as segments,
    static_trajectory as static_trajectory,
    table_trajectory as table_trajectory,
)
from .vehicle import (
    smooth_step as smooth_step,
    static_imu as static_imu,
    vehicle_trajectory as vehicle_trajectory,
)

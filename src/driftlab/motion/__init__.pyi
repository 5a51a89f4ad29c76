from . import (
    profiles as profiles,
    scheme as scheme,
    trajectory as trajectory,
    turntable as turntable,
    turntable_rotation as turntable_rotation,
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
from .turntable import (
    segments as segments,
    static_trajectory as static_trajectory,
    turntable_trajectory as turntable_trajectory,
)
from .turntable_rotation import (
    TurntableRotation as TurntableRotation,
)
from .vehicle import (
    smooth_step as smooth_step,
    static_imu as static_imu,
    vehicle_trajectory as vehicle_trajectory,
)

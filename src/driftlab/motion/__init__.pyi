from . import (
    profiles as profiles,
)
from . import (
    turntable as turntable,
)
from . import (
    vehicle as vehicle,
)
from .profiles import (
    Coning as Coning,
)
from .profiles import (
    FixedAxis as FixedAxis,
)
from .profiles import (
    Motion as Motion,
)
from .profiles import (
    Sway as Sway,
)
from .turntable import (
    DIRECTIONS as DIRECTIONS,
)
from .turntable import (
    EIGHTEEN_ROTATIONS as EIGHTEEN_ROTATIONS,
)
from .turntable import (
    NINETEEN_POSITIONS as NINETEEN_POSITIONS,
)
from .turntable import (
    SCHEMES as SCHEMES,
)
from .turntable import (
    Record as Record,
)
from .turntable import (
    Scheme as Scheme,
)
from .turntable import (
    Segment as Segment,
)
from .turntable import (
    segments as segments,
)
from .turntable import (
    simulate as simulate,
)
from .turntable import (
    stand as stand,
)
from .vehicle import (
    Voyage as Voyage,
)
from .vehicle import (
    sensed_at_rest as sensed_at_rest,
)
from .vehicle import (
    smooth_step as smooth_step,
)
from .vehicle import (
    voyage as voyage,
)

from . import (
    cayley as cayley,
)
from . import (
    coning_algorithms as coning_algorithms,
)
from . import (
    finite_precision as finite_precision,
)
from . import (
    integration as integration,
)
from . import (
    riccati as riccati,
)
from .cayley import (
    cayley_transform as cayley_transform,
)
from .cayley import (
    cayley_vector as cayley_vector,
)
from .cayley import (
    rotation_quaternion as rotation_quaternion,
)
from .cayley import (
    shadow as shadow,
)
from .cayley import (
    skew_operator as skew_operator,
)
from .coning_algorithms import (
    ALGORITHMS as ALGORITHMS,
)
from .coning_algorithms import (
    Algorithm as Algorithm,
)
from .coning_algorithms import (
    Iterate as Iterate,
)
from .coning_algorithms import (
    Weights as Weights,
)
from .coning_algorithms import (
    attitude_algorithm as attitude_algorithm,
)
from .coning_algorithms import (
    coning_drift as coning_drift,
)
from .finite_precision import (
    UPDATES as UPDATES,
)
from .finite_precision import (
    Update as Update,
)
from .finite_precision import (
    integrate_in_word as integrate_in_word,
)
from .finite_precision import (
    step_in_word as step_in_word,
)
from .integration import (
    integrate as integrate,
)
from .integration import (
    step_quaternions as step_quaternions,
)
from .integration import (
    step_vectors as step_vectors,
)
from .riccati import (
    SWITCH as SWITCH,
)
from .riccati import (
    RiccatiSolution as RiccatiSolution,
)
from .riccati import (
    integrate_riccati as integrate_riccati,
)
from .riccati import (
    riccati_rate as riccati_rate,
)

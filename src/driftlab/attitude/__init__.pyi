from . import (
    cayley as cayley,
    coning_algorithms as coning_algorithms,
    finite_precision as finite_precision,
    integration as integration,
    riccati as riccati,
)
from .cayley import (
    cayley_transform as cayley_transform,
    cayley_vector as cayley_vector,
    rotation_quaternion as rotation_quaternion,
    shadow as shadow,
    skew_operator as skew_operator,
)
from .coning_algorithms import (
    ALGORITHMS as ALGORITHMS,
    CONING_ALGORITHMS as CONING_ALGORITHMS,
    Algorithm as Algorithm,
    AttitudeAlgorithm as AttitudeAlgorithm,
    LastStage as LastStage,
    Weights as Weights,
    attitude_algorithm as attitude_algorithm,
    coning_algorithm as coning_algorithm,
)
from .finite_precision import (
    UPDATES as UPDATES,
    Update as Update,
    integrate_in_word as integrate_in_word,
    step_in_word as step_in_word,
)
from .integration import (
    integrate as integrate,
    step_quaternions as step_quaternions,
    step_vectors as step_vectors,
)
from .riccati import (
    SWITCH as SWITCH,
    RiccatiSolution as RiccatiSolution,
    integrate_riccati as integrate_riccati,
    riccati_rate as riccati_rate,
)

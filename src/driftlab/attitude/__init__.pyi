from . import (
    cayley as cayley,
    coning_algorithms as coning_algorithms,
    drift_on_cones as drift_on_cones,
    finite_precision as finite_precision,
    functional_iteration as functional_iteration,
    integration as integration,
    noise_amplification as noise_amplification,
    own_algorithms as own_algorithms,
    riccati as riccati,
    sculling as sculling,
    spherical_area as spherical_area,
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
)
from .drift_on_cones import (
    coning_drift as coning_drift,
    simulated_coning_drift as simulated_coning_drift,
)
from .finite_precision import (
    UPDATES as UPDATES,
    integrate_finite_word as integrate_finite_word,
    step_finite_word as step_finite_word,
)
from .functional_iteration import FunctionalIteration as FunctionalIteration
from .integration import (
    integrate as integrate,
    step_quaternions as step_quaternions,
    step_rotation_vectors as step_rotation_vectors,
)
from .noise_amplification import (
    correction_gains as correction_gains,
    noise_growth as noise_growth,
    step_noise_covariance as step_noise_covariance,
)
from .riccati import (
    SWITCH as SWITCH,
    integrate_riccati as integrate_riccati,
    riccati_rate as riccati_rate,
)
from .sculling import (
    sculling_correction as sculling_correction,
    step_velocities as step_velocities,
)
from .spherical_area import solid_angle as solid_angle

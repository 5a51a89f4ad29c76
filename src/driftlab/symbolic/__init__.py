"""The book's objects in SymPy: rotations and rates, and the steps of attitude algorithms."""

from driftlab._extra import require_extra

require_extra(__name__, "sympy")

from driftlab.symbolic.identity import identity as identity
from driftlab.symbolic.objects import (
    IDENTITY as IDENTITY,
    cayley_transform as cayley_transform,
    conjugate as conjugate,
    cross_matrix as cross_matrix,
    error_rate_matrix as error_rate_matrix,
    left_matrix as left_matrix,
    multiply as multiply,
    pure as pure,
    quaternion as quaternion,
    rate_matrix as rate_matrix,
    riccati_rate as riccati_rate,
    right_matrix as right_matrix,
    rotation_exponential as rotation_exponential,
    rotation_matrix as rotation_matrix,
    simplified as simplified,
    skew_operator as skew_operator,
    vector as vector,
)
from driftlab.symbolic.step_cost import (
    LAST_STAGES as LAST_STAGES,
    operations as operations,
    run_program as run_program,
    step_program as step_program,
)
from driftlab.symbolic.step_series import (
    exact_step_vector as exact_step_vector,
    leading_error as leading_error,
    picard_iterate as picard_iterate,
    vector_of_rotation as vector_of_rotation,
)

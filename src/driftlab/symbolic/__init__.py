"""The book's objects in SymPy: rotations and rates, and the steps of attitude algorithms."""

from driftlab._extra import require_extra

require_extra(__name__, "sympy")

from driftlab.symbolic.identity import identity
from driftlab.symbolic.objects import (
    IDENTITY,
    cayley_transform,
    conjugate,
    cross_matrix,
    error_rate_matrix,
    left_matrix,
    multiply,
    pure,
    quaternion,
    rate_matrix,
    riccati_rate,
    right_matrix,
    rotation_exponential,
    rotation_matrix,
    simplified,
    skew_operator,
    vector,
)
from driftlab.symbolic.step_cost import (
    LAST_STAGES,
    operations,
    run_program,
    step_program,
)
from driftlab.symbolic.step_series import (
    exact_step_vector,
    leading_error,
    picard_iterate,
    vector_of_rotation,
)

__all__ = [
    "IDENTITY",
    "LAST_STAGES",
    "cayley_transform",
    "conjugate",
    "cross_matrix",
    "error_rate_matrix",
    "exact_step_vector",
    "identity",
    "leading_error",
    "left_matrix",
    "multiply",
    "operations",
    "picard_iterate",
    "pure",
    "quaternion",
    "rate_matrix",
    "riccati_rate",
    "right_matrix",
    "rotation_exponential",
    "rotation_matrix",
    "run_program",
    "simplified",
    "skew_operator",
    "step_program",
    "vector",
    "vector_of_rotation",
]

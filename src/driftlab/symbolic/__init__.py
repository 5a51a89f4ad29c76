"""The book's objects in SymPy: rotations and rates, and the steps of attitude algorithms."""

from .objects import (
    IDENTITY,
    cayley_transform,
    conjugate,
    error_composition_matrix,
    error_rate_matrix,
    left_matrix,
    multiply,
    pure,
    quaternion,
    rate_matrix,
    riccati_rate,
    right_matrix,
    rotation_exponential,
    simplified,
    skew_operator,
    vector,
)
from .step_cost import (
    Program,
    operations,
    step_program,
)
from .step_series import (
    Series,
    algorithm_step_vector,
    exact_step_vector,
    leading_error,
    picard_iterate,
)

__all__ = [
    "IDENTITY",
    "Program",
    "Series",
    "algorithm_step_vector",
    "cayley_transform",
    "conjugate",
    "error_composition_matrix",
    "error_rate_matrix",
    "exact_step_vector",
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
    "simplified",
    "skew_operator",
    "step_program",
    "vector",
]

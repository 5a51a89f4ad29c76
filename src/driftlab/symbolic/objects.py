"""The objects of the book in SymPy, for derivations that end in an identity.

Quaternions and vectors are column matrices, quaternions scalar last, exactly as in the numeric
modules; the tests compare the two entry by entry.
"""

import sympy as sp

IDENTITY = sp.Matrix([0, 0, 0, 1])
"""The quaternion of no rotation: the initial value of every error."""


def vector(name: str) -> sp.Matrix:
    """Column of three real symbols name_1, name_2, name_3."""
    return sp.Matrix(sp.symbols(f"{name}_1:4", real=True))


def quaternion(name: str) -> sp.Matrix:
    """Column of four real symbols name_1, name_2, name_3, name_0: scalar last."""
    return sp.Matrix(sp.symbols(f"{name}_1:4 {name}_0", real=True))


def pure(rate: sp.Matrix) -> sp.Matrix:
    """Quaternion with the vector `rate` and scalar part zero."""
    return sp.Matrix([*rate, 0])


def conjugate(q: sp.Matrix) -> sp.Matrix:
    """Conjugate quaternion."""
    return sp.Matrix([-q[0], -q[1], -q[2], q[3]])


def multiply(p: sp.Matrix, q: sp.Matrix) -> sp.Matrix:
    """Hamilton product p∘q."""
    p_vector, q_vector = sp.Matrix(p[:3]), sp.Matrix(q[:3])
    product = p[3] * q_vector + q[3] * p_vector + p_vector.cross(q_vector)
    return sp.Matrix([*product, p[3] * q[3] - p_vector.dot(q_vector)])


def left_matrix(q: sp.Matrix) -> sp.Matrix:
    """Matrix of p -> q∘p."""
    return sp.Matrix.hstack(*(multiply(q, unit) for unit in _units()))


def right_matrix(q: sp.Matrix) -> sp.Matrix:
    """Matrix of p -> p∘q."""
    return sp.Matrix.hstack(*(multiply(unit, q) for unit in _units()))


def _units() -> list[sp.Matrix]:
    return [sp.eye(4).col(i) for i in range(4)]


def rate_matrix(rate: sp.Matrix) -> sp.Matrix:
    """Omega of Larin (1.1)."""
    return right_matrix(pure(rate))


def error_rate_matrix(rate: sp.Matrix, measured_rate: sp.Matrix) -> sp.Matrix:
    """Omega_e of Larin (1.4)."""
    return right_matrix(pure(measured_rate)) - left_matrix(pure(rate))


def rotation_exponential(rate: sp.Matrix, time: sp.Expr) -> sp.Matrix:
    """Quaternion exp(rate time / 2) of the attitude under a constant rate."""
    norm = sp.sqrt(rate.dot(rate))
    half_angle = norm * time / 2
    return sp.Matrix([*(rate * sp.sin(half_angle) / norm), sp.cos(half_angle)])


def simplified(matrix: sp.Matrix) -> sp.Matrix:
    """Bring every entry to the normal form of a rational expression in roots, sines and cosines."""
    return matrix.applyfunc(sp.cancel)


def skew_operator(k: sp.Matrix, dimension: int = 4) -> sp.Matrix:
    """Skew matrix of a vector in the pattern of Perelyaev & Chelnokov (1.2), scalar last."""
    return right_matrix(pure(k))[:dimension, :dimension]


def cayley_transform(matrix: sp.Matrix) -> sp.Matrix:
    """(I - X)(I + X)^-1; Perelyaev & Chelnokov (1.2)."""
    unit = sp.eye(matrix.rows)
    return (unit - matrix) * (unit + matrix).inv()


def cross_matrix(v: sp.Matrix) -> sp.Matrix:
    """Matrix of the cross product u -> v × u."""
    return sp.Matrix.hstack(*(v.cross(sp.eye(3).col(i)) for i in range(3)))


def rotation_matrix(k: sp.Matrix) -> sp.Matrix:
    """Any rotation of less than half a turn, without sines: rational in three parameters.

    The Cayley transform of order three: body to reference components for k = -tan(phi/2) e, as in
    `driftlab.attitude.cayley.rotation_quaternion` with dimension 3.
    """
    return simplified(cayley_transform(skew_operator(k, dimension=3))).T


def riccati_rate(k: sp.Matrix, rate: sp.Matrix, dimension: int = 4) -> sp.Matrix:
    """Time derivative of k; Perelyaev & Chelnokov (1.11), and its counterpart of dimension 3."""
    if dimension == 3:
        return (k.cross(rate) - k.dot(rate) * k - rate) / 2
    return (k.dot(k) * rate - 2 * k.dot(rate) * k + 2 * k.cross(rate) - rate) / 4

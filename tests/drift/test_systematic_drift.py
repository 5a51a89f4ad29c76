"""Larin, section 2: characteristic equation, exact and asymptotic roots, systematic drift."""

import mpmath
import numpy as np
import pytest
from hypothesis import assume, example, given, strategies as st
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from driftlab.drift.characteristic_equation import (
    asymptotic_roots,
    characteristic_polynomial,
    exact_roots,
    split_error_rate_matrix,
)
from driftlab.drift.error_kinematics import (
    error_quaternion,
    error_rate_matrix,
)
from driftlab.drift.systematic_drift import (
    _exact_drift_coefficient,
    drift_coefficient,
    drift_per_revolution,
    principal_drifts,
)
from driftlab.quaternion import from_rotation_vector, rotate
from driftlab.triad import (
    measured_rate,
    non_orthogonality,
    pairwise_non_orthogonality,
    triad_matrix,
)
from support import EPS, directions, matrices, order_of, vectors

RATE = np.array([0.7, -1.1, 0.4])
SHAPE = np.array([[0.3, -0.8, 0.5], [0.9, -0.2, 0.7], [-0.6, 0.4, 0.1]])
BENT = 0.1 * SHAPE
SKEW = SHAPE - SHAPE.T


def exact_coefficient(direction, error_matrix):
    """|(I + M) n| - 1 with digits enough for M = 1e-300, rounded once."""
    with mpmath.workdps(700):
        n = mpmath.matrix(np.asarray(direction, dtype=float).tolist())
        triad = mpmath.eye(3) + mpmath.matrix(np.asarray(error_matrix, dtype=float).tolist())
        return float(mpmath.norm(triad * n) / mpmath.norm(n) - 1)


# The triad


def test_2_4_rows_are_the_sensitive_axes():
    a2, a3, b1, b3, g1, g2 = 1e-3 * np.arange(1, 7)
    error_matrix = [[0, b1, g1], [a2, 0, g2], [a3, b3, 0]]
    np.testing.assert_array_equal(
        triad_matrix(error_matrix), [[1, b1, g1], [a2, 1, g2], [a3, b3, 1]]
    )


@given(vectors(), matrices(0.3))
def test_1_5_each_gyro_measures_along_its_axis(rate, error_matrix):
    along = [axis @ rate for axis in np.eye(3) + error_matrix]
    np.testing.assert_allclose(measured_rate(rate, error_matrix), along, rtol=0, atol=8 * EPS * 20)


@pytest.mark.parametrize(
    "error_matrix",
    [-np.eye(3), [[0, 0, 0], [1, -1, 0], [0, 0, 0]], [[0, 0, 0], [0, 0, 0], [1, 1, -1]]],
    ids=["nothing measured", "two axes parallel", "three axes in a plane"],
)
def test_singular_triad_is_refused(error_matrix):
    with pytest.raises(ValueError, match=r"^error_matrix: .* got a singular triad matrix I \+ M"):
        triad_matrix(error_matrix)


# Characteristic equation


@given(vectors(), vectors(), st.complex_numbers(max_magnitude=20))
def test_2_1_is_the_determinant(rate, measured, s):
    """det(sE - Omega_e), with two eps^T eps where the copy has one."""
    determinant = np.linalg.det(s * np.eye(4) - error_rate_matrix(rate, measured))
    # Each of the determinant's products is at most (|s| + |w| + |w_hat|)^4.
    size = (abs(s) + np.linalg.norm(rate) + np.linalg.norm(measured)) ** 4
    polynomial = np.polyval(characteristic_polynomial(rate, measured), s)
    assert abs(polynomial - determinant) <= 100 * EPS * size + np.finfo(float).tiny


@given(vectors(), vectors())
def test_2_1_in_the_squares_of_the_two_rates(rate, measured):
    true, apparent = rate @ rate, measured @ measured
    expected = [1, 0, 2 * (true + apparent), 0, (apparent - true) ** 2]
    np.testing.assert_allclose(
        characteristic_polynomial(rate, measured), expected, rtol=0, atol=64 * EPS * 600**2
    )


def test_2_1_in_the_copy_lacks_one_eps_t_eps_in_one_coefficient():
    rate, measured = np.array([1, 2, 3]), np.array([2, 0, 4])  # eps = [1, -2, 1]
    difference = characteristic_polynomial(rate, measured) - characteristic_polynomial(
        rate, measured, as_copied=True
    )
    np.testing.assert_array_equal(difference, [0, 0, 6, 0, 0])


@pytest.mark.parametrize("axis", [RATE, [1, 0, 0], [-1, 2, 3]])
def test_2_1_in_the_copy_has_the_roots_2_2_to_first_order(axis):
    """The missing eps^T eps is of second order in the fast root and of third in the slow one."""

    def error(size, pair):
        measured = measured_rate(axis, size * SHAPE)
        *_, middle, _, constant = characteristic_polynomial(axis, measured, as_copied=True)
        fast = np.sqrt((middle + np.sqrt(middle**2 - 4 * constant)) / 2)
        slow = np.sqrt(constant) / fast
        exact = np.abs(exact_roots(axis, measured)[2 * pair].imag)
        return np.abs((fast, slow)[pair] - exact)

    orders = [order_of(lambda size, pair=pair: error(size, pair)) for pair in (0, 1)]
    np.testing.assert_allclose(orders, [2, 3], atol=0.06)


# Roots


def by_size(roots):
    return np.sort(np.asarray(roots).imag)


@given(vectors(), vectors())
def test_exact_roots_are_the_eigenvalues(rate, measured):
    matrix = error_rate_matrix(rate, measured)
    # Omega_e is skew, so that eigvalsh of -i Omega_e finds its roots to eps |Omega_e|.
    # No entry's square is taken here: rates may be so small that it vanishes.
    bound = 32 * EPS * np.abs(matrix).max()
    np.testing.assert_allclose(
        by_size(exact_roots(rate, measured)), np.linalg.eigvalsh(-1j * matrix), rtol=0, atol=bound
    )


def test_exact_roots_come_in_the_promised_order():
    measured = measured_rate(RATE, BENT)
    w, w_hat = np.linalg.norm(RATE), np.linalg.norm(measured)
    expected = 1j * np.array([w_hat + w, -w_hat - w, w_hat - w, w - w_hat])
    np.testing.assert_allclose(exact_roots(RATE, measured), expected, rtol=0, atol=8 * EPS)


@pytest.mark.parametrize("size", [1e-15, 1e-12, 1e-6, 0.5])
def test_slow_roots_keep_their_digits(size):
    measured = (1 + size) * RATE
    with mpmath.workdps(50):
        norms = [mpmath.norm(mpmath.matrix(vector.tolist())) for vector in (measured, RATE)]
        expected = float(norms[0] - norms[1])
    np.testing.assert_allclose(exact_roots(RATE, measured)[2].imag, expected, rtol=8 * EPS)


@pytest.mark.parametrize("scale", [1e-300, 1e-200, 1e-160, 1e40, 1e49])
def test_roots_scale_with_the_rate(scale):
    measured = measured_rate(RATE, BENT)
    np.testing.assert_allclose(
        exact_roots(scale * RATE, scale * measured) / scale,
        exact_roots(RATE, measured),
        rtol=0,
        atol=8 * EPS,
    )
    np.testing.assert_allclose(
        asymptotic_roots(scale * RATE, BENT) / scale,
        asymptotic_roots(RATE, BENT),
        rtol=8 * EPS,
    )


def test_2_2_first_order():
    """theta = |w| (2 + rho) and rho |w|, rho = mu n^T T n."""
    size = np.linalg.norm(RATE)
    rho = RATE @ BENT @ RATE / size**2
    expected = 1j * size * np.array([2 + rho, -2 - rho, rho, -rho])
    np.testing.assert_allclose(asymptotic_roots(RATE, BENT), expected, rtol=0, atol=8 * EPS)


@pytest.mark.parametrize("order", [1, 2])
def test_2_2_misses_by_the_next_order(order):
    def error(mu):
        exact = exact_roots(RATE, measured_rate(RATE, mu * SHAPE))
        return np.abs(exact - asymptotic_roots(RATE, mu * SHAPE, order=order)).max()

    # Between mu = 2^-6 and 2^-10 the order after next bends the slope by about mu.
    assert order_of(error) == pytest.approx(order + 1, abs=0.03)


def test_2_2_is_off_by_no_more_than_its_bound():
    rng = np.random.default_rng(2)
    bent, n = rng.normal(size=(20000, 3, 3)), rng.normal(size=(20000, 3))
    n /= np.linalg.norm(n, axis=1)[:, np.newaxis]
    m = 10 ** rng.uniform(-6, -0.005, len(n))  # up to 0.99
    bent *= (m / np.linalg.norm(bent, 2, axis=(1, 2)))[:, np.newaxis, np.newaxis]
    error = np.einsum("nij,nj->ni", bent, n)
    rho = np.einsum("ni,ni->n", n, error)
    across = (np.cross(n, error) ** 2).sum(axis=1)
    exact = exact_roots(n, measured_rate(n, bent)).imag
    first, second = (exact - asymptotic_roots(n, bent, order=order).imag for order in (1, 2))
    slack = 16 * EPS  # the roots are of size two and less, known to a few roundings
    for off in (first * [1, -1, 1, -1]).T:
        assert (off >= -slack).all()
        assert (off <= across / (2 * (1 + rho)) + slack).all()
    assert (across / (2 * (1 + rho)) <= m**2 / (2 * (1 - m)) + slack).all()
    assert (np.abs(second).max(axis=1) <= across * m / (2 * (1 - m)) + slack).all()
    # No smaller constant would do: an error that is all across the axis.
    small = 1e-4
    drift = _exact_drift_coefficient([0, 0, 1], [[0, 0, small], [0, 0, 0], [0, 0, 0]])
    assert drift > 0.999 * small**2 / 2


# Drift


@given(directions(), matrices(0.3))
def test_only_the_symmetric_part_drifts(n, error_matrix):
    rho = n @ error_matrix @ n / (n @ n)
    assert drift_coefficient(n, error_matrix) == pytest.approx(rho, abs=16 * EPS)
    sigma = non_orthogonality(error_matrix)
    np.testing.assert_array_equal(sigma, 0.5 * (error_matrix + error_matrix.T))
    assert drift_coefficient(n, sigma) == pytest.approx(rho, abs=16 * EPS)


@given(directions())
def test_a_skew_triad_drifts_at_second_order_only(n):
    assert drift_coefficient(n, SKEW) == pytest.approx(0, abs=16 * EPS)
    across = np.linalg.norm(SKEW @ n / np.linalg.norm(n))
    mu = 2.0**-10
    # sqrt(1 + x) - 1 = x/2 - x^2/8 + ..., x = |mu T n|^2
    assert _exact_drift_coefficient(n, mu * SKEW) == pytest.approx(
        (mu * across) ** 2 / 2, abs=(mu * across) ** 4 / 8 + EPS
    )


@given(directions(), matrices(0.3))
def test_exact_drift_in_every_digit(n, error_matrix):
    expected = exact_coefficient(n, error_matrix)
    # The three terms of |A n|^2 - 1 may cancel; each is rounded at its own size.
    size = np.abs(error_matrix).sum()
    assert _exact_drift_coefficient(n, error_matrix) == pytest.approx(expected, abs=16 * EPS * size)


@pytest.mark.parametrize("size", [1e-300, 1e-15, 1e-12, 1e-6, 0.5, 1e6])
@pytest.mark.filterwarnings("ignore::driftlab.checks.UnusualWarning")
def test_exact_drift_of_any_size_keeps_its_digits(size):
    error_matrix = size * np.array([[1, 2, 0], [0, 1, 3], [1, 0, 1]])
    expected = exact_coefficient([1, 1, 1], error_matrix)
    actual = _exact_drift_coefficient([1, 1, 1], error_matrix)
    np.testing.assert_allclose(actual, expected, rtol=16 * EPS)


@pytest.mark.parametrize("left", [1e-6, 1e-9, 1e-11])
def test_a_triad_that_hardly_sees_the_turn(left):
    """A n = left * n: the drift is minus a whole turn, and `left` of it is still resolved."""
    error_matrix = np.diag([0, 0, left - 1])
    assert _exact_drift_coefficient([0, 0, 1], error_matrix) + 1 == pytest.approx(left, abs=2 * EPS)


@pytest.mark.parametrize("turns", [1, 2, 7, -3])
@given(rate=directions(), error_matrix=matrices(0.3))
@example(rate=RATE, error_matrix=BENT)  # drifts backwards
def test_2_3_after_whole_turns_the_error_is_drift_alone(turns, rate, error_matrix):
    """t_j = 2 pi j/|w|, with the factor j that the paper lacks."""
    measured = measured_rate(rate, error_matrix)
    time = 2 * np.pi * turns / np.linalg.norm(rate)
    _, drifting = split_error_rate_matrix(rate, measured)
    bound = 128 * abs(turns) * EPS  # angles up to 4 pi j carry a few eps each
    np.testing.assert_allclose(
        expm(0.5 * time * error_rate_matrix(rate, measured)),
        expm(0.5 * time * drifting),
        rtol=0,
        atol=8 * bound,  # each squaring in expm doubles the error of an approximant
    )
    axis = measured / np.linalg.norm(measured)
    np.testing.assert_allclose(
        error_quaternion(rate, measured, time),
        from_rotation_vector(turns * drift_per_revolution(rate, error_matrix) * axis),
        rtol=0,
        atol=bound,
    )


@given(directions(), directions())
def test_split_is_exact_commutes_and_is_periodic(rate, measured):
    """Omega_e = V + W, VW = WV, exp(V pi/|w|) = I; Larin, between (2.2) and (2.3)."""
    periodic, drifting = split_error_rate_matrix(rate, measured)
    size = np.linalg.norm(rate) + np.linalg.norm(measured)
    whole = error_rate_matrix(rate, measured)
    np.testing.assert_allclose(periodic + drifting, whole, rtol=0, atol=8 * EPS * size)
    np.testing.assert_allclose(
        periodic @ drifting, drifting @ periodic, rtol=0, atol=16 * EPS * size**2
    )
    turn = expm(periodic * np.pi / np.linalg.norm(rate))
    np.testing.assert_allclose(turn, np.eye(4), rtol=0, atol=200 * EPS)


@given(directions(), directions())
def test_split_has_the_roots_that_the_paper_gives(rate, measured):
    """V: +-2i|w| and twice zero; W: +-i(|w_hat| - |w|), twice."""
    w = np.linalg.norm(rate)
    drift = np.abs(exact_roots(rate, measured)[2].imag)
    periodic, drifting = split_error_rate_matrix(rate, measured)
    for matrix, expected in (
        (periodic, [-2 * w, 0, 0, 2 * w]),
        (drifting, [-drift, -drift, drift, drift]),
    ):
        roots = np.linalg.eigvalsh(-1j * matrix)
        bound = 32 * EPS * (w + np.linalg.norm(measured))
        np.testing.assert_allclose(roots, expected, rtol=0, atol=bound)


# Non-orthogonality


@pytest.mark.parametrize("sigma", [1e-2, 1e-3, 1e-4, -1e-3])
def test_2_6_nu_is_2_sqrt2_pi_chi_to_first_order(sigma):
    """All six off-diagonals sigma: largest rho 2 sigma, about the space diagonal."""
    error_matrix = sigma * (np.ones((3, 3)) - np.eye(3))
    coefficients, axes = principal_drifts(error_matrix)
    largest = np.abs(coefficients).argmax()
    assert coefficients[largest] == pytest.approx(2 * sigma, abs=4 * EPS)
    np.testing.assert_allclose(axes[largest], np.ones(3) / np.sqrt(3), rtol=0, atol=16 * EPS)

    i_x = triad_matrix(error_matrix)[0]
    chi = np.copysign(np.arctan2(np.linalg.norm(i_x[1:]), i_x[0]), sigma)
    nu = drift_per_revolution(axes[largest], error_matrix)
    # nu = 4 pi sigma and tan(chi) = sqrt2 sigma, so that nu/chi misses by 2/3 sigma^2.
    assert nu / (2 * np.sqrt(2) * np.pi * chi) == pytest.approx(1, abs=sigma**2)


def test_2_6_is_off_by_no_more_than_its_bound():
    rng = np.random.default_rng(3)
    sigma = rng.choice([-1, 1], 2000) * 10 ** rng.uniform(-5, -0.31, 2000)  # up to 0.49
    chi = np.arctan(np.sqrt(2) * sigma)
    linear = sigma[:, np.newaxis, np.newaxis] * (np.ones((3, 3)) - np.eye(3))
    unit = (np.eye(3) + linear) * np.cos(chi)[:, np.newaxis, np.newaxis] - np.eye(3)
    for bent, bound in (
        (linear, 8 / 3 * np.pi * np.abs(sigma) ** 3),
        (unit, 2 * np.pi * (chi**2 / 2 + np.sqrt(2) * np.abs(chi) ** 3 / 6)),
    ):
        coefficients, _ = principal_drifts(bent, exact=True)
        places = np.abs(coefficients).argmax(axis=-1)[:, np.newaxis]
        nu = 2 * np.pi * np.take_along_axis(coefficients, places, axis=-1)[:, 0]
        off = np.abs(nu - 2 * np.sqrt(2) * np.pi * chi)
        # The entries of I + M are rounded at one, and so is each eigenvalue.
        assert (off <= bound + 2 * np.pi * 32 * EPS).all()
        small = (sigma > 1e-3) & (sigma < 0.1)
        assert (off[small] > 0.95 * bound[small]).all()


def test_2_6_has_its_bound_down_to_the_lean_at_which_the_drift_turns_back():
    """Unit axes that lean by -50 to 80 degrees, about the space diagonal."""
    chi = np.radians(np.arange(-50, 81))
    sigma = np.tan(chi) / np.sqrt(2)
    unit = np.cos(chi) * (1 + 2 * sigma)  # n^T A n, and A n is along n
    off = np.abs(2 * np.pi * (np.abs(unit) - 1) - 2 * np.sqrt(2) * np.pi * chi)
    bound = 2 * np.pi * (chi**2 / 2 + np.sqrt(2) * np.abs(chi) ** 3 / 6)
    inside = sigma > -0.5
    np.testing.assert_array_equal(inside, chi > np.radians(-35.2))
    assert (off <= bound + 1e-12)[inside].all()
    assert (off > bound)[chi < np.radians(-45.6)].all()


@given(matrices(0.1), directions())
def test_principal_drifts_bound_every_axis(error_matrix, n):
    coefficients, axes = principal_drifts(error_matrix)
    rho = drift_coefficient(n, error_matrix)
    assert coefficients[0] - 16 * EPS <= rho <= coefficients[2] + 16 * EPS
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), rtol=0, atol=32 * EPS)
    np.testing.assert_allclose(
        drift_coefficient(axes, error_matrix), coefficients, rtol=0, atol=32 * EPS
    )
    assert (axes.max(axis=1) == np.abs(axes).max(axis=1)).all()


@given(directions(), directions(), directions())
def test_pairwise_non_orthogonality_sees_the_angle_and_nothing_else(x, y, z):
    """|i_x - i_y|^2 = 2 - 2 cos, so that sigma = 1 - sqrt(1 - cos)."""
    x, y, z = units = [axis / np.linalg.norm(axis) for axis in (x, y, z)]
    cosines = np.minimum([x @ y, x @ z, y @ z], 1)
    # The root magnifies an error of the cosine, so compare squares.
    squares = (1 - pairwise_non_orthogonality(units)) ** 2
    np.testing.assert_allclose(squares, 1 - cosines, rtol=0, atol=16 * EPS)


def test_pairwise_non_orthogonality_is_sigma_to_first_order():
    shape = SHAPE - np.diag(np.diag(SHAPE))

    def error(mu):
        triad = triad_matrix(mu * shape)
        axes = triad / np.linalg.norm(triad, axis=1, keepdims=True)
        sigma = non_orthogonality(mu * shape)[[0, 0, 1], [1, 2, 2]]
        return np.abs(pairwise_non_orthogonality(axes) - sigma).max()

    assert order_of(error) == pytest.approx(2, abs=0.03)


def test_axes_must_be_unit_vectors():
    with pytest.raises(ValueError, match=r"^axes: expected rows of unit length"):
        pairwise_non_orthogonality(np.diag([1, 1, 1.001]))


@given(matrices(0.3))
def test_exact_principal_drifts_are_the_singular_values_less_one(error_matrix):
    coefficients, axes = principal_drifts(error_matrix, exact=True)
    singular = np.linalg.svd(np.eye(3) + error_matrix, compute_uv=False)[::-1]
    # The squares are exact to rounding; the root divides by twice the singular value.
    assume(singular[0] > 1e-2)
    np.testing.assert_allclose(coefficients, singular - 1, rtol=0, atol=1e3 * EPS)
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), rtol=0, atol=16 * EPS)
    at_axes = _exact_drift_coefficient(axes, error_matrix)
    np.testing.assert_allclose(at_axes, coefficients, rtol=0, atol=1e3 * EPS)


@given(directions(), matrices(0.3))
def test_rate_error_is_fixed_in_the_body_and_turns_with_it(rate, error_matrix):
    """In N it goes round omega; of its sum over a turn only the part along omega is left."""
    count, size = 64, np.linalg.norm(rate)
    times = 2 * np.pi / size * np.arange(count) / count
    error = measured_rate(rate, error_matrix) - rate
    in_fixed_frame = rotate(from_rotation_vector(rate * times[:, np.newaxis]), error)
    turned = Rotation.from_rotvec(rate * times[:, np.newaxis]).apply(error)
    np.testing.assert_allclose(in_fixed_frame, turned, rtol=0, atol=16 * EPS * size)
    along = drift_coefficient(rate, error_matrix) * rate
    np.testing.assert_allclose(in_fixed_frame.mean(axis=0), along, rtol=0, atol=count * EPS * size)


@given(directions(), matrices(0.3))
def test_roots_and_drift_agree(rate, error_matrix):
    slow, size = exact_roots(rate, measured_rate(rate, error_matrix))[2].imag, np.linalg.norm(rate)
    drift = _exact_drift_coefficient(rate, error_matrix) * size
    assert slow == pytest.approx(drift, abs=16 * EPS * size)

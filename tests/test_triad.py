"""Wu et al., sections 2 and 3: the parts of an error matrix, and the choice of body axes."""

import numpy as np
import pytest
import scipy.linalg
from hypothesis import given, strategies as st
from scipy.spatial.transform import Rotation

from driftlab.body_frames import (
    BODY_FRAMES,
    GYRO_FRAMES,
    body_frame_rotation,
    change_body_frame,
    misalignment_vector,
)
from driftlab.drift.systematic_drift import drift_coefficient, principal_drifts
from driftlab.triad import non_orthogonality, split_error_matrix
from driftlab.vectors import cross_matrix
from support import EPS, directions, matrices, order_of, quaternions, vectors

IDENTITY = np.eye(3)
BENT = np.array([[0.03, -0.08, 0.05], [0.09, -0.02, 0.07], [-0.06, 0.04, 0.01]])
OTHER = np.array([[-0.05, 0.02, 0.09], [0.03, 0.06, -0.04], [0.08, 0.01, -0.07]])

every_frame = pytest.mark.parametrize("frame", BODY_FRAMES)
# Rows of I + K then have more on the diagonal than beside it: right-handed, far from flat.
bent = matrices(0.2)
ANGLES = st.floats(-0.5, 0.5)


def in_frame(matrix, frame):
    """The matrix as both triads of a unit, in the axes of a frame, and the rotation there."""
    rotation = body_frame_rotation(matrix, matrix, frame)
    return change_body_frame(matrix, rotation), rotation


# The split (7)-(15)


@given(matrices(0.5))
def test_parts_are_diagonal_symmetric_and_skew(matrix):
    scale, symmetric, skew = split_error_matrix(matrix)
    np.testing.assert_array_equal(scale, np.diag(np.diag(matrix)))
    np.testing.assert_array_equal(symmetric, symmetric.T)
    np.testing.assert_array_equal(np.diag(symmetric), 0)
    np.testing.assert_array_equal(skew, -skew.T)


@given(vectors(1.0), vectors(1.0), vectors(1.0))
def test_any_three_such_matrices_are_the_parts_of_their_sum(diagonal, pairs, vector):
    x, y, z = pairs
    whole = (np.diag(diagonal), np.array([[0, x, y], [x, 0, z], [y, z, 0]]), cross_matrix(vector))
    for found, expected in zip(split_error_matrix(sum(whole)), whole, strict=True):
        np.testing.assert_allclose(found, expected, rtol=0, atol=4 * EPS)


@given(matrices(0.5))
def test_parts_are_orthogonal_to_each_other(matrix):
    parts = np.array(split_error_matrix(matrix)).reshape(3, 9)
    products = parts @ parts.T
    # Sums of nine products of numbers up to 1.
    np.testing.assert_allclose(products, np.diag(np.diag(products)), rtol=0, atol=16 * EPS)
    assert np.trace(products) == pytest.approx((matrix**2).sum(), abs=16 * EPS)


@given(matrices(0.5), vectors())
def test_misalignment_is_a_cross_product(matrix, rate):
    np.testing.assert_allclose(
        split_error_matrix(matrix).misalignment @ rate,
        np.cross(misalignment_vector(matrix), rate),
        rtol=0,
        atol=64 * EPS,  # three products of numbers up to 1 and 10
    )


@given(matrices(0.5), directions())
def test_symmetric_parts_are_larins_sigma_and_drift_alone(matrix, n):
    """The bridge to Part I: of the three parts only the misalignment does not drift."""
    scale, symmetric, skew = split_error_matrix(matrix)
    np.testing.assert_allclose(scale + symmetric, non_orthogonality(matrix), rtol=0, atol=2 * EPS)
    assert drift_coefficient(n, skew) == pytest.approx(0, abs=16 * EPS)
    assert drift_coefficient(n, scale + symmetric) == pytest.approx(
        float(drift_coefficient(n, matrix)), abs=16 * EPS
    )


# The small rotation to the chosen axes (40), (42)


@given(matrices(0.5))
def test_subtracting_the_rotation_leaves_what_the_frame_allows(matrix):
    def rest(frame):
        return matrix - cross_matrix(misalignment_vector(matrix, frame=frame))

    np.testing.assert_allclose(split_error_matrix(rest("averaged")).misalignment, 0, atol=2 * EPS)
    np.testing.assert_array_equal(np.triu(rest("upper triangle"), 1), 0)
    np.testing.assert_array_equal(np.tril(rest("lower triangle"), -1), 0)


@given(matrices(0.5))
def test_averaged_is_the_mean_of_the_two_triangles(matrix):
    both = [misalignment_vector(matrix, frame=f"{side} triangle") for side in ("upper", "lower")]
    np.testing.assert_allclose(misalignment_vector(matrix), sum(both) / 2, rtol=0, atol=2 * EPS)


def test_averaging_halves_the_three_gyro_parameters():
    """The usual choice keeps sums of opposite entries, the new one half of them."""
    usual = BENT - cross_matrix(misalignment_vector(BENT, frame="upper triangle"))
    new = BENT - cross_matrix(misalignment_vector(BENT))
    np.testing.assert_allclose(np.tril(usual, -1), np.tril(BENT + BENT.T, -1), atol=EPS)
    np.testing.assert_allclose(np.tril(new, -1), np.tril(usual, -1) / 2, atol=EPS)


@pytest.mark.parametrize("function", [misalignment_vector, body_frame_rotation])
def test_only_the_frames_of_the_accelerometers_ask_for_them(function):
    for theirs, of_gyros in (
        ("accelerometers", "upper triangle"),
        ("averaged accelerometers", "averaged"),
    ):
        expected = function(OTHER, frame=of_gyros)
        np.testing.assert_array_equal(function(BENT, OTHER, theirs), expected)
    for frame in GYRO_FRAMES:
        np.testing.assert_array_equal(function(BENT, OTHER, frame), function(BENT, frame=frame))
    np.testing.assert_array_equal(function(BENT), function(BENT, frame="averaged"))


@every_frame
def test_small_rotation_is_the_exact_one_to_first_order(frame):
    def error(size):
        rotation = body_frame_rotation(size * BENT, size * OTHER, frame)
        small = misalignment_vector(size * BENT, size * OTHER, frame)
        return np.abs(Rotation.from_matrix(rotation).as_rotvec() - small).max()

    assert order_of(error) == pytest.approx(2, abs=0.02)


# The exact rotation


@every_frame
@given(matrix=bent)
def test_body_frame_rotation_is_a_rotation(frame, matrix):
    rotation = body_frame_rotation(matrix, matrix, frame)
    # LAPACK's orthogonal factors are good to some eps.
    np.testing.assert_allclose(rotation @ rotation.T, IDENTITY, rtol=0, atol=32 * EPS)
    assert np.linalg.det(rotation) == pytest.approx(1, abs=32 * EPS)


@every_frame
@given(matrix=bent)
def test_changed_matrix_is_symmetric_or_triangular(frame, matrix):
    changed, _ = in_frame(matrix, frame)
    zeros = {
        "averaged": changed - changed.T,
        "upper triangle": np.triu(changed, 1),
        "lower triangle": np.tril(changed, -1),
        "accelerometers": np.triu(changed, 1),
        "averaged accelerometers": changed - changed.T,
    }[frame]
    # LAPACK's factors multiply to the triad within some tens of eps.
    np.testing.assert_allclose(zeros, 0, atol=64 * EPS)
    # No axis turned round; for averaged axes all eigenvalues, which are the diagonal elsewhere.
    assert (np.linalg.eigvals(IDENTITY + changed).real > 0).all()


@given(bent)
def test_rotations_are_those_of_scipys_decompositions(matrix):
    triad = IDENTITY + matrix
    # Neighbours of triads with singular values above 0.4: conditions of at most 4.
    close = {"rtol": 0, "atol": 64 * EPS}
    polar, _ = scipy.linalg.polar(triad, side="left")
    np.testing.assert_allclose(body_frame_rotation(matrix), polar, **close)
    upper, orthogonal = scipy.linalg.rq(triad)
    signs = np.sign(np.diag(upper))[:, np.newaxis]
    found = body_frame_rotation(matrix, frame="lower triangle")
    np.testing.assert_allclose(found, signs * orthogonal, **close)
    # Cholesky's factor of A A^T is triangular and positive, so what is left of A is the rotation.
    factor = scipy.linalg.cholesky(triad @ triad.T, lower=True)
    found = body_frame_rotation(matrix, frame="upper triangle")
    np.testing.assert_allclose(found, np.linalg.solve(factor, triad), **close)


@every_frame
@given(q=quaternions())
def test_triad_that_is_turned_only_comes_out_straight(frame, q):
    """However far: nothing here is small."""
    turn = Rotation.from_quat(q).as_matrix()
    changed, rotation = in_frame(turn - IDENTITY, frame)
    np.testing.assert_allclose(rotation, turn, rtol=0, atol=16 * EPS)
    np.testing.assert_allclose(changed, 0, atol=16 * EPS)


@every_frame
@given(matrix=bent, q=quaternions())
def test_result_does_not_depend_on_the_axes_at_hand(frame, matrix, q):
    turned = change_body_frame(matrix, Rotation.from_quat(q).as_matrix())
    changed, rotation = in_frame(turned, frame)
    expected, first = in_frame(matrix, frame)
    np.testing.assert_allclose(changed, expected, rtol=0, atol=64 * EPS)
    # The rotation undoes the turn first.
    undone = first @ Rotation.from_quat(q).as_matrix().T
    np.testing.assert_allclose(rotation, undone, rtol=0, atol=64 * EPS)
    _, again = in_frame(changed, frame)
    np.testing.assert_allclose(again, IDENTITY, rtol=0, atol=64 * EPS)


@given(st.floats(-1.4, 1.4), st.floats(-0.7, 0.7))
def test_plane_triad_is_turned_by_the_mean_of_its_two_angles(mean, half):
    """Wu (43), (44), exactly: x and y gyros turned about the third axis until they are parallel."""
    x, y = mean + half, mean - half
    matrix = np.array([[np.cos(x), np.sin(x), 0], [-np.sin(y), np.cos(y), 0], [0, 0, 1]]) - IDENTITY
    for frame, angle in (("averaged", (x + y) / 2), ("upper triangle", x), ("lower triangle", y)):
        rotation = body_frame_rotation(matrix, frame=frame)
        # Components turn backwards when the axes turn forwards; the third axis stays.
        found = Rotation.from_matrix(rotation).as_rotvec()
        np.testing.assert_allclose(found, [0, 0, -angle], rtol=0, atol=64 * EPS)
    parts = split_error_matrix(in_frame(matrix, "averaged")[0])
    assert parts.non_orthogonality[0, 1] == pytest.approx(np.sin(half), abs=16 * EPS)
    expected = np.diag([np.cos(half) - 1, np.cos(half) - 1, 0])
    np.testing.assert_allclose(parts.scale_factor, expected, rtol=0, atol=16 * EPS)


@given(bent)
def test_averaged_axes_show_the_principal_drifts(matrix):
    """Polar and singular value decompositions belong together."""
    changed, rotation = in_frame(matrix, "averaged")
    coefficients, axes = principal_drifts(matrix, exact=True)
    np.testing.assert_allclose(np.linalg.eigvalsh(changed), coefficients, rtol=0, atol=64 * EPS)
    # Each principal axis, in the new components, is stretched by its coefficient.
    stretched = axes @ rotation.T @ changed.T
    expected = coefficients[:, np.newaxis] * (axes @ rotation.T)
    np.testing.assert_allclose(stretched, expected, rtol=0, atol=64 * EPS)


@given(matrix=bent, q=quaternions())
def test_no_other_axes_leave_a_smaller_matrix_than_averaged_ones(matrix, q):
    least = np.linalg.norm(in_frame(matrix, "averaged")[0])
    other = change_body_frame(matrix, Rotation.from_quat(q).as_matrix())
    assert least <= np.linalg.norm(other) + 16 * EPS


@every_frame
def test_triad_that_is_nearly_flat_has_axes(frame):
    _, rotation = in_frame(np.diag([0.0, 0.0, 1e-6 - 1]), frame)
    np.testing.assert_allclose(rotation, IDENTITY, rtol=0, atol=16 * EPS)


# A change of axes


@given(matrices(0.5), quaternions(), vectors())
def test_triad_says_the_same_of_the_same_rate_in_any_axes(matrix, q, rate):
    rotation = Rotation.from_quat(q).as_matrix()
    changed = change_body_frame(matrix, rotation)
    np.testing.assert_allclose(
        (IDENTITY + changed) @ (rotation @ rate), (IDENTITY + matrix) @ rate, rtol=0, atol=512 * EPS
    )


# Refusals


@pytest.mark.parametrize("function", [misalignment_vector, body_frame_rotation])
def test_accelerometers_that_are_missing_are_refused(function):
    words = "^accelerometer_error_matrix: expected the matrix that fixes the axes, got None"
    with pytest.raises(ValueError, match=words):
        function(BENT, frame="accelerometers")


@every_frame
@pytest.mark.parametrize(
    "triad",
    [np.diag([1.0, 1.0, -1.0]), np.diag([1.0, 1.0, 0.0]), IDENTITY[[1, 0, 2]], np.ones((3, 3))],
    ids=["turned round", "flat", "swapped", "all alike"],
)
def test_triads_that_are_left_handed_or_flat_are_refused(frame, triad):
    of_accelerometers = "accelerometers" in frame
    name = "accelerometer_error_matrix" if of_accelerometers else "gyro_error_matrix"
    # One bad triad among good ones.
    many = np.stack([BENT, triad - IDENTITY])
    with pytest.raises(
        ValueError, match=rf"^{name}: expected a right-handed triad I \+ K, got a left-handed or a "
    ):
        body_frame_rotation(*((BENT, many) if of_accelerometers else (many,)), frame=frame)


def test_an_attitude_error_known_at_three_attitudes_shows_the_misalignment():
    """phi(t) - phi(0) = (C(t) - C(0)) kappa: what navigation alone, as Wu says, cannot separate."""
    kappa = np.array([2e-4, -3e-4, 1e-4])
    first = Rotation.from_rotvec([0.3, -0.2, 0.5])
    attitudes, errors = [first.as_matrix()], [np.zeros(3)]
    for axis in np.eye(3)[:2]:
        begin, turn = attitudes[-1], (np.pi / 2) * axis
        # phi' = -C (kappa × omega), by the midpoint rule over a quarter turn in many steps.
        parts = (np.arange(2000) + 0.5) / 2000
        on_the_way = begin @ Rotation.from_rotvec(np.outer(parts, turn)).as_matrix()
        driven = -(on_the_way @ np.cross(kappa, turn)).mean(axis=0)
        attitudes.append(begin @ Rotation.from_rotvec(turn).as_matrix())
        errors.append(errors[-1] + driven)
    design = np.vstack([attitude - attitudes[0] for attitude in attitudes[1:]])
    assert np.linalg.matrix_rank(design) == 3
    again = (first * Rotation.from_rotvec([1, 0, 0])).as_matrix()  # about the same line
    assert np.linalg.matrix_rank(np.vstack([design[:3], again - attitudes[0]])) == 2
    found = np.linalg.lstsq(design, np.concatenate(errors[1:]), rcond=None)[0]
    np.testing.assert_allclose(found, kappa, rtol=1e-6)


@given(matrices(0.5))
def test_parts_add_up_to_the_matrix(matrix):
    # Halves of entries up to 1/2, added and subtracted.
    np.testing.assert_allclose(sum(split_error_matrix(matrix)), matrix, rtol=0, atol=2 * EPS)


@given(vectors(), vectors())
def test_skew_matrix_is_the_cross_product(vector, other):
    np.testing.assert_allclose(
        cross_matrix(vector) @ other, np.cross(vector, other), rtol=0, atol=400 * EPS
    )

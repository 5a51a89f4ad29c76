"""Drift over closed motions: against quadrature, SciPy's rotations, whole turns, and by order."""

import itertools

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.spatial.transform import Rotation

from driftlab.drift.closed_motion import drift_per_cycle, exact_drift_per_cycle
from driftlab.drift.systematic_drift import drift_coefficient, drift_per_revolution
from driftlab.earth import EARTH_RATE
from driftlab.motion import Coning
from driftlab.vectors import cross_matrix
from support import EPS, directions, matrices, order_of, quaternions, vectors

SHAPE = np.array([[0.3, -0.8, 0.5], [0.9, -0.2, 0.7], [-0.6, 0.4, 0.1]])
TUMBLE = np.pi / 2 * np.tile([[1, 0, 0], [0, 1, 0]], (3, 1))
WAY = np.array([[0.3, -1.0, 0.2], [2.0, 0.4, -0.5], [-0.1, 0.7, 1.9]])
"""Some way out; `closed` finds the way home."""


def closed(way):
    """The way, and the one turn that brings the body back."""
    there = Rotation.identity()
    for turn in way:
        there = there * Rotation.from_rotvec(turn)
    return np.vstack([way, there.inv().as_rotvec()])


def cone(half_angle, samples=360):
    return Coning(half_angle, 1.0).increments(1 / samples, samples)


MOTIONS = {"turn": [[0, 0, 2 * np.pi]], "tumble": TUMBLE, "way": closed(WAY), "cone": cone(0.5)}
every_motion = pytest.mark.parametrize("increments", MOTIONS.values(), ids=MOTIONS)


def apparent(increments, error_matrix):
    """What SciPy makes of the measured increments."""
    attitude = Rotation.identity()
    for turn in np.asarray(increments) @ (np.eye(3) + error_matrix).T:
        attitude = attitude * Rotation.from_rotvec(turn)
    return attitude


@given(directions(), matrices(1e-2))
def test_whole_turn_is_larins_drift(direction, error_matrix):
    n = direction / np.linalg.norm(direction)
    turn = 2 * np.pi * n[np.newaxis]
    expected = 2 * np.pi * drift_coefficient(n, error_matrix) * n
    np.testing.assert_allclose(drift_per_cycle(turn, error_matrix), expected, atol=1e-15)
    size = np.linalg.norm(exact_drift_per_cycle(turn, error_matrix))
    np.testing.assert_allclose(size, abs(drift_per_revolution(n, error_matrix)), atol=1e-14)


@given(st.lists(vectors(3.0), min_size=1, max_size=6), vectors(1.0))
def test_skew_part_leaves_nothing_on_any_closed_motion(way, kappa):
    drift = drift_per_cycle(closed(way), cross_matrix(kappa))
    np.testing.assert_allclose(drift, 0, atol=1e-13)


@pytest.mark.filterwarnings("ignore::driftlab.checks.UnusualWarning")  # it may be turned far
@given(st.lists(vectors(3.0), min_size=1, max_size=6), quaternions())
def test_rotated_block_leaves_exactly_nothing(way, attitude):
    rotated = Rotation.from_quat(attitude).as_matrix() - np.eye(3)
    for increments in (TUMBLE, closed(way)):
        np.testing.assert_allclose(exact_drift_per_cycle(increments, rotated), 0, atol=1e-13)


@every_motion
def test_first_order_differs_from_exact_in_second(increments):
    order = order_of(
        lambda size: np.linalg.norm(
            exact_drift_per_cycle(increments, size * SHAPE)
            - drift_per_cycle(increments, size * SHAPE)
        )
    )
    assert abs(order - 2) < 0.05


@every_motion
def test_exact_drift_is_that_of_scipys_rotations(increments):
    expected = apparent(increments, 0.02 * SHAPE)
    true = apparent(increments, np.zeros((3, 3)))
    np.testing.assert_allclose(
        exact_drift_per_cycle(increments, 0.02 * SHAPE),
        (expected * true.inv()).as_rotvec(),
        rtol=0,
        atol=4 * (len(increments) + np.abs(increments).sum()) * EPS,  # steps, and what they turn
    )


def test_repeated_motion_drifts_in_proportion():
    once = exact_drift_per_cycle(TUMBLE, 0.01 * SHAPE)
    for times in (2, 5, 20):
        repeated = exact_drift_per_cycle(np.tile(TUMBLE, (times, 1)), 0.01 * SHAPE)
        np.testing.assert_allclose(repeated, times * once, rtol=0, atol=1e-13)


def test_a_motion_that_the_earth_keeps_open_is_refused_with_its_cure():
    turning = np.diff(np.sin(np.arange(61) * np.pi / 30))[:, np.newaxis] * [0.0, 0.2, 0.0]
    drift_per_cycle(turning, SHAPE)
    on_earth = turning + EARTH_RATE * np.array([0.0, 0.6, 0.8])  # a minute
    with pytest.raises(ValueError, match=r"ends 0\.004\d* rad .*; on the Earth take its rate off"):
        drift_per_cycle(on_earth, SHAPE)


@pytest.mark.parametrize("half_angle", [0.1, 0.6, 2.0])
def test_cone_has_the_drift_in_closed_form(half_angle):
    """Integrated in SymPy, in the axes of the cone; the body leans about axis 1 at the start."""
    (s11, _, s13), (_, s22, s23), (s31, s32, s33) = SHAPE
    sine, cosine = np.sin(half_angle), np.cos(half_angle)
    of_cone = np.pi * np.array(
        [
            -(s13 + s31) * sine**2,
            -(s23 + s32) * sine**2,
            (s11 + s22) * sine**2 - 2 * s33 * cosine * (1 - cosine),
        ]
    )
    expected = Rotation.from_rotvec([-half_angle, 0, 0]).apply(of_cone)
    samples = 720
    found = drift_per_cycle(cone(half_angle, samples), SHAPE, tolerance=1e-2)
    # The increments leave out how the axis moves within a sample: second order in its angle.
    bound = 3 * (2 * np.pi / samples) ** 2
    np.testing.assert_allclose(found, expected, rtol=0, atol=bound * np.linalg.norm(SHAPE))


def test_continuous_motion_against_quadrature():
    """The integral of C M rate over a period, by the trapezoidal rule of a periodic function."""
    motion, samples = Coning(0.4, 2.0), 1440
    time = np.arange(64) / 128
    rate = motion.rate(time) @ SHAPE.T
    mean = Rotation.from_quat(motion.attitude(time)).apply(rate).mean(axis=0) / 2
    expected = Rotation.from_quat(motion.attitude(0.0)).inv().apply(mean)
    found = drift_per_cycle(motion.increments(0.5 / samples, samples), SHAPE)
    # Second order in the angle of the cone that one increment covers.
    np.testing.assert_allclose(found, expected, rtol=0, atol=(2 * np.pi / samples) ** 2)


@given(st.integers(0, 1000), matrices(0.3))
def test_small_motion_counts_by_the_area_of_its_rotation_vector(seed, error_matrix):
    """(tr M I - M - M^T) times the area that the rotation vector goes round, on any closed way."""
    size, waves = 1e-3, np.outer(np.linspace(0, 2 * np.pi, 97), [1, 2, 3])
    there, back = np.random.default_rng(seed).normal(size=(2, 3, 3))
    path = size / 4 * (np.cos(waves) @ there + np.sin(waves) @ back)  # not in one plane
    attitudes = Rotation.from_rotvec(path)
    motion = (attitudes[:-1].inv() * attitudes[1:]).as_rotvec()
    area = np.cross(path[:-1], path[1:]).sum(axis=0) / 2
    matrix = np.trace(error_matrix) * np.eye(3) - error_matrix - error_matrix.T
    drift = attitudes[0].apply(drift_per_cycle(motion, error_matrix))
    # What is left is of the third power of the size.
    np.testing.assert_allclose(drift, matrix @ area, rtol=0, atol=100 * size**3)


def test_leading_axes_broadcast_and_arguments_stay():
    motions = np.stack([closed(WAY), closed(WAY[::-1])])
    errors = np.array([0.1, 0.2, 0.3])[:, np.newaxis, np.newaxis, np.newaxis] * SHAPE
    motions.setflags(write=False)
    errors.setflags(write=False)
    for function in (drift_per_cycle, exact_drift_per_cycle):
        together = function(motions, errors)
        assert together.shape == (3, 2, 3)
        for i, j in np.ndindex(3, 2):
            alone = function(motions[j], errors[i, 0])
            np.testing.assert_allclose(together[i, j], alone, rtol=0, atol=1e-14)


@pytest.mark.parametrize("function", [drift_per_cycle, exact_drift_per_cycle])
@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (([0, 0, 6.28], SHAPE), r"increments: expected shape \(\.\.\., n, 3\), got shape \(3,\)"),
        (([[0, 0, 0]], np.zeros(3)), "error_matrix: expected shape"),
        (
            (WAY, SHAPE),
            r"increments: .*closes to 0\.0001 rad, got one that ends 3\.1 rad from where.*began\.$",
        ),
        ((np.zeros((2, 4, 3)), np.zeros((3, 3, 3))), "increments, error_matrix: expected leading"),
    ],
)
def test_refusals(function, arguments, sentence):
    with pytest.raises(ValueError, match=f"^{sentence}"):
        function(*arguments)


def test_each_of_several_motions_must_close():
    open_motion = np.zeros((len(WAY) + 1, 3))
    open_motion[0, 0] = 1e-3
    with pytest.raises(ValueError, match=r"got one that ends 0\.001 rad from where it began"):
        drift_per_cycle([closed(WAY), open_motion], SHAPE)


def test_tolerance_is_the_callers():
    coarse = cone(0.5, samples=36)
    with pytest.raises(ValueError, match="expected a motion that closes"):
        drift_per_cycle(coarse, SHAPE)
    assert drift_per_cycle(coarse, SHAPE, tolerance=0.02).shape == (3,)
    with pytest.raises(ValueError, match=r"^tolerance: expected a positive number"):
        drift_per_cycle(coarse, SHAPE, tolerance=0)


def test_flat_triad_is_refused():
    with pytest.raises(ValueError, match=r"^error_matrix: expected three sensitive axes"):
        exact_drift_per_cycle(TUMBLE, np.diag([0.0, 0.0, -1.0]))


def test_the_area_law_is_off_by_no_more_than_its_bound():
    rng, phases = np.random.default_rng(6), np.linspace(0, 2 * np.pi, 2001)[:, np.newaxis]
    for size, m in itertools.product(np.geomspace(0.01, 2, 12), (1e-5, 1e-3, 0.1)):
        sines, cosines = size * rng.normal(size=(2, 3, 3)) / np.arange(1, 4)[:, np.newaxis]
        theta = sum(
            sines[k - 1] * np.sin(k * phases) + cosines[k - 1] * (np.cos(k * phases) - 1)
            for k in (1, 2, 3)
        )
        attitude = Rotation.from_rotvec(theta)
        motion = (attitude[:-1].inv() * attitude[1:]).as_rotvec()
        matrix = rng.normal(size=(3, 3))
        matrix *= m / np.linalg.norm(matrix, 2)
        pieces, middle = np.diff(theta, axis=0), (theta[1:] + theta[:-1]) / 2
        area = np.cross(middle, pieces).sum(axis=0) / 2
        law = (np.trace(matrix) * np.eye(3) - matrix - matrix.T) @ area
        lengths = np.linalg.norm(pieces, axis=1)
        s = np.linalg.norm(matrix + matrix.T, 2) / 2
        first = 7 / 6 * s * ((middle**2).sum(axis=1) * lengths).sum()
        # Some roundings of 2000 increments; the chords of the curve are 1e-6 shorter than it.
        assert np.linalg.norm(drift_per_cycle(motion, matrix) - law) < first + 1e-13 * size
        error = Rotation.from_rotvec(exact_drift_per_cycle(motion, matrix)).as_matrix()
        off = np.linalg.norm(error - np.eye(3) - cross_matrix(law), 2)
        assert off < first + (m * lengths.sum()) ** 2 / 2 + 1e-12


def test_a_skew_triad_leaves_the_second_order_of_the_area_law():
    """A circle through the origin: to first order nothing, the bound of the first order is zero."""
    phase = np.linspace(0, 2 * np.pi, 2001)
    theta = 0.13 * np.stack([1 - np.cos(phase), np.sin(phase), 0 * phase], axis=-1)
    attitude = Rotation.from_rotvec(theta)
    motion = (attitude[:-1].inv() * attitude[1:]).as_rotvec()
    skew = 0.01 * cross_matrix(np.ones(3))
    assert np.linalg.norm(drift_per_cycle(motion, skew)) < 1e-15
    left = np.linalg.norm(exact_drift_per_cycle(motion, skew))
    assert 9e-6 < left < (np.linalg.norm(skew, 2) * 2 * np.pi * 0.13) ** 2 / 2

"""Wu (45)-(48): the states, and what is known of them before."""

import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from hypothesis import given, strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial.transform import Rotation

from driftlab.body_frames import BODY_FRAMES
from driftlab.calibration.body_axes import attitude_error, attitude_of_axes, imu_errors_in_frame
from driftlab.calibration.error_model import ERROR_MODELS, FULL
from driftlab.imu import ImuErrors, PriorStandardDeviations, random_imu_errors
from driftlab.quaternion import from_rotation_vector, multiply
from driftlab.vectors import cross_matrix
from support import EPS, order_of, random_quaternions

MODELS = {"all": FULL, **ERROR_MODELS}
every_model = pytest.mark.parametrize("model", MODELS.values(), ids=list(MODELS))
every_reduced_model = pytest.mark.parametrize(
    "model", ERROR_MODELS.values(), ids=list(ERROR_MODELS)
)
ATTITUDE = np.array([0.1, -0.5, 0.3, 0.8]) / np.sqrt(0.99)
AXES = {"x": 0, "y": 1, "z": 2}


def states(size):
    return arrays(float, size, elements=st.floats(-1, 1))


def embedded(model):
    """Matrix (30, size): the states of a model among all states."""
    imu_errors = model.imu_errors(np.eye(model.size))
    matrix = FULL.state(imu_errors)
    matrix[:, :6] = np.eye(model.size)[:, :6]
    return matrix.T


# States and what they are called


def test_all_errors_make_thirty_states_and_a_choice_of_axes_twenty_seven():
    """3 + 3 + 9 + 12 = 27, and three more without a choice."""
    assert FULL.size == 30
    assert tuple(ERROR_MODELS) == BODY_FRAMES
    for frame, model in ERROR_MODELS.items():
        assert (model.size, model.frame) == (27, frame)


@every_model
def test_names_say_what_the_states_are(model):
    assert len(set(model.names)) == len(model.names) == model.size
    assert [name.split()[0] for name in model.names[:6]] == ["attitude"] * 3 + ["velocity"] * 3
    assert [name.split()[1] for name in model.names[:6]] == ["East", "North", "Up"] * 2
    for state, name in zip(np.eye(model.size)[6:], model.names[6:], strict=True):
        sensor, kind, place = name.split()
        bias, matrix = np.zeros(3), np.zeros((3, 3))
        if kind == "bias":
            bias[AXES[place]] = 1
        else:
            row, column = AXES[place[0]], AXES[place[-1]]
            assert (len(place) == 1) == (kind == "scale")
            matrix[row, column] = 1
            if kind == "non-orthogonality":
                matrix[column, row] = 1
        expected = {"gyro": (bias, matrix, 0, 0), "accelerometer": (0, 0, bias, matrix)}[sensor]
        for found, value in zip(model.imu_errors(state), expected, strict=True):
            np.testing.assert_array_equal(found, np.broadcast_to(value, found.shape))


@every_model
def test_model_has_no_state_that_its_axes_exclude(model):
    gyro, accelerometer = model.gyro_basis, model.accelerometer_basis
    assert len(gyro) + len(accelerometer) == model.size - 12
    if model.frame == "averaged":
        np.testing.assert_array_equal(gyro, np.swapaxes(gyro, -1, -2))
    elif model.frame == "upper triangle":
        np.testing.assert_array_equal(np.triu(gyro, 1), 0)
    elif model.frame == "lower triangle":
        np.testing.assert_array_equal(np.tril(gyro, -1), 0)
    elif model.frame == "accelerometers":
        np.testing.assert_array_equal(np.triu(accelerometer, 1), 0)
    elif model.frame == "averaged accelerometers":
        np.testing.assert_array_equal(accelerometer, np.swapaxes(accelerometer, -1, -2))


@every_model
@given(data=st.data())
def test_state_of_the_unit_of_a_state_is_the_state(model, data):
    state = data.draw(states(model.size))
    expected = np.concatenate([np.zeros(6), state[6:]])
    np.testing.assert_array_equal(model.state(model.imu_errors(state)), expected)


def test_unit_of_the_state_of_a_unit_is_the_unit():
    imu_errors = random_imu_errors(PriorStandardDeviations(), np.random.default_rng(0))
    for found, expected in zip(FULL.imu_errors(FULL.state(imu_errors)), imu_errors, strict=True):
        np.testing.assert_array_equal(found, expected)


# Reduction to the axes of a model


@every_reduced_model
@pytest.mark.parametrize("q", random_quaternions(4, seed=3), ids=range(4))
def test_both_triads_turned_with_the_attitude_are_no_error_at_all(model, q):
    """Wu (19)-(36): dl = dk and phi = C dk; one row for each direction of dk."""
    turns, nothing = cross_matrix(np.eye(3)), np.zeros((3, 3))
    unobservable = FULL.state(ImuErrors(nothing, turns, nothing, turns))
    unobservable[:, :3] = Rotation.from_quat(q).apply(np.eye(3))
    reduction = model.reduction(q)
    np.testing.assert_allclose(reduction @ unobservable.T, 0, atol=len(reduction) * EPS)
    # Nothing else is nothing: neither the attitude nor a single triad turned alone.
    assert np.linalg.svd(reduction, compute_uv=False)[-1] > 0.1


@every_reduced_model
def test_reduction_leaves_the_states_of_the_model_as_they_are(model):
    """So it is a projection: to reduce twice is to reduce once."""
    found = model.reduction(ATTITUDE) @ embedded(model)
    np.testing.assert_allclose(found, np.eye(27), rtol=0, atol=4 * EPS)


def test_all_states_need_no_reduction():
    np.testing.assert_array_equal(FULL.reduction(ATTITUDE), np.eye(30))


@every_reduced_model
def test_reduction_is_the_exact_change_of_axes_to_first_order(model):
    rng = np.random.default_rng(2)
    sizes = PriorStandardDeviations(
        gyro_bias=1.0, accelerometer_bias=1.0, scale_factor=1.0, installation=1.0
    )
    imu_errors, phi = random_imu_errors(sizes, rng), rng.normal(size=3)

    def error(size):
        small = ImuErrors(*(0.3 * size * field for field in imu_errors))
        state = FULL.state(small)
        state[:3] = 0.3 * size * phi
        turned, rotation = imu_errors_in_frame(small, model.frame)
        expected = model.state(turned)
        # What the computer holds for the attitude of its axes, compared with their true one.
        computed = multiply(from_rotation_vector(-state[:3]), ATTITUDE)
        expected[:3] = attitude_error(computed, attitude_of_axes(ATTITUDE, rotation))
        return np.linalg.norm(model.reduction(ATTITUDE) @ state - expected)

    assert order_of(error) == pytest.approx(2, abs=0.05)


# What is known before


SPREAD = PriorStandardDeviations(
    0.2, gyro_bias=0.3, accelerometer_bias=0.5, scale_factor=0.7, installation=0.11, velocity=0.9
)


def variances(model, prior=SPREAD, attitude=ATTITUDE):
    """Unit whose fields are the variances of the states, and variances of attitude, velocity."""
    values = np.diag(model.covariance(prior, attitude))
    return model.imu_errors(values), values[:3], values[3:6]


def test_prior_of_all_states_is_the_spread():
    covariance = FULL.covariance(SPREAD, ATTITUDE)
    np.testing.assert_array_equal(covariance, np.diag(np.diag(covariance)))
    imu_errors, attitude, velocity = variances(FULL)
    matrix = np.where(np.eye(3) == 1, 0.7**2, 0.11**2)
    expected = (np.full(3, 0.3**2), matrix, np.full(3, 0.5**2), matrix)
    for found, value in zip(imu_errors, expected, strict=True):
        np.testing.assert_array_equal(found, value)
    np.testing.assert_array_equal(attitude, 0.2**2)
    np.testing.assert_array_equal(velocity, 0.9**2)


@every_reduced_model
def test_prior_of_a_choice_of_axes_in_closed_form(model):
    """K_xy + K_yx has twice the variance s^2, their mean half of it; L loses what K does."""
    s = 0.11**2
    imu_errors, attitude, velocity = variances(model)
    for bias, size in ((imu_errors.gyro_bias, 0.3), (imu_errors.accelerometer_bias, 0.5)):
        np.testing.assert_allclose(bias, size**2, rtol=8 * EPS)
    for matrix in (imu_errors.gyro_error_matrix, imu_errors.accelerometer_error_matrix):
        np.testing.assert_allclose(np.diag(matrix), 0.7**2, rtol=8 * EPS)
    own, other = imu_errors.gyro_error_matrix, imu_errors.accelerometer_error_matrix
    if "accelerometers" in model.frame:
        own, other = other, own
    off = ~np.eye(3, dtype=bool)
    rows, columns = own[off] > 0, own.T[off] > 0
    averaged = model.frame.startswith("averaged")
    turned = s / 2 if averaged else s
    if averaged:
        np.testing.assert_allclose(own[off], s / 2, rtol=8 * EPS)
    else:
        np.testing.assert_allclose(own[off][rows], 2 * s, rtol=8 * EPS)
        assert (rows != columns).all()  # one of each pair
    np.testing.assert_allclose(other[off], s + turned, rtol=8 * EPS)
    # The axes' own uncertainty comes to that of the table.
    np.testing.assert_allclose(attitude, 0.2**2 + turned, rtol=16 * EPS)
    np.testing.assert_array_equal(velocity, 0.9**2)


@every_reduced_model
def test_prior_is_the_covariance_of_random_units_in_the_models_axes(model):
    """Drawn, turned exactly, and counted: all of the covariance, not its diagonal only."""
    prior, count = PriorStandardDeviations(), 10000
    rng = np.random.default_rng(8)
    imu_errors, rotation = imu_errors_in_frame(random_imu_errors(prior, rng, count), model.frame)
    drawn = model.state(imu_errors)
    computed = multiply(
        from_rotation_vector(-prior.attitude * rng.standard_normal((count, 3))), ATTITUDE
    )
    drawn[:, :3] = attitude_error(computed, attitude_of_axes(ATTITUDE, rotation))
    assert (drawn[:, 3:6] == 0).all()
    some = np.delete(np.arange(27), [3, 4, 5])  # the velocity is known
    covariance = model.covariance(prior, ATTITUDE)[np.ix_(some, some)]
    # In units of the covariance: n rows of p independent numbers. Their singular values over
    # sqrt(n) lie within 1 +- (sqrt(p/n) + t) but for a probability of 2 exp(-n t^2/2), Davidson
    # and Szarek (2001); t = sqrt(28/n) makes that 2e-6.
    white = np.linalg.solve(np.linalg.cholesky(covariance), drawn[:, some].T)
    values = np.linalg.svd(white / np.sqrt(count), compute_uv=False)
    bound = np.sqrt(24 / count) + np.sqrt(28 / count)
    assert np.abs(values - 1).max() < bound


def test_a_name_that_no_model_has_is_told_those_that_there_are():
    with pytest.raises(KeyError, match=r"expected one of averaged, .* got '27'"):
        ERROR_MODELS["27"]
    assert "27" not in ERROR_MODELS
    assert ERROR_MODELS.get("27") is None


def test_threads_are_given_the_same_model():
    """Models are told apart as objects: a filter refuses an earlier pass that is of another."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)  # they take turns as often as they can
    try:
        with ThreadPoolExecutor(8) as threads:
            found = threads.map(ERROR_MODELS["lower triangle"].with_states, ["time skew"] * 8)
            assert len({id(model) for model in found}) == 1
    finally:
        sys.setswitchinterval(before)


def test_a_model_in_a_signature_is_one_short_line():
    assert repr(FULL) == "<ErrorModel of 30 states, any body axes>"
    larger = ERROR_MODELS["averaged"].with_states("time skew")
    assert repr(larger) == "<ErrorModel of 28 states, axes 'averaged', with time skew>"

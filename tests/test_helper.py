"""The front door: every function that ``import driftlab as dl`` offers, proved by an identity."""

import inspect
import re

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import driftlab as dl
from support import EPS, ROOT, order_of

PAGE = (ROOT / "docs" / "helper.md").read_text("utf-8")
FUNCTIONS = [name for name in dl.__all__ if inspect.isfunction(getattr(dl, name))]
M = 1e-3 * np.array([[1.0, 2.0, -0.5], [0.3, -2.0, 1.0], [0.4, -0.7, 0.5]])
N = np.array([1.0, 2.0, -2.0]) / 3
RATE = 0.3 * N
LATITUDE = 0.7


def still(duration: float, interval: float = 0.5) -> dl.Increments:
    """Increments of a perfect unit that stands level, with its axes East, North, Up."""
    rate, force = dl.earth.earth_rate(LATITUDE), [0.0, 0.0, float(dl.earth.gravity(LATITUDE))]
    count = round(duration / interval)
    one_row = [interval * np.array([each]) for each in (rate, force)]
    return dl.Increments(interval, *(np.repeat(each, count, axis=0) for each in one_row))


def test_measured_rate():
    np.testing.assert_allclose(dl.measured_rate(RATE, M), RATE + M @ RATE, rtol=4 * EPS)


def test_split_error_matrix():
    scale_factor, non_orthogonality, misalignment = dl.split_error_matrix(M)
    np.testing.assert_allclose(scale_factor + non_orthogonality + misalignment, M, atol=1e-18)
    np.testing.assert_array_equal(misalignment, -misalignment.T)
    np.testing.assert_array_equal(non_orthogonality, non_orthogonality.T)


def test_error_quaternion():
    """Two rotations about fixed axes: the true one taken back, then the measured one."""
    measured, time = dl.measured_rate(RATE, M), 40.0
    expected = Rotation.from_rotvec(-RATE * time) * Rotation.from_rotvec(measured * time)
    found = Rotation.from_quat(dl.error_quaternion(RATE, measured, time))
    assert (found.inv() * expected).magnitude() < 100 * EPS


def test_characteristic_polynomial():
    measured = RATE + np.array([0.05, -0.02, 0.01])
    matrix = dl.drift.error_rate_matrix(RATE, measured)
    found = dl.characteristic_polynomial(RATE, measured)
    np.testing.assert_allclose(found, np.poly(matrix), atol=1e-14)


def test_exact_roots():
    """The polynomial vanishes at its roots."""
    measured = RATE + np.array([0.05, -0.02, 0.01])
    polynomial = dl.characteristic_polynomial(RATE, measured)
    roots = dl.exact_roots(RATE, measured)
    np.testing.assert_allclose(np.poly(roots), polynomial, atol=1e-14)


@pytest.mark.parametrize("order", [1, 2])
def test_asymptotic_roots(order):
    """They differ from the exact ones by the first power that they leave out."""

    def error(size: float) -> float:
        exact = dl.exact_roots(N, dl.measured_rate(N, size * 1e3 * M))
        return float(np.abs(exact - dl.asymptotic_roots(N, size * 1e3 * M, order=order)).max())

    assert order_of(error) == pytest.approx(order + 1, abs=0.1)


def test_drift_per_revolution():
    """After a revolution the error quaternion has turned by this angle."""
    time = 2 * np.pi / 0.3
    error = dl.error_quaternion(RATE, dl.measured_rate(RATE, M), time)
    found = dl.drift_per_revolution(N, M)
    assert abs(found) == pytest.approx(dl.quaternion.rotation_angle(error), rel=1e-9)
    assert found == pytest.approx(2 * np.pi * N @ M @ N, abs=20 * np.linalg.norm(M) ** 2)


def test_principal_drifts():
    """They are the extremes over all directions: nothing lies outside them."""
    coefficients, axes = dl.principal_drifts(M)
    np.testing.assert_allclose(dl.drift.drift_coefficient(axes, M), coefficients, atol=1e-17)
    directions = np.random.default_rng(1).normal(size=(1000, 3))
    found = dl.drift.drift_coefficient(directions, M)
    assert coefficients.min() <= found.min() <= found.max() <= coefficients.max()


def test_turn_estimate():
    """A rotation about the axis by 2 pi k times a number gives the number."""
    error = Rotation.from_rotvec(2 * np.pi * 3 * 1e-3 * N)
    assert dl.turn_estimate(error, N, turns=3) == pytest.approx(1e-3, rel=1e-12)


def test_fit_turns():
    axes = dl.drift.PAIR_AXES
    sigma = np.array([2.0, -1.0, 0.5])
    symmetric = np.zeros((3, 3))
    symmetric[[0, 0, 1], [1, 2, 2]] = symmetric[[1, 2, 2], [0, 0, 1]] = sigma
    estimates = dl.drift.drift_coefficient(axes, symmetric)
    fit = dl.fit_turns(estimates, axes)
    again = dl.fit_turns(2 * estimates, axes)
    np.testing.assert_allclose(np.sort(fit.sigma), np.sort(sigma), rtol=1e-14)
    np.testing.assert_allclose(again.sigma, 2 * fit.sigma, rtol=1e-14)


def test_integrate():
    """About a fixed axis rotation vectors are exact, however the rate changes."""
    angles = np.random.default_rng(1).uniform(0, 0.2, 100)
    found = dl.integrate(angles[:, np.newaxis] * N, "rotation-vector-2")[-1]
    expected = Rotation.from_rotvec(angles.sum() * N)
    assert (Rotation.from_quat(found).inv() * expected).magnitude() < 100 * 4 * EPS


def test_coning_drift():
    """The formula's drift is the one that the algorithm shows when it runs."""
    cone = np.radians(1.0), 10.0, 0.01
    by_formula = dl.coning_drift("picard-1", *cone)
    simulated = dl.attitude.simulated_coning_drift("picard-1", *cone)
    assert by_formula == pytest.approx(simulated, rel=1e-6)


def test_measure_and_compensate():
    """The true increments come back from those of a unit whose errors are known."""
    errors = dl.ImuErrors(np.full(3, 1e-5), M, np.full(3, 1e-3), -M)
    true = still(10.0)
    found = dl.compensate(dl.measure(true, errors), errors)
    np.testing.assert_allclose(found.angle, true.angle, atol=1e-18)
    np.testing.assert_allclose(found.velocity, true.velocity, rtol=0, atol=40 * EPS)


def test_calibrate():
    """Without noise in the record the errors come back, to a tenth of what the noise hides."""
    table = dl.motion.turntable_trajectory(dl.motion.EIGHTEEN_ROTATIONS, LATITUDE, 0.05)
    unit = dl.ImuErrors(np.full(3, 5e-7), 0 * M, np.array([1e-3, -5e-4, 2e-4]), 0 * M)
    found = dl.calibrate(
        dl.measure(table.increments, unit),
        latitude=LATITUDE,
        start=table.attitude[0],
        model="averaged",
        prior=dl.imu.PriorStandardDeviations(),
        noise=dl.ImuNoise(),
    )
    true = found.model.state(dl.calibration.imu_errors_in_frame(unit, "averaged")[0])
    sensors = slice(found.model.size - 21, None)
    error = np.abs(found.state[-1] - true)[sensors]
    assert (error < 0.1 * found.standard_deviations[-1, sensors]).all()


def test_unobservable_subspace():
    """An error in this subspace changes no velocity, whatever the table does."""
    along = dl.calibration.linearize_along(dl.motion.NINETEEN_POSITIONS, LATITUDE)
    directions = dl.unobservable_subspace(along).directions
    assert len(directions) == 3
    velocity = [name.startswith("velocity") for name in along.model.names]
    state = directions.T
    for transition in along.transitions:
        state = transition @ state
        np.testing.assert_allclose(state[velocity], 0, atol=1e-6)


def test_align():
    """A unit that stands still gives back the attitude and the latitude in which it stands."""
    heading, pitch, roll = 0.4, -0.2, 0.3
    attitude = dl.frames.from_euler_angles(heading, pitch, roll)
    found = dl.align(*dl.motion.static_imu(attitude, LATITUDE))
    np.testing.assert_allclose(
        [found.heading, found.pitch, found.roll, found.latitude],
        [heading, pitch, roll, LATITUDE],
        rtol=0,
        atol=1e-13,
    )


@pytest.mark.parametrize("sensor", ["gyro", "accelerometer"])
def test_alignment_errors(sensor):
    """They are the derivatives of `align` by the biases: what is left is of second order."""
    heading, pitch = 0.4, -0.2
    attitude = dl.frames.from_euler_angles(heading, pitch, 0.3)
    rate, force = dl.motion.static_imu(attitude, LATITUDE)

    def error(size: float) -> float:
        gyro_bias, accelerometer_bias = np.zeros(3), np.zeros(3)
        if sensor == "gyro":
            gyro_bias = 1e-5 * size * np.array([1.0, -0.5, 0.7])
        else:
            accelerometer_bias = size * np.array([1.0, -0.5, 0.7])
        expected = dl.alignment_errors(heading, pitch, LATITUDE, gyro_bias, accelerometer_bias)
        into_body = attitude * [-1, -1, -1, 1]
        found = dl.align(
            rate + dl.quaternion.rotate(into_body, gyro_bias),
            force + dl.quaternion.rotate(into_body, accelerometer_bias),
        )
        return abs(found.heading - heading - expected.heading) + abs(
            found.latitude - LATITUDE - expected.latitude
        )

    assert order_of(error) == pytest.approx(2, abs=0.1)


def test_speed_error():
    """The horizontal rate of a body under way points this angle away from the Earth's."""
    north, east = 8.0, -5.0
    radius = dl.earth.EARTH_RADIUS
    northward = dl.earth.EARTH_RATE * np.cos(LATITUDE) + east / radius
    expected = np.arctan2(north / radius, northward)
    assert abs(dl.speed_error(LATITUDE, [north, east])) == pytest.approx(expected, rel=1e-12)


def test_operating_heading_error():
    """At rest, levelled and settled, it is the alignment error of the same bias."""
    bias, zero = [1e-8, 3e-8], [0.0, 0.0]
    found = dl.operating_heading_error(LATITUDE, zero, zero, zero, bias, 0.0, 0.4, 0.0)
    aligned = dl.alignment_errors(0.4, 0.0, LATITUDE, [bias[0], 0.0, bias[1]], np.zeros(3))
    assert found.heading == pytest.approx(aligned.heading, rel=1e-12)


def test_navigate_from_a_stationary_state():
    """A unit that stands still, given what perfect sensors measure, stays where it is."""
    start = dl.stationary_state(LATITUDE, [0, 0, 0, 1])
    found = dl.navigate(start, still(60.0))
    assert np.abs(found.velocity).max() < 1e-5
    assert np.abs(found.latitude - LATITUDE).max() < 1e-10


def test_allan_deviation():
    """At the shortest averaging time it is the root of half the mean squared difference."""
    rates = np.random.default_rng(1).normal(size=1000)
    found = dl.allan_deviation(rates, 0.1, [0.1])
    expected = np.sqrt(np.mean(np.diff(rates) ** 2) / 2)
    np.testing.assert_allclose(found.deviation, [expected], rtol=1e-12)


TESTS = [name for name in globals() if name.startswith("test_")]


def test_every_function_is_proved_here_and_explained_on_the_page():
    for name in FUNCTIONS:
        assert name == "figure" or any(name.removesuffix("_state") in test for test in TESTS), name
        assert f"`dl.{name}" in PAGE, name


def test_examples_print_what_the_page_shows(capsys):
    namespace: dict[str, object] = {}
    for code, shown in re.findall(r"```python\n(.*?)```(?:\n\n```\n(.*?)```)?", PAGE, re.DOTALL):
        exec(compile(code, "docs/helper.md", "exec"), namespace)
        assert capsys.readouterr().out == shown, code

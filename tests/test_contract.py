"""What the package promises of every function of arrays: it broadcasts over leading axes, leaves
its arguments alone, takes any real dtype, and refuses bad input by the argument's name."""

import inspect
import re
from functools import partial, update_wrapper
from itertools import cycle

import numpy as np
import pytest
from numpy.typing import ArrayLike

from driftlab import (
    allan,
    axes,
    body_frames,
    conventions,
    earth,
    frames,
    increments,
    quaternion,
    sampled_rates,
    strapdown,
    triad,
    vectors,
)
from driftlab.attitude import (
    cayley,
    drift_on_cones,
    finite_precision,
    integration,
    noise_amplification,
    own_algorithms,
    riccati,
    sculling,
    spherical_area,
)
from driftlab.attitude.functional_iteration import FunctionalIteration
from driftlab.calibration import (
    body_axes,
    error_budget,
    error_dynamics,
    filter,
    kalman,
    matrix_conventions,
    static_error_growth,
    static_navigation,
)
from driftlab.drift import (
    characteristic_equation,
    closed_motion,
    error_kinematics,
    recorded_turns,
    systematic_drift,
    turn_calibration,
    turns_by_hand,
    weighing_designs,
)
from driftlab.gyrocompass import (
    alignment,
    alignment_deviations,
    heading_error,
    inertial_alignment,
    levelling,
    noise,
    simulation,
    trials,
    two_position_alignment,
)
from driftlab.motion import profiles, turntable, vehicle
from driftlab.noise_terms import NoiseTerms
from support import helper_modules

# These numbers test types and axes, and would be much for biases.
pytestmark = pytest.mark.filterwarnings(
    "ignore:(error_quaternion|gyro_bias_n).* is much:driftlab.checks.UnusualWarning"
)
Q, P = np.array([0.1, -0.3, 0.2, 0.9]), np.array([0.4, 0.5, -0.6, 0.2])
RATE, MEASURED = np.array([0.7, -1.1, 0.4]), np.array([0.72, -1.13, 0.37])
BENT = np.array([[0.03, -0.08, 0.05], [0.09, -0.02, 0.07], [-0.06, 0.04, 0.01]])
TIME = np.array(1.5)
GRAVITY = np.array(9.8)
LATITUDE = np.array(0.7)
PITCH = np.array(-0.4)
LEVEL = np.array([11.0, -7.0])
INCREMENTS = np.array([RATE, MEASURED, -RATE, RATE[[1, 2, 0]]])


def fixed(function, **arguments):
    """The function with some arguments given that are not arrays, under its own name."""
    return update_wrapper(partial(function, **arguments), function)


def navigate(**parts):
    """`strapdown.navigate` of the parts of its records, by the names that sentences give them."""
    begun = [parts[f"start.{field}"] for field in strapdown.Navigation._fields]
    rows = increments.Increments(0.1, parts["increments.angle"], parts["increments.velocity"])
    return strapdown.navigate(strapdown.Navigation(*begun), rows)


# Each function with good arguments that have no leading axes.
CASES = {
    quaternion.multiply: {"first": Q, "second": P},
    quaternion.conjugate: {"quaternion": Q},
    quaternion.pure: {"vector": RATE},
    quaternion.left_matrix: {"quaternion": Q},
    quaternion.right_matrix: {"quaternion": Q},
    quaternion.from_rotation_vector: {"rotation_vector": RATE},
    quaternion.to_rotation_vector: {"quaternion": Q},
    quaternion.rotation_angle: {"quaternion": Q},
    quaternion.cumulative_product: {"quaternions": np.array([Q, P, Q])},
    error_kinematics.rate_matrix: {"rate": RATE},
    error_kinematics.error_composition_matrix: {"attitude": Q},
    error_kinematics.error_rate_matrix: {"rate": RATE, "measured_rate": MEASURED},
    error_kinematics.error_quaternion: {"rate": RATE, "measured_rate": MEASURED, "time": TIME},
    triad.triad_matrix: {"error_matrix": BENT},
    triad.measured_rate: {"rate": RATE, "error_matrix": BENT},
    characteristic_equation.characteristic_polynomial: {"rate": RATE, "measured_rate": MEASURED},
    characteristic_equation.exact_roots: {"rate": RATE, "measured_rate": MEASURED},
    characteristic_equation.asymptotic_roots: {"rate": RATE, "error_matrix": BENT},
    vectors.direction_from_angles: {"azimuth": TIME, "elevation": TIME},
    systematic_drift.drift_coefficient: {"direction": RATE, "error_matrix": BENT},
    systematic_drift.drift_per_revolution: {"direction": RATE, "error_matrix": BENT},
    characteristic_equation.split_error_rate_matrix: {"rate": RATE, "measured_rate": MEASURED},
    triad.non_orthogonality: {"error_matrix": BENT},
    systematic_drift.principal_drifts: {"error_matrix": BENT},
    triad.pairwise_non_orthogonality: {"axes": np.eye(3)[[1, 2, 0]]},
    turn_calibration.turn_estimate: {"error_quaternion": Q, "axis": RATE},
    turn_calibration.exact_turn_estimate: {"axis": RATE, "error_matrix": BENT},
    turn_calibration.TurnExperiment(1, 5).error_quaternion: {"axis": RATE, "error_matrix": BENT},
    turn_calibration.TurnExperiment(1, 5).estimate: {"axis": RATE, "error_matrix": BENT},
    turn_calibration.earth_rate_offset: {
        "latitude": LATITUDE,
        "table_rate": TIME,
        "table_axis": RATE,
    },
    turn_calibration.TurnExperiment().integrate: {"increments": INCREMENTS},
    recorded_turns.recorded_turn_estimate: {
        "increments": np.tile([0.0, 0.0, 1.0], (6, 1)),
        "axis": np.array([0.0, 0.0, 2.0]),
    },
    weighing_designs.weighing_estimate: {"estimates": Q},
    cayley.cayley_transform: {"matrix": BENT},
    cayley.skew_operator: {"vector": RATE},
    cayley.cayley_vector: {"quaternion": Q},
    cayley.rotation_quaternion: {"vector": RATE},
    riccati.riccati_rate: {"vector": RATE, "rate": MEASURED},
    fixed(cayley.skew_operator, dimension=3): {"vector": RATE},
    fixed(cayley.cayley_vector, dimension=3): {"quaternion": Q},
    fixed(cayley.rotation_quaternion, dimension=3): {"vector": RATE},
    fixed(riccati.riccati_rate, dimension=3): {"vector": RATE, "rate": MEASURED},
    cayley.shadow: {"vector": RATE},
    integration.integrate: {"increments": INCREMENTS, "start": Q},
    fixed(integration.integrate, algorithm="memory-4"): {
        "increments": INCREMENTS,
        "start": Q,
    },
    fixed(integration.integrate, algorithm=FunctionalIteration("own", window=2)): {
        "increments": INCREMENTS,
        "start": Q,
    },
    fixed(sampled_rates.increments_from_rates, interval=0.1, degree=3): {"rates": INCREMENTS},
    fixed(integration.step_quaternions, algorithm="two-step-4"): {"increments": INCREMENTS},
    fixed(integration.step_quaternions, algorithm="memory-4"): {
        "increments": INCREMENTS,
        "history": INCREMENTS[:2],
    },
    fixed(integration.step_rotation_vectors, algorithm="one-step-3"): {"increments": INCREMENTS},
    fixed(drift_on_cones.coning_drift, algorithm="rotation-vector-2"): {
        "half_angle": PITCH,
        "frequency": TIME,
        "sample_interval": TIME,
    },
    fixed(drift_on_cones.simulated_coning_drift, algorithm="memory-4", count=4): {
        "half_angle": PITCH,
        "frequency": TIME,
        "sample_interval": TIME,
    },
    fixed(own_algorithms.checked_steps, algorithm=lambda g: g[0::2] + g[1::2]): {
        "increments": INCREMENTS
    },
    fixed(noise_amplification.step_noise_covariance, algorithm="one-step-3"): {"turn": RATE},
    fixed(noise_amplification.noise_growth, algorithm="memory-4"): {"sample_angle": TIME},
    spherical_area.solid_angle: {"directions": INCREMENTS},
    sculling.sculling_correction: {"angle": INCREMENTS, "velocity": INCREMENTS[::-1]},
    sculling.step_velocities: {"angle": INCREMENTS, "velocity": INCREMENTS[::-1]},
    profiles.Coning(0.3, 0.5).attitude: {"time": TIME},
    profiles.Coning(0.3, 0.5).rate: {"time": TIME},
    profiles.Sway(0.3, 0.5).attitude: {"time": TIME},
    profiles.Sway(0.3, 0.5).rate: {"time": TIME},
    profiles.FixedAxis(0.3, 0.5).attitude: {"time": TIME},
    profiles.FixedAxis(0.3, 0.5).rate: {"time": TIME},
    quaternion.rotate: {"quaternion": Q, "vector": RATE},
    quaternion.to_matrix: {"quaternion": Q},
    triad.split_error_matrix: {"matrix": BENT},
    body_frames.misalignment_vector: {"gyro_error_matrix": BENT},
    body_frames.body_frame_rotation: {"gyro_error_matrix": BENT},
    fixed(body_frames.body_frame_rotation, frame="upper triangle"): {"gyro_error_matrix": BENT},
    fixed(body_frames.body_frame_rotation, frame="lower triangle"): {"gyro_error_matrix": BENT},
    body_frames.change_body_frame: {"matrix": BENT, "rotation": BENT},
    vectors.cross_matrix: {"vector": RATE},
    kalman.predict: {
        "covariance": np.diag([1.0, 2.0, 3.0, 4.0]),
        "transition": np.eye(4) + 0.1,
        "noise": np.eye(4),
    },
    kalman.nees: {"errors": Q, "covariance": np.diag([1.0, 2.0, 3.0, 4.0])},
    earth.earth_rate: {"latitude": LATITUDE},
    earth.checked_latitude: {"latitude": LATITUDE},
    earth.curvature_radii: {"latitude": LATITUDE},
    earth.gravity: {"latitude": LATITUDE, "altitude": TIME},
    frames.from_euler_angles: {"heading": TIME, "pitch": PITCH, "roll": TIME},
    frames.to_euler_angles: {"attitude": Q},
    frames.navigation_frame_rate: {"latitude": LATITUDE, "velocity": LEVEL},
    heading_error.coriolis_correction: {"latitude": LATITUDE, "velocity": LEVEL},
    noise.GyroNoise().allan_deviation: {"averaging_times": TIME},
    NoiseTerms(1e-6, 1e-5).deviation: {"averaging_times": TIME},
    trials.turntable_heading_error: {
        "dial_reading": TIME,
        "gyro_bias_body": 1e-6 * RATE,
        "accelerometer_bias_body": RATE,
        "latitude": LATITUDE,
        "north_error": PITCH,
        "tilt": 1e-2 * LEVEL,
    },
    vehicle.static_imu: {"attitude": Q, "latitude": LATITUDE, "gravity": GRAVITY},
    fixed(alignment_deviations.alignment_standard_deviation, angle_random_walk=1e-6): {
        "latitude": LATITUDE,
        "duration": TIME,
    },
    fixed(alignment_deviations.two_position_standard_deviation, angle_random_walk=1e-6): {
        "latitude": LATITUDE,
        "duration": TIME,
        "turn_angle": TIME,
    },
    fixed(alignment.align, rate_unit=None): {
        "angular_rate": RATE,
        "specific_force": np.array([0.3, 0.5, -0.6]),
    },
    alignment.alignment_errors: {
        "heading": TIME,
        "pitch": PITCH,
        "latitude": LATITUDE,
        "gyro_bias_nue": RATE,
        "accelerometer_bias_nue": MEASURED,
        "gravity": GRAVITY,
    },
    alignment.alignment_attitude_error: {
        "latitude": LATITUDE,
        "gyro_bias_nue": RATE,
        "accelerometer_bias_nue": MEASURED,
        "gravity": GRAVITY,
    },
    heading_error.operating_heading_error: {
        "latitude": LATITUDE,
        "velocity": LEVEL,
        "tilt": LEVEL,
        "tilt_rate": LEVEL,
        "gyro_bias_north_east": LEVEL,
        "yaw_error": TIME,
        "heading": TIME,
        "pitch": PITCH,
        "proportional_rate": LEVEL,
    },
    fixed(inertial_alignment.inertial_alignment_standard_deviation, angle_random_walk=1e-6): {
        "latitude": LATITUDE,
        "duration": TIME,
    },
    heading_error.speed_error: {"latitude": LATITUDE, "velocity": LEVEL},
    fixed(axes.convert_vectors, from_axes="NED", to_axes="NUE"): {"vectors": RATE},
    fixed(axes.convert_matrix, from_axes="FRD", to_axes="RFU"): {"matrix": BENT},
    fixed(axes.convert_attitude, reference=("NED", "ENU"), body=("FRD", "FUR")): {"attitude": Q},
    fixed(conventions.convert_attitude_error, source="larin", target="phi"): {
        "error": RATE,
        "true_attitude": Q,
    },
    conventions.position_angle: {
        "latitude": LATITUDE,
        "latitude_error": PITCH,
        "longitude_error": TIME,
    },
    conventions.mirror_heading: {"heading": TIME},
    conventions.scalar_first: {"quaternion": Q},
    conventions.scalar_last: {"quaternion": Q},
    navigate: {
        "start.latitude": LATITUDE,
        "start.longitude": PITCH,
        "start.altitude": 100 * TIME,
        "start.velocity": np.array([3.0, -20.0, 0.5]),
        "start.attitude": Q,
        "increments.angle": 0.01 * INCREMENTS,
        "increments.velocity": np.array([0.1, 0.2, 0.98]) + 0.01 * INCREMENTS,
    },
    fixed(vehicle.smooth_step, begin=0.5, duration=3.0): {"times": TIME},
}
# Tested where they belong.
APART = {
    turns_by_hand.hand_turns,  # one record, whose rests are its own
    turns_by_hand.near_turns,
    weighing_designs.fit_turns,  # its two arguments share an axis instead of broadcasting
    # Their increments must close, bent a little they do not.
    closed_motion.drift_per_cycle,
    closed_motion.exact_drift_per_cycle,
    riccati.integrate_riccati,  # takes a row of times and returns all that it knows about them
    finite_precision.integrate_finite_word,  # answers in the word that it is asked for
    # Their arguments and answers are records of several arrays.
    strapdown.stationary_state,
    turntable.static_trajectory,
    vectors.wrap_angle,
    increments.compensate,
    increments.checked_increments,
    error_dynamics.free_transition,
    filter.calibrate,
    kalman.correct,
    body_axes.attitude_of_axes,
    body_axes.attitude_error,
    static_navigation.navigate_static,
    static_error_growth.checked_moments,  # a row
    static_error_growth.static_error_sources,
    static_error_growth.static_errors,
    static_error_growth.schuler_position_error,
    error_budget.mission_errors,
    error_budget.mission_error_sources,
    error_budget.calibration_error_budget,
    matrix_conventions.checked_zeros,
    levelling.propagate_level_frame,
    inertial_alignment.align_in_inertial_frame,
    two_position_alignment.align_multi_position,  # its positions share an axis
    simulation.simulate_gyrocompass,
    vehicle.vehicle_trajectory,
    # Their last axis is a row, and shorter or gone in the answer.
    allan.allan_deviation,
    trials.range_over_standard_deviation,
}

BAD = {
    "NaN": (lambda good: np.full_like(good, np.nan), "finite numbers"),
    "infinite": (lambda good: np.full_like(good, -np.inf), "finite numbers"),
    "complex": (lambda good: good + 0j, "real numbers, got "),
    "bool": (lambda good: good > 0, "real numbers, got "),
    "text": (lambda good: good.astype(str), "real numbers, got "),
    "none": (lambda good: None, "real numbers, got "),
    "ragged": (lambda good: [[1.0, 2.0], [3.0]], "got rows of unequal length"),
    "empty": (lambda good: np.empty((0, *good.shape)), "got an empty array"),
    "too long": (lambda good: np.ones((*good.shape[:-1], 5)), "got shape ("),
    "scalar": (lambda good: 1.0, "got shape ()"),
}
# Times, angles and the like have no axes of their own, so no shape of theirs is bad.
ANY_SHAPE = ("too long", "scalar")
WITHOUT_AXES = (
    "time",
    "azimuth",
    "elevation",
    "half_angle",
    "frequency",
    "sample_interval",
    "table_rate",
    "sample_angle",
    "latitude",
    "altitude",
    "heading",
    "pitch",
    "roll",
    "yaw_error",
    "gravity",
    "times",
    "duration",
    "averaging_times",
    "dial_reading",
    "turn_angle",
    "north_error",
    "latitude_error",
    "longitude_error",
    "start.latitude",
    "start.longitude",
    "start.altitude",
)
# To have no history is not bad, gravity is known where none is given, and some errors need no
# attitude.
ALLOWED = [("history", "none"), ("gravity", "none"), ("true_attitude", "none")]

every_function = pytest.mark.parametrize(
    ("function", "good"), CASES.items(), ids=[function.__name__ for function in CASES]
)


def results(function, arguments):
    """The answer as a tuple of arrays, whether the function returns one or several."""
    answer = function(**arguments)
    return answer if isinstance(answer, tuple) else (answer,)


def with_leading_axes(name, good, leading, rng):
    """`good` with each copy along the leading axes bent a little, and read-only."""
    value = good * (1 + 0.01 * rng.uniform(-1, 1, (*leading, *good.shape)))
    if name == "axes":
        value /= np.linalg.norm(value, axis=-1, keepdims=True)
    value.setflags(write=False)
    return value


@every_function
@pytest.mark.parametrize(
    "shapes",
    [[(4,)], [(2, 3)], [(2, 1, 3)], [(5, 1), (4,)], [(), (2, 3, 4)], [(2, 1, 3), (4, 1), ()]],
    ids=str,
)
def test_broadcasts_over_leading_axes_and_writes_into_no_argument(function, good, shapes):
    rng = np.random.default_rng(5)
    leading = dict(zip(good, cycle(shapes), strict=False))
    arguments = {
        name: with_leading_axes(name, value, leading[name], rng) for name, value in good.items()
    }
    shape = np.broadcast_shapes(*leading.values())
    together = results(function, arguments)
    spread = {
        name: np.broadcast_to(value, shape + good[name].shape) for name, value in arguments.items()
    }
    for index in np.ndindex(shape):
        alone = results(function, {name: value[index] for name, value in spread.items()})
        for one, many in zip(alone, together, strict=True):
            assert many.shape == shape + np.shape(one)
            # The same few operations in another order.
            np.testing.assert_allclose(one, many[index], rtol=1e-13, atol=1e-14)


class Foreign:
    """An array of another library, which NumPy can ask for one of its own."""

    def __init__(self, value):
        self.value = np.asarray(value, np.float32)

    def __array__(self, dtype=None, copy=None):
        return self.value if dtype is None else self.value.astype(dtype)


@every_function
@pytest.mark.parametrize("dtype", ["float32", "float16", "int64", "list", "protocol"])
def test_any_real_dtype_is_calculated_in_double(function, good, dtype):
    kinds = {"list": lambda value: value.tolist(), "protocol": Foreign}
    # Whole numbers, which every dtype holds exactly.
    whole = {name: np.ceil(value) for name, value in good.items()}
    given = {
        name: kinds[dtype](value) if dtype in kinds else value.astype(dtype)
        for name, value in whole.items()
    }
    for one, other in zip(results(function, given), results(function, whole), strict=True):
        assert one.dtype in (np.float64, np.complex128)
        np.testing.assert_array_equal(one, other)


@every_function
def test_a_single_number_is_a_number_and_no_array_without_axes(function, good):
    """As NumPy's own functions have it; a test of numbers alone would not tell the two apart."""
    if function is not earth.checked_latitude:  # like all checks it makes arrays
        for result in results(function, good):
            assert np.ndim(result) or not isinstance(result, np.ndarray)


@pytest.mark.parametrize(
    ("function", "name"),
    [(function, name) for function, good in CASES.items() for name in good],
    ids=lambda value: getattr(value, "__name__", value),
)
def test_bad_input_is_refused_by_name(function, name):
    good = CASES[function]
    for bad, (make, words) in BAD.items():
        if (name in WITHOUT_AXES and bad in ANY_SHAPE) or (name, bad) in ALLOWED:
            continue
        with pytest.raises(ValueError, match=f"^{name}: expected .*{re.escape(words)}"):
            function(**(good | {name: make(good[name])}))


def test_no_function_of_arrays_is_forgotten():
    known = {getattr(f, "__func__", getattr(f, "func", f)) for f in CASES} | APART
    found = set()
    for module in helper_modules():
        for name, function in inspect.getmembers(module, inspect.isfunction):
            if function.__module__ == module.__name__ and not name.startswith("_"):
                # The modules keep their annotations as text; `eval_str` makes them types again.
                signature = inspect.signature(function, eval_str=True)
                kinds = [p.annotation for p in signature.parameters.values()]
                if ArrayLike in kinds:
                    found.add(function)
    assert found - known == set()
    assert len(found) > 30


@pytest.mark.parametrize(
    ("function", "good"),
    [(function, good) for function, good in CASES.items() if len(good) > 1],
    ids=lambda case: getattr(case, "__name__", ""),
)
def test_leading_axes_that_do_not_broadcast_are_refused_by_name(function, good):
    first, second, *rest = good
    arguments = {
        first: np.tile(good[first], (2, *[1] * np.ndim(good[first]))),
        second: np.tile(good[second], (3, *[1] * np.ndim(good[second]))),
        **{name: good[name] for name in rest},
    }
    names = ".*".join(sorted(good, key=list(good).index))
    expected = rf"{names}|{'.*'.join(reversed(list(good)))}"
    with pytest.raises(ValueError, match=rf"^({expected}): expected leading axes that broadcast"):
        function(**arguments)

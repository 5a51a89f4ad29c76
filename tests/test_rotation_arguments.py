"""A `Rotation` of SciPy, one or a stack, is taken wherever a quaternion is."""

import inspect
import re
from functools import partial

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from driftlab import axes, conventions, frames, quaternion, strapdown
from driftlab.attitude import cayley, finite_precision, integration
from driftlab.calibration import (
    ERROR_MODELS,
    body_axes,
    error_budget,
    error_model,
    filter,
    static_error_growth,
    static_navigation,
)
from driftlab.checks import finite_array
from driftlab.drift import error_kinematics, turn_calibration, weighing_designs
from driftlab.gyrocompass import align_multi_position, two_position_alignment
from driftlab.imu import NO_ERRORS, ImuNoise, PriorStandardDeviations
from driftlab.motion import Scheme, turntable, turntable_trajectory, vehicle
from support import helper_modules, random_quaternions

ONE = random_quaternions(seed=1)
FEW = random_quaternions(3, seed=2)
GRID = random_quaternions(2, 3, seed=3)
try:
    Rotation.from_quat(GRID)
except ValueError:  # older SciPys have stacks along one axis only
    GRID = GRID.reshape(-1, 4)
ROWS = np.full((4, 3), 0.01)
VECTOR = np.array([0.1, -0.2, 0.3])
LATITUDE = 0.7
MODEL = ERROR_MODELS["averaged"]
STILL = turntable_trajectory(Scheme("", dwell=20.0), LATITUDE, interval=0.5)


def calibrated(start):
    return filter.calibrate(
        STILL.increments,
        latitude=LATITUDE,
        start=start,
        model=MODEL,
        prior=PriorStandardDeviations(),
        noise=ImuNoise(),
        update_interval=5.0,
        check=False,
    )


FOUND = calibrated(STILL.attitude[0])


def static_causes_of(name, attitude):
    given = {"attitude": ONE, "start": ONE, "reference": ONE} | {name: attitude}
    return static_error_growth.static_error_sources(
        NO_ERRORS, NO_ERRORS, latitude=LATITUDE, **given
    )


def navigated(name, attitude):
    given = {"attitude": ONE, "start": ONE, "reference": ONE} | {name: attitude}
    return static_navigation.navigate_static(
        NO_ERRORS, NO_ERRORS, latitude=LATITUDE, duration=120.0, interval=10.0, **given
    )


def budget(attitude):
    known = MODEL.covariance(PriorStandardDeviations(), ONE)
    return error_budget.calibration_error_budget([60.0], LATITUDE, MODEL, known, attitude)


def in_positions(turn):
    rate, force = vehicle.static_imu(FEW[:2], LATITUDE)
    return align_multi_position(rate, force, turn, heading_tolerance=np.inf)


# By function, for each argument that is a quaternion: the function of it, and what is given to it.
CASES = {
    cayley.cayley_vector: {"quaternion": (cayley.cayley_vector, GRID)},
    integration.integrate: {"start": (lambda q: integration.integrate(ROWS, start=q), GRID)},
    finite_precision.integrate_finite_word: {
        "start": (lambda q: finite_precision.integrate_finite_word(ROWS, start=q), GRID)
    },
    axes.convert_attitude: {
        "attitude": (lambda q: axes.convert_attitude(q, reference=("NED", "ENU")), GRID)
    },
    body_axes.attitude_error: {
        "computed": (lambda q: body_axes.attitude_error(q, ONE), GRID),
        "true": (lambda q: body_axes.attitude_error(ONE, q), GRID),
    },
    body_axes.attitude_of_axes: {
        "attitude": (lambda q: body_axes.attitude_of_axes(q, np.eye(3)), GRID)
    },
    static_error_growth.static_error_sources: {
        name: (partial(static_causes_of, name), ONE) for name in ("attitude", "start", "reference")
    },
    static_navigation.navigate_static: {
        name: (partial(navigated, name), ONE) for name in ("attitude", "start", "reference")
    },
    error_budget.mission_error_sources: {
        "attitude": (lambda q: error_budget.mission_error_sources(MODEL, q, LATITUDE), ONE)
    },
    error_budget.calibration_error_budget: {
        "attitude": (lambda q: budget(q), ONE),
        "turn": None,  # a float, of which the same line speaks
    },
    error_model.ErrorModel.reduction: {"attitude": (MODEL.reduction, ONE)},
    error_model.ErrorModel.covariance: {
        "attitude": (lambda q: MODEL.covariance(PriorStandardDeviations(), q), ONE)
    },
    filter.calibrate: {"start": (lambda q: calibrated(q).innovations, ONE)},
    conventions.convert_attitude_error: {
        "true_attitude": (
            lambda q: conventions.convert_attitude_error(VECTOR, "phi", "larin", q),
            GRID,
        )
    },
    conventions.scalar_first: {"quaternion": (conventions.scalar_first, GRID)},
    error_kinematics.error_composition_matrix: {
        "attitude": (error_kinematics.error_composition_matrix, GRID)
    },
    turn_calibration.turn_estimate: {
        "error_quaternion": (lambda q: turn_calibration.turn_estimate(q, VECTOR), GRID)
    },
    frames.to_euler_angles: {"attitude": (frames.to_euler_angles, GRID)},
    two_position_alignment.align_multi_position: {"turn": (lambda q: in_positions(q), FEW[:2])},
    turntable.static_trajectory: {
        "attitude": (lambda q: turntable.static_trajectory(q, LATITUDE, 1.0, 3).attitude, ONE)
    },
    vehicle.static_imu: {"attitude": (lambda q: vehicle.static_imu(q, LATITUDE), GRID)},
    strapdown.stationary_state: {
        "attitude": (lambda q: strapdown.stationary_state(LATITUDE, q).attitude, GRID)
    },
    quaternion.multiply: {
        "first": (lambda q: quaternion.multiply(q, ONE), GRID),
        "second": (lambda q: quaternion.multiply(ONE, q), GRID),
    },
    quaternion.rotate: {"quaternion": (lambda q: quaternion.rotate(q, VECTOR), GRID)},
    quaternion.cumulative_product: {"quaternions": (quaternion.cumulative_product, GRID)},
    **{
        one: {"quaternion": (one, GRID)}
        for one in (
            quaternion.conjugate,
            quaternion.left_matrix,
            quaternion.right_matrix,
            quaternion.rotation_angle,
            quaternion.to_matrix,
            quaternion.to_rotation_vector,
        )
    },
}
PARAMETER = re.compile(r"^([\w, ]+) : (array_like.*\b4,?\).*)$", re.MULTILINE)
NO_QUATERNIONS = {
    (weighing_designs.weighing_estimate, "estimates"),  # four numbers of four turns
    (conventions.scalar_last, "quaternion"),  # its scalar stands first
}


@pytest.mark.filterwarnings("ignore:error_quaternion:driftlab.checks.UnusualWarning")  # any
@pytest.mark.parametrize(
    ("function", "name"),
    [(f, name) for f, cases in CASES.items() for name, case in cases.items() if case],
    ids=lambda value: getattr(value, "__name__", value),
)
def test_rotation_is_taken_like_its_quaternion(function, name):
    of, quaternions = CASES[function][name]
    rotation = Rotation.from_quat(quaternions)
    for found, expected in zip(leaves(of(rotation)), leaves(of(rotation.as_quat())), strict=True):
        np.testing.assert_array_equal(found, expected)


def leaves(result):
    """All arrays of a result, which may be a tuple or a dictionary of results."""
    if isinstance(result, dict):
        result = tuple(result.values())
    if isinstance(result, tuple):
        return [leaf for one in result for leaf in leaves(one)]
    return [np.asarray(result)]


def test_no_argument_that_is_a_quaternion_is_forgotten():
    found = set()
    for module in helper_modules():
        things = [
            t for t in vars(module).values() if getattr(t, "__module__", "") == module.__name__
        ]
        functions = [t for t in things if inspect.isfunction(t)] + [
            member
            for thing in things
            if inspect.isclass(thing)
            for member in vars(thing).values()
            if inspect.isfunction(member) and member.__doc__
        ]
        for function in functions:
            # Insiders, which are not checked, take arrays only.
            for names, kind in PARAMETER.findall(inspect.getdoc(function) or ""):
                for name in map(str.strip, names.split(",")):
                    found.add((function, name))
                    assert ("Rotation" in kind) != ((function, name) in NO_QUATERNIONS), name
    known = {(function, name) for function, cases in CASES.items() for name in cases}
    assert found - NO_QUATERNIONS <= known


def test_rotation_in_place_of_other_numbers_is_refused():
    for wrong in (Rotation.identity(), Rotation.identity(2)):
        with pytest.raises(ValueError, match=r"^rate: expected real numbers, got "):
            finite_array(wrong, "rate", 3)
    with pytest.raises(ValueError, match=r"^quaternion: expected numbers, scalar first, got a Rot"):
        conventions.scalar_last(Rotation.identity())

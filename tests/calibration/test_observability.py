"""What a scheme shows: three directions never, some not from every start; and how accurately."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import null_space, subspace_angles
from scipy.spatial.transform import Rotation

from driftlab.calibration import error_dynamics
from driftlab.calibration.covariance import covariance_analysis
from driftlab.calibration.error_dynamics import linearize_along
from driftlab.calibration.error_model import ERROR_MODELS, FULL
from driftlab.calibration.observability import (
    UnobservableWarning,
    _warn_if_unobservable,
    observability_matrix,
    unobservable_subspace,
)
from driftlab.earth import gravity
from driftlab.imu import ImuErrors, ImuNoise, PriorStandardDeviations
from driftlab.motion.scheme import EIGHTEEN_ROTATIONS, NINETEEN_POSITIONS, SCHEMES, Scheme
from driftlab.motion.turntable import turntable_trajectory
from driftlab.vectors import cross_matrix
from numerical_growth import allowed, numerical_growth
from support import EPS

LATITUDE = float(np.radians(37.5))
AVERAGED = ERROR_MODELS["averaged"]
GRAVITY = float(gravity(LATITUDE))
SHORT = Scheme("+50X -70Z +400Y", ("North", "West", "Up"), dwell=12.0, rate=np.radians(40))

every_scheme = pytest.mark.parametrize("scheme", SCHEMES.values(), ids=list(SCHEMES))
every_frame = pytest.mark.parametrize("frame", ERROR_MODELS)


def typical_sizes(way):
    """Standard deviations of the states, by which they are compared; 1 cm/s of velocity."""
    sizes = np.sqrt(np.diag(way.model.covariance(PriorStandardDeviations(), way.start)))
    sizes[3:6] = 0.01
    return sizes


def common_misalignments(start):
    """States (3, 30) with dl = dk along x, y, z, and phi = C dk: Wu (36)."""
    turns, nothing = cross_matrix(np.eye(3)), np.zeros((3, 3))
    states = FULL.state(ImuErrors(nothing, turns, nothing, turns))
    states[:, :3] = Rotation.from_quat(start).apply(np.eye(3))
    return states


def assert_unobservable(way, found, expected):
    """Do two sets of directions span the same space, the states in their typical sizes?"""
    assert found.shape == np.shape(expected)
    sizes = typical_sizes(way)
    angles = subspace_angles((found / sizes).T, (expected / sizes).T)
    assert angles.max() < 1e-6


def unit_states(model, *names):
    """Rows with a one at each of the named states."""
    return np.eye(model.size)[[model.names.index(name) for name in names]]


# Three directions


@every_scheme
def test_three_directions_are_unobservable_with_all_states(scheme):
    """Wu, section 2.3: both triads turned together, the attitude with them; nothing else."""
    way = linearize_along(scheme, LATITUDE)
    unobservable = unobservable_subspace(way)
    assert_unobservable(way, unobservable.directions, common_misalignments(way.start))
    # Rounding below, information above. These are squares of singular values, so their rounding
    # is the square of an eps; eigenvalues of the Gramian itself are tested further down.
    values = unobservable.eigenvalues
    assert (np.diff(values) >= 0).all()
    assert values[2] < 1e-25 * values[-1]
    assert values[3] > 1e-9 * values[-1]
    assert unobservable.descriptions == [
        f"both triads turned together about {axis}, the attitude with them" for axis in "xyz"
    ]


@every_scheme
@every_frame
def test_all_is_observable_once_the_axes_are_chosen(scheme, frame):
    way = linearize_along(scheme, LATITUDE, ERROR_MODELS[frame])
    unobservable = unobservable_subspace(way)
    assert unobservable.directions.shape == (0, 27)
    assert unobservable.descriptions == []
    assert unobservable.eigenvalues[0] > 1e-9 * unobservable.eigenvalues[-1]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        _warn_if_unobservable(way)


@pytest.mark.parametrize("latitude", np.radians([0.0, -37.5, 80.0]))
def test_they_are_the_same_three_anywhere_on_earth(latitude):
    way = linearize_along(NINETEEN_POSITIONS, latitude)
    assert_unobservable(way, unobservable_subspace(way).directions, common_misalignments(way.start))


@pytest.mark.parametrize(
    ("rotations", "dwell", "rate"),
    [
        ("+30X +30Y +30Z", 10.0, 10.0),
        ("+90X +90Z", 10.0, 10.0),
        ("+90X +90Y", 10.0, 10.0),
        ("+90X +90Z", 20.0, 40.0),
        ("+90Z", 20.0, 10.0),
        ("+45X", 30.0, 10.0),
        ("+90X", 1.0, 10.0),
        ("", 3.0, 10.0),
    ],
)
def test_short_pauses_show_as_much_as_many_measurements_in_them(
    monkeypatch, rotations, dwell, rate
):
    """What counts is what a continuous measurement could show, not how few steps there are."""
    scheme = Scheme(rotations, dwell=dwell, rate=np.radians(rate))
    found = unobservable_subspace(linearize_along(scheme, 0.7, ERROR_MODELS["averaged"]))
    monkeypatch.setattr(error_dynamics, "_STEP", 0.5)
    monkeypatch.setattr(error_dynamics, "_TURN", np.radians(5.0))
    fine = unobservable_subspace(linearize_along(scheme, 0.7, ERROR_MODELS["averaged"]))
    assert len(found.directions) == len(fine.directions)


@every_scheme
@every_frame
def test_velocity_shows_a_unit_as_it_shows_its_reduction(scheme, frame):
    """Why a choice of axes loses nothing: 27 states explain what 30 do."""
    model = ERROR_MODELS[frame]
    every, few = linearize_along(scheme, LATITUDE), linearize_along(scheme, LATITUDE, model)
    expected = observability_matrix(every)
    found = observability_matrix(few) @ model.reduction(every.start)
    # Four Gauss points in 30 degrees: (pi/6)^8/2e9 of each step; some hundred steps of rounding.
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12 * np.abs(expected).max())


# Schemes that show less


def test_eighteen_rotations_from_north_up_east_leave_three_more():
    """Axis z is never raised there, so its accelerations never show."""
    scheme = replace(EIGHTEEN_ROTATIONS, start=("North", "Up", "East"))
    attitudes = Rotation.from_quat(turntable_trajectory(scheme, LATITUDE, 1.0).attitude)
    np.testing.assert_allclose(attitudes.apply([0, 0, 1])[:, 2], 0, atol=64 * EPS)
    column = [f"accelerometer {name}" for name in ("scale z", "installation xz", "installation yz")]
    for frame in ("averaged", "upper triangle", "lower triangle"):
        way = linearize_along(scheme, LATITUDE, ERROR_MODELS[frame])
        unobservable = unobservable_subspace(way)
        assert_unobservable(way, unobservable.directions, unit_states(way.model, *column))
        assert unobservable.descriptions == [f"3 among {', '.join(column)}"]
        assert unobservable.eigenvalues[3] > 1e-9 * unobservable.eigenvalues[-1]
    way = linearize_along(scheme, LATITUDE)
    unobservable = unobservable_subspace(way)
    expected = np.vstack([common_misalignments(way.start), unit_states(FULL, *column)])
    assert_unobservable(way, unobservable.directions, expected)
    assert len(unobservable.descriptions) == 4
    # What is unobservable besides is named in axes without a common turn.
    assert unobservable.descriptions[3] == f"3 among {', '.join(column)}"
    # The accelerometers' own axes put two of the three into the gyros and the attitude.
    way = linearize_along(scheme, LATITUDE, ERROR_MODELS["accelerometers"])
    reduced = (way.model.reduction(way.start) @ unit_states(FULL, *column).T).T
    assert_unobservable(way, unobservable_subspace(way).directions, reduced)


def test_rotations_about_the_vertical_show_three_of_twelve_accelerometer_errors():
    """Force stays along z in body axes: only nabla + g L_z can be told, one number an axis."""
    way = linearize_along(Scheme("+90Z +90Z +90Z +90Z"), LATITUDE, AVERAGED)
    nothing, entries = np.zeros((9, 3)), np.eye(9).reshape(9, 3, 3)
    biases = -GRAVITY * entries[:, :, 2]
    errors = AVERAGED.state(ImuErrors(nothing, np.zeros((9, 3, 3)), biases, entries))
    unobservable = unobservable_subspace(way)
    assert_unobservable(way, unobservable.directions, errors)
    assert unobservable.descriptions == [f"9 among {', '.join(AVERAGED.names[15:])}"]


@pytest.mark.parametrize("frame", [None, *ERROR_MODELS])
def test_without_rotations_nine_combinations_show(frame):
    """Three velocities, three levellings, the gyro's horizontal and vertical rates, no more.

    At rest the sensors' errors are two vectors, e = eps + K w and a = nabla + L f. Then
    dv' = f x phi + a and phi' = -w x phi - e hide two tilts behind the accelerometers and the
    heading behind the East gyro: 6 + 6 - 3.
    """
    model = FULL if frame is None else ERROR_MODELS[frame]
    unobservable = unobservable_subspace(linearize_along(Scheme(""), LATITUDE, model))
    assert len(unobservable.directions) == model.size - 9
    if model is FULL:
        assert len(unobservable.descriptions) == 4
        assert unobservable.descriptions[-1].startswith("18 among attitude East, ")


@pytest.mark.parametrize("scheme", [Scheme(""), Scheme("+90X +90X +90X")], ids=["none", "about x"])
def test_unobservable_directions_are_the_null_space_of_the_matrix(scheme):
    way = linearize_along(scheme, LATITUDE, AVERAGED)
    sizes = typical_sizes(way)
    expected = null_space(observability_matrix(way) * sizes, rcond=1e-10).T * sizes
    assert_unobservable(way, unobservable_subspace(way).directions, expected)


def test_unobservable_is_what_shows_nothing_beside_the_rest():
    """Not what shows little: after a moment everything shows little, and the same three nothing."""
    way = linearize_along(NINETEEN_POSITIONS, LATITUDE)
    dim = unobservable_subspace(way._replace(durations=1e-24 * way.durations))
    assert_unobservable(way, dim.directions, common_misalignments(way.start))


@pytest.mark.parametrize("model", [FULL, AVERAGED], ids=["30 states", "27 states"])
def test_eigenvalues_are_those_of_the_gramian(model):
    """Information on the start, by steps: duration times the square of what the velocity shows."""
    way = linearize_along(NINETEEN_POSITIONS, LATITUDE, model)
    gramian, since = np.zeros((model.size, model.size)), np.eye(model.size)
    for duration, matrix in zip(way.durations, way.transitions, strict=True):
        since = matrix @ since
        gramian += duration * since[3:6].T @ since[3:6]
    scaled = gramian * np.outer(typical_sizes(way), typical_sizes(way))
    expected = np.linalg.eigvalsh(scaled)
    # What eigenvalues of the square keep of the digits.
    np.testing.assert_allclose(
        unobservable_subspace(way).eigenvalues, expected, rtol=1e-9, atol=64 * EPS * expected[-1]
    )
    # Zero but for the rounding of as many products, and far from it.
    unobservable = model.size - 27
    assert (np.abs(expected[:unobservable]) < model.size * EPS * expected[-1]).all()
    assert expected[unobservable] > 1e-8 * expected[-1]


# Warnings


def test_warning_names_what_is_unobservable():
    scheme = replace(EIGHTEEN_ROTATIONS, start=("North", "Up", "East"))
    with pytest.warns(
        UnobservableWarning,
        match=r"^scheme: leaves 3 directions of 27 unobservable: 3 among accelerometer scale z, "
        r"accelerometer installation xz, accelerometer installation yz\.$",
    ) as caught:
        _warn_if_unobservable(linearize_along(scheme, LATITUDE, AVERAGED))
    # It points to the line that asked.
    assert [warning.filename for warning in caught] == [__file__]


# The way along a scheme


@every_scheme
def test_passage_takes_as_long_as_the_scheme(scheme):
    way = linearize_along(scheme, LATITUDE, AVERAGED)
    turned = sum(abs(angle) for _, angle in scheme.turns)
    expected = scheme.positions * scheme.dwell + turned / scheme.rate
    assert way.durations.sum() == pytest.approx(expected, rel=1e-12)
    assert way.durations.max() <= error_dynamics._STEP
    assert way.transitions.shape == (len(way.durations), 27, 27)
    np.testing.assert_array_equal(way.start, scheme.start_attitude)


def test_steps_are_no_shorter_than_need_be():
    """Ten seconds of a pause, 30 degrees of a rotation, at least four of each."""
    way = linearize_along(Scheme("+180X +90X", dwell=50.0), LATITUDE)
    pause = [10.0] * 5
    expected = [*pause, *[3.0] * 6, *pause, *[2.25] * 4, *pause]
    np.testing.assert_allclose(way.durations, expected, rtol=1e-12)
    way = linearize_along(Scheme("", dwell=50.1), LATITUDE)
    np.testing.assert_allclose(way.durations, [50.1 / 6] * 6, rtol=1e-12)


@pytest.mark.parametrize("model", [FULL, *ERROR_MODELS.values()], ids=["all", *ERROR_MODELS])
@pytest.mark.parametrize(
    ("rotations", "dwell"),
    [("+30X", 0.025), ("-20Y", 0.025), ("+30Z", 0.025), (SHORT.rotations, SHORT.dwell)],
)
def test_steps_multiply_to_the_nonlinear_mechanisation(model, rotations, dwell):
    """One long step, each axis; then a minute of pauses, quick rotations, more than a turn."""
    scheme = replace(SHORT, rotations=rotations, dwell=dwell)
    way = linearize_along(scheme, LATITUDE, model)
    found = np.eye(model.size)
    for matrix in way.transitions:
        found = matrix @ found
    record = turntable_trajectory(scheme, LATITUDE, 0.0125, multiple_of=2)
    turned = sum(abs(angle) for _, angle in scheme.turns)
    # Each step leaves out less than one long interval would.
    bounds = allowed(model, float(way.durations.sum()), turned)
    difference = np.abs(found[:6] - numerical_growth(record, LATITUDE, model))
    assert (difference < bounds).all()


# Expected accuracy


@every_scheme
def test_expected_accuracy_is_that_of_least_squares(scheme):
    """Without noise in the sensors the filter is one batch adjustment of the state at the start."""
    way, noise, prior = (
        linearize_along(scheme, LATITUDE, AVERAGED),
        ImuNoise(0, 0, 0.02),
        PriorStandardDeviations(),
    )
    before = AVERAGED.covariance(prior, way.start)
    design = observability_matrix(way)
    # One measurement each 2 s: rows that count sqrt(duration) have a variance of 2 * 0.02^2.
    innovation = design @ before @ design.T + 2 * 0.02**2 * np.eye(len(design))
    start = before - before @ design.T @ np.linalg.solve(innovation, design @ before)
    since = np.eye(27)
    for matrix in way.transitions:
        since = matrix @ since
    expected = np.sqrt(np.diag(since @ start @ since.T))
    found = np.sqrt(np.diag(covariance_analysis(way, noise, prior, update=2.0)))
    # Variances fall by six decades on the way.
    np.testing.assert_allclose(found, expected, rtol=1e-5)


@every_frame
def test_any_axes_end_with_the_reduction_of_the_same_covariance(frame):
    """Filters with other states are the same filter in other words."""
    model = ERROR_MODELS[frame]
    every = covariance_analysis(
        linearize_along(SHORT, LATITUDE), ImuNoise(), PriorStandardDeviations()
    )
    found = covariance_analysis(
        linearize_along(SHORT, LATITUDE, model), ImuNoise(), PriorStandardDeviations()
    )
    end = turntable_trajectory(SHORT, LATITUDE, 0.5).attitude[-1]
    reduction = model.reduction(end)
    expected = reduction @ every @ reduction.T
    sizes = np.sqrt(np.diag(expected))
    np.testing.assert_allclose(
        found / np.outer(sizes, sizes), expected / np.outer(sizes, sizes), rtol=0, atol=1e-7
    )


@every_scheme
def test_unobservable_directions_leave_the_velocity_alone(scheme):
    way = linearize_along(scheme, LATITUDE)
    unobservable = unobservable_subspace(way).directions
    seen = observability_matrix(way) * typical_sizes(way)
    shown = np.linalg.norm(observability_matrix(way) @ unobservable.T, axis=0)
    assert (shown < 1e-12 * np.linalg.norm(seen, 2)).all()
    # They are directions of unit length in typical sizes, across each other.
    scaled = unobservable / typical_sizes(way)
    np.testing.assert_allclose(scaled @ scaled.T, np.eye(3), rtol=0, atol=64 * EPS)

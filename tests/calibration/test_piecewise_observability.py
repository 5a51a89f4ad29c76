"""Rank of the stripped observability matrix, beside the Gramian and beside known results."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.linalg import expm, subspace_angles
from scipy.spatial.transform import Rotation

from driftlab.calibration.error_dynamics import free_transition, linearize_along
from driftlab.calibration.error_model import ERROR_MODELS, FULL
from driftlab.calibration.observability import (
    _error_rates,
    _observable_rows,
    gramian_ranks,
    stripped_observability as stripped,
    unobservable_subspace,
)
from driftlab.earth import earth_rate, gravity
from driftlab.imu import PriorStandardDeviations
from driftlab.motion.scheme import EIGHTEEN_ROTATIONS, NINETEEN_POSITIONS, SCHEMES, Scheme
from support import EPS

LATITUDE = float(np.radians(37.5))
AVERAGED = ERROR_MODELS["averaged"]
LEVEL = np.array([0.0, 0.0, 0.0, 1.0])
MIXED = Scheme("+50X -70Z +200Y -33Z", ("North", "West", "Up"), dwell=40.0)

stripped_observability = cache(stripped)  # many tests look at the same schemes

every_scheme = pytest.mark.parametrize("scheme", [*SCHEMES.values(), MIXED], ids=[*SCHEMES, "odd"])
every_model = pytest.mark.parametrize("model", [FULL, AVERAGED], ids=["30 states", "27 states"])


def scaled(model, start):
    """Typical sizes of the states; 1 cm/s of velocity."""
    sizes = np.sqrt(np.diag(model.covariance(PriorStandardDeviations(), start)))
    sizes[3:6] = 0.01
    return sizes


# The matrix F


@every_model
def test_rates_grow_into_the_transition_of_a_pause(model):
    scheme = Scheme("", ("South", "Up", "West"), dwell=4.0)
    way, sizes = linearize_along(scheme, LATITUDE, model), scaled(model, scheme.start_attitude)
    rates = _error_rates(model, LATITUDE, scheme.start_attitude, np.zeros(3))
    expected = expm(way.durations[0] * rates)
    gap = np.abs(way.transitions[0] - expected) * sizes / sizes[:, np.newaxis]
    # In a second the Earth turns by 7e-5 rad; `_transition` leaves out what that does to an error
    # that arises meanwhile.
    largest = np.abs(expected * sizes / sizes[:, np.newaxis]).max(axis=1, keepdims=True)
    assert (gap <= 5e-5 * largest).all()


def test_body_axes_are_another_way_to_count_the_same_errors():
    """F in body axes is the derivative of C^T x: followed from moment to moment, both agree."""
    attitude, spin = MIXED.start_attitude, np.array([0.02, -0.1, 0.05])
    found = _error_rates(FULL, LATITUDE, attitude, spin, body_axes=True)
    local = _error_rates(FULL, LATITUDE, attitude, spin)

    def to_body(seconds):
        turned = Rotation.from_quat(attitude) * Rotation.from_rotvec(seconds * spin)
        whole = np.eye(30)
        whole[:6, :6] = np.kron(np.eye(2), turned.as_matrix().T)
        return whole

    rate = (to_body(1e-4) - to_body(-1e-4)) / 2e-4
    expected = (to_body(0) @ local + rate) @ to_body(0).T
    np.testing.assert_allclose(found, expected, atol=1e-10 * np.abs(expected).max())


def test_free_transition_is_the_exponential_of_the_free_rates():
    still = _error_rates(FULL, LATITUDE, LEVEL, np.zeros(3))[:6, :6].copy()
    still[3:, :3] = 0.0  # without gravity
    np.testing.assert_allclose(free_transition(LATITUDE, 60.0), expm(60 * still), rtol=0, atol=1e-9)


# One constant system


def test_powers_and_rounds_find_the_same_rows():
    rng = np.random.default_rng(5)
    basis = np.linalg.qr(rng.standard_normal((7, 7)))[0]
    rates = np.zeros((7, 7))
    rates[:4, :4] = rng.standard_normal((4, 4))
    rates[4:] = rng.standard_normal((3, 7))  # three states that nothing else depends on
    seen = np.zeros((1, 7))
    seen[0, :4] = rng.standard_normal(4)
    rates, seen = basis @ rates @ basis.T, seen @ basis.T
    rows = _observable_rows(rates, seen)
    powers = np.concatenate([seen @ np.linalg.matrix_power(rates, k) for k in range(7)])
    assert rows.shape == (4, 7)
    np.testing.assert_allclose(rows @ rows.T, np.eye(4), atol=1e-14)
    _, values, expected = np.linalg.svd(powers)
    assert values[3] > 1e-6 > values[4]
    assert subspace_angles(rows.T, expected[:4].T).max() < 1e-9


def twelve_states(latitude, attitude=LEVEL):
    """F of a resting unit with three tilts, three velocities and six biases, and its sizes."""
    kept = [i for i, name in enumerate(FULL.names) if i < 6 or "bias" in name]
    rates = _error_rates(FULL, latitude, attitude, np.zeros(3))[np.ix_(kept, kept)]
    sizes = scaled(FULL, attitude)[kept]
    return rates * sizes / sizes[:, np.newaxis], sizes


def test_a_resting_system_of_twelve_states_hides_three():
    """Bar-Itzhack and Berman (1988): two level accelerometers and the East gyro, with the tilts.

    Their ten states leave out the vertical velocity and accelerometer, and show seven.
    """
    rates, sizes = twelve_states(LATITUDE)
    rows = _observable_rows(rates, np.eye(12)[3:6])
    assert len(rows) == 9
    g, (_, north, up) = float(gravity(LATITUDE)), earth_rate(LATITUDE)
    hidden = np.zeros((3, 12))
    hidden[0, [1, 9]] = 1, g  # a tilt about North behind the East accelerometer,
    hidden[0, 6] = up  # and the rate that the turning Earth makes of it
    hidden[1, [0, 10]] = 1, -g
    hidden[1, 7] = -up
    hidden[1, 8] = north
    hidden[2, [2, 6]] = 1, -north  # the heading behind the East gyro
    hidden /= sizes
    hidden /= np.linalg.norm(hidden, axis=1, keepdims=True)
    # Both are of length one, so products of twelve components are rounded by a few eps.
    assert np.abs(rows @ hidden.T).max() < 64 * EPS
    ten = [i for i in range(12) if i not in (5, 11)]
    assert len(_observable_rows(rates[np.ix_(ten, ten)], np.eye(10)[3:5])) == 7


def test_taking_the_three_out_leaves_a_system_that_shows_all():
    """What the classical papers do: no states for the level accelerometers and the East gyro."""
    rates, _ = twelve_states(LATITUDE)
    kept = [i for i in range(12) if i not in (6, 9, 10)]
    assert len(_observable_rows(rates[np.ix_(kept, kept)], np.eye(9)[3:6])) == 9


# Schemes


@every_scheme
@every_model
def test_carried_pieces_have_the_rank_of_the_gramian_of_the_pauses(scheme, model):
    found = stripped_observability(scheme, LATITUDE, model)
    expected = gramian_ranks(scheme, LATITUDE, model, pauses_only=True)
    np.testing.assert_array_equal(found.ranks, expected)
    # Whoever looks in the turns as well sees at least as much.
    assert (gramian_ranks(scheme, LATITUDE, model) >= expected).all()
    assert len(found.null_directions) == model.size - found.ranks[-1]


@every_scheme
@every_model
@pytest.mark.parametrize("turns", ["carried", "in pieces"])
def test_stripped_matrix_has_the_null_directions_of_the_gramian(scheme, model, turns):
    found = stripped_observability(scheme, LATITUDE, model, turns).null_directions
    way = linearize_along(scheme, LATITUDE, model)
    expected, sizes = unobservable_subspace(way).directions, scaled(model, way.start)
    assert len(found) == len(expected)
    if len(found):
        assert subspace_angles((found / sizes).T, (expected / sizes).T).max() < 1e-6


@pytest.mark.parametrize("scheme", SCHEMES.values(), ids=list(SCHEMES))
@pytest.mark.parametrize("turns", ["carried", "ignored", "in pieces"])
def test_what_a_piece_does_not_show_stays(scheme, turns):
    """The condition under which the stripped matrix stands for the total one."""
    found = stripped_observability(scheme, LATITUDE, FULL, turns)
    assert found.moves < 1e-12
    assert found.condition < 1e3  # far from the 1e9 at which a direction would count as unseen


def test_ignored_turns_show_what_cannot_be_seen():
    for scheme in SCHEMES.values():
        assert stripped_observability(scheme, LATITUDE, FULL, "ignored").ranks[-1] == 30


def test_turns_in_pieces_show_an_error_too_early():
    """About one level axis a tilt hides behind an accelerometer; pieces hold it in the body."""
    scheme = Scheme("+90X", dwell=120.0)
    assert gramian_ranks(scheme, LATITUDE, AVERAGED)[-1] == 22
    assert stripped_observability(scheme, LATITUDE, AVERAGED, "in pieces").ranks[-1] == 24


def test_a_bad_start_leaves_three_errors_whatever_the_method():
    scheme = replace(EIGHTEEN_ROTATIONS, start=("North", "Up", "East"))
    for turns in ("carried", "in pieces"):
        found = stripped_observability(scheme, LATITUDE, AVERAGED, turns)
        named = {name for name, at in zip(AVERAGED.names, found.known_after, strict=True) if not at}
        assert found.ranks[-1] == 24
        assert named == {
            f"accelerometer {name}" for name in ("scale z", "installation xz", "installation yz")
        }


def test_a_state_is_known_from_the_position_on_in_which_it_can_be_told():
    """Velocity at once; a gyro's scale error after a turn about it; a bias from both sides."""
    found = stripped_observability(NINETEEN_POSITIONS, LATITUDE, AVERAGED)
    after = dict(zip(AVERAGED.names, found.known_after.tolist(), strict=True))
    assert {after[f"velocity {name}"] for name in ("East", "North", "Up")} == {1}
    assert after["accelerometer bias x"] == 3  # up in the first position and down in the third
    assert after["accelerometer bias y"] == 8  # level until then
    few = replace(NINETEEN_POSITIONS, rotations=NINETEEN_POSITIONS.rotations[:9])
    assert stripped_observability(few, LATITUDE, AVERAGED).ranks.tolist() == [9, 18, 22]
    assert found.ranks[:3].tolist() == [9, 18, 22]


def test_other_turns_than_those_are_refused():
    with pytest.raises(ValueError, match=r"^turns: expected one of carried, ignored, in pieces, "):
        stripped(MIXED, LATITUDE, turns="frozen")

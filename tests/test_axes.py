"""Other people's axes: by hand, by round trips, against SciPy, and on a log that would mislead."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.spatial.transform import Rotation

from driftlab.axes import _axes_rotation, convert_attitude, convert_matrix, convert_vectors
from driftlab.earth import earth_rate
from driftlab.frames import FROM_EAST_NORTH_UP, from_euler_angles, to_euler_angles
from driftlab.gyrocompass import align
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import to_matrix
from driftlab.recordings import Recording
from support import EPS, matrices, quaternions, same_rotation, vectors


def right_handed(letters):
    """All right-handed axes made of six letters in opposite pairs, by SciPy's count of turns."""
    first = np.array([letters.index(letter) for letter in letters])
    unit = dict(zip(letters, np.vstack([np.eye(3), -np.eye(3)])[first], strict=True))
    names = ("".join(name) for name in itertools.permutations(letters, 3))
    return [n for n in names if np.dot(np.cross(unit[n[0]], unit[n[1]]), unit[n[2]]) == 1]


LOCAL, BODY = right_handed("ENUWSD"), right_handed("FLUBRD")
local_axes, body_axes = st.sampled_from(LOCAL), st.sampled_from(BODY)
few = settings(max_examples=30)
# Each component of a product of two or three unit quaternions is a few roundings off.
TURN = 16 * EPS


def test_there_are_as_many_axes_as_turns_of_a_cube():
    assert len(LOCAL) == len(BODY) == 24
    turns = {_axes_rotation("NED", name).tobytes() for name in LOCAL}
    cube = {(m.round() + 0.0).tobytes() for m in Rotation.create_group("O").as_matrix()}
    assert turns == cube


@pytest.mark.parametrize(
    ("old", "new", "components"),
    [
        ("NED", "ENU", [2, 1, -3]),
        ("ENU", "NED", [2, 1, -3]),
        ("ENU", "NUE", [2, 3, 1]),
        ("NUE", "ENU", [3, 1, 2]),
        ("NED", "NUE", [1, -3, 2]),
        ("NED", "NWU", [1, -2, -3]),
        ("FRD", "FUR", [1, -3, 2]),
        ("FRD", "RFU", [2, 1, -3]),
        ("FRD", "FLU", [1, -2, -3]),
        ("RFU", "FUR", [2, 3, 1]),
        ("FLU", "RFU", [-2, 1, 3]),
    ],
)
def test_components_as_read_off_the_letters(old, new, components):
    assert convert_vectors([1, 2, 3], old, new).tolist() == components


@few
@given(local_axes, local_axes, local_axes, vectors())
def test_two_changes_are_one_and_back_is_back(first, second, third, vector):
    halfway = convert_vectors(vector, first, second)
    # Nothing is rounded: components change places and signs.
    np.testing.assert_array_equal(
        convert_vectors(halfway, second, third), convert_vectors(vector, first, third)
    )
    np.testing.assert_array_equal(convert_vectors(halfway, second, first), vector)


@pytest.mark.parametrize("new", ["FLU", "BRU", "RFU"])
def test_no_zero_gets_a_minus_sign(new):
    assert not np.signbit(convert_vectors(np.zeros(3), "FRD", new)).any()
    for zero in (0.0, -0.0):
        assert not np.signbit(convert_matrix(np.full((3, 3), zero), "FRD", new)).any()


@few
@given(body_axes, body_axes, matrices(1.0), vectors())
def test_a_matrix_does_the_same_to_a_vector(old, new, matrix, vector):
    # Sums of three products of numbers up to 1 and 10, added in another order.
    np.testing.assert_allclose(
        convert_matrix(matrix, old, new) @ convert_vectors(vector, old, new),
        convert_vectors(matrix @ vector, old, new),
        rtol=0,
        atol=30 * 4 * EPS,
    )


@few
@given(quaternions(), st.tuples(local_axes, local_axes), st.tuples(body_axes, body_axes))
def test_attitude_is_scipys_between_changed_axes(attitude, reference, body):
    found = convert_attitude(attitude, reference, body)
    expected = _axes_rotation(*reference) @ to_matrix(attitude) @ _axes_rotation(*body).T
    np.testing.assert_allclose(Rotation.from_quat(found).as_matrix(), expected, rtol=0, atol=TURN)
    back = convert_attitude(found, reference[::-1], body[::-1])
    assert same_rotation(back, attitude, TURN)


def test_quaternion_of_part_iv_is_one_of_these():
    level = np.array([0.0, 0.0, 0.0, 1.0])
    assert same_rotation(convert_attitude(level, ("ENU", "NUE")), FROM_EAST_NORTH_UP, EPS)


@few
@given(st.floats(-3.1, 3.1), st.floats(-1.5, 1.5), st.floats(-3.1, 3.1))
def test_yaw_pitch_roll_of_a_textbook_are_heading_pitch_roll(yaw, pitch, roll):
    """Body 3-2-1 angles in NED and FRD; only the heading changes its sign."""
    textbook = Rotation.from_euler("ZYX", [yaw, pitch, roll]).as_quat()
    attitude = convert_attitude(textbook, ("NED", "NUE"), ("FRD", "FUR"))
    # At 86 degrees of pitch heading and roll are 15 times as sensitive.
    np.testing.assert_allclose(to_euler_angles(attitude), [-yaw, pitch, roll], rtol=0, atol=1e-13)


def test_a_log_in_other_axes_misleads_until_it_is_converted():
    latitude = 1.0
    body = from_euler_angles(np.radians(-30.0), 0.0, 0.0)
    rate, force = static_imu(body, latitude)
    log = [convert_vectors(vector, "FUR", "FRD") for vector in (rate, force)]
    assert abs(np.degrees(align(*log).roll)) == pytest.approx(90, abs=1e-9)
    right = align(*(convert_vectors(vector, "FRD", "FUR") for vector in log))
    assert np.degrees(right.heading) == pytest.approx(-30, abs=1e-9)
    assert np.degrees(right.roll) == pytest.approx(0, abs=1e-9)


def test_rate_of_the_earth_in_north_east_down():
    """North component positive, down component negative in the northern hemisphere."""
    north, east, down = convert_vectors(earth_rate(0.7), "ENU", "NED")
    assert north > 0
    assert east == 0
    assert down < 0


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("NED", "NEU", "to_axes: expected right-handed axes, got 'NEU'"),
        ("RFD", "FRD", "from_axes: expected right-handed axes, got 'RFD'"),
        ("NED", "FRD", "to_axes: expected local axes such as 'NED' or 'ENU', as from_axes are loc"),
        ("FRD", "ENU", "to_axes: expected body axes such as 'FRD', as from_axes are body axes"),
        ("NSU", "ENU", "from_axes: expected three letters for three perpendicular directions"),
        ("NED", "ned", "to_axes: expected three letters .* got 'ned': in capitals, please"),
        ("", "FUR", "from_axes: .* got none: of a log, say axes= when it is read"),
        ("NED", "NEDU", "to_axes: expected three letters .* got 'NEDU'.$"),
        ("NED", "nedu", "to_axes: expected three letters .* got 'nedu'.$"),
        ("NED", "NRD", "to_axes: expected three letters"),
        ("NED", None, "to_axes: expected three letters"),
        (3, "NED", "from_axes: expected three letters"),
    ],
)
def test_impossible_axes_are_refused(old, new, sentence):
    with pytest.raises(ValueError, match=f"^{sentence}"):
        convert_vectors([1.0, 2.0, 3.0], old, new)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"reference": "NED"}, "reference: expected a pair of axes, old and new, got 'NED'"),
        ({"body": 3}, "body: expected a pair of axes, old and new, got 3"),
        ({"reference": ("FRD", "FUR")}, "reference: expected local axes such as 'NED' or 'ENU', g"),
        ({"body": ("NED", "ENU")}, "body: expected body axes such as 'FRD', got 'NED'"),
        ({"body": ("FRD", "ENU")}, "body: expected body axes such as 'FRD', got 'ENU'"),
    ],
)
def test_impossible_pairs_are_refused(arguments, sentence):
    with pytest.raises(ValueError, match=f"^{sentence}"):
        convert_attitude([0.0, 0.0, 0.0, 1.0], **arguments)


def test_a_log_in_local_axes_is_refused_by_the_name_that_was_said():
    with pytest.raises(ValueError, match=r"^axes: expected body axes .* 'NED', which are local"):
        Recording(np.zeros((2, 3)), None, 0.01, "rates", axes="NED")

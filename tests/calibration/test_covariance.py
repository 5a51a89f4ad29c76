"""Turns of a table as whole numbers: against rotations, and drawn evenly."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from driftlab.calibration.covariance import STARTS, _TableMoves
from driftlab.motion.scheme import DIRECTIONS, Scheme

MOVES = _TableMoves((90, 180))
TURNS = Scheme(" ".join(MOVES.words)).turns


def in_the_room(start, turns):
    """Rotation vectors (k, 3) of turns in East, North, Up, and the axes (k + 1, 3, 3) between."""
    body = Rotation.from_matrix(np.array([DIRECTIONS[name] for name in STARTS[start]]).T)
    vectors, between = [], [body.as_matrix()]
    for turn in turns:
        axis, angle = TURNS[turn]
        vectors.append(body.apply(angle * axis))
        body = body * Rotation.from_rotvec(angle * axis)
        between.append(body.as_matrix())
    return np.array(vectors), np.array(between)


@pytest.mark.parametrize("seed", range(6))
def test_orientations_are_those_of_rotations(seed):
    rng = np.random.default_rng(seed)
    start, turns = int(rng.integers(24)), rng.integers(len(TURNS), size=6)
    [found] = MOVES.orientations(np.array([start]), turns[np.newaxis])
    expected = in_the_room(start, turns)[1]
    names = [np.array([DIRECTIONS[name] for name in STARTS[one]]).T for one in found]
    np.testing.assert_allclose(names, expected, atol=1e-12)


@pytest.mark.parametrize("seed", range(12))
def test_after_an_exchange_turns_about_other_axes_stay_in_the_room(seed):
    rng = np.random.default_rng(seed)
    start, turns = int(rng.integers(24)), rng.integers(len(TURNS), size=6)
    place, other = int(rng.integers(6)), int(rng.integers(len(TURNS)))
    found = MOVES.exchanged(start, turns, place, other)
    before, after = in_the_room(start, turns)[0], in_the_room(start, found)[0]
    np.testing.assert_array_equal(found[:place], turns[:place])
    assert found[place] == other
    same = MOVES.axes[turns] == MOVES.axes[turns[place]]
    for k in range(place + 1, 6):
        if same[k]:
            assert found[k] == turns[k]
        else:
            np.testing.assert_allclose(after[k], before[k], atol=1e-12)


@pytest.mark.parametrize("two_axes", [False, True])
def test_rows_are_drawn_evenly_from_those_that_a_table_can_do(two_axes):
    starts, rows = MOVES.drawn(np.random.default_rng(1), 4800, 5, two_axes)
    shares = np.bincount(starts, minlength=24) / 200
    # A count of 200 is good to 14; five standard deviations.
    assert (np.abs(shares - 1) < 0.36).all()
    assert MOVES.on_two_axes(starts, rows).all() == two_axes
    # Of two axes either has half of the turns, and keeps all five of them once in 16; of three
    # axes once in 81. The counts are good to 17 and to 8.
    axes = MOVES.axes[rows]
    alone = (axes == axes[:, :1]).all(axis=1).sum()
    assert abs(alone - (4800 / 16 if two_axes else 4800 / 81)) < (85 if two_axes else 40)
    each = np.array([np.bincount(turns, minlength=12) for turns in rows.T]) / 400
    assert (np.abs(each - 1) < 0.4).all()


def test_a_scheme_has_some_of_the_turns_or_all():
    for scheme in (Scheme("+90X -180Z"), Scheme(" ".join(MOVES.words))):
        start, row = MOVES.row(scheme)
        assert MOVES.scheme(start, row).rotations == scheme.rotations
    with pytest.raises(ValueError, match=r"^scheme: expected turns by 90, 180 degrees, got"):
        MOVES.row(Scheme("+90X -270Z"))

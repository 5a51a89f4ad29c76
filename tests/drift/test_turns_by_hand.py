"""Turns by hand: found among other moves, and made into numbers whose deviations are honest."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import t

from driftlab.drift.turns_by_hand import (
    HandTurn,
    HandTurnFit,
    fit_hand_turns,
    hand_turns,
    near_turns,
)

REST = np.zeros((40, 3))


def turned(*angle, rows=100):
    """Rows that add up to an angle, in turns."""
    return np.tile(2 * np.pi * np.array(angle) / rows, (rows, 1))


def record(*moves):
    """Increments of moves with rests between them, and the rests."""
    parts, rests, at = [], [], 0
    for move in [*moves, None]:
        rests.append((at, at + len(REST)))
        parts.append(REST)
        at += len(REST)
        if move is not None:
            parts.append(move)
            at += len(move)
    return np.concatenate(parts), np.array(rests)


def test_a_rest_may_begin_where_the_last_ends():
    rows, rests = record(turned(0, 0, 1.0))
    first, second = rests
    (found,) = hand_turns(rows, 0.1, [[0, 20], [20, first[1]], second])
    assert (found.axis, found.turns, found.begin, found.end) == (2, 1, 30, 160)


def test_finds_turns_and_leaves_out_other_moves():
    moves = turned(0, 0, 1.01), turned(0, 0.25, 0), turned(-2.02, 0, 0), turned(0.7, 0, 0.7)
    rows, rests = record(*moves)
    found = hand_turns(rows, 0.1, rests)
    assert [(each.axis, each.turns) for each in found] == [(2, 1), (0, -2)]
    assert [(each.begin, each.end) for each in found] == [(20, 160), (300, 440)]
    assert np.allclose([each.estimate for each in found], 0.01, rtol=0, atol=1e-12)
    assert np.allclose([each.seconds for each in found], 14.0)


def test_tells_the_moves_that_nearly_were_turns():
    there_and_back = np.concatenate([turned(0, 0, 1.0), turned(0, 0, -1.0)])
    moves = turned(0, 330 / 360, 0), turned(0, 0, 1.01), turned(0.5, 0, 0), there_and_back
    rows, rests = record(*moves, turned(0.2, 0, 1.0), turned(0, 0.25, 0))
    bias = np.array([1e-4, -2e-4, 3e-4])  # up to four degrees in a move, which is no reach
    found = near_turns(rows + bias, 0.1, rests)
    assert [(each.axis, each.begin, each.end) for each in found] == [
        (1, 20, 160),
        (2, 440, 680),
        (2, 680, 820),
    ]
    whole = [each.begin for each in hand_turns(rows, 0.1, rests)]
    assert whole == [160]
    reached = np.degrees([each.reach for each in found])
    assert np.allclose(reached, [330, 360, 360], rtol=0, atol=1e-9)
    ended, across = np.degrees(
        [(each.angle, each.across) for each in near_turns(rows, 0.1, rests)]
    ).T
    assert np.allclose(ended, [330, 0, 360], rtol=0, atol=1e-9)
    assert np.allclose(across, [0, 0, 72], rtol=0, atol=1e-9)
    assert np.allclose([each.seconds for each in found], [14.0, 24.0, 14.0])


def test_turn_about_a_pair_axis_is_found_if_it_is_looked_for():
    pair = np.array([1.0, 1.0, 0.0]) / np.sqrt(2)
    rows, rests = record(turned(*pair))
    assert hand_turns(rows, 0.1, rests) == []
    (found,) = hand_turns(rows, 0.1, rests, [[1, 1, 0], [0, 1, 1]])
    assert (found.axis, found.turns) == (0, 1)


def test_steady_part_of_a_turn_is_no_rest():
    rows, rests = record(turned(0, 0, 1.0), turned(0, 0, -1.0))
    with_steady = np.insert(rests, [1, 2], [[60, 90], [200, 230]], axis=0)
    assert hand_turns(rows, 0.1, with_steady) == hand_turns(rows, 0.1, rests)


def test_the_hand_is_still_at_work_at_the_ends_of_a_rest():
    rows, rests = record(turned(0, 0, 1.0), turned(0, 0, -1.0))
    for begin, end in rests:
        rows[begin : begin + 10] += [0.0, 0.0, 1e-3]
        rows[end - 10 : end] -= [0.0, 0.0, 2e-3]
    found = hand_turns(rows, 0.1, rests)
    assert np.allclose([each.static_rate for each in found], 0.0, rtol=0, atol=1e-15)


@pytest.mark.parametrize("bias", [[0.0, 0.0, 0.002], [1e-3, -8e-4, 5e-4]])
def test_rests_tell_the_bias_along_and_take_out_the_square_of_that_across(bias):
    rows, rests = record(turned(0, 0, 1.0), turned(0, 0, -1.0))
    found = hand_turns(rows + bias, 0.1, rests)
    assert np.allclose([each.static_rate for each in found], 10 * bias[2], rtol=1e-12)
    fit = fit_hand_turns(found)
    assert np.allclose(fit.sigma, 0, atol=1e-12)
    assert np.allclose(fit.offset, 10 * bias[2], rtol=1e-12)
    assert fit.degrees_of_freedom == 0
    assert np.isnan(fit.stop_standard_deviation)


@pytest.mark.parametrize("confidence", [0.5, 0.99])
def test_intervals_are_those_of_student(confidence):
    sigma, offset = np.array([2e-3, 5e-3]), np.array([1e-5, 3e-5])
    fit = HandTurnFit((0, 2), np.zeros(2), np.zeros(2), sigma, offset, 0.01, 5)
    for found, deviation in zip(fit.half_widths(confidence), (sigma, offset), strict=True):
        low, high = t.interval(confidence, 5, 0.0, deviation)
        np.testing.assert_allclose([-found, found], [low, high], rtol=1e-9)


STOP = 0.003
"""Standard deviation of a stop in the experiments below, rad."""


def chain(stops, senses, axis=0):
    """Turns of one axis after each other, whose angles err by the difference of two stops."""
    seconds = 10 + np.arange(len(senses))
    errors = np.diff(stops) / (2 * np.pi * senses)
    return [
        HandTurn(axis, int(sense), i, i + 1, t, 0.01 + 0.02 * t / (2 * np.pi * sense) + error, 0)
        for i, (sense, t, error) in enumerate(zip(senses, seconds, errors, strict=True))
    ]


@pytest.mark.parametrize("senses", [[1, 1, -1, -1], [1, -1, 1, -1], [2, -1, -1, 1, 1, -2]])
def test_deviations_are_those_of_many_repetitions(senses):
    rng = np.random.default_rng(3)
    count = 250
    fits = [
        fit_hand_turns(chain(rng.normal(0, STOP, len(senses) + 1), np.array(senses)))
        for _ in range(count)
    ]
    found = np.array([(*fit.sigma, *fit.offset) for fit in fits])
    stated = np.array(
        [(*fit.sigma_standard_deviation, *fit.offset_standard_deviation) for fit in fits]
    )
    # The variance of a variance from n normal values is 2/n of its square, from k degrees of
    # freedom in each of n fits 2/(k n); five standard deviations of their ratio.
    spare = fits[0].degrees_of_freedom
    bound = 5 * np.sqrt(2 / count + 2 / (spare * count))
    ratio = found.var(axis=0) / (stated**2).mean(axis=0)
    assert np.abs(ratio - 1).max() < bound
    scatter = np.mean([fit.stop_standard_deviation**2 for fit in fits]) / STOP**2
    assert abs(scatter - 1) < 5 * np.sqrt(2 / (spare * count))
    inside = [abs(fit.sigma[0] - 0.01) < fit.half_widths()[0][0] for fit in fits]
    assert abs(np.mean(inside) - 0.95) < 5 * np.sqrt(0.95 * 0.05 / count)


def test_each_axis_costs_two_degrees_of_freedom():
    stops = STOP * np.random.default_rng(5).normal(size=5)
    first = chain(stops, np.array([1, -1, 1, -1]))
    later = chain(stops, np.array([1, -1, 2, -1]), axis=2)
    later = [replace(turn, begin=turn.begin + 10, end=turn.end + 10) for turn in later]
    fit = fit_hand_turns([*first, *later])
    assert fit.axes == (0, 2)
    assert fit.degrees_of_freedom == 4
    alone = [fit_hand_turns(turns) for turns in (first, later)]
    np.testing.assert_allclose(fit.sigma, [each.sigma[0] for each in alone])
    # The scatter is that of all together.
    squares = [each.stop_standard_deviation**2 for each in alone]
    assert fit.stop_standard_deviation == pytest.approx(np.sqrt(np.mean(squares)))


@pytest.mark.parametrize(
    ("rests", "sentence"),
    [
        ([[0, 10], [5, 20]], r"^static_intervals: expected rows from 0 to 100 in order"),
        ([[0, 10], [90, 101]], r"^static_intervals: expected rows from 0 to 100 in order"),
        ([[0, 10], [20, 22]], r"^static_intervals: expected four rows or more"),
        ([0, 10], r"^static_intervals: expected whole numbers of shape \(m, 2\)"),
        ([[0.0, 10.0]], r"^static_intervals: expected whole numbers of shape \(m, 2\)"),
    ],
)
def test_rests_that_are_none_are_refused(rests, sentence):
    with pytest.raises(ValueError, match=sentence):
        hand_turns(np.zeros((100, 3)), 0.1, rests)


def test_one_sense_is_refused_and_nothing_too():
    with pytest.raises(ValueError, match=r"^turns: expected both senses about axis 0, got one"):
        fit_hand_turns(chain(np.zeros(3), np.array([1, 1])))
    with pytest.raises(ValueError, match=r"^turns: expected whole turns, got none"):
        fit_hand_turns([])


def test_turns_that_say_the_same_twice_are_refused_and_those_that_are_none():
    pair = chain(np.zeros(3), np.array([1, -1]))
    ring = [*pair, replace(pair[0], turns=2, end=2)]
    for turns in ([pair[0], *pair], ring):
        with pytest.raises(ValueError, match=r"^turns: expected turns of which none follows"):
            fit_hand_turns(turns)
    for change in ({"turns": 0}, {"seconds": 0.0}, {"seconds": np.nan}, {"end": 0}):
        with pytest.raises(ValueError, match=r"^turns: expected whole turns that take some time"):
            fit_hand_turns([*pair, replace(pair[0], **change)])

"""Dead, stuck and clipped channels, counted by hand."""

import numpy as np
import pytest

from driftlab.recordings.channels import (
    ENOUGH,
    clipped_rows,
    dead_channels,
    longest_run,
    twin_channels,
)


@pytest.mark.parametrize(("rows", "told"), [(ENOUGH, True), (ENOUGH - 1, False)])
def test_dead_channels_and_twins_are_told_from_a_hundred_rows_on(rows, told):
    one, other = np.random.default_rng(1).standard_normal((2, rows))
    channels = np.stack([one, np.full(rows, 3.0), other, 2 - one], axis=1)
    assert dead_channels(channels) == [False, told, False, False]
    assert twin_channels(channels) == ([(0, 3)] if told else [])
    assert dead_channels(np.ones((rows, 2))) == [False, False]  # none of them changes


@pytest.mark.parametrize("begin", [0, 1, 7, 15])
def test_the_longest_run_is_found_wherever_it_begins(begin):
    channel = np.arange(20.0)
    channel[begin : begin + 5] = -1
    assert longest_run(channel)[:2] == (begin, 5)


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("rows", [3, 40, 49, 50, 60, 97])
def test_a_channel_at_its_extreme_for_half_of_the_time_or_more_rests_there(rows, sign):
    """Each level below has one row, and one more is counted."""
    channel = -np.arange(100.0).clip(rows - 1)
    assert clipped_rows(sign * channel) == ((rows, rows / 2) if rows < 50 else (0, 0.0))

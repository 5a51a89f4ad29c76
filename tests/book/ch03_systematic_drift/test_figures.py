"""The figures of chapter 03: the drift in time, by symmetry, over all axes, of closed motions."""

import numpy as np
import pytest
from hypothesis import given

from driftlab.book.ch03_systematic_drift.experiments import (
    REPEATS,
    closed_motions,
    drift_history,
)
from driftlab.book.machinery.figure.publish import PublishedFigure
from driftlab.book.scenarios import LARIN_TRIAD
from driftlab.drift.closed_motion import exact_drift_per_cycle
from published import published
from support import directions, matrices


@given(matrices(2e-3), directions())
def test_drift_history_stays_within_the_fixed_axes(
    error_matrix: np.ndarray, direction: np.ndarray
) -> None:
    data = drift_history(error_matrix, direction)
    table = data.columns()
    assert np.abs(table["along_deg"]).max() < 12
    assert table["across_arcmin"].max() < 45
    np.testing.assert_allclose(data.turns[::60], data.whole_turns, rtol=0, atol=1e-12)
    # (2.3), made exact: once a turn the error is so many times the drift of one turn.
    seen = np.linalg.norm(data.error[::60], axis=-1)
    expected = np.abs(data.whole_turns * data.exact_per_turn)
    np.testing.assert_allclose(seen, expected, rtol=1e-6, atol=1e-14)


@published("03-drift-by-symmetry")
def test_drift_by_symmetry_slopes_and_cosine(figure: PublishedFigure) -> None:
    data = figure.data
    slope = [
        np.polyfit(np.log(data.sizes), np.log(drift), 1)[0] for drift in (data.symmetric, data.skew)
    ]
    np.testing.assert_allclose(slope, [1, 2], atol=0.01)
    # The skew part adds nothing about (1, 1, 1), its own axis; only second order is left.
    expected = 4 * np.pi * np.cos(data.mixing)
    np.testing.assert_allclose(data.mixed_per_size, expected, rtol=0, atol=1e-10)


@published("03-closed-motions")
def test_closed_motions_leave_the_same_each_time_and_the_swing_nothing(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    for name, motion in closed_motions().items():
        back = data.angle[name][data.motions % 1 == 0]
        exact = np.linalg.norm(exact_drift_per_cycle(motion, LARIN_TRIAD))
        # The samples of the cone miss its start by less than 1e-4 rad.
        np.testing.assert_allclose(back, exact * np.arange(REPEATS + 1), rtol=1e-4, atol=1e-12)
        # What first order lacks is of the size of the entries squared, some turns long.
        assert abs(exact - data.drift[name]) < 4 * np.pi * np.abs(LARIN_TRIAD).max() ** 2
        assert f"({name})" in figure.caption or name == "swing"
    assert data.drift["swing"] < 1e-14
    # On the way the swing is wrong as well.
    assert data.angle["swing"].max() > 1e-4


def test_closed_motions_are_as_fine_as_asked() -> None:
    fine, coarse = closed_motions(720), closed_motions(6)
    for name in ("whole turn", "tumble", "swing"):
        np.testing.assert_allclose(fine[name].sum(axis=0), coarse[name].sum(axis=0), atol=1e-12)
    with pytest.raises(ValueError, match="increments: expected a multiple of six, got 100"):
        closed_motions(100)

"""The ship that turns with a bent triad: the puzzle's numbers, its factor, and its handles."""

import numpy as np
import pytest
from scipy.constants import arcsecond, minute

from driftlab.book import CapstoneExplorer, TurningShip
from driftlab.book.ch16_one_triad.experiments import (
    MISALIGNMENT,
    NON_ORTHOGONALITY,
    STAGES,
    bent_triad,
    left_over,
)
from driftlab.book.ch16_one_triad.puzzle import heading_error
from driftlab.book.ch16_one_triad.scenes import LEAN_FACTOR, LENGTH, bent_of, tips_of
from driftlab.book.ch16_one_triad.turning_ship import swing_factor, turning_ship
from driftlab.book.scenarios import SPEED, TURN
from driftlab.quaternion import rotate
from grouped import opened
from support import largest


def test_the_first_preset_is_the_puzzle() -> None:
    scene = opened(TurningShip)
    leaning = bent_of(scene.values)
    expected = np.zeros((3, 3))
    expected[0, 1] = -30 * arcsecond
    assert largest(leaning - expected) < 1e-12
    run = turning_ship(leaning)
    here = np.searchsorted(run.times, sum(TURN) + 30 * minute)
    assert np.isclose(abs(run.shown_error[here]) / arcsecond, heading_error(), rtol=1e-9)


@pytest.mark.parametrize("degrees", [0.0, 30.0, 51.5, 70.0])
def test_the_heading_swings_with_the_horizon_as_the_factor_says(degrees: float) -> None:
    latitude = np.radians(degrees)
    run = turning_ship(bent_triad([-15 * arcsecond, 0, 0], [0, 0, 15 * arcsecond]),
                       latitude=latitude)  # fmt: skip
    after = run.times > sum(TURN)
    # From the first extreme of either to its last; the line of the swing turns meanwhile.
    ratio = np.ptp(run.shown_error[after]) / np.ptp(run.tilt[after, 1])
    assert abs(ratio / swing_factor(latitude) - 1) < 0.05


def test_the_turn_leaves_the_tilt_of_the_formula() -> None:
    """Twice the sine of half the turn, times the size of the second column of K; chapter 16."""
    bent = bent_triad(NON_ORTHOGONALITY, MISALIGNMENT)
    for turn in (np.pi / 2, np.pi):
        run = turning_ship(bent, turn=turn)
        here = np.searchsorted(run.times, sum(TURN))
        formula = 2 * np.sin(turn / 2) * np.hypot(bent[0, 1], bent[2, 1])
        # Two minutes of a swing of 84 go by while it turns.
        assert abs(np.hypot(*run.tilt[here]) / formula - 1) < 0.03


def test_whole_turns_leave_half_of_the_bend_and_the_filter_next_to_nothing() -> None:
    bent = bent_triad(NON_ORTHOGONALITY, MISALIGNMENT)
    built, turned, filtered = (
        largest(turning_ship(left_over(bent, stage), speed=SPEED).shown_error) for stage in STAGES
    )
    assert built > 2 * turned > 20 * filtered
    panel = opened(CapstoneExplorer)
    stages = panel.compute(panel.values).heading_error
    # The panel sails in steps of 16 s.
    found = [largest(errors) for errors in stages]
    assert np.allclose(found, [built, turned, filtered], rtol=0.03)


def test_the_gyros_are_drawn_as_they_lean() -> None:
    bent = bent_triad(NON_ORTHOGONALITY, MISALIGNMENT)
    tips = tips_of(bent)
    assert np.allclose(np.linalg.norm(tips, axis=1), LENGTH)
    # The forward gyro points to the bow, the upper one up, the right one to the right.
    right, forward, up = tips[0] / tips[0, 1]
    assert forward == 1
    assert np.allclose([up, right], LEAN_FACTOR * bent[0, 1:])
    scene = opened(TurningShip)
    stage = scene.view.stage(scene.compute(scene.values))
    gyro = next(p for p in stage.views[0].parts if p.handle == "gyro 1")
    east, north, _ = rotate(stage.tracks["ship"][-1], gyro.points[0])
    assert east < -0.9 * LENGTH  # after the turn to the West
    assert abs(north) < 1e-9


def test_a_dragged_gyro_leaves_the_others() -> None:
    scene = opened(TurningShip)
    scene.preset.value = "Bent and turned"
    before = bent_of(scene.values)
    target = before.copy()
    target[1] = np.array([12.0, 0.0, -24.0]) * arcsecond
    message = {"handle": "gyro 2", "direction": tips_of(target)[1].tolist()}
    scene._asked(None, message, [])
    # The sliders stop at whole seconds.
    assert largest(bent_of(scene.values) - target) < 1.01 * arcsecond
    # As far as it goes: still the others stay.
    scene._asked(None, {"handle": "gyro 2", "direction": [0.5, 0.5, 0.1]}, [])
    after = bent_of(scene.values)
    assert largest((after - target)[[0, 2]]) < 1.01 * arcsecond
    assert (after[1, [0, 2]] > 40 * arcsecond).all()

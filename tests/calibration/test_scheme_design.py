"""Designed schemes: pieces are the covariance analysis; the search never loses, and repeats."""

import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from driftlab.calibration.covariance import covariance_analysis
from driftlab.calibration.error_dynamics import linearize_along
from driftlab.calibration.error_model import FULL
from driftlab.calibration.scheme_design import CRITERIA, DesignTask, _neighbours, design_scheme
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.motion.scheme import EIGHTEEN_ROTATIONS, NINETEEN_POSITIONS, SCHEMES, Scheme
from driftlab.motion.turntable import segments
from driftlab.quaternion import rotate

SMALL = DesignTask(positions=6)
DRAWN = SMALL.random_schemes(np.random.default_rng(3), 12)


def in_time(scheme, task):
    return replace(scheme, rate=task.rate).with_duration(task.duration)


def analysed(scheme, task):
    """Covariance of `covariance_analysis`, step by step."""
    way = linearize_along(in_time(scheme, task), task.latitude, task.model)
    return covariance_analysis(way, task.noise, task.prior)


# The criterion


@pytest.mark.parametrize(
    "task",
    [
        DesignTask(),
        DesignTask("volume", latitude=-0.9, duration=900.0, rate=float(np.radians(30))),
        DesignTask("mean", model=FULL, noise=ImuNoise(1e-5, 1e-4, 0.002)),
    ],
    ids=lambda task: task.criterion,
)
def test_pieces_are_the_covariance_analysis(task):
    """Variances fall by seven decades, and each way loses digits in its own places."""
    for scheme in SCHEMES.values():
        rows = task._rows
        found = rows.after([rows.row(scheme)])[0]
        expected = analysed(scheme, task)
        sizes = np.sqrt(np.diag(expected))
        np.testing.assert_allclose(
            found / np.outer(sizes, sizes), expected / np.outer(sizes, sizes), rtol=0, atol=1e-7
        )
        assert task.value(scheme) == pytest.approx(float(task.values(expected)), rel=1e-7)


def test_criteria_are_what_they_are_called():
    rng = np.random.default_rng(4)
    root = rng.standard_normal((27, 40))
    covariance, sizes = root @ root.T, tuple(rng.uniform(1, 3, 21))
    inner = covariance[6:, 6:] / np.outer(sizes, sizes)
    axes = np.sqrt(np.linalg.eigvalsh(inner))
    expected = {
        "worst": np.sqrt(np.diag(inner)).max(),
        "mean": np.sqrt(np.mean(axes**2)),
        "volume": np.exp(np.log(axes).mean()),
    }
    for name in CRITERIA:
        found = DesignTask(name, requirement=sizes).values(np.stack([covariance, 4 * covariance]))
        np.testing.assert_allclose(found, [expected[name], 2 * expected[name]], rtol=1e-12)


# The table


def room_axes(scheme):
    """For each turn its axis in the body, and in the room: 0, 1, 2 for East, North, Up."""
    turns = [segment for segment in segments(scheme, 1e-3) if segment.rate]
    body = [int(np.argmax(segment.axis)) for segment in turns]
    room = [int(np.abs(rotate(segment.attitude, segment.axis)).argmax()) for segment in turns]
    return body, room


@pytest.mark.parametrize("scheme", [*SCHEMES.values(), *DRAWN], ids=lambda scheme: scheme.rotations)
def test_a_table_with_two_axes_turns_about_one_of_the_body_and_a_level_one(scheme):
    body, room = room_axes(scheme)
    assert any(
        all(b == inner or r == outer for b, r in zip(body, room, strict=True))
        for inner in range(3)
        for outer in range(2)
    )
    start, row = SMALL._rows.moves.row(scheme)
    assert SMALL._rows.moves.on_two_axes(np.array([start]), row[np.newaxis]).tolist() == [True]


def test_random_schemes_fill_the_time_and_show_some_of_everything():
    for scheme in DRAWN:
        assert in_time(scheme, SMALL).dwell == pytest.approx(scheme.dwell, rel=1e-12)
        assert scheme.positions == 6
    assert {word[-1] for scheme in DRAWN for word in scheme.rotations.split()} == set("XYZ")
    assert len({scheme.start for scheme in DRAWN}) > 3


# The search


@pytest.mark.parametrize("two_axes", [True, False])
def test_a_design_is_never_worse_than_what_it_began_with(two_axes):
    task = replace(SMALL, two_axes=two_axes)
    begin = Scheme("+180X -90Y -90Y +90X +90X", ("Up", "East", "North"))
    design = design_scheme(task, np.random.default_rng(2), draws=20, climbs=1, begin=begin)
    assert design.value <= min(task.value(begin), design.drawn.min())
    assert design.value == pytest.approx(task.value(design.scheme), rel=1e-9)
    assert design.value == pytest.approx(
        float(task.values(analysed(design.scheme, task))), rel=1e-7
    )
    assert all(climb.after <= climb.before for climb in design.climbs)
    assert [climb.after for climb in design.climbs] == sorted(c.after for c in design.climbs)
    assert in_time(begin, task).rotations in {climb.begin.rotations for climb in design.climbs}
    assert design.tried > 20


def test_neighbours_differ_in_one_turn_in_the_order_or_in_the_start():
    moves = SMALL._rows.moves
    turns = np.array([0, 1, 1])
    found = {(start, *row.tolist()) for start, row in _neighbours(moves, 5, turns)}
    count = len(moves.words)
    one = {(5, *np.where(np.arange(3) == place, other, turns).tolist())
           for place in range(3) for other in range(count)}  # fmt: skip
    orders = {(5, 1, 0, 1), (5, 1, 1, 0)}
    starts = {(start, 0, 1, 1) for start in range(24)}
    assert (one | orders | starts) - found == {(5, 0, 1, 1)}
    # The others keep later turns in the room.
    exchanged = {(5, *moves.exchanged(5, turns, place, other).tolist())
                 for place in range(3) for other in range(count)}  # fmt: skip
    assert found <= one | orders | starts | exchanged


def test_no_other_row_of_two_turns_is_better():
    """Few enough to try them all: the search finds the best of 24 starts and 36 rows."""
    task = DesignTask("mean", positions=3, angles=(90,), two_axes=False)
    words = [f"{sign}90{axis}" for axis in "XYZ" for sign in "+-"]
    starts = [task._rows.scheme(i, np.array([0, 0])).start for i in range(24)]
    best = min(
        task.value(Scheme(f"{first} {second}", start))
        for start in starts
        for first in words
        for second in words
    )
    found = design_scheme(task, np.random.default_rng(1), draws=20, climbs=3).value
    assert found == pytest.approx(best, rel=1e-6)


PROGRAM = """
import numpy as np
from driftlab.calibration import DesignTask, design_scheme
design = design_scheme(DesignTask(positions=5), np.random.default_rng(7), draws=20, climbs=1)
print(design.scheme, design.tried, f"{design.value:.6g}")
"""


def test_another_processor_finds_the_same_scheme():
    """The kernels of OpenBLAS differ in the last digits; the search must not follow them."""
    said = {
        subprocess.run(
            [sys.executable, "-c", PROGRAM],
            env={**os.environ, "OPENBLAS_CORETYPE": kernel, "OPENBLAS_NUM_THREADS": "1"},
            check=True,
            capture_output=True,
            text=True,
        ).stdout
        for kernel in ("Prescott", "Haswell")
    }
    assert len(said) == 1


# Refusals


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"criterion": "best"}, "criterion: expected one of worst, mean, volume, got 'best'"),
        ({"requirement": (0.0,) * 21}, "requirement: expected positive deviations"),
        ({"positions": 1}, "positions: expected"),
        ({"duration": 200.0}, "duration: expected more than 343 s"),
        ({"angles": (45,)}, r"angles: expected some of 90, 180, 270, 360, got \(45,\)"),
        ({"angles": ()}, "angles: expected some of"),
        ({"latitude": np.pi / 2}, "latitude: expected"),
        ({"noise": ImuNoise(reference_velocity=0.0)}, "noise: expected a deviation of the ref"),
        ({"prior": 1.0}, "prior: expected"),
        ({"rate": 0.0}, "rate: expected"),
    ],
)
def test_tasks_that_are_none_are_refused(arguments, sentence):
    with pytest.raises(ValueError, match=f"^{sentence}"):
        DesignTask(**arguments)


@pytest.mark.parametrize(
    ("begin", "sentence"),
    [
        (Scheme("+45X +90Y +90Z +90X +90Y"), "scheme: expected turns by 90, 180 degrees, got"),
        (Scheme("+90X"), r"begin: expected 6 positions that the table can do, got '\+90X' from"),
        (Scheme("+90X +90Y +90Z +90X +90Y"), "begin: expected 6 positions that the table can"),
    ],
)
def test_beginnings_that_do_not_fit_are_refused(begin, sentence):
    with pytest.raises(ValueError, match=f"^{sentence}"):
        design_scheme(SMALL, np.random.default_rng(1), draws=2, climbs=1, begin=begin)


def test_a_scheme_that_takes_too_long_is_refused():
    with pytest.raises(ValueError, match=r"^scheme: expected turns and pauses in 200 s, got"):
        DesignTask(positions=2, duration=200.0).value(EIGHTEEN_ROTATIONS)


def test_pauses_may_be_short_but_not_nothing():
    task = DesignTask(positions=2, rate=np.pi / 20)  # so a quarter turn takes ten seconds
    scheme = Scheme("+90X +180X")
    assert replace(task, duration=30.3).value(scheme) > 0
    with pytest.raises(ValueError, match=r"^scheme: expected turns and pauses in 30 s, got"):
        replace(task, duration=30.0).value(scheme)


def test_states_that_are_known_before_leave_the_criterion():
    for criterion in ("worst", "mean", "volume"):
        task = DesignTask(criterion, prior=PriorStandardDeviations(scale_factor=0.0))
        assert 0 < task.value(NINETEEN_POSITIONS) < 1
    with pytest.raises(ValueError, match=r"^prior: expected some sensor error"):
        DesignTask(prior=PriorStandardDeviations(0, 0, 0, 0, 0))


def test_covariance_of_another_shape_is_refused():
    with pytest.raises(ValueError, match=r"^covariance: expected shape \(\.\.\., 27, 27\)"):
        DesignTask().values(np.eye(21))

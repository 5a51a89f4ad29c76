"""What the scene of the schemes claims: the table's own motion, and which turn tells what."""

import numpy as np
import pytest

from driftlab.book.ch11_kalman_calibration.experiments import scheme_run
from driftlab.book.ch11_kalman_calibration.scenes import PLAYED
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration import ERROR_MODELS, covariance_analysis, linearize_along
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.motion.scheme import NINETEEN_POSITIONS
from driftlab.motion.turntable import turntable_trajectory
from driftlab.quaternion import conjugate, multiply, rotate, rotation_angle


def test_the_cube_stands_as_the_table_does() -> None:
    run = scheme_run()
    true = turntable_trajectory(NINETEEN_POSITIONS, TABLE_LATITUDE, 0.75)
    at = run.time / 0.75
    whole = np.flatnonzero(np.abs(at - at.round()) < 1e-6)
    assert len(whole) > 200
    assert run.time[-1] == pytest.approx(19 * 120 + 18 * 9)
    away = multiply(conjugate(true.attitude[at.round().astype(int)[whole]]), run.attitude[whole])
    assert rotation_angle(away).max() < 1e-9


@pytest.mark.parametrize("name", PLAYED)
def test_words_say_how_the_cube_stands(name) -> None:
    run = scheme_run(PLAYED[name])
    towards = {"Up": (2, 1), "Down": (2, -1), "North": (1, 1), "South": (1, -1)}
    for doing in np.flatnonzero([not said.startswith("turns") for said in run.doings]):
        moment = np.flatnonzero(run.doing == doing)[0]
        for said, axis in zip(run.doings[doing].split(", "), np.eye(3), strict=True):
            row, sign = towards.get(said[2:], (0, 1 if said[2:] == "East" else -1))
            assert rotate(run.attitude[moment], axis)[row] == pytest.approx(sign, abs=1e-9)


def test_the_last_deviations_are_those_of_the_covariance_analysis() -> None:
    way = linearize_along(NINETEEN_POSITIONS, TABLE_LATITUDE, ERROR_MODELS["averaged"])
    last = covariance_analysis(way, ImuNoise(), PriorStandardDeviations())
    np.testing.assert_allclose(
        scheme_run().standard_deviations[-1], np.sqrt(np.diag(last)), rtol=1e-12
    )


@pytest.mark.parametrize("axis", "xyz")
def test_a_gyro_scale_error_waits_for_turns_about_its_own_axis(axis) -> None:
    run = scheme_run()
    level = np.log(run.standard_deviations[:, run.names.index(f"gyro scale {axis}")])
    own = [k for k, said in enumerate(run.doings) if said.endswith(f"about {axis}")]
    during = np.isin(run.doing[:-1], [*own, *(k + 1 for k in own)])
    assert np.diff(level)[during].sum() < 0.85 * (level[-1] - level[0])


@pytest.mark.parametrize("axis", "xyz")
def test_an_accelerometer_bias_waits_until_its_axis_has_stood_up_and_down(axis) -> None:
    run = scheme_run()
    deviation = run.standard_deviations[:, run.names.index(f"accelerometer bias {axis}")]
    both = max(
        next(k for k, said in enumerate(run.doings) if f"{axis} {way}" in said)
        for way in ("Up", "Down")
    )
    before = np.flatnonzero(run.doing == both)[0]
    after = np.flatnonzero(run.doing == both)[-1]
    assert deviation[before] > 0.1 * deviation[0]
    assert deviation[after] < 0.01 * deviation[0]


def test_from_a_bad_start_one_scale_error_is_never_learnt() -> None:
    run = scheme_run(PLAYED["18 rotations, bad start"])
    lost = run.standard_deviations[-1] > 0.5 * run.standard_deviations[0]
    assert "accelerometer scale z" in np.array(run.names)[lost]
    assert np.abs(rotate(run.attitude, [0.0, 0.0, 1.0])[:, 2]).max() < 1e-9

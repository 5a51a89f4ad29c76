"""`diagnose` at a table that stands within 10 micrometres a second, on a log of 100 Hz.

The pauses are no multiple of any step in which slips are tried; the gyros are ten times better than
usual, so that small slips show.
"""

import pickle
import re

import numpy as np
import pytest

from driftlab import diagnosis
from driftlab.calibration import (
    ERROR_MODELS,
    InconsistentCalibrationWarning,
    calibrate,
    innovation_test,
    to_json,
)
from driftlab.calibration._filter_inputs import evidence
from driftlab.calibration.filter import FilterFailure
from driftlab.checks import UnusualWarning
from driftlab.diagnosis import _Judge, diagnose
from driftlab.earth import EARTH_RATE
from driftlab.higher_order_errors import NO_HIGHER_ORDER_ERRORS
from driftlab.imu import TYPICAL_ERRORS, ImuNoise, PriorStandardDeviations
from driftlab.increments import Increments, measure
from driftlab.motion import Scheme, turntable_trajectory
from driftlab.quaternion import from_rotation_vector, multiply
from driftlab.recordings import Recording

LATITUDE = np.radians(60.0)
NOISE = ImuNoise(angle_random_walk=np.radians(5e-4) / 60, reference_velocity=1e-5)
TABLE = turntable_trajectory(
    Scheme("+90X +90X +90Y +90Y +90Z +90X +90Z", ("North", "West", "Up"), dwell=37.37),
    LATITUDE,
    0.01,
    multiple_of=2,
)
ARMS = NO_HIGHER_ORDER_ERRORS._replace(
    lever_arms=np.array([[3, 1, 0], [0, 2, 1], [1, -1, 4]]) / 100, time_skew=np.array(2e-3)
)
MODEL = ERROR_MODELS["averaged"]
LARGER = MODEL.with_states("lever arms", "time skew")
PLAIN, ARMED = (
    measure(TABLE.increments, TYPICAL_ERRORS, NOISE, np.random.default_rng(2), higher_order=besides)
    for besides in (None, ARMS)
)


def arguments(increments=PLAIN, **changes):
    return {
        "increments": increments,
        "latitude": LATITUDE,
        "start": TABLE.attitude[0],
        "model": MODEL,
        "prior": PriorStandardDeviations(),
        "noise": NOISE,
        "update_interval": 2.0,
        "keep": 10**6,
    } | changes


def turned(degrees):
    turn = from_rotation_vector([0.0, 0.0, np.radians(degrees)])
    return {"start": multiply(turn, TABLE.attitude[0])}


def walking(factor):
    return {"noise": ImuNoise(factor * NOISE.angle_random_walk, reference_velocity=1e-5)}


def diagnosed(inputs):
    with np.errstate(all="ignore"):
        try:
            found = calibrate(**inputs)
        except FilterFailure as failure:
            found = failure
        return str(diagnose(found))


LACKING = "errors that the model does not have, such as lever arms"
DOUBTS = {
    "place": (arguments(latitude=np.radians(59.0)), r"latitude: (59\.9|60\.0)\d degrees"),
    "sign of the place": (arguments(latitude=-LATITUDE), "latitude: the other sign"),
    "heading": (arguments(**turned(2.0)), r"a heading wrong by (2|2\.0\d|1\.9\d) degrees\?$"),
    "arms": (arguments(ARMED), f": {LACKING}"),
    "arms and heading": (arguments(ARMED, **turned(2.0)), f"heading wrong by .*, and {LACKING}"),
    "noise too small": (arguments(**walking(1 / 30)), r"gyros: noise (29|30|31) times what"),
    "noise in degrees": (arguments(**walking(57.3)), "what was told: degrees for radians"),
    "interval by 0.1 %": (
        arguments(PLAIN._replace(interval=0.01001)),
        r"accelerometer scale .: found -\d+ ppm where the prior says 100: interval: 0\.01 s",
    ),
    "degrees": (
        arguments(PLAIN._replace(angle=np.degrees(PLAIN.angle))),
        "gyros: degrees taken for radians",
    ),
}


@pytest.mark.parametrize(
    "slip",
    [
        pytest.param(slip, marks=pytest.mark.long if k % 3 else pytest.mark.slow)
        for k, slip in enumerate(DOUBTS)
    ],
)
def test_slip_is_named(slip):
    inputs, words = DOUBTS[slip]
    with pytest.warns(
        InconsistentCalibrationWarning, match=r"; driftlab\.diagnosis\.diagnose\(found\) looks"
    ):
        sentence = diagnosed(inputs)
    assert re.search(words, sentence), sentence
    assert "record again" not in sentence


@pytest.mark.parametrize(("increments", "model"), [(PLAIN, MODEL), (ARMED, LARGER)])
def test_right_run_is_not_doubted_nor_by_the_judge(increments, model):
    """Also not in the coarse steps in which slips are tried."""
    found = calibrate(**arguments(increments, model=model))
    assert innovation_test(found).verdict == "consistent"
    assert _Judge(found.inputs).steps is None
    assert str(diagnose(found)).startswith("Nothing contradicts")


def test_the_judge_looks_last_with_the_noise_that_was_told(monkeypatch):
    def contradicted(rows, reference, *, noise, **inputs):
        if noise.reference_velocity > NOISE.reference_velocity:
            return calibrate(rows, reference, noise=noise, **inputs)
        raise ValueError("as if nothing fitted")

    inputs = calibrate(**arguments()).inputs
    monkeypatch.setattr(diagnosis, "calibrate", contradicted)
    assert _Judge(inputs).steps == (NOISE.reference_velocity, 0.02)


def test_only_slips_beyond_the_prior_are_named():
    """An interval wrong by 2e-4 is two deviations of a scale; a start wrong by as much is right."""
    calibrate(**arguments(PLAIN._replace(interval=0.010002)))
    calibrate(**arguments(**turned(1 / 60)))


def test_windows_that_a_turn_begins_in_are_no_rests():
    shown = evidence(PLAIN)
    assert 0.5 < shown.rest.mean() < 0.9
    rates = np.linalg.norm(shown.rate[shown.rest], axis=-1)
    # Biases of TYPICAL_ERRORS come to 0.37 degrees an hour.
    np.testing.assert_allclose(rates, EARTH_RATE, rtol=0.03)


def test_one_update_for_the_whole_record_needs_little_room():
    with pytest.warns(
        UnusualWarning, match=r"^update_interval: 100000 s is longer than the record"
    ):
        found = calibrate(**arguments(update_interval=1e5))
    assert found.nis.shape == (1,)


def test_rates_for_increments_are_named_whether_the_filter_can_go_on_or_not():
    # It diverges, and rounding decides whether a step becomes a whole turn.
    fast = Increments(0.01, 100 * PLAIN.angle, 100 * PLAIN.velocity)
    with pytest.warns(
        InconsistentCalibrationWarning, match="expected gravity and the Earth's rate"
    ):
        assert "gyros: rates taken for increments" in diagnosed(arguments(fast))


def test_filter_that_cannot_go_on_says_so_in_one_sentence_and_keeps_its_arguments():
    fast = Increments(0.01, 5000 * PLAIN.angle, 5000 * PLAIN.velocity)
    words = r"^increments: .* could not go on: position: .*diagnose, given this error, looks"
    with (
        pytest.warns(InconsistentCalibrationWarning),
        pytest.raises(FilterFailure, match=words) as no,
    ):
        calibrate(**arguments(fast))
    assert isinstance(no.value.__cause__, InconsistentCalibrationWarning)
    kept = pickle.loads(pickle.dumps(no.value))
    assert str(kept) == str(no.value)
    np.testing.assert_array_equal(kept.inputs.increments.angle, fast.angle)


def test_a_calibration_keeps_its_arguments_unless_it_does_not_check_them():
    found = calibrate(**arguments())
    np.testing.assert_array_equal(found.inputs.increments.angle, PLAIN.angle)
    assert calibrate(**arguments(check=False)).inputs is None
    assert found == found
    np.testing.assert_array_equal(
        pickle.loads(pickle.dumps(found)).inputs.start, found.inputs.start
    )
    assert "inputs" not in to_json(found)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"increments": PLAIN.part(0, 3)}, "increments: expected at least 4, two pairs, got 3"),
        (
            {"increments": Recording(PLAIN.angle, PLAIN.velocity, 0.01, "increments")},
            r"increments: .* hand in its increments\(\)",
        ),
        ({"start": Scheme("+90Y")}, r"start: .* hand in scheme\.start_attitude"),
    ],
)
def test_what_is_not_meant_is_refused_with_what_is(changes, words):
    with pytest.raises(ValueError, match=f"^{words}"):
        calibrate(**arguments(**changes))

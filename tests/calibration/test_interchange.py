"""Calibrations as JSON: back to the last digit, and refused where they say something else."""

import json
import re

import numpy as np
import pytest

from driftlab.calibration import ERROR_MODELS, from_json, to_json
from driftlab.calibration.calibration_history import Calibration
from driftlab.calibration.interchange import KeptCalibration
from driftlab.calibration.multi_position import MultiPositionCalibration
from driftlab.checks import UnusualWarning
from driftlab.drift import PAIR_AXES, fit_turns
from driftlab.higher_order_errors import NO_HIGHER_ORDER_ERRORS
from driftlab.imu import (
    TYPICAL_ERRORS,
    ImuErrors,
    ImuNoise,
    PriorStandardDeviations,
    random_imu_errors,
)

RNG = np.random.default_rng(8)
# Neither short nor exact in decimals.
UNIT = random_imu_errors(PriorStandardDeviations(), RNG)
FLEET = random_imu_errors(PriorStandardDeviations(), RNG, 4)
DEVIATIONS = ImuErrors(*(np.abs(array) / 7 for array in UNIT))
FULL = KeptCalibration(UNIT, DEVIATIONS, None, ImuNoise())
TURNS = fit_turns(RNG.normal(size=3), PAIR_AXES)
HIGHER = NO_HIGHER_ORDER_ERRORS._replace(
    lever_arms=RNG.normal(size=(3, 3)), time_skew=np.float64(1 / 3)
)


def assert_same(found, expected):
    assert type(found) is type(expected)
    if isinstance(expected, tuple):
        for one, other in zip(found, expected, strict=True):
            assert_same(one, other)
    elif isinstance(expected, np.ndarray):
        np.testing.assert_array_equal(found, expected, strict=True)
    else:
        assert found == expected


@pytest.mark.parametrize(
    "kept",
    [
        KeptCalibration(UNIT),
        KeptCalibration(FLEET, axes="FRD"),
        KeptCalibration(
            UNIT,
            DEVIATIONS,
            HIGHER._replace(time_skew=np.array(1 / 3)),
            ImuNoise(1e-7 / 3, 2e-5 / 3, 0.0, 1e-9 / 3, 1000 / 3),
            "averaged",
            "RFU",
            "Gerät 7",
            "2024-05-01",
        ),
    ],
)
def test_what_is_kept_comes_back_to_the_last_digit(kept, tmp_path):
    text = to_json(kept)
    assert_same(from_json(text), kept)
    path = tmp_path / "kept.json"
    path.write_text(text, encoding="utf-8")
    assert_same(from_json(path), kept)
    assert to_json(from_json(path)) == text


def test_errors_alone_with_what_the_caller_says():
    found = from_json(to_json(UNIT, axes="FUR", noise=ImuNoise(), name="unit", date="2024-05-01"))
    assert_same(
        found, KeptCalibration(UNIT, None, None, ImuNoise(), "", "FUR", "unit", "2024-05-01")
    )


@pytest.mark.parametrize("states", [(), ("lever arms", "time skew")])
def test_end_of_a_filter_with_deviations_of_each_entry(states):
    model = ERROR_MODELS["upper triangle"].with_states(*states)
    state = 0.01 * RNG.normal(size=(2, 3, model.size))
    half = RNG.normal(size=(2, 3, model.size, model.size))
    covariance = half @ np.swapaxes(half, -1, -2)
    none = np.zeros((2, 3, 4))
    calibration = Calibration(model, np.arange(3.0), state, covariance, none, none, none)
    found = from_json(to_json(calibration))
    assert_same(found.imu_errors, ImuErrors(*map(np.asarray, calibration.imu_errors)))
    assert found.body_axes == "upper triangle"
    assert (found.higher_order is not None) == bool(states)
    if states:
        assert_same(found.higher_order.lever_arms, model.higher_order_errors(state[:, -1])[0])
    # Of draws with that covariance, entry by entry.
    root = half[:, -1]
    each = model.imu_errors(np.swapaxes(root, -1, -2))  # the columns of the root, one by one
    for key, array in each._asdict().items():
        expected = np.sqrt((array**2).sum(axis=1))
        np.testing.assert_allclose(getattr(found.standard_deviations, key), expected, rtol=1e-12)


@pytest.mark.parametrize("felt_axes", [3, 1])
def test_poses_with_what_the_gyros_feel_of_force(felt_axes):
    sensitivity, none = 1e-5 * RNG.normal(size=(3, 3)), np.zeros((3, 3))
    sensitivity[felt_axes:] = 0.0
    fit = MultiPositionCalibration(
        FLEET._replace(**{key: value[0] for key, value in FLEET._asdict().items()}),
        "averaged", (), none, DEVIATIONS, sensitivity, none, 9.8, none, none, none, {},
        (1.0, 1.0), 1.0, 1,
    )  # fmt: skip
    found = from_json(to_json(fit))
    assert_same(found.imu_errors, fit.imu_errors)
    assert_same(found.standard_deviations, DEVIATIONS)
    felt = (np.eye(3) + fit.imu_errors.gyro_error_matrix) @ found.higher_order.gyro_g_sensitivity
    np.testing.assert_allclose(felt, sensitivity, rtol=1e-13, atol=1e-20)


@pytest.mark.parametrize("scale_factor", ["none", "each"])
def test_turns(scale_factor):
    axes = np.repeat([*PAIR_AXES, [1, 1, 1], [1, 0, 0], [0, 1, 0], [0, 0, 1]], 2, axis=0)
    rates = np.tile([0.1, -0.1], 7)
    fit = fit_turns(
        RNG.normal(size=14), axes, scale_factor, table_rates=rates, gyro_bias=scale_factor == "each"
    )
    assert_same(from_json(to_json(fit)), fit)


@pytest.mark.parametrize("kept", [FULL, TURNS], ids=["unit", "turns"])
def test_texts_of_version_0_2_0_are_read(kept):
    text = to_json(kept).replace('_error_matrix"', '_error"').replace('"scale_factor"', '"scale"')
    assert text != to_json(kept)
    assert_same(from_json(text), kept)


def test_turns_of_several_triads_at_once():
    fit = fit_turns(RNG.normal(size=(2, 3)), PAIR_AXES)
    assert fit.scale_factor.shape == (2, 0)
    assert_same(from_json(to_json(fit)), fit)


def test_one_set_of_deviations_may_serve_many_units():
    kept = KeptCalibration(FLEET, DEVIATIONS)
    assert_same(from_json(to_json(kept)), kept)


def test_a_triad_that_reads_double_is_warned_of_and_kept():
    double = UNIT._replace(gyro_error_matrix=UNIT.gyro_error_matrix + np.eye(3))  # the other range
    with pytest.warns(UnusualWarning, match="gyro_error_matrix: .* If so, subtract"):
        text = to_json(double)
    with pytest.warns(UnusualWarning, match="gyro_error_matrix: .* If so, subtract"):
        assert_same(from_json(text), KeptCalibration(double))


def with_change(change, found=UNIT):
    document = json.loads(to_json(found))
    change(document)
    return json.dumps(document)


def with_field(key, found=FULL, **fields):
    return with_change(lambda document: document["quantities"][key].update(fields), found)


SLIPS = {
    "no JSON": ("calibration.json", "source: expected JSON, got .*; a file is named by a Path"),
    "no text": (None, "source: expected a text or a Path, got NoneType"),
    "a list": ("[1]", "source: expected a calibration, got a list"),
    "schema": (
        with_change(lambda d: d.update(schema="driftlab calibration 2")),
        "schema: expected 'driftlab calibration 1' or .*, got 'driftlab calibration 2'",
    ),
    "another program": ('{"T_g": [1]}', "schema: expected .*, got None"),
    "convention": (
        with_change(lambda d: d.update(convention="true = K (measured - bias)")),
        "convention: expected 'measured = .*, got 'true = K",
    ),
    "unit": (
        with_change(lambda d: d["quantities"]["gyro_bias"].update(unit="deg/h")),
        "gyro_bias: expected the unit rad/s, got 'deg/h'",
    ),
    "missing": (
        with_change(lambda d: d["quantities"].pop("gyro_error_matrix")),
        "quantities: expected gyro_bias, gyro_error_matrix, .*, got no gyro_error_matrix",
    ),
    "unknown": (
        with_change(lambda d: d["quantities"].update(temperature={})),
        "quantities: expected some of gyro_bias, .*, got 'temperature'",
    ),
    "bare": (
        with_change(lambda d: d["quantities"].update(gyro_bias=[1, 2, 3])),
        r"gyro_bias: expected a unit and a value, got \[1, 2, 3\]",
    ),
    "half the deviations": (
        with_change(lambda d: d["quantities"]["gyro_bias"].update(deviation=[1, 2, 3])),
        "gyro_error_matrix: expected a deviation, as others have one, got none",
    ),
    "negative deviation": (
        with_field("gyro_bias", deviation=[-1, 0, 0]),
        "gyro_bias: expected deviations of at least 0, got -1",
    ),
    "one deviation": (
        with_field("gyro_bias", deviation=1),
        r"gyro_bias: .* shapes \(\) and \(3,\)",
    ),
    "misspelt": (
        with_field("gyro_bias", deviaton=[1, 2, 3]),
        "gyro_bias: expected unit, value, deviation, got 'deviaton'",
    ),
    "deviation of noise": (
        with_field("angle_random_walk", deviation=1),
        "angle_random_walk: expected unit, value, got 'deviation'",
    ),
    "half the noise": (
        with_change(lambda d: d["quantities"].pop("velocity_random_walk"), FULL),
        "quantities: expected all of angle_random_walk, .* got no velocity_random_walk",
    ),
    "twice": (
        to_json(UNIT).replace("accelerometer_bias", "gyro_bias"),
        "source: expected each name once, got 'gyro_bias' again",
    ),
    "deg/s": (
        with_field("gyro_bias", value=[100, 0, 0]),
        "gyro_bias: expected rad/s, at most 10 in size, got 100",
    ),
    "date": (with_change(lambda d: d.update(date="yesterday")), "date: expected a date such as"),
    "more unknowns": (
        with_field("gyro_bias", TURNS, value=[1, 2, 3]),
        r"covariance: expected shape \(\.\.\., 6, 6\), got shape \(3, 3\)",
    ),
    "axes": (with_change(lambda d: d.update(axes="FLD")), "axes"),
}


@pytest.mark.parametrize("slip", SLIPS)
def test_another_text_is_refused_in_a_sentence(slip):
    text, words = SLIPS[slip]
    with pytest.raises(ValueError, match=words):
        from_json(text)


def test_what_cannot_be_kept_is_refused():
    for found, words in (
        ("averaged", "found: expected ImuErrors, a Calibration, .* got str"),
        (UNIT._replace(gyro_bias=np.full(3, np.nan)), "gyro_bias: expected finite numbers"),
        (KeptCalibration(UNIT, UNIT), "gyro_bias: expected deviations of at least 0"),
        (KeptCalibration(UNIT, date="yesterday"), "date: expected a date such as"),
        (TURNS._replace(residuals=np.zeros((0, 3))), r"residuals: .* got shape \(0, 3\)"),
    ):
        with pytest.raises(ValueError, match=words):
            to_json(found)
    with pytest.raises(ValueError, match="axes"):
        to_json(TYPICAL_ERRORS, axes="FLD")


def test_the_text_says_units_and_nothing_that_is_no_json():
    text = to_json(KeptCalibration(UNIT, DEVIATIONS, HIGHER, ImuNoise()))
    quantities = json.loads(text, parse_constant=lambda word: pytest.fail(word))["quantities"]
    assert all(re.fullmatch(r"1|[\w/^()]+", one["unit"]) for one in quantities.values())
    assert len(quantities) == 4 + 2 + 3

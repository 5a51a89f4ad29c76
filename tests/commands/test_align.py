"""`align`: the package's numbers, the truth of the made-up log, and warnings where they belong."""

import json
from dataclasses import replace

import numpy as np
import pytest

from driftlab.axes import convert_vectors
from driftlab.commands import example
from driftlab.commands.align import FOUND, WITHIN, find
from driftlab.commands.example import OPTIONS
from driftlab.commands.record import moved_at
from driftlab.earth import EARTH_RATE, gravity
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass import align
from driftlab.motion import static_imu
from driftlab.recordings.recording import Recording
from support import recording_or_skip

HOUR = np.radians(1 / 3600)


def still(bias=0.0, noise=0.1 * HOUR, latitude=0.7, seconds=600, axes="FRD"):
    """A unit at rest with the bow 50 degrees East of North, and an error of its right gyro."""
    attitude = from_euler_angles(np.radians(-50.0), 0.02, 0.01)
    rate, force = static_imu(attitude, latitude, gravity(latitude))
    rng = np.random.default_rng(3)
    rows = rate + [0.0, 0.0, bias] + noise * rng.standard_normal((seconds, 3))
    forces = force + 1e-4 * rng.standard_normal((seconds, 3))
    rows, forces = (convert_vectors(each, "FUR", axes) for each in (rows, forces))
    return Recording(rows, forces, 1.0, "rates", axes=axes, latitude=latitude)


def found(recording):
    return find(recording, None, lambda name: None)


def test_numbers_for_other_programs_are_the_package_s(run, example_log, tmp_path):
    words = f"align {example_log} {OPTIONS} --axes FRD --latitude 59.9 --end 60 --json found.json"
    code, out, _ = run(words)
    values = json.loads((tmp_path / "found.json").read_text())["values"]
    record = example.example().between(0.0, 60.0).in_axes("FUR")
    means = record.gyro.mean(axis=0), record.accelerometer.mean(axis=0)
    direct = align(*means, heading_tolerance=np.inf)
    for name in FOUND:  # the log has eight digits
        assert values[name]["value"] == pytest.approx(getattr(direct, name), rel=1e-5)
    assert code == 0
    # The errors of the unit itself: 4 mg tilt it, and 0.4 % of the Earth's rate turn it.
    compass = np.degrees(values["compass_heading"]["value"])
    assert abs(compass - 40.0) < 4 * np.degrees(values["heading"]["deviation"]) + 0.5
    assert f"{compass:.2f} degrees of a compass card" in out
    assert "from North to East" in out


def test_deviations_are_those_of_many_records():
    """The deviation of a mean from its stretches, against headings of records drawn anew."""
    rng = np.random.default_rng(5)
    true = still(noise=0.0)
    headings, stated = [], []
    for _ in range(60):
        noisy = true.gyro + 5 * HOUR * rng.standard_normal(true.gyro.shape)
        values = found(replace(true, gyro=noisy, latitude=None)).values
        headings.append(values["heading"]["value"])
        stated.append(values["heading_noise_standard_deviation"])
    # Of 60 records the deviation is known to 1 in sqrt(118), the mean of the stated ones better.
    assert np.std(headings, ddof=1) / np.mean(stated) == pytest.approx(1.0, abs=4 / np.sqrt(118))


@pytest.mark.parametrize("axes", ["FRD", "RFU", "FLU"])
def test_axes_do_not_matter_when_they_are_told(axes):
    values = found(still(axes=axes)).values
    assert np.degrees(values["compass_heading"]["value"]) == pytest.approx(50.0, abs=0.2)
    assert values["in_inertial_space"]["compass_heading"] == pytest.approx(np.radians(50), abs=0.01)


def test_a_beginning_before_the_record_is_refused(refused, example_log):
    words = f"align {example_log} {OPTIONS} --axes FRD --begin -5"
    assert refused(words).startswith("--begin: expected seconds from the first row on, got -5")


def test_without_axes_there_is_no_heading(refused, example_log):
    assert refused(f"align {example_log} {OPTIONS}").startswith("--axes: expected the body axes")
    words = OPTIONS.replace(",ax,ay,az", "").replace("deg/s,g", "deg/s")
    assert "three accelerometers" in refused(f"align {example_log} {words} --axes FRD")


def test_an_error_that_the_earth_s_rate_shows_is_in_the_deviation_and_warned_of():
    wrong, right = found(still(bias=3 * HOUR)), found(still())
    assert any("rates differ from the Earth's" in warning for warning in wrong.warnings)
    assert right.warnings == ()
    assert wrong.values["heading"]["deviation"] == wrong.values["heading_bias_standard_deviation"]
    assert (
        right.values["heading_bias_standard_deviation"]
        < 0.02 * wrong.values["heading_bias_standard_deviation"]
    )


def test_errors_of_the_heading_are_as_large_as_the_earth_s_rate_shows_them():
    """Biases in all directions: of Student's t with two degrees of freedom 0.577, 0.816, 0.950."""
    rng = np.random.default_rng(11)
    true, errors = still(noise=0.0, seconds=20), []
    heading = found(true).values["heading"]["value"]
    for _ in range(200):
        record = replace(true, gyro=true.gyro + 0.5 * HOUR * rng.standard_normal(3))
        one = found(record).values["heading"]
        errors.append(abs(one["value"] - heading) / one["deviation"])
    for standard_deviations, share in ((1.0, 0.577), (2.0, 0.816), (WITHIN, 0.95)):
        spread = np.sqrt(share * (1 - share) / 200)
        assert np.mean(np.array(errors) < standard_deviations) == pytest.approx(
            share, abs=3.5 * spread
        )


def test_without_the_latitude_the_whole_rate_must_do():
    record = replace(still(bias=1 * HOUR), latitude=None)
    findings = found(record)
    assert findings.values["heading_bias_standard_deviation"] > 0
    assert any(words.startswith("The one rate that can be") for words in findings.sentences)


def test_a_unit_that_was_moved_is_told_so_first():
    record = example.example()
    findings = found(record)
    assert findings.sentences[0].startswith("No heading: the unit was moved at 60 s.")
    assert "heading" not in findings.values
    assert findings.warnings == ()
    assert moved_at(record.between(0.0, 60.0)) is None
    assert moved_at(record.between(0.0, 0.1)) is None  # too few rows to say


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"axes": "FLU"}, "upside down"),
        ({"axes": "DRB"}, "lies steeply"),
        ({"latitude": -0.7}, "is minus the one told"),
    ],
)
def test_axes_and_signs_that_can_hardly_be_are_warned_of(change, words):
    assert any(words in warning for warning in found(replace(still(), **change)).warnings)


@pytest.mark.parametrize(
    ("factor", "words"),
    [
        (57.3, "degrees taken for radians?"),
        (1 / 57.3, "radians taken for degrees?"),
        (3600.0, "deg/h taken for deg/s?"),
        (0.0, "No heading"),
        (0.1, "taken the bias off already"),
    ],
)
def test_a_rate_of_another_size_has_its_reason(factor, words):
    record = still(noise=0.01 * HOUR)
    assert words in found(replace(record, gyro=record.gyro * factor)).sentences[0]


def test_a_unit_that_cannot_see_the_earth_gets_no_heading():
    """A cheap gyro's bias is hundreds of degrees an hour."""
    blind = found(still(bias=500 * HOUR))
    assert "heading" not in blind.values
    assert not blind.values["earth_rate_sensed"]
    assert blind.sentences[0].startswith("No heading: ")
    assert f"{EARTH_RATE / HOUR:.2f}" in blind.sentences[0]
    assert blind.values["pitch"]["value"] == pytest.approx(0.02, abs=1e-4)
    noisy = found(still(noise=200 * HOUR))
    assert "known to" in noisy.sentences[0]
    assert noisy.values["earth_rate_sensed"]


def test_a_car_that_is_not_still_is_told_by_its_own_record():
    """The publisher's heading is -90.6 degrees, 'coarse'; its means say nothing, gravity does."""
    record = recording_or_skip("laser-gyro").between(0.0, 300.0)
    findings = found(record)
    values = findings.values
    by_gravity = np.degrees(values["in_inertial_space"]["heading"])
    assert by_gravity == pytest.approx(-90.6, abs=0.3)
    assert "heading" not in values
    assert "The base was not still" in findings.sentences[0]
    assert "points to 90." in findings.sentences[1]

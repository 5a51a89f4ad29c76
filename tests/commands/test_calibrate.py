"""`calibrate`: the errors that were put into the made-up log, and those that others published."""

import json
import shlex

import numpy as np
import pytest

from driftlab.book.ch17_real_recordings.experiments.publishers_numbers import IMU_TK
from driftlab.calibration import calibrate_multi_position, from_json
from driftlab.calibration.interchange import KeptCalibration
from driftlab.commands import example
from driftlab.commands.calibrate import FORMS, matrices
from driftlab.commands.example import OPTIONS
from driftlab.recordings import published_file
from driftlab.recordings.static_detection import static_intervals
from support import recording_or_skip

PLACE = "--axes FRD --latitude 59.9"


@pytest.fixture(scope="module")
def calibrated(example_log, tmp_path_factory):
    """What the command prints of the made-up log, and what it writes."""
    import contextlib
    import io

    from driftlab.commands.line import main

    folder = tmp_path_factory.mktemp("calibrated")
    words = ["calibrate", str(example_log), *OPTIONS.split(), *PLACE.split()]
    words += ["--form", "imu-tk", "--json", str(folder / "a.json"), "--csv", str(folder / "a.csv")]
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        assert main(words) == 0
    values = json.loads((folder / "a.json").read_text())["values"]
    return printed.getvalue(), values, (folder / "a.csv").read_text()


def test_errors_that_were_put_in_are_found(calibrated):
    """Each within 4.5 of its own deviations: 21 numbers go beyond that once in 7000 logs."""
    _, values, _ = calibrated
    for name, true in example.ERRORS._asdict().items():
        found, spread = (
            np.array(values[kind][name]) for kind in ("imu_errors", "standard_deviations")
        )
        free = spread > 1e-6 * spread.max()
        assert (abs(found - true)[free] < 4.5 * spread[free]).all()
        assert np.allclose(found[~free], true[~free], atol=1e-12)
    matrix, spread = (
        np.array(values[kind]["gyro_error_matrix"])
        for kind in ("imu_errors", "standard_deviations")
    )
    assert (abs(matrix) > 3 * spread).all()  # and none of them is lost in its deviation


def test_the_package_reads_what_was_written(calibrated):
    _, values, _ = calibrated
    kept = from_json(json.dumps({"values": values}))
    assert isinstance(kept, KeptCalibration)
    for part in ("imu_errors", "standard_deviations"):
        for name, array in getattr(kept, part)._asdict().items():
            assert array.tolist() == values[part][name]
    assert (kept.body_axes, kept.higher_order) == (values["body_axes"], None)


def test_numbers_are_the_package_s(calibrated):
    _, values, table = calibrated
    record = example.example()
    direct = calibrate_multi_position(record, static_intervals(record))
    for name, array in direct.imu_errors._asdict().items():
        spread = getattr(direct.standard_deviations, name)
        found = np.array(values["imu_errors"][name])
        assert (abs(found - array) <= 1e-2 * spread + 1e-12).all()  # the log has eight digits
    assert len(table.splitlines()) == len(static_intervals(record)) + 1
    assert values["gravity"] == pytest.approx(record.gravity, rel=1e-12)


def test_the_table_has_the_numbers_and_the_test_in_words(calibrated):
    printed, values, _ = calibrated
    scale = 100 * values["imu_errors"]["gyro_error_matrix"][0][0]
    spread = 100 * values["standard_deviations"]["gyro_error_matrix"][0][0]
    digits = 1 - int(np.floor(np.log10(spread)))  # two of the deviation's
    assert f"{scale:.{digits}f} ± {spread:.{digits}f}" in printed
    assert "0 by axes" in printed
    assert "Does noise explain what is left?" in printed
    # The Earth turns under moves that so good a gyro feels, and is no excess.
    assert values["consistency"]["moves"]["excess"] == 0.0
    assert "one of unknown direction" in " ".join(printed.split())
    assert "As imu-tk has it" in printed


@pytest.mark.parametrize("form", FORMS)
def test_forms_of_other_programs_are_written(form, calibrated):
    _, values, _ = calibrated
    shown = values["forms"][form]
    assert shown
    arrays = matrices(example.ERRORS, form)
    for name, array in shown.items():
        assert np.allclose(array, arrays[name], atol=2e-3), name


def test_what_the_forms_and_options_do_not_know_is_refused(refused, run, example_log):
    words = f"calibrate {example_log} {OPTIONS}"
    assert refused(words).startswith("--latitude: expected the latitude of the place")
    assert "three accelerometers" in refused(
        f"calibrate {example_log} --gyro gx,gy,gz --units deg/s --time t,s {PLACE}"
    )
    assert "closed: expected pairs of rests" in refused(f"{words} {PLACE} --closed 1,99")
    code, _, err = run(f"{words} {PLACE} --form nasa")
    assert (code, "invalid choice: 'nasa'" in err) == (2, True)


def test_units_that_cannot_be_are_refused_until_they_are_allowed(refused, run, example_log):
    wrong = OPTIONS.replace("deg/s,g", "deg/s,m/s^2")
    sentence = refused(f"calibrate {example_log} {wrong} {PLACE}")
    assert "g taken for m/s^2?" in sentence
    assert "--allow force" in sentence
    _, out, err = run(f"integrate {example_log} {wrong} --allow force")
    assert err == ""
    assert "Warning: accelerometer: expected a median size near gravity" in out


def test_a_published_unit_is_calibrated_from_its_publisher_s_files(run, tmp_path):
    """IMU-TK's own record and its published gyro matrix, within our three deviations of it."""
    recording_or_skip("xsens-mti")
    files = [published_file(f"xsens_{name}.mat", download=False) for name in ("acc", "gyro")]
    words = (
        "--format imu-tk --units '1/4778 rad/s,1/415 m/s^2' --zeros 32768,32768 --gravity 9.81744 "
        "--body-axes lower-triangle-accelerometers --json a.json --end 160"
    )
    code, out, err = run(f"calibrate {shlex.join(map(str, files))} {words}")
    assert (code, err) == (0, "")
    assert out.count("0 by axes") == 3  # what rounding leaves of them is no number to show
    values = json.loads((tmp_path / "a.json").read_text())["values"]
    found = np.array(values["forms"]["imu-tk"]["gyro_T"])
    published = np.array(IMU_TK[0].gyro_T)
    spread = 4 * np.array(values["standard_deviations"]["gyro_error_matrix"]) + 5e-4
    assert (abs(found - published) < spread).all()
    assert abs(found - published).max() < 8e-3  # by a third of the record

"""`allan`: the numbers of `driftlab.allan`, in units that engineers use."""

import json

import numpy as np
import pytest
from scipy.constants import degree, hour

from driftlab.allan import allan_deviation
from driftlab.commands import example
from driftlab.commands.allan import find, moved
from driftlab.commands.example import OPTIONS
from driftlab.recordings.recording import Recording


def test_the_noise_of_the_made_up_log_is_found(run, example_log, tmp_path):
    words = f"allan {example_log} {OPTIONS} --end 60 --json a.json --csv a.csv"
    code, out, _ = run(words)
    assert code == 0
    values = json.loads((tmp_path / "a.json").read_text())["values"]
    sizes = [size / np.sqrt(example.RATE) for size in example.NOISE]
    for name, size in zip(("gyro", "accelerometer"), sizes, strict=True):
        for axis in "xyz":
            one = values[name][axis]
            walk, spread = (
                one["terms"]["angle_random_walk"],
                one["standard_deviations"]["angle_random_walk"],
            )
            assert abs(walk - size) < 4 * spread
            assert one["terms"]["rate_ramp"] == 0.0
    record = example.example().between(0.0, 60.0)
    direct = allan_deviation(record.gyro[:, 1], record.interval)
    assert values["gyro"]["y"]["deviation"] == pytest.approx(direct.deviation, rel=1e-4)
    header, *rows = (tmp_path / "a.csv").read_text().splitlines()
    assert header.startswith("averaging_time_s,gyro_x_rad_per_s,gyro_x_lower,")
    assert len(rows) == len(direct.averaging_times)
    usual = sizes[0] / (degree / np.sqrt(hour))
    assert f"{usual:.4f}"[:5] in out
    assert "deg/√h" in out


def test_a_unit_that_was_moved_is_warned_of():
    rng = np.random.default_rng(1)
    rows = 1e-4 * rng.standard_normal((3000, 3))
    assert moved(Recording(rows, None, 0.01, "rates")) == []
    rows[1700:1900, 0] += 0.3
    (warning,) = moved(Recording(rows, None, 0.01, "rates"))
    assert "moved at 17 s" in warning


def test_a_short_record_is_refused():
    short = Recording(np.ones((500, 3)), None, 0.01, "rates")
    with pytest.raises(ValueError, match="at least 1000 rows, got 500"):
        find(short, None, lambda name: None)

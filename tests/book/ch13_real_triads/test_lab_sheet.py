"""The made-up phone has the errors that it says, and the lab sheet finds and shows them."""

import numpy as np
import pytest

from driftlab.book.ch13_real_triads import made_up_phone as phone
from driftlab.book.ch13_real_triads.lab_sheet import result_table, turns_picture, turns_table
from driftlab.drift.turns_by_hand import fit_hand_turns, hand_turns
from driftlab.recordings.csv_reader import read_csv
from driftlab.recordings.recording import Recording
from driftlab.recordings.rest_detection import rests

SENSES = [(2, 1), (2, 1), (2, -1), (2, -1), (1, 1), (1, 1), (1, -1), (1, -1)]
SENSES += [(0, 1), (0, 1), (0, -1), (0, -1)]


def found_in(recording):
    """Increments, rests and turns of a log, as the lab sheet finds them."""
    stops = rests(recording).rows
    return recording.angles(), stops, hand_turns(recording.angles(), recording.interval, stops)


def test_log_is_read_back_as_it_was_made(tmp_path):
    path = phone.made_up_log(folder=tmp_path)
    log = read_csv(path, gyro=[f"Gyroscope {axis}" for axis in "xyz"], time="Time")
    _, rates = phone.made_up_phone()
    assert log.kind == "rates"
    assert log.interval == pytest.approx(phone.INTERVAL)
    assert np.allclose(log.gyro, rates, rtol=1e-8, atol=0)


def test_twelve_turns_are_found_and_their_numbers_lie_in_the_intervals():
    seeds, inside, stops = range(8), [], []
    for seed in seeds:
        _, rates = phone.made_up_phone(seed)
        log = Recording(rates, None, phone.INTERVAL, "rates")
        _, _, turns = found_in(log)
        assert [(turn.axis, turn.turns) for turn in turns] == SENSES
        fit = fit_hand_turns(turns)
        inside += list(np.abs(fit.sigma - np.diag(phone.TRIAD_ERROR)) < fit.half_widths()[0])
        stops.append(fit.stop_deviation)
    # The three axes of a phone share one scatter; count them as if they were one, 20 independent.
    assert np.mean(inside) > 0.95 - 4 * np.sqrt(0.95 * 0.05 / len(seeds))
    ratio = np.mean(np.square(stops)) / phone.STOP_ERROR**2
    assert abs(ratio - 1) < 5 * np.sqrt(2 / (6 * len(seeds)))


def test_tables_and_picture_say_what_was_found():
    _, rates = phone.made_up_phone()
    log = Recording(rates, None, phone.INTERVAL, "rates")
    increments, stops, turns = found_in(log)
    fit = fit_hand_turns(turns)
    picture = turns_picture(increments, log.interval, stops, turns)
    assert f"{len(stops)} stretches" in picture.caption
    assert "12 whole turns: +z, +z, −z, −z, +y" in picture.caption
    assert picture.svg().startswith(b"<?xml")
    rows = turns_table(turns).rows
    assert len(rows) == 13
    assert rows[3][1:3] == ("z", "clockwise")
    _, *axes = result_table(fit, turns).rows
    assert [row[:2] for row in axes] == [("x", "4"), ("y", "4"), ("z", "4")]
    assert [float(row[2]) for row in axes] == pytest.approx(fit.sigma, abs=6e-6)


def test_a_log_without_turns_has_a_picture_too():
    rng = np.random.default_rng(1)
    increments = 1e-4 * rng.standard_normal((500, 3))
    assert "0 whole turns: none." in turns_picture(increments, 0.01, [[0, 500]], []).caption

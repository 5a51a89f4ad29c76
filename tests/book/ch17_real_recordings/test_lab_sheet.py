"""The made-up phone has the errors that it says, and the lab sheet finds and shows them."""

import numpy as np
import pytest

from driftlab.book.ch17_real_recordings import made_up_phone as phone
from driftlab.book.ch17_real_recordings.lab_sheet import (
    DASH,
    rests_table,
    result_table,
    stop_sentence,
    turns_picture,
    turns_table,
)
from driftlab.book.ch17_real_recordings.offset_two_ways import (
    DOUBT_RESTS,
    DOUBT_TWO_WAYS,
    RestRates,
    chance_of_rests,
    chance_of_two_ways,
    rest_rates,
    verdicts,
)
from driftlab.book.machinery.figure.csv_table import read_table
from driftlab.drift.turns_by_hand import HandTurn, fit_hand_turns, hand_turns, near_turns
from driftlab.recordings.readers import read_csv
from driftlab.recordings.recording import Recording
from driftlab.recordings.static_detection import static_intervals

SENSES = [(2, 1), (2, 1), (2, -1), (2, -1), (1, 1), (1, 1), (1, -1), (1, -1)]
SENSES += [(0, 1), (0, 1), (0, -1), (0, -1)]


def found_in(recording):
    """Increments, rests and turns of a log, as the lab sheet finds them."""
    stops = static_intervals(recording).rows
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
        stops.append(fit.stop_standard_deviation)
    # The three axes of a phone share one scatter; count them as if they were one, 20 independent.
    assert np.mean(inside) > 0.95 - 4 * np.sqrt(0.95 * 0.05 / len(seeds))
    ratio = np.mean(np.square(stops)) / phone.STOP_ERROR**2
    assert abs(ratio - 1) < 5 * np.sqrt(2 / (6 * len(seeds)))


def test_tables_and_picture_say_what_was_found(tmp_path):
    _, rates = phone.made_up_phone()
    log = Recording(rates, None, phone.INTERVAL, "rates")
    increments, stops, turns = found_in(log)
    fit = fit_hand_turns(turns)
    picture = turns_picture(increments, log.interval, stops, turns)
    assert f"{len(stops)} stretches" in picture.caption
    assert "12 whole turns: +z, +z, −z, −z, +y" in picture.caption
    assert picture.svg().startswith(b"<?xml")
    assert picture.save(tmp_path / "log.pdf", width=3.5).read_bytes().startswith(b"%PDF")
    comments, table = read_table(picture.save(tmp_path / "log.csv"))
    assert "turns_picture(" in comments[1]
    assert sum(line.startswith('  "about') for line in comments) == 3
    assert [word for word in table["turn"] if word] == [str(number) for number in range(1, 13)]
    rows = turns_table(turns).rows
    assert len(rows) == 13
    assert rows[3][1:3] == ("z", "clockwise")
    at_rest = rest_rates(increments, log.interval, stops, turns)
    _, *axes = result_table(fit, turns, at_rest).rows
    assert [row[:2] for row in axes] == [("x", "4"), ("y", "4"), ("z", "4")]
    assert [float(row[2]) for row in axes] == pytest.approx(fit.sigma, abs=6e-6)


def test_a_missed_stop_has_a_row_and_a_question_mark():
    rows = np.zeros((220, 3))
    rows[20:100, 1] = 2 * np.pi * 330 / 360 / 80
    rows[120:200, 2] = -2 * np.pi / 80
    stops = np.array([[0, 20], [100, 120], [200, 220]])
    turns, near = hand_turns(rows, 0.1, stops), near_turns(rows, 0.1, stops)
    _, missed, turn = turns_table(turns, near).rows
    assert missed == ("?", "y", "left out: the gyros say 330°, 0° across", "10.0 s", DASH, DASH)
    assert turn[:2] == ("1", "z")
    picture = turns_picture(rows, 0.1, stops, turns, near)
    assert picture.caption.endswith("The question mark is at a move that nearly was a turn.")
    assert picture.svg().startswith(b"<?xml")


def test_two_turns_have_numbers_and_dashes():
    turns = [HandTurn(2, 1, 10, 110, 10.0, 0.02, 0.003), HandTurn(2, -1, 110, 210, 12.0, 0.0, 0.0)]
    fit = fit_hand_turns(turns)
    noise = 1e-4 * np.random.default_rng(1).standard_normal((220, 3))
    at_rest = rest_rates(noise, 0.1, [[0, 20], [100, 120], [200, 220]], turns)
    _, row = result_table(fit, turns, at_rest).rows
    assert row[3] == DASH
    assert row[4].endswith(" °/s")
    assert not any("nan" in cell for cell in row)
    assert "cannot be told" in stop_sentence(fit)
    assert "cannot be told" in verdicts(fit, at_rest)
    assert "nan" not in verdicts(fit, at_rest)


def phone_by_numbers(rng, stop=0.0026, rest=7e-5, jump=None):
    """Fit and rests of twelve turns of a right phone; or of one whose offset jumps by 0.005 rad/s.

    It jumps in a move from one rest to the next, the `jump`-th of the fifteen.
    """
    offset = np.full(15, 0.005)
    if jump is not None:
        offset[jump:] = 0.0
    turns, rates = [], []
    for place, axis in enumerate((2, 1, 0)):
        at = np.diff(rng.normal(0, stop, 5))
        for i, sense in enumerate((1, 1, -1, -1)):
            row, seconds = 5 * place + i, rng.uniform(12, 15)
            angle = 2 * np.pi * sense
            error = at[i] + seconds * offset[row : row + 2].mean()
            turns.append(HandTurn(axis, sense, row, row + 1, seconds, error / angle, 0.0))
        own = offset[5 * place : 5 * place + 5, np.newaxis]
        rates.append(own + rng.normal(0, rest, (5, 3)))
    scatter = rest * np.sqrt(rng.chisquare(45) / 45)
    return fit_hand_turns(turns), RestRates((0, 1, 2), tuple(rates[::-1]), scatter, 45)


def test_a_right_phone_passes_and_one_that_corrects_itself_does_not():
    rng, count = np.random.default_rng(2), 600
    chances = np.array(
        [
            (chance_of_two_ways(*phone), chance_of_rests(phone[1]))
            for phone in (phone_by_numbers(rng) for _ in range(count))
        ]
    )
    # Four standard deviations of a part of `count`; that of the two ways has its degrees of freedom
    # by Welch's approximation, which is good to a hundredth.
    for found, part, approximation in zip(
        (chances < (DOUBT_TWO_WAYS, DOUBT_RESTS)).mean(axis=0),
        (DOUBT_TWO_WAYS, DOUBT_RESTS),
        (0.01, 0.0),
        strict=True,
    ):
        assert abs(found - part) < 4 * np.sqrt(part * (1 - part) / count) + approximation
    for jump in range(1, 15):
        between_axes = jump in (5, 10)  # does no harm: each axis has its own offset
        doubt = chance_of_rests(phone_by_numbers(rng, jump=jump)[1]) < DOUBT_RESTS
        assert doubt != between_axes


def test_a_made_up_phone_passes_and_its_rests_tell_a_jump():
    for seed in range(4):
        times, rates = phone.made_up_phone(seed)
        for begin in (np.inf, times[-1] / 7):  # never, or among the turns of the first axis
            said = rates - np.where(times[:, np.newaxis] > begin, phone.BIAS, 0.0)
            log = Recording(said, None, phone.INTERVAL, "rates")
            increments, stops, turns = found_in(log)
            at_rest = rest_rates(increments, log.interval, stops, turns)
            if np.isinf(begin):
                own = np.abs(at_rest.offset - phone.BIAS)
                # Five deviations, and what the Earth can add.
                assert (own < 5 * at_rest.offset_standard_deviation + 7.3e-5).all()
                # Of eight chances one is less than this in every 1250th trial.
                fit = fit_hand_turns(turns)
                assert min(chance_of_two_ways(fit, at_rest), chance_of_rests(at_rest)) > 1e-4
                _, *rows = rests_table(at_rest).rows
                assert [row[:2] for row in rows] == [("x", "5"), ("y", "5"), ("z", "5")]
            else:
                assert "rests of the same axis do not agree" in verdicts(
                    fit_hand_turns(turns), at_rest
                )

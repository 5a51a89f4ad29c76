"""Without recordings the chapter says so once, and goes on."""

import re
from pathlib import Path

import nbformat
import numpy as np
import pytest

from driftlab.book.ch17_real_recordings import at_hand
from driftlab.recordings.publishers import PUBLISHED, RecordingUnavailable
from support import recording_or_skip

NOTEBOOK = Path(__file__).parents[3] / "notebooks" / "17_real_recordings.ipynb"


@pytest.fixture
def asked(monkeypatch):
    """Nothing is at hand; which recordings were asked for, and whether they might be fetched."""
    calls = []

    def nothing(name, download=True):
        calls.append((name, download))
        raise RecordingUnavailable(f"{name} is not at hand.")

    for function in ("published", "published_file"):
        monkeypatch.setattr(at_hand, function, nothing)
    return calls


def test_recording_that_is_missing_is_one_sentence(asked, capsys):
    assert at_hand.at_hand("laser-gyro") is None
    assert capsys.readouterr().out.startswith("laser-gyro is not at hand; ")
    assert at_hand.first_lines("imu0.log") is None
    assert asked == [("laser-gyro", False), ("imu0.log", False)]


def test_network_is_tried_once_only(asked, capsys):
    table = at_hand.fetch_recordings()
    said = capsys.readouterr().out
    assert said.startswith(f"{len(PUBLISHED)} of {len(PUBLISHED)} recordings are not here")
    assert said.endswith(f"{next(iter(PUBLISHED))} is not at hand.\n")
    assert said.count("\n") == 1
    assert [download for _, download in asked] == [True] + [False] * (len(PUBLISHED) - 1)
    assert {row[-1] for row in table.rows[1:]} == {"no"}


def test_what_is_at_hand_is_listed_with_its_licence(monkeypatch, capsys):
    class Log:
        duration = 12.0

    monkeypatch.setattr(at_hand, "published", lambda name, download: Log())
    table = at_hand.fetch_recordings()
    assert capsys.readouterr().out == ""
    assert [row[0] for row in table.rows[1:]] == list(PUBLISHED)
    assert all(row[-2:] == ("12 s", "yes") and row[3] for row in table.rows[1:])


def test_every_cell_that_needs_the_recording_has_its_words():
    named = re.findall(r'kept_words\(\\"(\w+)', NOTEBOOK.read_text("utf-8"))
    assert [at_hand.kept_words(cell)[:4] for cell in named] == ["With"] * 3


def test_kept_words_are_what_the_cells_say(capsys):
    recording_or_skip("mpu9150-1")
    cells = {cell.id: cell.source for cell in nbformat.read(NOTEBOOK, as_version=4).cells}
    names = {"np": np}
    for number, what in ((2, "lines"), (4, "doubts"), (6, "rests")):
        exec(cells[f"17-a-log-comes-in-{number}"], names)
        assert at_hand.kept_words(what).endswith(f"\n\n{capsys.readouterr().out.strip()}"), what

"""``lab.py figures`` sends the many runs of its studies to processes, and keeps them."""

import sys

import numpy as np
import pytest

import driftlab.book.__main__ as command
from driftlab.book.machinery.figure.publish import FigureDefinition
from driftlab.calibration.simulation import TurntableTrial
from driftlab.monte_carlo import run_batches
from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme

TASK = TurntableTrial(
    Scheme(NINETEEN_POSITIONS.rotations, NINETEEN_POSITIONS.start, dwell=3.0),
    sample_interval=0.5,
    update_interval=3.0,
).run


def study():
    return np.concatenate(
        [batch.nees[:, -1] for batch in run_batches(TASK, 4, seed=1, batch_size=2)]
    )


@pytest.fixture
def drawn(monkeypatch, tmp_path):
    """What the command computes with some options, of a book with one figure."""
    found = []

    def compute():
        found.append(study())
        return found[-1]

    definition = FigureDefinition(
        "00-study",
        compute,
        draw=lambda nees: "<svg xmlns='http://www.w3.org/2000/svg'/>",
        columns=None,
        caption=lambda nees: "Some numbers.",
    )
    monkeypatch.setattr(command, "figure_definitions", lambda: {definition.name: definition})

    def run(*options):
        arguments = ["driftlab.book", "figures", "--output", str(tmp_path / "figures"), *options]
        monkeypatch.setattr(sys, "argv", arguments)
        command.main()
        return found[-1]

    return run


@pytest.mark.slow
def test_processes_change_nothing_and_what_is_kept_is_taken(drawn, tmp_path, monkeypatch):
    kept = tmp_path / "kept"
    expected = study()
    np.testing.assert_array_equal(drawn("--workers", "1"), expected)
    np.testing.assert_allclose(drawn("--workers", "2", "--keep", str(kept)), expected, rtol=1e-9)
    assert len(list(kept.glob("*/*.batch"))) == 2
    monkeypatch.setattr("driftlab.calibration.simulation.random_imu_errors", None)
    with pytest.raises(TypeError):
        drawn("--workers", "1")  # no run can be made any more
    np.testing.assert_allclose(drawn("--workers", "1", "--keep", str(kept)), expected, rtol=1e-9)


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["--workers", "0"], "workers: expected a whole number of at least 1, got 0."),
        (["01"], "got 01. There are 00-study, 04-larin-numbers."),
        (["--keep", "{file}/kept"], "Not a directory: '{file}/kept'"),
        (["--scheduler", "tcp://127.0.0.1:1"], "pip install driftlab[cluster]."),
    ],
)
def test_what_cannot_be_is_said_in_a_sentence_before_anything_is_made(
    drawn, options, says, monkeypatch, tmp_path
):
    monkeypatch.setitem(sys.modules, "distributed", None)
    file = tmp_path / "file"
    file.write_text("mine")
    with pytest.raises(SystemExit) as stop:
        drawn(*(option.format(file=file) for option in options))
    assert str(stop.value).endswith(says.format(file=file))
    assert not (tmp_path / "figures").exists()


def test_some_are_written_alone(drawn, tmp_path):
    drawn("--workers", "1", "00", "00-study")
    assert [path.name for path in (tmp_path / "figures").iterdir()] == ["00-study.svg"]


def test_what_is_only_a_picture_has_nothing_to_compare(drawn, tmp_path, capsys):
    drawn("--workers", "1", "--compare", "00")
    assert capsys.readouterr().out.endswith("there are no numbers to compare.\n")
    assert not (tmp_path / "figures").exists()

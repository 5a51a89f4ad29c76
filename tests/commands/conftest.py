"""Commands run in this process; a made-up log, written once, in a folder of its own."""

import os
import shlex

import pytest

from driftlab.commands.line import main


@pytest.fixture(scope="session")
def example_log(tmp_path_factory):
    path = tmp_path_factory.mktemp("log") / "log.csv"
    assert main(["example", str(path)]) == 0
    return path


@pytest.fixture
def run(capsys, tmp_path, monkeypatch):
    """A function that runs words in an empty folder: exit code, what it prints, and its errors."""
    monkeypatch.chdir(tmp_path)

    def running(line, *more):
        try:
            words = shlex.split(line.replace(os.sep, "/"))  # it takes backslashes for its own
            code = main([*words, *map(str, more)])
        except SystemExit as stop:  # argparse's own
            code = stop.code
        printed = capsys.readouterr()
        return code, printed.out, printed.err

    return running


@pytest.fixture
def refused(run):
    """A function that runs words that must be refused: the one sentence."""

    def refusal(line, *more):
        code, out, err = run(line, *more)
        assert code == 2, out + err
        assert out == ""
        assert "Traceback" not in err
        assert err.count("\n") == 1
        assert err.startswith("driftlab: ")
        return err.removeprefix("driftlab: ").strip()

    return refusal

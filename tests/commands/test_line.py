"""What is typed: help with examples that run, and sentences for what cannot be done."""

import json
import os
import shlex
import subprocess
import sys

import pytest

import driftlab
from driftlab.__main__ import main as door
from driftlab.commands import COMMANDS
from driftlab.commands.example import OPTIONS
from driftlab.commands.line import command
from driftlab.commands.outputs import PLAIN

PLACE = "--axes FRD --latitude 59.9"


def test_the_door_names_the_commands_first(capsys):
    assert door([]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert "your own log" in lines[0].lower()
    assert [line.split()[0] for line in lines[1:6]] == list(COMMANDS)
    assert "driftlab.earth: " in "\n".join(lines)


@pytest.mark.parametrize(("word", "meant"), [("calibrat", "calibrate"), ("allen", "allan")])
def test_a_command_mistyped_is_not_done(word, meant, capsys):
    assert door([word, "log.csv"]) == 2
    assert f"Did you mean the command {meant}?" in capsys.readouterr().out


def test_the_version_is_told(run):
    assert run("--version")[:2] == (0, f"driftlab {driftlab.__version__}\n")


def test_a_terminal_without_a_sign_shows_another():
    assert "1 ± 0.1 deg/√h ж".encode("ascii", PLAIN) == b"1 +- 0.1 deg/sqrt h ?"


def test_help_names_every_command(run):
    code, out, _ = run("--help")
    assert code == 0
    for name in COMMANDS:
        assert f"\n    {name}" in out
    assert "find WORD" in out


@pytest.mark.parametrize("words", [["find", "allan"], ["FIND", "x"]])
def test_the_name_of_a_command_starts_it_and_other_words_are_looked_for(words, capsys):
    assert door(words) == (2 if words[0] == "FIND" else 0)
    out = capsys.readouterr().out
    assert "usage:" not in out
    assert ("Nothing here" in out) == (words[0] == "FIND")


@pytest.mark.parametrize("option", ["-h", "--help"])
def test_help_of_find_shows_an_example_that_finds_something(option, capsys):
    assert door(["find", option]) == 0
    out = capsys.readouterr().out
    assert out.startswith("usage: python -m driftlab find ")
    example = out.splitlines()[-1].removeprefix("python -m driftlab ").split()
    assert door(example) == 0
    assert example[1] in capsys.readouterr().out


@pytest.mark.parametrize("name", COMMANDS)
def test_the_example_of_each_help_runs_as_it_is_written(name, run):
    code, out, _ = run(f"{name} --help")
    example = command(name).EXAMPLE
    assert code == 0
    assert example in out
    lines = example.splitlines()
    for line in lines:
        assert line.startswith("python -m driftlab ")
        code, out, err = run(line.removeprefix("python -m driftlab "))
        assert (code, err) == (0, "")


def test_one_process_from_log_to_page(example_log, tmp_path):
    """As a reader would: another process, its exit code, and a pipe that closes early."""
    words = f"align {example_log} {OPTIONS} {PLACE} --end 20 --json found.json"
    done = subprocess.run(
        [sys.executable, "-m", "driftlab", *shlex.split(words)],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert (done.returncode, done.stderr) == (0, "")
    found = json.loads((tmp_path / "found.json").read_text())
    assert found["values"]["earth_rate_sensed"]
    assert found["origin"]["call"] == f"python -m driftlab {words}"
    assert found["title"] in done.stdout


@pytest.mark.skipif(os.name == "nt", reason="no pipes of this kind on Windows")
def test_a_pipe_that_closes_early_is_no_error():
    reader, writer = os.pipe()
    os.close(reader)
    done = subprocess.run(
        [sys.executable, "-m", "driftlab"], stdout=writer, stderr=subprocess.PIPE, timeout=60
    )
    os.close(writer)
    assert (done.returncode, done.stderr) == (1, b"")


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ("--time t,s --units deg/s,g", "--columns: expected the columns of the log"),
        ("--columns 2,3,4,5 --time t,s", "--columns: expected three gyros, or these and three"),
        (f"{OPTIONS} --rate 50", "--time: expected the column of the time stamps, or --rate"),
        ("--columns gx,gy,gz --units deg/s", "--time: expected the column of the time stamps"),
        ("--columns gx,gy,gq --units deg/s --time t,s", "'gq'"),
        ("--columns gx,gy,gz --units furlong --time t,s", "'furlong'"),
        (f"{OPTIONS} --latitude 95", "--latitude: expected degrees, at most 90, got 95."),
        (f"{OPTIONS} --axes FRX", "--axes: expected three letters of right-handed body axes"),
        (f"{OPTIONS} --zeros 0", "--zeros: expected two numbers"),
        (f"{OPTIONS} --latitude 33,9", "with a point, got '33,9'; python -m driftlab integrate"),
        ("--columns gx,gy,gz --units deg/s --time t", "--time: expected a unit beside column 't'"),
        (f"{OPTIONS} --begin 70 --end 20", "begin, end: expected times of the record"),
        (f"{OPTIONS} --allow everything", "got everything."),
        (f"{OPTIONS} --format psins", "--columns: expected none with --format psins"),
        (f"{OPTIONS} --format imu-tk", "log: expected two files, accelerometers and gyros,"),
        (f"{OPTIONS} --gyro a,b,c", "--columns: expected it alone"),
    ],
)
def test_what_is_missing_or_wrong_is_a_sentence(words, sentence, refused, example_log):
    assert sentence in refused("integrate", example_log, *shlex.split(words))


def test_no_such_file_and_no_such_option(refused, run, tmp_path):
    assert refused(f"allan nowhere.csv {OPTIONS}") == "nowhere.csv: No such file or directory."
    assert "Is a directory" in refused("allan", tmp_path, *shlex.split(OPTIONS))
    code, _, err = run("allan log.csv --colums a,b,c")
    assert code == 2
    assert "unrecognized arguments: --colums" in err


BAD = {
    "empty": ("", "expected lines of numbers"),
    "binary": (bytes(range(256)) * 9, "expected"),
    "short": ("t,gx,gy,gz\n0,1,2,3\n0.1,1,2\n0.2,1,2,3\n", "bad.csv, line 3: "),
}


@pytest.mark.parametrize("kind", BAD)
def test_a_bad_file_is_a_sentence_with_the_line(kind, refused, tmp_path):
    content, sentence = BAD[kind]
    content = content if isinstance(content, bytes) else content.encode()
    (tmp_path / "bad.csv").write_bytes(content)
    assert sentence in refused(
        "integrate bad.csv --gyro gx,gy,gz --units deg/s --time t,s --allow stuck,dead"
    )

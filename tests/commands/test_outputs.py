"""Files: none is overwritten unasked, and other programs can read them."""

import csv
import hashlib
import json
import os
import threading

import numpy as np
import pytest

from driftlab.commands.example import OPTIONS
from driftlab.commands.findings import Findings
from driftlab.commands.outputs import Origin, as_csv, as_json, write

ORIGIN = Origin((("log.csv", "0" * 64),), "python -m driftlab", "rows", "versions")


@pytest.mark.parametrize("option", ["--report", "--csv", "--json"])
def test_nothing_is_overwritten_without_being_asked(option, run, refused, example_log, tmp_path):
    there = tmp_path / "there"
    there.write_text("precious")
    words = f"integrate {example_log} {OPTIONS} {option} there"
    assert refused(words) == f"{option}: there is there already; --force overwrites it."
    assert there.read_text() == "precious"
    if option == "--csv":
        assert run(f"{words} --force")[0] == 0
        assert there.read_text().startswith("time_s,qx,qy,qz,qw,heading_deg,")


def test_the_log_itself_is_never_an_output(refused, example_log, tmp_path):
    words = f"integrate {example_log} {OPTIONS} --force"
    content = example_log.read_bytes()
    other = example_log.with_name("other")
    other.hardlink_to(example_log)
    for log in (example_log, other):
        assert "got the log" in refused(f"{words} --csv {log}")
    assert "got the file of --report" in refused(f"{words} --csv a --report ./a")
    assert "expected a file in a folder that is there" in refused(f"{words} --csv no/where.csv")
    assert "expected a file, got the folder" in refused(f"{words} --csv {tmp_path}")
    assert example_log.read_bytes() == content
    assert list(tmp_path.iterdir()) == []


def test_a_file_is_written_whole_or_not_at_all(tmp_path, monkeypatch):
    there = tmp_path / "there"
    there.write_text("precious")

    def full(self, target):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.replace", full)
    with pytest.raises(OSError, match=r"No space left on device: .*there"):
        write(there, "new", force=True)
    assert there.read_text() == "precious"
    assert list(tmp_path.iterdir()) == [there]


@pytest.mark.skipif(os.name == "nt", reason="no pipes of this kind on Windows")
def test_of_a_pipe_the_bytes_that_were_read_are_hashed(run, example_log, tmp_path):
    os.mkfifo(tmp_path / "pipe")
    content = example_log.read_bytes()[:100_000].rpartition(b"\n")[0] + b"\n"
    write = (tmp_path / "pipe").write_bytes
    writer = threading.Thread(target=write, args=(content,), daemon=True)
    writer.start()
    code, _, err = run(f"integrate pipe {OPTIONS} --json found.json")
    writer.join(60)
    assert (code, err) == (0, "")
    found = json.loads((tmp_path / "found.json").read_text())
    assert found["origin"]["files"] == [["pipe", hashlib.sha256(content).hexdigest()]]


def test_the_example_is_not_overwritten_either(refused, tmp_path):
    (tmp_path / "log.csv").write_text("mine")
    assert "--force" in refused("example log.csv")
    assert (tmp_path / "log.csv").read_text() == "mine"


def test_json_has_no_word_that_json_does_not_know():
    values = {"a": np.array([1.0, np.nan]), "b": {"c": np.float64(np.inf), "d": np.int64(3)}}
    text = as_json(Findings("T", (), values=values), ORIGIN)
    assert json.loads(text)["values"] == {"a": [1.0, None], "b": {"c": None, "d": 3}}


def test_csv_has_columns_with_their_units():
    columns = {"time_s": np.array([0.0, 0.1]), "odd, name": ["a", 'b"c']}
    rows = list(csv.reader(as_csv(Findings("T", (), columns=columns)).splitlines()))
    assert rows == [["time_s", "odd, name"], ["0", "a"], ["0.1", 'b"c']]

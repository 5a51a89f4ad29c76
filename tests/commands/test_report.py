"""The page stands alone, repeats byte for byte, and takes nothing of a log for code."""

import hashlib
import importlib.util
import os
import re
import shlex
import sys

import numpy as np
import pytest

from driftlab.commands import line
from driftlab.commands.example import OPTIONS
from driftlab.commands.findings import Curve, Findings, Plot, Table
from driftlab.commands.outputs import Origin
from driftlab.commands.record import outline
from driftlab.commands.report import page

EVIL = "<script>alert('x')</script>\" onload=\"y"


@pytest.mark.skipif(os.name == "nt", reason="no file has such a name on Windows")
def test_the_page_of_a_log_asks_for_nothing_and_takes_its_words_for_text(
    run, example_log, tmp_path
):
    log = tmp_path / "<img src=x onerror=alert(1)>.csv"
    log.write_text(example_log.read_text().replace("gx", "<b>gx</b>", 1))
    columns = shlex.split(OPTIONS.replace("gx", "<b>gx</b>"))
    more = ["--end", "20", "--report", "page.html", "--title", EVIL]
    assert run("integrate", log, *columns, *more)[0] == 0
    text = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert text.startswith("<!DOCTYPE html>")
    assert "default-src 'none'" in text
    body = text.partition("</head>")[2]
    tags = {tag.lower() for tag in re.findall(r"<\s*/?\s*([^\s>]+)", body)}
    known = "h1 p dl dt dd h2 section div table thead tbody tr th td figure figcaption img pre span"
    assert tags <= {*known.split(), "body", "html"}
    images = re.findall(r"<img[^>]*>", body)
    assert images
    assert all("src='data:image/svg" in image for image in images)
    assert "onerror=alert(1)&gt;" in text
    assert "<dt>Date</dt><dd>not told</dd>" in text  # a clock would make each page another
    assert hashlib.sha256(log.read_bytes()).hexdigest() in text
    assert "<span>--end 20</span> <span>--report page.html</span>" in text


def test_tables_and_plots_escape_their_words_and_repeat():
    plot = Plot(EVIL, "x", "y", (Curve(EVIL, np.arange(3.0), np.arange(3.0)),))
    made = Findings(EVIL, (Table(EVIL, (EVIL,), ((EVIL,),), EVIL),), (EVIL,), (EVIL,), (plot,))
    origin = Origin(((EVIL, EVIL),), EVIL, EVIL, EVIL, EVIL)
    text = page(made, origin)
    assert text == page(made, origin)
    assert "<script" not in text
    assert '" onload' not in text


def test_without_matplotlib_a_sentence_says_what_to_do(refused, example_log, tmp_path, monkeypatch):
    monkeypatch.setattr(line, "find_spec", lambda name: None)
    words = f"integrate {example_log} {OPTIONS} --report page.html"
    assert "install it by 'pip install matplotlib'" in refused(words)
    assert not (tmp_path / "page.html").exists()
    assert importlib.util.find_spec("matplotlib") is not None


@pytest.mark.parametrize("terminal", [True, False])
def test_steps_are_counted_in_a_terminal_only(terminal, capsys, monkeypatch):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: terminal)
    with line.steps(2) as step:
        step("one")
        step("two")
    shown = [part.split() for part in capsys.readouterr().err.split("\r")]
    assert shown == ([[], ["one", "1/2"], ["two", "2/2"], [], []] if terminal else [[]])


def test_a_long_line_keeps_its_peaks():
    y = np.sin(np.arange(20_000.0))
    y[12_345] = 9.0
    x, seen = outline(np.arange(20_000.0), y)
    assert len(seen) == len(x) == 1000
    assert seen.max() == 9.0
    assert seen.min() == y.min()
    assert (np.diff(x) >= 0).all()

"""Panels on the page's stand-in for ipywidgets are what they are on ipywidgets."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from standin_report import report

from driftlab.book.panels import EXPLORERS, SCENES
from support import ROOT

IN_PLACE = ROOT / "site/in_place"

# All of them, of whichever panel: the report is made in one of several processes.
pytestmark = pytest.mark.xdist_group("standin")


@pytest.fixture(scope="module")
def standin() -> dict:
    """The report of all panels on the stand-in, which must not touch this process."""
    script = Path(__file__).with_name("standin_report.py")
    told = subprocess.run(
        [sys.executable, script, IN_PLACE], capture_output=True, text=True, check=False
    )
    assert told.returncode == 0, told.stderr[-3000:]
    return json.loads(told.stdout)


@pytest.mark.slow
@pytest.mark.parametrize("panel_class", [*EXPLORERS, *SCENES], ids=lambda each: each.__name__)
def test_shows_the_same(standin, panel_class):
    expected = json.loads(json.dumps(report(panel_class())))
    assert standin["reports"][panel_class.__name__] == expected


@pytest.mark.slow
def test_needs_no_symbols_and_no_notebook(standin):
    assert standin["wrong"] == []

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


def test_a_link_with_a_name_that_no_control_has_is_refused():
    code = """
import sys
sys.path.insert(0, sys.argv[1])
import widgets_standin
widgets_standin.install()
import panels
from driftlab.book import DriftExplorer
from driftlab.book.machinery.panel.still import plain_values
values = plain_values(DriftExplorer().values)
opened = panels.open("DriftExplorer", values, {"azimuth": "5", "self": "1"})
assert opened["values"] == values
print(opened["refused"])
try:
    panels.set(opened["panel"], {"self": "1"})
except ValueError as error:
    print(error)
"""
    told = subprocess.run(
        [sys.executable, "-c", code, IN_PLACE], capture_output=True, text=True, check=False
    )
    assert told.returncode == 0, told.stderr[-3000:]
    opening, moving = told.stdout.splitlines()
    assert moving.startswith("values: expected names from ")
    assert moving.endswith(", got self.")
    assert opening == f"This link does not fit the panel. {moving}"

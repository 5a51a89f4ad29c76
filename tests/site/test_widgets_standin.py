"""Panels on the page's stand-in for ipywidgets: all of them open."""

import subprocess
import sys

import pytest

from driftlab.book.panels import EXPLORERS, SCENES
from support import ROOT

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("site")]
OPEN_ALL = """
import sys
sys.path.insert(0, sys.argv[1])
import widgets_standin
widgets_standin.install()
import panels
from driftlab.book.panels import EXPLORERS, SCENES
from driftlab.book.machinery.panel.still import plain_values

def kinds(widget):
    yield widget["kind"]
    for child in widget["state"].get("children", ()):
        yield from kinds(child)

for each in (*EXPLORERS, *SCENES):
    starts = {control.name: control.start for control in each.controls}
    opened = panels.open(each.__name__, plain_values(starts), plain_values(starts))
    print(each.__name__, *{*kinds(opened["widget"])})
assert not {"sympy", "IPython", "ipykernel", "comm"} & set(sys.modules)
"""


def test_every_panel_opens_without_a_notebook_and_has_controls_that_the_page_can_show():
    done = subprocess.run(
        [sys.executable, "-c", OPEN_ALL, ROOT / "site/in_place"],
        capture_output=True,
        encoding="utf-8",
    )
    assert done.returncode == 0, done.stderr[-3000:]
    rows = [line.split() for line in done.stdout.splitlines()]
    assert [name for name, *_ in rows] == [each.__name__ for each in (*EXPLORERS, *SCENES)]
    shown = (ROOT / "site/in_place/controls.js").read_text("utf-8")
    for name, *kinds in rows:
        for kind in kinds:
            assert f"  {kind}(model" in shown or f"  {kind}: (model" in shown, (name, kind)

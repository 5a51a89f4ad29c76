"""Tests of one panel are one group, so that only one of several processes computes its runs."""

from functools import cache

import pytest

from driftlab.book.machinery.panel.panel import Explorer
from driftlab.book.panels import EXPLORERS, SCENES

every_panel = pytest.mark.parametrize(
    "panel_class",
    [pytest.param(e, id=e.__name__, marks=pytest.mark.xdist_group(e.__name__)) for e in EXPLORERS],
)

every_scene = pytest.mark.parametrize(
    "scene_class",
    [pytest.param(s, id=s.__name__, marks=pytest.mark.xdist_group(s.__name__)) for s in SCENES],
)


@cache
def only_panel(panel_class: type[Explorer]) -> Explorer:
    """The one panel of its kind that the tests of a process use, whatever it shows now."""
    return panel_class()


def opened(panel_class: type[Explorer]) -> Explorer:
    """A panel as it opens; what it showed before has no part in what it shows."""
    panel = only_panel(panel_class)
    panel.reset.click()
    return panel

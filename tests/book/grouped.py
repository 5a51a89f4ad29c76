"""Tests of one panel are one group, so that only one of several processes computes its runs."""

import pytest

from driftlab.book.panels import EXPLORERS

every_panel = pytest.mark.parametrize(
    "panel_class",
    [pytest.param(e, id=e.__name__, marks=pytest.mark.xdist_group(e.__name__)) for e in EXPLORERS],
)

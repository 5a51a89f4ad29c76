"""The panel of chapter 14: axes that follow its curves."""

import pytest

from driftlab.book import GyrocompassExplorer


@pytest.mark.xdist_group("GyrocompassExplorer")
def test_axes_that_must_reach_farther_are_drawn_anew_and_come_back() -> None:
    panel = GyrocompassExplorer()
    at_first, background = panel.view.widget.value, panel.view.background
    panel.set(damping=0.5)
    assert panel.view.background is not background
    far = panel.view.picture.panels[0].get_ylim()
    assert far == (-2.0, 2.0)
    background = panel.view.background
    panel.set(damping=0.501)
    assert panel.view.background is background  # the same step: nothing to draw but lines
    panel.set(damping=0.0)
    assert panel.view.picture.panels[0].get_ylim() == (-0.5, 0.5)
    assert panel.view.widget.value == at_first

"""The panel of chapter 13: a vertical body."""

import re

from driftlab.book import AlignmentBudgetExplorer
from panel_numbers import results_of


def test_a_vertical_body_still_shows_its_attitude() -> None:
    panel = AlignmentBudgetExplorer()
    panel.set(pitch=90.0)
    assert panel.message.value == ""
    said = dict(results_of(panel))
    assert said["heading error"] == "no heading"
    assert said["heading: exact"] == said["heading: first order"] == "–"
    assert re.fullmatch(r"0\.\d+°", said["attitude: exact"])

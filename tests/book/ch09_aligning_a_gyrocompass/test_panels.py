"""The panel of chapter 09: a vertical body."""

import re

from driftlab.book import AlignmentBudgetExplorer


def test_a_vertical_body_still_shows_its_attitude() -> None:
    panel = AlignmentBudgetExplorer()
    panel.set(pitch=90.0)
    assert panel.message.value == ""
    assert "sum, first order <b>none</b>" in panel.text.value
    assert re.search(r"attitude error, exact <b>0\.\d+°</b>", panel.text.value)

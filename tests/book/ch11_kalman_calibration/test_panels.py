"""The panel of chapter 11: a scheme of a turntable, typed."""

import pytest

from driftlab.book import ObservabilityExplorer


def test_a_scheme_is_typed_and_a_wrong_word_gives_a_sentence() -> None:
    panel = ObservabilityExplorer()
    picture = panel.view.widget.value
    panel._widgets["rotations"].value = "+90X +90W"
    assert "expected words like +90Y or -180X" in panel.message.value
    assert "got &#x27;+90W&#x27;" in panel.message.value
    assert panel.view.widget.value == picture
    panel._widgets["rotations"].value = "+99999999X"
    assert "expected at most 3600 degrees a word" in panel.message.value
    panel._widgets["rotations"].value = "+90X −90Y"  # a pasted minus is one too
    assert panel.message.value == ""
    panel._widgets["rotations"].value = "+90X +90Y"
    assert panel.message.value == ""
    assert panel.view.widget.value != picture
    with pytest.raises(ValueError, match="rotations: expected text, got 90"):
        panel.set(rotations=90)

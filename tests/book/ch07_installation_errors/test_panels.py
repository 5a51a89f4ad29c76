"""The panel of chapter 07: the parts of a triad."""

from driftlab.book import SplitExplorer


def test_split_panel_says_the_three_parts() -> None:
    panel = SplitExplorer("One gyro leans")
    for words in ("non-orthogonality xy <b>40.0″</b>", "misalignment about z <b>-40.0″</b>"):
        assert words in panel.text.value
    panel.preset.value = "Turned as a whole"
    assert "non-orthogonality xy <b>0.0″</b>" in panel.text.value
    assert "misalignment about z <b>80.0″</b>" in panel.text.value

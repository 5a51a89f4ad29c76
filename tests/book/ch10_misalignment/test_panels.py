"""The panel of chapter 10: the parts of a triad."""

from driftlab.book import SplitExplorer
from panel_numbers import results_of


def parts(panel: SplitExplorer, name: str) -> list[str]:
    return [text for row, text in results_of(panel) if row.startswith(name)]


def test_split_panel_says_the_three_parts() -> None:
    panel = SplitExplorer("One gyro leans")
    assert parts(panel, "non-orthogonality") == ["40.0", "0.0", "0.0"]
    assert parts(panel, "misalignment") == ["0.0", "0.0", "-40.0"]
    assert parts(panel, "the most") == ["80.0″"]
    panel.preset.value = "Turned as a whole"
    assert parts(panel, "non-orthogonality") == ["0.0", "0.0", "0.0"]
    assert parts(panel, "misalignment") == ["0.0", "0.0", "80.0"]

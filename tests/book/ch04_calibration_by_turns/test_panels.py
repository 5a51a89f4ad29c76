"""The panel of chapter 04: noise, and the arc seconds of the text."""

from driftlab.book import TurnCalibrationExplorer
from panel_numbers import results_of


def test_noise_gives_a_spread_and_its_mean() -> None:
    panel = TurnCalibrationExplorer()
    assert "mean of" not in panel.text.value
    panel.preset.value = "Noisy gyros"
    assert "mean of 12" in panel.text.value


def test_the_offset_of_the_earth_stands_in_arc_seconds_beside_the_picture() -> None:
    panel = TurnCalibrationExplorer()
    panel.preset.value = "On the Earth, a perfect triad"
    assert dict(results_of(panel))["largest error"] == "52.46″"
    assert panel.text.value.count("<td>52.46</td>") == 3

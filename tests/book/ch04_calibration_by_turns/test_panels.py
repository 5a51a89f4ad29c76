"""The panel of chapter 04: noise."""

from driftlab.book import TurnCalibrationExplorer


def test_noise_gives_a_spread_and_its_mean() -> None:
    panel = TurnCalibrationExplorer()
    assert "mean of" not in panel.text.value
    panel.preset.value = "Noisy gyros"
    assert "mean of 12" in panel.text.value

"""The panel of chapter 04: noise, and the arc seconds of the text."""

import numpy as np
from scipy.constants import arcsecond

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


def test_only_the_turn_of_the_triad_pays_for_the_axes_if_there_are_six() -> None:
    """The price: first order for the skew part, and for the rest as well about three axes only."""
    panel = TurnCalibrationExplorer()
    panel.preset.value = "Axes known to 60″"
    six = panel.compute(panel.values)
    assert six.nine_spread[:6].max() < 1 * arcsecond
    assert six.nine_spread[6:].min() > 20 * arcsecond
    panel.set(plan="three pair axes, (3.4)")
    three = panel.compute(panel.values)
    assert three.nine_spread.min() > 20 * arcsecond
    for table in (six, three):  # Larin's numbers pay by products only
        assert np.abs(table.mean_error).max() < 1.5 * arcsecond

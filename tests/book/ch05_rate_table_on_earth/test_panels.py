"""The panel of chapter 05: the Earth, its remedies, and badly known axes."""

import numpy as np
import pytest
from scipy.constants import arcsecond

from driftlab.book import EarthTurnsExplorer
from panel_numbers import results_of


def test_the_offset_of_the_earth_stands_in_arc_seconds_beside_the_picture() -> None:
    panel = EarthTurnsExplorer()
    panel.preset.value = "A perfect triad"
    assert dict(results_of(panel))["largest error"] == "52.46″"
    assert panel.text.value.count("<td>52.46</td>") == 3


def test_only_the_turn_of_the_triad_pays_for_the_axes_if_there_are_six() -> None:
    """The price: first order for the skew part, and for the rest as well about three axes only."""
    panel = EarthTurnsExplorer()
    panel.preset.value = "Axes known to 60″"
    six = panel.compute(panel.values)
    assert six.nine_spread[:6].max() < 1 * arcsecond
    assert six.nine_spread[6:].min() > 20 * arcsecond
    panel.set(plan="three pair axes, (3.4)")
    three = panel.compute(panel.values)
    assert three.nine_spread.min() > 20 * arcsecond
    for table in (six, three):  # Larin's numbers pay by products only
        assert np.abs(table.mean_error).max() < 1.5 * arcsecond


def test_presets_show_the_trap_and_its_cures() -> None:
    panel = EarthTurnsExplorer()
    errors = {}
    for name in panel.presets:
        panel.preset.value = name
        data = panel.compute(panel.values)
        errors[name] = np.abs(data.runs - data.true).max() / arcsecond
    assert errors["A perfect triad"] == pytest.approx(52.46, abs=0.01)
    assert errors["Larin's triad"] > 50
    assert errors["Both directions"] < 0.2
    assert errors["Common offset"] < 0.2

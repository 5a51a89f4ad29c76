"""The panel of chapter 05: the trap of the Earth, and its cures."""

import numpy as np
import pytest
from scipy.constants import arcsecond

from driftlab.book import EarthTurnsExplorer


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

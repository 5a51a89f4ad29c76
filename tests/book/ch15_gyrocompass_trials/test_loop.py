"""The figures of the levelling loop: a compass on waves, and a laser gyro unit."""

import numpy as np
import pytest

from driftlab.book.machinery.figure.publish import PublishedFigure
from driftlab.earth import EARTH_RATE
from published import published
from saratov import LATITUDE, SCHULER

VERTICAL_RATE = EARTH_RATE * np.sin(LATITUDE)


@published("15-frequency-response")
def test_the_compass_answers_waves_as_the_loop_says(figure: PublishedFigure) -> None:
    for disturbance, parts in figure.data.gain_and_lead.items():
        # The coupling by the Earth's turn, (U sin(latitude)/2 zeta ws)^2, and the Coriolis force.
        coupling = (VERTICAL_RATE / SCHULER) ** 2
        to_and_fro = 0.02 if disturbance == "acceleration" else 0.0
        assert np.nanmax(np.abs(parts[:, 0])) < 2 * coupling + to_and_fro
    # The notch: nothing of a log's error at Schuler's frequency, in truth a little of the step.
    answer = np.abs(figure.data.driven["speed_log_error"][1])
    assert answer[2] < 0.003 * answer[1]


@published("15-pulses")
def test_a_laser_gyro_unit_finds_north_with_a_damped_horizon(figure: PublishedFigure) -> None:
    """From the record if it is at hand, else from the table that was computed from it."""
    read, whole = np.degrees(figure.data.by_integrals), np.degrees(figure.data.by_whole_rate)
    assert read.std() < 0.1
    assert whole.std() > 60
    # Like gravity in inertial space, which chapter 17 has; the header of the file says -90.6.
    assert read.mean() == pytest.approx(-90.6, abs=0.05)
    # A pulse is four counts of the file; a mean over a minute has as many of them as there are.
    assert figure.data.pulse == pytest.approx(4 * figure.data.count, rel=1e-9)
    assert figure.data.pulse_over_earth_rate > 15
    assert np.degrees(figure.data.by_minutes).std() < 0.1

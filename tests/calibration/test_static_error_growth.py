"""Errors at rest in closed form: rates and modes, curves against the navigation, refusals."""

import re

import numpy as np
import pytest
from scipy.linalg import expm

from driftlab.calibration.static_error_growth import (
    STATIC_ERROR_SOURCES,
    schuler_position_error,
    static_error_modes,
    static_error_sources,
    static_errors,
)
from driftlab.calibration.static_navigation import navigate_static
from driftlab.core.strapdown import CHUNK
from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity
from driftlab.imu import NO_ERRORS, TYPICAL_ERRORS
from driftlab.quaternion import from_rotation_vector

LEVEL = np.array([0.0, 0.0, 0.0, 1.0])
DAY = 86400.0
LATITUDES = np.radians([51.5, -35.0, 0.5])
SIZES = np.array([1e-5] * 3 + [0.05] * 2 + [100.0] * 2 + [5e-8] * 3 + [1e-4] * 2)
"""Of the causes, so that each leads some hundred metres away."""
SCALES = np.array([1.0] * 3 + [8e3] * 2 + [6.4e6] * 2)
"""Of the states: angles, and what an angle of 1 is in velocity and position."""


@pytest.mark.parametrize("degrees", [0.0, 1e-3, 37.5, -60.0, 89.9])
def test_rates_are_the_eigenvalues_of_the_matrix(degrees):
    latitude = np.radians(degrees)
    modes = static_error_modes(latitude)
    rates, found = modes.rates, np.linalg.eigvals(modes.matrix[:, :7])
    # Rounding beside Schuler's rate of 1e-3; the matrix holds 9.8 and 1e-7, hence 1e-12.
    np.testing.assert_allclose(found.real, 0, rtol=0, atol=1e-12)
    expected = np.sort([0.0, *rates, *(-rate for rate in rates)])
    np.testing.assert_allclose(np.sort(found.imag), expected, rtol=0, atol=1e-12)


@pytest.mark.parametrize("latitude", LATITUDES)
def test_schulers_pair_is_split_by_the_earth_under_it(latitude):
    """On a sphere w² ± ... exactly; the ellipsoid moves the pair by its flattening, 1/298."""
    rates = static_error_modes(latitude).rates
    schuler = np.sqrt(float(gravity(latitude)) / EARTH_RADIUS)
    assert rates.schuler == pytest.approx(schuler, rel=1 / 298)
    # Without the Earth's turn the two radii alone, apart by 2/298 at most, split it by w/298.
    vertical = EARTH_RATE * abs(np.sin(latitude))
    assert vertical <= rates.foucault <= np.hypot(vertical, schuler / 298)


@pytest.mark.parametrize("latitude", [*LATITUDES, 0.0])
def test_sum_of_modes_is_the_matrix_exponential(latitude):
    whole = np.zeros((12, 12))
    modes = static_error_modes(latitude)
    whole[:7] = modes.matrix
    times = np.array([0.0, 600.0, 5000.0, DAY])
    found = modes.at(times).sum(axis=0)
    sizes = np.concatenate([SCALES, [1e-3] * 3, [9.8] * 2])
    for one, time in zip(found, times, strict=True):
        expected = expm(whole * time)[:7] * sizes / SCALES[:, np.newaxis]
        gap = np.abs(one * sizes / SCALES[:, np.newaxis] - expected).max()
        assert gap < 1e-9 * max(1.0, np.abs(expected).max())


@pytest.mark.parametrize("latitude", LATITUDES)
def test_curves_are_those_of_the_navigation_for_a_third_of_a_day(latitude):
    """Every cause alone that `navigate_static` can be given, after what a perfect unit shows."""
    chosen = [0, 1, 2, 7, 8, 9, 10, 11]
    causes = np.vstack([np.zeros(12), np.diag(SIZES)[chosen]])
    none = np.zeros((len(causes), 3, 3))
    units = NO_ERRORS._replace(
        gyro_bias=causes[:, 7:10],
        gyro_error_matrix=none,
        accelerometer_bias=np.pad(causes[:, 10:], ((0, 0), (0, 1))),
        accelerometer_error_matrix=none,
    )
    starts = from_rotation_vector(-causes[:, :3])
    run = navigate_static(
        units, NO_ERRORS, LEVEL, start=starts, reference=LEVEL,
        latitude=latitude, duration=DAY / 3, interval=5.0, output_interval=600.0,
    )  # fmt: skip
    curves = static_errors(run.times, latitude, causes)
    # Second order: the latitude moves by 1e-3 at most, rates and radii with it. Steps of h = 10 s
    # slow the pendulum by (w h)²/24 = 6e-6, in 6 swings by 2e-4 rad.
    bound = 2e-3
    # The height is free for 40 s at a time: a velocity East makes one Up by Coriolis, 2 U cos L t
    # times as large, and that one brakes it. Over 20 s on the average, half of it in the amplitude.
    bound += 2 * (EARTH_RATE * np.cos(latitude)) ** 2 * CHUNK / 2 * DAY / 3
    for name in ("attitude", "velocity", "position"):
        whole, expected = getattr(run, name), getattr(curves, name)[1:]
        gap = np.abs(whole[1:] - whole[0] - expected).max(axis=(1, 2))
        assert (gap < bound * np.abs(expected).max(axis=(1, 2))).all()
    # The unit's own causes say the same.
    same = static_error_sources(
        units, NO_ERRORS, LEVEL, start=starts, reference=LEVEL, latitude=latitude
    )
    np.testing.assert_allclose(same, causes, rtol=0, atol=1e-12)


def test_causes_of_a_bent_unit_give_its_curves():
    """All installation, scale and bias errors at once, in a tilted unit that begins a bit off."""
    latitude, standing = -0.6, from_rotation_vector([0.3, -0.2, 1.0])
    found = NO_ERRORS._replace(
        **{name: 0.99 * part for name, part in TYPICAL_ERRORS._asdict().items()}
    )
    setting = {"start": from_rotation_vector([0.3, -0.2, 1.00001]), "reference": standing}
    run = navigate_static(
        TYPICAL_ERRORS,
        found,
        standing,
        latitude=latitude,
        duration=14400.0,
        interval=1.0,
        **setting,
    )
    causes = static_error_sources(TYPICAL_ERRORS, found, standing, latitude=latitude, **setting)
    curves = static_errors(run.times, latitude, causes)
    for name in ("attitude", "velocity", "position"):
        expected = getattr(curves, name)
        assert np.abs(getattr(run, name) - expected).max() < 2e-3 * np.abs(expected).max()


@pytest.mark.parametrize("latitude", [0.65, -0.9])
def test_textbook_curves_hold_for_the_first_swing(latitude):
    """They neglect U t, a tenth in 23 minutes of it; a quarter of an hour is used here."""
    times = np.linspace(60.0, 900.0, 15)
    causes = np.diag(SIZES)[
        [i for i, name in enumerate(STATIC_ERROR_SOURCES) if name != "position North"]
    ]
    exact = static_errors(times, latitude, causes).position
    gap = np.abs(schuler_position_error(times, latitude, causes) - exact).max(axis=(1, 2))
    main = np.abs(exact).max(axis=(1, 2))
    bound = 1.5 * EARTH_RATE * times[-1]
    assert (gap < bound * main).all()
    # A wrong latitude stays, and turns the horizon by what is of second order in the time.
    assert np.abs(static_errors(times, latitude, np.eye(12)[6]).position[-1] - [0, 1]).max() < bound


def test_only_a_bias_along_the_earths_axis_grows_without_end():
    """It is East of what it began with, by U's rate of change of longitude: R cos L times it."""
    latitude = 0.7
    growing = static_error_modes(latitude).growing
    along = np.array([0.0, np.cos(latitude), np.sin(latitude)])
    biases = growing[:, 7:10]
    # Rounding of 1e-10 beside the radius.
    others = np.delete(growing, [7, 8, 9], axis=1) * SIZES[[0, 1, 2, 3, 4, 5, 6, 10, 11]]
    np.testing.assert_allclose(others, 0, rtol=0, atol=1e-9)
    np.testing.assert_allclose(biases[[0, 1, 2, 3, 4, 6]], 0, rtol=0, atol=1e-2)
    radius = biases[5] @ along / np.cos(latitude)
    np.testing.assert_allclose(biases[5], radius * np.cos(latitude) * along, rtol=0, atol=1e-2)
    assert radius == pytest.approx(6378137.0 / np.sqrt(1 - 0.00669438 * np.sin(latitude) ** 2))


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: static_error_modes(1.6), "latitude: expected at most 89.9 degrees"),
        (lambda: static_errors(3.0, 0.1, np.zeros(12)), "times: expected shape (k,), got shape ()"),
        (
            lambda: static_error_sources(
                NO_ERRORS, NO_ERRORS, LEVEL, start=LEVEL, reference=np.zeros(4), latitude=0.1
            ),
            "reference: expected nonzero quaternions",
        ),
    ],
)
def test_bad_arguments_are_refused_by_name(call, words):
    with pytest.raises(ValueError, match=f"^{re.escape(words)}"):
        call()

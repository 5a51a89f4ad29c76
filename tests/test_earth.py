"""The Earth against its constants, the exact normal potential and differential geometry."""

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.integrate import quad
from scipy.special import ellipe

from driftlab.core import earth as core
from driftlab.core.earth import (
    ECCENTRICITY_SQUARED,
    EQUATOR_GRAVITY,
    FLATTENING,
    POLE_GRAVITY,
    SEMI_MAJOR_AXIS,
)
from driftlab.earth import EARTH_RATE, checked_latitude, curvature_radii, earth_rate, gravity
from support import EPS

MINOR_AXIS = SEMI_MAJOR_AXIS * (1 - FLATTENING)
GM = 3.986004418e14  # m^3/s^2, the fourth defining constant of WGS 84
# A coordinate of an Earth's radius is good to some of its eps, m.
ROUNDING = 16 * SEMI_MAJOR_AXIS * EPS
LATITUDES = np.linspace(-np.pi / 2, np.pi / 2, 181)

latitudes = st.floats(-np.pi / 2, np.pi / 2)
longitudes = st.floats(-3.14, 3.14)
altitudes = st.floats(-5e3, 2e4)


def of_arrays(function):
    """A function of the core, which takes arrays only."""
    return lambda *values: function(*map(np.asarray, values))


geodetic, gravitation = of_arrays(core.geodetic), of_arrays(core.gravitation)
gravity_north, position_vector = of_arrays(core.gravity_north), of_arrays(core.position_vector)


def vertical(latitude):
    """Unit vectors (..., 3) to the North and up, on the meridian of longitude zero."""
    sine, cosine, zero = np.sin(latitude), np.cos(latitude), np.zeros(np.shape(latitude))
    return np.stack([-sine, zero, cosine], axis=-1), np.stack([cosine, zero, sine], axis=-1)


def turned(vector, longitude):
    """Vectors (..., 3) turned about the third axis."""
    x, y, z = np.moveaxis(np.asarray(vector), -1, 0)
    sine, cosine = np.sin(longitude), np.cos(longitude)
    return np.stack([cosine * x - sine * y, sine * x + cosine * y, z], axis=-1)


def derivative(function, step):
    """Derivative at zero from five points; its error is step^4/30 of the fifth derivative."""
    near, far = (function(k * step) - function(-k * step) for k in (1, 2))
    return (8 * near - far) / (12 * step)


def exact_gravity(latitude, altitude):
    """Gradient (..., 3) of the exact potential of gravity of the ellipsoid, in m/s^2.

    Heiskanen and Moritz, Physical Geodesy, 2-62, differentiated along imaginary steps.
    """
    focus = np.sqrt(SEMI_MAJOR_AXIS**2 - MINOR_AXIS**2)

    def q(u):
        return 0.5 * ((1 + 3 * u**2 / focus**2) * np.arctan(focus / u) - 3 * u / focus)

    def potential(rho, z):
        excess = rho**2 + z**2 - focus**2
        u_squared = 0.5 * (excess + np.sqrt(excess**2 + 4 * focus**2 * z**2))
        u = np.sqrt(u_squared)
        form = 0.5 * EARTH_RATE**2 * SEMI_MAJOR_AXIS**2 * q(u) / q(MINOR_AXIS)
        centrifugal = 0.5 * EARTH_RATE**2 * rho**2
        return GM / focus * np.arctan(focus / u) + form * (z**2 / u_squared - 1 / 3) + centrifugal

    rho, _, z = np.moveaxis(position_vector(latitude, altitude), -1, 0)
    step = 1e-20j
    along, across = potential(rho + step, z).imag, potential(rho, z + step).imag
    return np.stack([along, np.zeros_like(rho), across], axis=-1) / step.imag


# The ellipsoid


def test_points_of_altitude_zero_lie_on_the_ellipse():
    x, y, z = position_vector(LATITUDES, 0.0).T
    np.testing.assert_allclose(
        (x / SEMI_MAJOR_AXIS) ** 2 + (z / MINOR_AXIS) ** 2, 1, rtol=0, atol=16 * EPS
    )
    np.testing.assert_array_equal(y, 0)


def test_latitude_is_that_of_the_normal_to_the_ellipse():
    north, up = vertical(LATITUDES)
    normal = position_vector(LATITUDES, 0.0) / [SEMI_MAJOR_AXIS**2, 1, MINOR_AXIS**2]
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    np.testing.assert_allclose(normal, up, rtol=0, atol=8 * EPS)
    np.testing.assert_allclose(np.sum(normal * north, axis=-1), 0, rtol=0, atol=8 * EPS)


@given(latitudes, altitudes, st.floats(-1e3, 1e3))
def test_altitude_goes_along_the_vertical(latitude, altitude, more):
    rise = position_vector(latitude, altitude + more) - position_vector(latitude, altitude)
    np.testing.assert_allclose(rise, more * vertical(latitude)[1], rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("altitude", [-5e3, 0.0, 2e4])
def test_meridian_radius_is_the_way_north_for_an_angle(altitude):
    north, _ = vertical(LATITUDES)
    way = derivative(lambda angle: position_vector(LATITUDES + angle, altitude), 1e-3)
    expected = (curvature_radii(LATITUDES)[0] + altitude)[:, np.newaxis] * north
    # Rounding over the step, and a fifth derivative of about a radius.
    bound = 1.5 * ROUNDING / 1e-3 + 1e-12 / 30 * 7e6
    np.testing.assert_allclose(way, expected, rtol=0, atol=bound)


@given(latitudes)
def test_prime_vertical_radius_reaches_down_to_the_axis(latitude):
    _, across = curvature_radii(latitude)
    foot = position_vector(latitude, 0.0) - across * vertical(latitude)[1]
    assert foot[0] == pytest.approx(0, abs=ROUNDING)


def test_meridian_quadrant_is_the_elliptic_integral():
    length, _ = quad(lambda latitude: float(curvature_radii(latitude)[0]), 0, np.pi / 2)
    assert length == pytest.approx(SEMI_MAJOR_AXIS * ellipe(ECCENTRICITY_SQUARED), rel=1e-13)
    # As printed in geodetic tables for this ellipsoid.
    assert length == pytest.approx(10_001_965.729, abs=5e-4)


# Geodetic coordinates


@given(latitudes, longitudes, altitudes)
def test_geodetic_inverts_the_position_vector(latitude, longitude, altitude):
    found = geodetic(turned(position_vector(latitude, altitude), longitude))
    # What the function promises. An error of the latitude enters the altitude squared.
    assert found[0] == pytest.approx(latitude, rel=0, abs=1e-11)
    assert found[2] == pytest.approx(altitude, rel=0, abs=ROUNDING)
    if abs(latitude) < 1.57:  # at a pole the longitude is rounding
        assert found[1] == pytest.approx(longitude, rel=0, abs=8 * EPS / np.cos(latitude))


@pytest.mark.parametrize("pole", [1.0, -1.0])
def test_poles_have_a_latitude_and_an_altitude(pole):
    latitude, _, altitude = geodetic([0.0, 0.0, pole * (MINOR_AXIS + 100)])
    assert latitude == pole * np.pi / 2
    assert altitude == pytest.approx(100, abs=ROUNDING)
    pull = gravitation([0.0, 0.0, pole * MINOR_AXIS])
    np.testing.assert_allclose(pull, [0, 0, -pole * POLE_GRAVITY], rtol=0, atol=64 * EPS)


@pytest.mark.parametrize("function", [geodetic, gravitation])
def test_positions_deep_inside_are_refused(function):
    with pytest.raises(
        ValueError,
        match=r"^position: expected at least 6\.2e\+06 m from the Earth's centre, got 5e\+06 m\.$",
    ):
        function([[7e6, 0, 0], [3e6, 0, -4e6]])
    function([3.8e6, 0, 5e6])


# Rotation


@given(st.floats(-1.6, 1.6))
def test_earth_rate_is_along_the_axis(latitude):
    east, north, up = earth_rate(latitude)
    level, plumb = vertical(latitude)
    assert east == 0
    np.testing.assert_allclose(
        north * level + up * plumb, [0, 0, EARTH_RATE], rtol=0, atol=4 * EPS * EARTH_RATE
    )


# Gravity


def test_gravity_takes_its_constants_at_equator_and_poles():
    np.testing.assert_allclose(
        gravity([-np.pi / 2, 0, np.pi / 2]),
        [POLE_GRAVITY, EQUATOR_GRAVITY, POLE_GRAVITY],
        rtol=4 * EPS,
    )


def test_gravity_on_the_ellipsoid_is_the_gradient_of_the_exact_potential():
    _, up = vertical(LATITUDES)
    # The two gravities are printed to 1e-10 m/s^2, and the Earth's GM to 1e-10 of it.
    np.testing.assert_allclose(
        exact_gravity(LATITUDES, 0.0), -gravity(LATITUDES)[:, np.newaxis] * up, rtol=0, atol=2e-9
    )


def test_mean_gravity_is_the_printed_one():
    def area(latitude):
        along, across = curvature_radii(latitude)
        return float(along * across * np.cos(latitude))

    total, _ = quad(lambda latitude: area(latitude) * float(gravity(latitude)), 0, np.pi / 2)
    # NIMA TR8350.2, table 3.4.
    assert total / quad(area, 0, np.pi / 2)[0] == pytest.approx(9.7976432222, abs=5e-10)


@pytest.mark.parametrize("altitude", [-5e3, 100.0, 2e3, 1e4, 2e4])
def test_gravity_above_the_ellipsoid_is_that_of_the_potential(altitude):
    north, up = vertical(LATITUDES)
    exact = exact_gravity(LATITUDES, altitude)
    height = abs(altitude) / SEMI_MAJOR_AXIS
    # Left out are 4 (h/a)^3, a few f^2 of the first-order term 2 h/a, and f of 3 (h/a)^2 or so.
    # The constants are good to 2e-9, as above.
    left_out = 4 * height**3 + 8 * FLATTENING**2 * height + 3 * FLATTENING * height**2
    difference = np.abs((exact * up).sum(axis=-1) + gravity(LATITUDES, altitude)).max()
    assert difference <= 9.84 * left_out + 2e-9
    assert difference <= 0.3e-6 * 9.8  # as the function says
    # The lean of 2 (g_p - g_e) h/a sin cos is itself of first order in f: 0.0053 h/a.
    lean = (exact * north).sum(axis=-1) - gravity_north(LATITUDES, altitude)
    most = 9.84 * 0.0053 * height * (3 * FLATTENING + 3 * height)
    assert np.abs(lean).max() <= most + 2e-9
    assert most < 0.4e-6 * 9.8
    assert np.abs(lean).max() < 0.3e-6 * 9.8


@given(latitudes, longitudes, altitudes)
def test_gravitation_and_centrifugal_force_make_gravity_along_the_vertical(
    latitude, longitude, altitude
):
    place = turned(position_vector(latitude, altitude), longitude)
    centrifugal = EARTH_RATE**2 * place * [1, 1, 0]
    north, up = (turned(axis, longitude) for axis in vertical(latitude))
    expected = gravity_north(latitude, altitude) * north - gravity(latitude, altitude) * up
    # The latitude found on the way is good to 1e-11 rad.
    np.testing.assert_allclose(
        gravitation(place) + centrifugal, expected, rtol=0, atol=9.84 * 1.1e-11
    )


# Refusals


@pytest.mark.parametrize("degrees", [89.95, -89.95, 90, -90, 1000])
def test_poles_are_refused_where_north_is_needed(degrees):
    with pytest.raises(
        ValueError,
        match=r"^latitude: expected at most 89\.9 degrees from the equator, because East and "
        rf"North are lost at a pole, got .* rad, that is {abs(degrees)} degrees\.",
    ):
        checked_latitude(np.radians([0.0, degrees]))


@pytest.mark.parametrize("function", [earth_rate, curvature_radii, gravity])
def test_degrees_are_refused_and_poles_are_not(function):
    words = r"^latitude: expected rad, at most 1\.6 in size, got -55: is it in degrees\? np\.rad"
    with pytest.raises(ValueError, match=words):
        function([0.5, -55.0])
    function([-np.pi / 2, np.pi / 2])


def test_other_latitudes_come_back_as_they_are():
    values = np.radians([-89.9, -45.0, 0.0, 89.89])
    np.testing.assert_array_equal(checked_latitude(values), values)

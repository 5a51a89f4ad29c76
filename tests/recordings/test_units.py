"""Units in every spelling that logs use, and nothing that is none."""

import numpy as np
import pytest

from driftlab.recordings._units import accelerometer_unit, gyro_unit, is_unit, spelled, time_unit

DEGREE = np.pi / 180
ARCSEC = DEGREE / 3600


@pytest.mark.parametrize(
    ("text", "kind", "size"),
    [
        *((text, "rates", DEGREE) for text in ("deg/s", "°/s", "dps", "Deg/sec", "degrees/second")),
        *((text, "rates", 1.0) for text in ("rad/s", "radians/s", " RAD/S ", "rad/sec")),
        *((text, "rates", ARCSEC) for text in ("deg/h", "°/hr", "deg/hour", "1 arcsec/s")[:3]),
        *((text, "increments", ARCSEC) for text in ("arcsec", "arc-sec", "arcseconds")),
        *((text, "increments", DEGREE) for text in ("deg", "°", "degrees")),
        *((text, "increments", 1.0) for text in ("rad", "radians")),
        ("mrad", "increments", 1e-3),
        ("mrad/s", "rates", 1e-3),
        ("mdps", "rates", 1e-3 * DEGREE),
        ("µrad", "increments", 1e-6),
        ("0.1 arcsec", "increments", 0.1 * ARCSEC),
        ("1/131 deg/s", "rates", DEGREE / 131),
        ("2^-1 deg", None, None),
        ("-1 deg", None, None),
        ("1/0 deg", None, None),
        ("m/s^2", None, None),
        ("", None, None),
    ],
)
def test_units_of_gyros(text, kind, size):
    if kind is None:
        with pytest.raises(ValueError, match=r"^units: expected one of deg/s, "):
            gyro_unit(text)
    else:
        assert gyro_unit(text).kind == kind
        assert gyro_unit(text).size == pytest.approx(size, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "kind", "size"),
    [
        *((text, "rates", 1.0) for text in ("m/s^2", "m/s²", "m/s2", "m/s/s", "m/sec2", "m/s**2")),
        *((text, "increments", 9.80665e-6) for text in ("ug*s", "µg·s", "μg s", "ugs")),
        *((text, "rates", 9.80665e-3) for text in ("mg", "milli-g")),
        ("G", "rates", 9.80665),
        *((text, "increments", 9.80665e-3) for text in ("mg*s", "mg s")),
        ("g*s", "increments", 9.80665),
        ("mm/s", "increments", 1e-3),
        ("m/s", "increments", 1.0),
        ("9.80665e-3 m/s", "increments", 9.80665e-3),
    ],
)
def test_units_of_accelerometers(text, kind, size):
    assert accelerometer_unit(text).kind == kind
    assert accelerometer_unit(text).size == pytest.approx(size, rel=1e-15)


def test_units_of_time():
    sizes = {"s": 1.0, "sec": 1.0, "ms": 1e-3, "µs": 1e-6, "us": 1e-6, "ns": 1e-9, "seconds": 1.0}
    assert {text: time_unit(text) for text in sizes} == sizes
    assert not is_unit("x")


def test_spellings_of_a_unit_are_one():
    assert spelled("°/sec") == spelled("dps") == "deg/s"

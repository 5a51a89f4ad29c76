"""Rows of the panel of chapter 13."""

import numpy as np
from scipy.constants import degree, g, hour, milli

from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import align, alignment_attitude_error, alignment_errors
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import conjugate, multiply, rotate, rotation_angle
from driftlab.vectors import wrap_angle

from .values import ABSENT, Rows, Values, listed


def alignment_budget(values: Values) -> Rows:
    angles = np.radians(listed(values, "heading pitch roll"))
    latitude = np.radians(values["latitude"])
    drifts = listed(values, "gyro_forward gyro_up gyro_right") * degree / hour
    offsets = listed(values, "acc_forward acc_up acc_right") * milli * g
    attitude = from_euler_angles(*angles)
    rate, force = static_imu(attitude, latitude)
    true = align(rate, force)
    found = align(rate + drifts, force + offsets, heading_tolerance=np.inf)
    turned = rotation_angle(multiply(found.attitude, conjugate(true.attitude)))
    local = rotate(attitude, drifts), rotate(attitude, offsets)
    # A vertical body has no heading and no roll. Pitch and latitude err alike at any pitch.
    vertical = abs(values["pitch"]) == 90
    formula = alignment_errors(angles[0], 0 if vertical else angles[1], latitude, *local)

    def said(error: float, name: str) -> str:
        hidden = vertical and name in ("heading", "roll")
        return ABSENT if hidden else f"{np.degrees(error):.4f}°"

    def exact(name: str) -> str:
        return said(wrap_angle(getattr(found, name) - getattr(true, name)), name)

    def pair(name: str, first: str, second: str) -> Rows:
        return [(f"{name}: exact", first), (f"{name}: first order", second)]

    terms = (
        "east gyro",
        "east acc., tan pitch",
        "north acc., tan pitch",
        "east acc., tan latitude",
    )
    headline = "no heading" if vertical else exact("heading")
    rows = [("heading error", headline)]
    rows += pair("heading", exact("heading"), said(formula.heading, "heading"))
    for name, term in zip(terms, formula.heading_terms, strict=True):
        rows += pair(f"by {name}", ABSENT, said(term, "heading"))
    for name in ("pitch", "roll", "latitude"):
        rows += pair(name, exact(name), said(getattr(formula, name), name))
    first_order = np.linalg.norm(alignment_attitude_error(latitude, *local))
    return rows + pair("attitude", said(turned, "attitude"), said(first_order, "attitude"))

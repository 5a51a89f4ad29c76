"""Rows of the panels of Part IV."""

from functools import cache

import numpy as np
from scipy.constants import arcminute, arcsecond, degree, g, hour, milli

from driftlab.attitude.coning_algorithms import coning_drift
from driftlab.book.scenarios import ship_manoeuvre
from driftlab.calibration.simulation import TableTrial
from driftlab.drift.systematic_drift import drift_per_turn
from driftlab.drift.turn_calibration import TurnExperiment
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import align, alignment_attitude_error, alignment_errors
from driftlab.gyrocompass.simulation import simulate_compass
from driftlab.imu import NO_ERRORS
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import conjugate, multiply, rotate, rotation_angle
from driftlab.vectors import cross_matrix, wrap_angle

from .values import Rows, Values, listed


def alignment_budget(values: Values) -> Rows:
    angles = np.radians(listed(values, "heading pitch roll"))
    latitude = np.radians(values["latitude"])
    drifts = listed(values, "gyro_forward gyro_up gyro_right") * degree / hour
    offsets = listed(values, "acc_forward acc_up acc_right") * milli * g
    attitude = from_euler_angles(*angles)
    rate, force = static_imu(attitude, latitude)
    true, found = align(rate, force), align(rate + drifts, force + offsets)
    turned = rotation_angle(multiply(found.attitude, conjugate(true.attitude)))
    local = rotate(attitude, drifts), rotate(attitude, offsets)
    # A vertical body has no heading and no roll. Pitch and latitude err alike at any pitch.
    vertical = abs(values["pitch"]) == 90
    formula = alignment_errors(angles[0], 0 if vertical else angles[1], latitude, *local)

    def said(error: float, name: str) -> str:
        hidden = vertical and name in ("heading", "roll")
        return "none" if hidden else f"{np.degrees(error):.4f}°"

    def exact(name: str) -> str:
        return said(wrap_angle(getattr(found, name) - getattr(true, name)), name)

    terms = (
        "east gyro",
        "east acc., tan pitch",
        "north acc., tan pitch",
        "east acc., tan latitude",
    )
    rows = [
        (name, said(term, "heading"))
        for name, term in zip(terms, formula.heading_terms, strict=True)
    ]
    rows += [("sum, first order", said(formula.heading, "heading")), ("exact", exact("heading"))]
    for name in ("pitch", "roll", "latitude"):
        rows.append((f"{name} error, exact", exact(name)))
        rows.append((f"{name} error, first order", said(getattr(formula, name), name)))
    first_order = np.linalg.norm(alignment_attitude_error(latitude, *local))
    rows.append(("attitude error, exact", said(turned, "attitude")))
    rows.append(("attitude error, first order", said(first_order, "attitude")))
    return rows


def gyrocompass(values: Values) -> Rows:
    latitude, course, turn = np.radians(listed(values, "latitude course turn"))
    run = simulate_compass(
        ship_manoeuvre(latitude, values["speed"], course, turn, 4.0),
        listed(values, "gyro_forward gyro_up gyro_right") * degree / hour,
        tuning_factor=values["tuning"],
        damping=values["damping"],
        tilt=values["tilt"] * arcminute,
        log=values["log"],
    )
    north, east = (np.abs(run.tilt[:, i]).max() / arcminute for i in (0, 1))
    gap = f"{np.degrees(np.abs(run.heading_error - run.formula.heading).max()):.4f}°"
    small = max(np.abs([run.yaw_error, run.compass_error]).max(axis=-1)) <= 0.2
    return [
        ("largest heading error", f"{np.degrees(np.abs(run.heading_error).max()):.4f}°"),
        ("at the end", f"{np.degrees(run.heading_error[-1]):.4f}°"),
        ("largest gap to the formula", gap if small else "too large errors for it"),
        ("largest tilt about North", f"{north:.3f}′"),
        ("largest tilt about East", f"{east:.3f}′"),
        ("largest speed error", f"{np.degrees(np.abs(run.speed_error).max()):.4f}°"),
        ("yaw error at the end", f"{np.degrees(run.yaw_error[-1]):.4f}°"),
        ("compass error at the end", f"{np.degrees(run.compass_error[-1]):.4f}°"),
    ]


def capstone(values: Values) -> Rows:
    xy, xz, yz = listed(values, "pair_0 pair_1 pair_2") * arcsecond
    turned = cross_matrix(listed(values, "turn_forward turn_up turn_right") * arcsecond)
    bent = np.array([[0, xy, xz], [xy, 0, yz], [xz, yz, 0]]) + turned
    # One turn about each axis between two of the triad's, each read with noise, shows a pair.
    between = [[1, 1, 0], [1, 0, 1], [0, 1, 1]] / np.sqrt(2)
    noise = np.random.default_rng(11)
    sxy, sxz, syz = TurnExperiment(1, angle_noise=1.8 * arcsecond).estimate(bent, between, noise)
    left = {
        "as built": bent,
        "after turns": bent - [[0, sxy, sxz], [sxy, 0, syz], [sxz, syz, 0]],
        "after the filter": -filter_leftover(),
    }
    axes = np.vstack([np.eye(3), between])
    cone = coning_drift(values["algorithm"], values["cone"] * arcminute, 5.0, 0.01)
    shaken = np.array([0, 0, cone])
    latitude, turn = np.radians(listed(values, "latitude turn"))
    headings = np.radians(np.arange(-180.0, 181.0, 10.0))
    attitude = from_euler_angles(headings, 0.0, 0.0)
    rate, _ = static_imu(attitude, latitude)
    way = ship_manoeuvre(latitude, 10.0, 0.0, turn, 16.0)
    rates = way.increments.mean_rate
    rows = []
    for stage, error in left.items():
        drift_a_turn = np.abs(drift_per_turn(axes, error)).max()
        drifts = rotate(attitude, rate @ error.T + shaken)
        aligned = alignment_errors(headings, 0.0, latitude, drifts, np.zeros(3)).heading
        run = simulate_compass(way, rates @ error.T + shaken, log=True)
        rows += [
            (f"drift in a turn, {stage}", f"{drift_a_turn / arcsecond:.1f}″"),
            (f"aligned heading, {stage}", f"{np.abs(aligned).max() / arcminute:.3f}′"),
            (f"under way, {stage}", f"{np.degrees(np.abs(run.heading_error).max()):.4f}°"),
        ]
    return rows


@cache
def filter_leftover() -> np.ndarray:
    """What the filter leaves in the gyros of the unit with which the panel opens."""
    true = np.array([[0, -30, 20], [-30, 0, 30], [20, 30, 0]]) * arcsecond
    true = true + cross_matrix(np.array([20, 25, 20]) * arcsecond)
    imu_errors = NO_ERRORS._replace(gyro_error=true)
    trial = TableTrial(frame="accelerometers", sample_interval=0.1)
    found = trial.run(np.random.default_rng(11), imu_errors=imu_errors).calibration.imu_errors
    return found.gyro_error - true

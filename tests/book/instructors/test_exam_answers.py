"""What the scheme of the examination calls right is found again by other ways."""

import re
from math import atan, atan2, cos, degrees, hypot, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from exam_numbers import EDITIONS, matrix_in, numbers, question, values

EARTH = 360 / 86164.0905 * 3600
"""Degrees an hour, from the length of the sidereal day."""


@pytest.mark.parametrize("edition", EDITIONS)
def test_error_of_a_turn_by_the_linear_equation(edition):
    found = question(edition, "01")
    before = ("°/s", r"\cdot10^{-4}$ of the", r"\cdot10^{-4}$ of it")
    rate, scale, cross = (numbers(found.given.split(text)[0])[-1] for text in before)
    omega = radians(rate) * np.array([0, 0, 1.0])
    drive = radians(rate) * 1e-4 * np.array([cross, 0, scale])
    period = 2 * pi / radians(rate)
    run = solve_ivp(lambda _, p: drive - np.cross(omega, p), (0, period), np.zeros(3),
                    rtol=1e-9, atol=1e-12, max_step=period / 400)  # fmt: skip
    _, (along,), (across,) = values(found)
    turns = int(re.search(r"after (\d) whole", found.parts[1].asks)[1])
    assert along == pytest.approx(60 * degrees(turns * run.y[2, -1]), rel=2e-3)
    assert across == pytest.approx(60 * degrees(np.hypot(*run.y[:2]).max()), rel=2e-3)


@pytest.mark.parametrize("edition", EDITIONS)
def test_roots_from_the_eigenvalues_of_the_matrix(edition):
    found = question(edition, "02")
    rate = np.array(numbers(re.search(r"omega = \((.*?)\)", found.given)[1]))
    error = matrix_in(found.given) * 1e-3
    size, measured = np.linalg.norm(rate), np.linalg.norm(rate + error @ rate)
    (exact,), (first,), (minutes,) = values(found)
    assert exact == pytest.approx(measured - size)
    assert first == pytest.approx(rate @ error @ rate / size)
    assert abs(first) > 0.003
    assert minutes == pytest.approx(10 / abs(measured - size) / 60)


@pytest.mark.parametrize("edition", EDITIONS)
def test_worst_axis_from_turns_integrated_about_many_axes(edition):
    found = question(edition, "03")
    error = matrix_in(found.given)
    (skew, mean), (oblique,), (largest,) = values(found)
    assert skew == np.abs(error - error.T).max() / 2
    assert np.isclose(np.abs(error + error.T) / 2, abs(mean)).any()
    diagonal = (np.array(numbers(found.parts[1].asks.split("axes")[1])[:2]) - 1).astype(int)
    n = np.eye(3)[diagonal].sum(axis=0) / sqrt(2)
    assert oblique == pytest.approx(2 * pi * n @ error @ n)
    axes = np.random.default_rng(1).normal(size=(40000, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    drifts = 2 * pi * np.einsum("ni,ij,nj->n", axes, error, axes)
    assert largest == pytest.approx(drifts.max(), rel=3e-3)
    assert largest >= drifts.max()


@pytest.mark.parametrize("edition", EDITIONS)
def test_table_on_the_earth_by_hand(edition):
    found = question(edition, "04")
    latitude, _, rate, one, other, _ = numbers(found.given)
    latitude *= -1 if "South" in found.given else 1
    (offset,), (sigma, bias), (deviation,) = values(found)
    upright = EARTH * sin(radians(latitude))
    assert offset == pytest.approx(upright / (3600 * rate) * degrees(1) * 3600, rel=1e-4)
    assert sigma == pytest.approx((one + other) / 2)
    # The estimates, made anew from what was found.
    turning = (bias + upright) / (3600 * rate) * degrees(1) * 3600
    assert [sigma + turning, sigma - turning] == pytest.approx([one, other], abs=0.01)
    assert 3 < abs(bias) < 13
    assert deviation == pytest.approx(numbers(found.parts[2].asks)[0] / sqrt(2))


@pytest.mark.parametrize("edition", EDITIONS)
def test_three_parts_from_a_flight_of_both_boxes(edition):
    found = question(edition, "07")
    error = matrix_in(found.given)
    apart, start, _ = values(found)
    symmetric, skew = (error + error.T) / 2, (error - error.T) / 2
    assert apart[:3] == pytest.approx([symmetric[0, 1], symmetric[0, 2], symmetric[1, 2]])
    kappa = np.array(apart[3:])
    assert skew @ [1, 2, 3] == pytest.approx(np.cross(kappa, [1, 2, 3]))
    names = {"East": [1, 0, 0], "North": [0, 1, 0], "Up": [0, 0, 1]}
    names |= {"West": [-1, 0, 0], "South": [0, -1, 0]}
    said = re.search(r"\$x\$ points (\w+), \$y\$ (\w+), \$z\$ (\w+)", found.parts[1].asks)
    attitude = Rotation.from_matrix(np.array([names[said[i]] for i in (1, 2, 3)]).T)
    second = radians(1 / 3600)
    true = turned = attitude
    # A wrong start: (I - [phi x]) C turns by -phi.
    ideal = Rotation.from_rotvec(-second * np.array(start)) * attitude
    for angle in np.random.default_rng(2).normal(0, 0.1, (40, 3)):
        true, ideal = (each * Rotation.from_rotvec(angle) for each in (true, ideal))
        turned *= Rotation.from_rotvec(angle + np.cross(second * kappa, angle))
    phi_ideal, phi_turned = (-(each * true.inv()).as_rotvec() for each in (ideal, turned))
    assert phi_ideal == pytest.approx(phi_turned - true.apply(second * kappa), abs=0.3 * second)


@pytest.mark.parametrize("edition", EDITIONS)
def test_compass_at_rest_by_hand(edition):
    found = question(edition, "09")
    forward, up, right = numbers(found.given)[:3]
    (heading, latitude), (error,), (minutes,) = values(found)
    level = hypot(forward, right)
    assert heading == pytest.approx(degrees(atan2(right, forward)))
    assert latitude == pytest.approx(degrees(atan2(up, level)))
    drift = numbers(found.parts[1].asks)[0]
    moved = degrees(atan2(right + drift, forward)) - heading
    assert error == pytest.approx(moved, rel=5e-3)
    walk, wanted = numbers(found.parts[2].asks)
    assert degrees(walk / sqrt(minutes / 60) / level) == pytest.approx(wanted)
    assert 1 < minutes < 30


@pytest.mark.parametrize("edition", EDITIONS)
def test_compass_under_way_by_hand(edition):
    found = question(edition, "10")
    latitude, knots = numbers(found.given)[:2]
    gravity = numbers(found.given.split("g = ")[1])[0]
    (size,), (left,), (period, swing) = values(found)
    speed = knots * 1852 / 3600 / sqrt(2)
    east = speed * (1 if "East" in found.given.split(". ")[0] else -1)
    level = radians(EARTH / 3600) * cos(radians(latitude))

    def turned(speed, east):
        return degrees(atan(speed / 6371e3 / (level + east / 6371e3)))

    assert size == pytest.approx(turned(speed, east), rel=1e-3)
    side = "to the West" if "North-" in found.given else "to the East"
    assert side in found.parts[0].works
    wrong = 1 + numbers(found.parts[1].asks)[0] / 100
    assert left == pytest.approx(60 * (turned(wrong * speed, wrong * east) - size), rel=5e-3)
    assert period == pytest.approx(2 * pi * sqrt(6371e3 / gravity) / 60, rel=2e-3)
    tilt = numbers(found.parts[2].asks)[0]
    assert swing == pytest.approx(tilt * sqrt(gravity / 6371e3) / level, rel=2e-3)


@pytest.mark.parametrize("edition", EDITIONS)
def test_cayley_vectors_by_scipy(edition):
    found = question(edition, "05")
    angle, *axis = numbers(found.given)
    (three, four), (shadow, back), (half, whole) = values(found)
    place = int(numbers(found.parts[0].asks)[0]) - 1
    assert three == pytest.approx(-tan(radians(angle / 2)) * axis[place])
    assert four == pytest.approx(-tan(radians(angle / 4)) * axis[place])
    shorter = -Rotation.from_rotvec(angle * np.array(axis), degrees=True).as_mrp()
    assert (shadow if angle > 180 else four) == pytest.approx(shorter[place])
    assert back == angle - 360
    rate = numbers(found.parts[2].asks)[0]
    assert [rate * half, rate * whole] == pytest.approx([180, 360])


@pytest.mark.parametrize("edition", EDITIONS)
def test_coning_step_by_the_formulas(edition):
    found = question(edition, "06")
    first, second = (np.array(numbers(part)) for part in re.findall(r"\((.*?)\)", found.given))
    correction, (drift,), (factor,) = values(found)
    assert correction == pytest.approx(2 / 3 * np.cross(first, second))
    half_angle, frequency, samples = numbers(found.parts[1].asks)[:3]

    def size(samples):
        omega = 2 * pi * frequency
        x = omega / samples
        drift = radians(half_angle) ** 2 / 2 * omega * (1 - sin(x) / x)
        return degrees(drift) * 3600

    assert drift == pytest.approx(size(samples), rel=1e-3)
    assert factor == pytest.approx(size(samples) / size(2 * samples), rel=1e-3)
    assert 3.5 < factor < 4


@pytest.mark.parametrize("edition", EDITIONS)
def test_calibration_step_by_least_squares(edition):
    found = question(edition, "08")
    angle, bias, time, measured, noise = numbers(found.given)
    (deviation, covariance), (at, moved, left), (nis,) = values(found)
    # What is known before and what is measured, as equations in angle and bias at the end.
    equations = np.array([[1 / angle, -time / angle], [0, 1 / bias], [1 / noise, 0]])
    known = np.array([0, 0, measured / noise])
    solution, (residual,), *_ = np.linalg.lstsq(equations, known, rcond=None)
    assert [at, moved] == pytest.approx(solution)
    assert nis == pytest.approx(residual)
    assert left == pytest.approx(sqrt(np.linalg.inv(equations.T @ equations)[1, 1]))
    assert deviation == pytest.approx(hypot(angle, time * bias))
    assert covariance == pytest.approx(time * bias**2)


@pytest.mark.parametrize("edition", EDITIONS)
def test_turned_by_hand_from_both_runs(edition):
    found = question(edition, "13")
    turns, seconds, there, back = numbers(found.given)
    (part, offset), (deviation,), (walk, white) = values(found)
    runs = [sense * 360 * turns * (1 + part) + offset * seconds for sense in (1, -1)]
    assert runs == pytest.approx([there, back])
    stop = numbers(found.parts[1].asks)[0]
    assert deviation == pytest.approx(stop / (360 * turns) / sqrt(2))
    allan, short, long, seen = numbers(found.parts[2].asks)
    assert walk == pytest.approx(allan * sqrt(short / 3600))
    assert white == pytest.approx(allan * sqrt(short / long))
    assert seen > 4 * white

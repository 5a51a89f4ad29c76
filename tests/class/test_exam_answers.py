"""What the scheme of the examination calls right is found again by other ways."""

import re
from math import atan, atan2, cos, degrees, hypot, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from exam_numbers import EDITIONS, asked, matrix_in, numbers, question
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

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
    (across,), _ = asked(found, "the largest error across")
    assert across == pytest.approx(60 * degrees(np.hypot(*run.y[:2]).max()), rel=2e-3)
    a_turn = 60 * degrees(run.y[2, -1])
    if part := asked(found, "the error along the axis"):
        turns = int(re.search(r"after (\d) whole", part[1])[1])
        assert part[0] == pytest.approx([turns * a_turn], rel=2e-3)
    if part := asked(found, "the scale-factor error"):
        allowed, turns = numbers(part[1])
        assert allowed / turns / abs(a_turn) * abs(scale) * 100 == pytest.approx(
            part[0][0], rel=2e-3
        )


@pytest.mark.parametrize("edition", EDITIONS)
def test_roots_from_the_eigenvalues_of_the_matrix(edition):
    found = question(edition, "02")
    rate = np.array(numbers(re.search(r"omega = \((.*?)\)", found.given)[1]))
    error = matrix_in(found.given) * 1e-3
    size, measured = np.linalg.norm(rate), np.linalg.norm(rate + error @ rate)
    (exact,), _ = asked(found, "the difference, exact,")
    assert exact == pytest.approx(measured - size)
    if part := asked(found, "the difference, first order,"):
        assert part[0] == pytest.approx([rate @ error @ rate / size])
        assert abs(part[0][0]) > 0.003
    if part := asked(found, "the time"):
        assert part[0] == pytest.approx([10 / abs(measured - size) / 60])
    place = re.search(r"The entry (\d)\1 of", found.parts[1].asks)
    if place:
        at = int(place[1]) - 1
        error[at, at] = found.parts[1].answers[0].value * 1e-3
        assert rate @ error @ rate == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("edition", EDITIONS)
def test_worst_axis_from_turns_integrated_about_many_axes(edition):
    found = question(edition, "03")
    error = matrix_in(found.given)
    (largest,), _ = asked(found, "the largest drift in one turn")
    axes = np.random.default_rng(1).normal(size=(40000, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    drifts = 2 * pi * np.einsum("ni,ij,nj->n", axes, error, axes)
    assert largest == pytest.approx(drifts.max(), rel=3e-3)
    assert largest >= drifts.max()
    if part := asked(found, "the entry of the skew part, by size,"):
        skew, mean = part[0]
        assert skew == np.abs(error - error.T).max() / 2
        assert np.isclose(np.abs(error + error.T) / 2, abs(mean)).any()
    if part := asked(found, "the drift in one turn"):
        diagonal = (np.array(numbers(part[1].split("axes")[1])[:2]) - 1).astype(int)
        n = np.eye(3)[diagonal].sum(axis=0) / sqrt(2)
        assert part[0] == pytest.approx([2 * pi * n @ error @ n])
    if part := asked(found, "the mean drift in one turn"):
        assert part[0] == pytest.approx([drifts.mean()], abs=4 * drifts.std() / 200)


@pytest.mark.parametrize("edition", EDITIONS)
def test_table_on_the_earth_by_hand(edition):
    found = question(edition, "04")
    latitude, _, rate, one, other, _ = numbers(found.given)
    latitude *= -1 if "South" in found.given else 1
    (sigma, bias), _ = asked(found, r"$n^T\Sigma n$")
    upright = EARTH * sin(radians(latitude))
    offset = upright / (3600 * rate) * degrees(1) * 3600
    assert sigma == pytest.approx((one + other) / 2)
    # The estimates, made anew from what was found.
    turning = (bias + upright) / (3600 * rate) * degrees(1) * 3600
    assert [sigma + turning, sigma - turning] == pytest.approx([one, other], abs=0.01)
    assert 3 < abs(bias) < 13
    if part := asked(found, "the Earth's offset"):
        assert part[0] == pytest.approx([offset], rel=1e-4)
    if part := asked(found, "the standard deviation"):
        assert part[0] == pytest.approx([numbers(part[1])[0] / sqrt(2)])
    if part := asked(found, "the error of one sense alone"):
        assert part[0] == pytest.approx([one - offset - sigma], abs=0.01)


@pytest.mark.parametrize("edition", EDITIONS)
def test_three_parts_from_a_flight_of_both_boxes(edition):
    found = question(edition, "07")
    error = matrix_in(found.given)
    symmetric, skew = (error + error.T) / 2, (error - error.T) / 2
    kappa = np.array([skew[2, 1], skew[0, 2], skew[1, 0]])
    if part := asked(found, "the non-orthogonality $xy$"):
        assert part[0][:3] == pytest.approx([symmetric[0, 1], symmetric[0, 2], symmetric[1, 2]])
        assert skew @ [1, 2, 3] == pytest.approx(np.cross(part[0][3:], [1, 2, 3]))
    if part := asked(found, "the new entry $xy$"):
        left = error - skew
        assert part[0] == pytest.approx([left[0, 1], left[1, 0], left[2, 2]])
    if not (part := asked(found, "the error about East")):
        return
    start, text = part
    names = {"East": [1, 0, 0], "North": [0, 1, 0], "Up": [0, 0, 1]}
    names |= {"West": [-1, 0, 0], "South": [0, -1, 0]}
    said = re.search(r"\$x\$ points (\w+), \$y\$ (\w+), \$z\$ (\w+)", text)
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
    (heading, latitude), _ = asked(found, "the heading")
    level = hypot(forward, right)
    assert heading == pytest.approx(degrees(atan2(right, forward)))
    assert latitude == pytest.approx(degrees(atan2(up, level)))

    def moved(drift):
        return degrees(atan2(right + drift, forward)) - heading

    if part := asked(found, "the error of the heading"):
        assert part[0] == pytest.approx([moved(numbers(part[1])[0])], rel=5e-3)
    if part := asked(found, "the allowed drift"):
        assert abs(moved(part[0][0])) == pytest.approx(numbers(part[1])[0], rel=0.02)
    if part := asked(found, "the time"):
        walk, wanted = numbers(part[1])
        assert degrees(walk / sqrt(part[0][0] / 60) / level) == pytest.approx(wanted)
        assert 1 < part[0][0] < 30


@pytest.mark.parametrize("edition", EDITIONS)
def test_compass_under_way_by_hand(edition):
    found = question(edition, "10")
    latitude, knots = numbers(found.given)[:2]
    gravity = numbers(found.given.split("g = ")[1])[0]
    (size,), _ = asked(found, "the size of the speed error")
    speed = knots * 1852 / 3600 / sqrt(2)
    east = speed * (1 if "East" in found.given.split(". ")[0] else -1)
    level = radians(EARTH / 3600) * cos(radians(latitude))

    def turned(speed, east):
        return degrees(atan(speed / 6371e3 / (level + east / 6371e3)))

    assert size == pytest.approx(turned(speed, east), rel=1e-3)
    side = "to the West" if "North-" in found.given else "to the East"
    assert side in found.parts[0].works
    if part := asked(found, "the error that is left"):
        wrong = 1 + numbers(part[1])[0] / 100
        left = 60 * (turned(wrong * speed, wrong * east) - size)
        assert part[0] == pytest.approx([left], rel=5e-3)
    if part := asked(found, "the period"):
        period, swing = part[0]
        assert period == pytest.approx(2 * pi * sqrt(6371e3 / gravity) / 60, rel=2e-3)
        tilt = numbers(part[1])[0]
        assert swing == pytest.approx(tilt * sqrt(gravity / 6371e3) / level, rel=2e-3)
    if part := asked(found, "the error due North"):
        assert part[0] == pytest.approx([turned(speed * sqrt(2), 0)], rel=1e-3)


@pytest.mark.parametrize("edition", EDITIONS)
def test_cayley_vectors_by_scipy(edition):
    found = question(edition, "05")
    angle, *axis = numbers(found.given.split("Cayley")[0])
    (three, four), text = asked(found, "that of dimension 3")
    place = int(numbers(text)[0]) - 1
    assert three == pytest.approx(-tan(radians(angle / 2)) * axis[place])
    assert four == pytest.approx(-tan(radians(angle / 4)) * axis[place])
    if part := asked(found, "the component of the shadow"):
        shorter = -Rotation.from_rotvec(angle * np.array(axis), degrees=True).as_mrp()
        assert (part[0][0] if angle > 180 else four) == pytest.approx(shorter[place])
        assert part[0][1] == angle - 360
    if part := asked(found, "dimension 3"):
        assert [numbers(part[1])[0] * time for time in part[0]] == pytest.approx([180, 360])
    if part := asked(found, "the angle"):
        length = numbers(part[1])[1]
        vector = -Rotation.from_rotvec([0, 0, part[0][0]], degrees=True).as_mrp()
        assert vector == pytest.approx([0, 0, length])


@pytest.mark.parametrize("edition", EDITIONS)
def test_coning_step_by_the_formulas(edition):
    found = question(edition, "06")
    rows = re.findall(r"\((.*?)\)", found.given.split("In (b)")[0])
    first, second = (np.array(numbers(row)) for row in rows)
    correction, _ = asked(found, "component 1")
    assert correction == pytest.approx(2 / 3 * np.cross(first, second))
    half_angle, frequency, samples = numbers(found.given.split("In (b)")[1])[:3]

    def size(samples, half_angle=half_angle):
        omega = 2 * pi * frequency
        x = omega / samples
        drift = radians(half_angle) ** 2 / 2 * omega * (1 - sin(x) / x)
        return degrees(drift) * 3600

    if part := asked(found, "the drift, by size,"):
        assert part[0] == pytest.approx([size(samples)], rel=1e-3)
    if part := asked(found, "the factor"):
        assert part[0] == pytest.approx([size(samples) / size(2 * samples)], rel=1e-3)
        assert 3.5 < part[0][0] < 4
    if part := asked(found, "the half angle"):
        assert size(samples, part[0][0]) == pytest.approx(numbers(part[1])[0], rel=1e-3)


@pytest.mark.parametrize("edition", EDITIONS)
def test_calibration_step_by_least_squares(edition):
    found = question(edition, "08")
    angle, bias, time, measured, noise = numbers(found.given)
    (at, moved, left), _ = asked(found, "the angle")

    def solved(time):
        """What is known before and what is measured, as equations in angle and bias at the end."""
        equations = np.array([[1 / angle, -time / angle], [0, 1 / bias], [1 / noise, 0]])
        solution, residual, *_ = np.linalg.lstsq(equations, [0, 0, measured / noise], rcond=None)
        return solution, residual, sqrt(np.linalg.inv(equations.T @ equations)[1, 1])

    solution, residual, deviation = solved(time)
    assert [at, moved] == pytest.approx(solution)
    assert left == pytest.approx(deviation)
    if part := asked(found, "the NIS"):
        assert part[0] == pytest.approx(residual)
    if part := asked(found, "the deviation of the angle"):
        assert part[0] == pytest.approx([hypot(angle, time * bias), time * bias**2])
    if part := asked(found, "the deviation of the bias, later,"):
        assert part[0] == pytest.approx([solved(numbers(part[1])[0])[2]])
        assert part[0][0] < left


@pytest.mark.parametrize("edition", EDITIONS)
def test_turned_by_hand_from_both_runs(edition):
    found = question(edition, "13")
    turns, seconds, there, back = numbers(found.given)
    (part, offset), _ = asked(found, "Larin's number")
    runs = [sense * 360 * turns * (1 + part) + offset * seconds for sense in (1, -1)]
    assert runs == pytest.approx([there, back])
    if part := asked(found, "the standard deviation"):
        assert part[0] == pytest.approx([numbers(part[1])[0] / (360 * turns) / sqrt(2)])
    if part := asked(found, "the turns, before rounding up,"):
        stop, wanted = numbers(part[1])
        assert stop / (360 * part[0][0]) / sqrt(2) == pytest.approx(wanted)
    if part := asked(found, "the angle random walk"):
        allan, short, long, seen = numbers(part[1])
        walk, white = part[0]
        assert walk == pytest.approx(allan * sqrt(short / 3600))
        assert white == pytest.approx(allan * sqrt(short / long))
        assert seen > 4 * white

"""What the scheme of the examination calls right is found again by other ways."""

import re
from math import acos, atan, atan2, cos, degrees, hypot, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from exam_numbers import EDITIONS, asked, matrix_in, numbers, powers, question
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

EARTH = 360 / 86164.0905 * 3600
"""Degrees an hour, from the length of the sidereal day."""


@pytest.mark.parametrize("edition", EDITIONS)
def test_error_of_a_turn_by_the_linear_equation(edition):
    found = question(edition, "01")
    rate, (scale, cross) = numbers(found.given)[0], numbers(" ".join(powers(found.given)))
    omega = radians(rate) * np.array([0, 0, 1.0])
    drive = radians(rate) * 1e-4 * np.array([cross, 0, scale])
    period = 2 * pi / radians(rate)
    run = solve_ivp(lambda _, p: drive - np.cross(omega, p), (0, period), np.zeros(3),
                    rtol=1e-9, atol=1e-12, max_step=period / 400, dense_output=True)  # fmt: skip
    largest = 60 * degrees(np.hypot(*run.y[:2]).max())
    a_turn = 60 * degrees(run.y[2, -1])
    if part := asked(found, "the largest perpendicular error"):
        assert part[0] == pytest.approx([largest], rel=2e-3)
    if part := asked(found, "the perpendicular error"):
        stopped = run.sol(numbers(part[1])[0] / 360 * period)
        assert part[0] == pytest.approx([60 * degrees(np.hypot(*stopped[:2]))], rel=2e-3)
    if part := asked(found, "the cross-coupling"):
        allowed = numbers(part[1])[0]
        assert part[0] == pytest.approx([100 * cross * allowed / largest], rel=2e-3)
    if part := asked(found, "the error along the axis"):
        assert part[0] == pytest.approx([numbers(part[1])[0] * a_turn], rel=2e-3)
    if part := asked(found, "the scale-factor error"):
        allowed, turns = numbers(part[1])
        assert part[0] == pytest.approx([100 * abs(scale / a_turn) * allowed / turns], rel=2e-3)


@pytest.mark.parametrize("edition", EDITIONS)
def test_roots_from_the_eigenvalues_of_the_matrix(edition):
    found = question(edition, "02")
    rate = np.array(numbers(re.search(r"omega = \((.*?)\)", found.given)[1]))
    error = matrix_in(found.given) * 1e-3
    size, measured = np.linalg.norm(rate), np.linalg.norm(rate + error @ rate)
    if part := asked(found, "the exact difference"):
        assert part[0] == pytest.approx([measured - size])
    if part := asked(found, "the excess of the angle"):
        assert part[0] == pytest.approx([60 * (measured * 360 / size - 360)])
    if part := asked(found, "$s - 1$"):
        factor = 1 + 1e-6 * part[0][0]
        assert np.linalg.norm(factor * (rate + error @ rate)) == pytest.approx(size, rel=1e-12)
    if part := asked(found, "the difference to first order"):
        assert part[0] == pytest.approx([rate @ error @ rate / size])
        assert abs(part[0][0]) > 0.003
    if part := asked(found, "the time"):
        assert part[0] == pytest.approx([10 / abs(measured - size) / 60])
    if place := re.search(r"The entry (\d)\1 of", found.parts[1].asks):
        at = int(place[1]) - 1
        error[at, at] = found.parts[1].answers[0].value * 1e-3
        assert rate @ error @ rate == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("edition", EDITIONS)
def test_worst_axis_from_drifts_about_many_axes(edition):
    found = question(edition, "03")
    error = matrix_in(found.given)
    axes = np.random.default_rng(1).normal(size=(40000, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    drifts = 2 * pi * np.einsum("ni,ij,nj->n", axes, error, axes)

    def about(axis):
        n = axis / np.linalg.norm(axis)
        return [pytest.approx(2 * pi * n @ error @ n)]

    def named(text):
        return [np.eye(3)[int(n) - 1] for n in numbers(text.split("of axes")[1])[:2]]

    if part := asked(found, "the largest drift per turn"):
        assert part[0] == pytest.approx([drifts.max()], rel=3e-3)
        assert part[0][0] >= drifts.max()
    if (task := found.parts[0]).answers[0].name.startswith("the angle from axis"):
        one, other = named(task.asks)
        tilt = radians(task.answers[0].value)
        assert [numbers(task.asks)[-1]] == about(cos(tilt) * one + sin(tilt) * other)
    if part := asked(found, "the drift about the bisector"):
        one, other = named(part[1])
        assert part[0] == about(one + other)
        assert [one @ error @ one, other @ error @ other] == [0, 0]
    if part := asked(found, "the skew entry, by magnitude,"):
        skew, mean = part[0]
        assert skew == np.abs(error - error.T).max() / 2
        assert np.isclose(np.abs(error + error.T) / 2, abs(mean)).any()
    if part := asked(found, "the drift about the diagonal"):
        assert part[0] == about(np.ones(3))
    if part := asked(found, "the average drift per turn"):
        assert part[0] == pytest.approx([drifts.mean()], abs=4 * drifts.std() / 200)


@pytest.mark.parametrize("edition", EDITIONS)
def test_table_on_the_earth_by_hand(edition):
    found = question(edition, "05")
    latitude, _, rate, one, other, _ = numbers(found.given)
    latitude *= -1 if "South" in found.given else 1
    upright = EARTH * sin(radians(latitude))

    def estimates(sigma, first, second, rate=rate):
        """What runs in both directions give with these biases in degrees an hour."""
        turned = [degrees(1) * (upright + bias) / rate for bias in (first, second)]
        return pytest.approx([sigma + turned[0], sigma - turned[1]], abs=0.01)

    mean, bias = (one + other) / 2, (one - other) / 2 * radians(rate) - upright
    assert 3 < abs(bias) < 13
    assert [one, other] == estimates(mean, bias, bias)
    if part := asked(found, r"$n^T\Sigma n$"):
        assert part[0] == pytest.approx([mean, bias], rel=1e-3)
    if part := asked(found, "counter-clockwise"):
        assert part[0] == estimates(mean, bias, bias, numbers(part[1])[0])
    if part := asked(found, r"$n^T\Sigma n$, after the change of bias,"):
        change = numbers(part[1])[0]
        first = (one - part[0][0]) * radians(rate) - upright
        assert [one, other] == estimates(part[0][0], first, first + change)
    if part := asked(found, "the contribution of the Earth"):
        assert part[0] == pytest.approx([degrees(1) * upright / rate], rel=1e-4)
    if part := asked(found, "the standard deviation"):
        assert part[0] == pytest.approx([numbers(part[1])[0] / sqrt(2)])
    if part := asked(found, "the error of one direction"):
        assert part[0] == pytest.approx([degrees(1) * bias / rate], abs=0.01)


@pytest.mark.parametrize("edition", EDITIONS)
def test_three_parts_from_a_flight_of_both_boxes(edition):
    found = question(edition, "10")
    error = matrix_in(found.given)
    symmetric, skew = (error + error.T) / 2, (error - error.T) / 2
    kappa = np.array([skew[2, 1], skew[0, 2], skew[1, 0]])
    if part := asked(found, "gyros minus accelerometers, $x$"):
        values = np.array(numbers(part[1])).reshape(2, 3)
        assert part[0] == pytest.approx(values[0] - values[1])
    if part := asked(found, "the remaining standard deviation"):
        before = np.eye(2) * numbers(part[1])[0] ** 2
        exact = np.linalg.inv(np.linalg.inv(before) + 1e4 * np.array([[1, -1], [-1, 1]]))
        assert part[0] == pytest.approx([sqrt(exact[0, 0])], rel=1e-6)
    if part := asked(found, "the non-orthogonality $xy$"):
        assert part[0][:3] == pytest.approx([symmetric[0, 1], symmetric[0, 2], symmetric[1, 2]])
        assert skew @ [1, 2, 3] == pytest.approx(np.cross(part[0][3:], [1, 2, 3]))
    if part := asked(found, "the new entry $xy$"):
        left = error - skew
        assert part[0] == pytest.approx([left[0, 1], left[2, 2]])
        assert left[0, 1] == left[1, 0]
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
    found = question(edition, "13")
    forward, up, right = numbers(found.given)[:3]
    level, heading = hypot(forward, right), degrees(atan2(right, forward))

    def moved(drift):
        return degrees(atan2(right + drift, forward)) - heading

    if part := asked(found, "the heading"):
        assert part[0] == pytest.approx([heading, degrees(atan2(up, level))])
    if part := asked(found, "the new reading of the forward gyro"):
        turned = complex(forward, right) * np.exp(1j * radians(numbers(part[1])[0]))
        assert part[0] == pytest.approx([turned.real, turned.imag])
        assert min(map(abs, part[0])) > 0.1 * level
    if part := asked(found, "the latitude without the up gyro"):
        assert part[0] == pytest.approx([degrees(acos(level / EARTH)), heading], rel=1e-4)
        assert part[0][0] == pytest.approx(degrees(atan2(up, level)), abs=0.1)
    if part := asked(found, "the heading error"):
        assert part[0] == pytest.approx([moved(numbers(part[1])[0])], rel=5e-3)
    if part := asked(found, "the largest drift"):
        assert abs(moved(part[0][0])) == pytest.approx(numbers(part[1])[0], rel=0.02)
    if part := asked(found, "the time"):
        walk, wanted = numbers(part[1])
        assert degrees(walk / sqrt(part[0][0] / 60) / level) == pytest.approx(wanted)
        assert 1 < part[0][0] < 30


@pytest.mark.parametrize("edition", EDITIONS)
def test_compass_under_way_by_hand(edition):
    found = question(edition, "14")
    latitude, knots = numbers(found.given)[:2]
    gravity = numbers(found.given.split("g = ")[1])[0]
    diagonal = sqrt(0.5)
    across = diagonal if "East" in found.given.split(". ")[0] else -diagonal

    def turned(knots, latitude=latitude, east=across, north=diagonal):
        speed = knots * 1852 / 3600
        level = radians(EARTH / 3600) * cos(radians(latitude))
        return degrees(atan(speed * north / 6371e3 / (level + east * speed / 6371e3)))

    size = turned(knots)
    side = f"to the {'West' if 'North-' in found.given else 'East'} of true North"
    assert (side in found.parts[0].works) == ("which side" in found.parts[0].asks)
    if part := asked(found, "the speed error, by magnitude,"):
        assert part[0] == pytest.approx([size], rel=1e-3)
    if part := asked(found, "the other latitude"):
        assert turned(knots, part[0][0]) == pytest.approx(numbers(part[1])[0], rel=1e-3)
        assert 50 < part[0][0] < 75
    if part := asked(found, "the speed"):
        assert turned(part[0][0]) == pytest.approx(numbers(part[1])[0], rel=1e-3)
    if part := asked(found, "the remaining error"):
        left = 60 * (turned((1 + numbers(part[1])[1] / 100) * knots) - size)
        assert part[0] == pytest.approx([left], rel=5e-3)
    if part := asked(found, "the period"):
        period, swing = part[0]
        assert period == pytest.approx(2 * pi * sqrt(6371e3 / gravity) / 60, rel=2e-3)
        level = radians(EARTH / 3600) * cos(radians(latitude))
        tilt = numbers(part[1])[0]
        assert swing == pytest.approx(tilt * sqrt(gravity / 6371e3) / level, rel=2e-3)
    if part := asked(found, "the speed error due North"):
        assert part[0] == pytest.approx([turned(knots, east=0, north=1)], rel=1e-3)


@pytest.mark.parametrize("edition", EDITIONS)
def test_cayley_vectors_by_scipy(edition):
    found = question(edition, "06")
    angle, *axis = numbers(found.given.split("The Cayley")[0])
    place = re.search(r"component (\d)", " ".join(part.asks for part in found.parts))
    place = int(place[1]) - 1 if place else 0

    def both(angle):
        return pytest.approx([-tan(radians(angle / part)) * axis[place] for part in (2, 4)])

    if part := asked(found, "in dimension 3"):
        assert part[0] == both(angle)
    if part := asked(found, "in dimension 3, after both rotations,"):
        assert part[0] == both(angle + numbers(part[1])[0])
    if part := asked(found, "the factor"):
        length = numbers(part[1])[0]
        assert part[0] == pytest.approx([-tan(-2 * atan(length) / 4)])
    if part := asked(found, "the component of the shadow"):
        other = -tan(radians((angle - 360) / 4)) * axis[place]
        assert part[0] == pytest.approx([other, angle - 360])
    if part := asked(found, "the time in dimension 3"):
        assert [numbers(part[1])[0] * time for time in part[0]] == pytest.approx([180, 360])
    if part := asked(found, "the angle"):
        length = numbers(part[1])[0]
        vector = -Rotation.from_rotvec([0, 0, part[0][0]], degrees=True).as_mrp()
        assert vector == pytest.approx([0, 0, length])


@pytest.mark.parametrize("edition", EDITIONS)
def test_coning_step_by_the_formulas(edition):
    found = question(edition, "07")
    rows = re.findall(r"\((.*?)\)", found.given.split("In (b)")[0])
    first, second = (np.array(numbers(row)) for row in rows)
    correction = 2 / 3 * np.cross(first, second)
    half_angle, frequency, samples = numbers(found.given.split("In (b)")[1])[:3]

    def size(samples, half_angle=half_angle):
        omega = 2 * pi * frequency
        x = omega / samples
        drift = radians(half_angle) ** 2 / 2 * omega * (1 - sin(x) / x)
        return degrees(drift) * 3600

    if part := asked(found, "component 1"):
        assert part[0] == pytest.approx(correction)
    if part := asked(found, "the angle"):
        angle = 3600 * degrees(1e-4 * np.linalg.norm(correction))
        assert part[0] == pytest.approx([angle])
    if part := asked(found, "component 1 of the difference"):
        assert part[0] == pytest.approx(correction - 2 / 3 * np.cross(second, first))
    if part := asked(found, "the drift, by magnitude,"):
        assert part[0] == pytest.approx([size(samples)], rel=1e-3)
    if part := asked(found, "the factor"):
        assert part[0] == pytest.approx([size(samples) / size(2 * samples)], rel=1e-3)
        assert 3.5 < part[0][0] < 4
    if part := asked(found, "the half angle"):
        assert size(samples, part[0][0]) == pytest.approx(numbers(part[1])[0], rel=1e-3)


@pytest.mark.parametrize("edition", EDITIONS)
def test_calibration_step_by_least_squares(edition):
    found = question(edition, "11")
    angle, bias, time, measured, noise = numbers(found.given)

    def solved(time, measured=measured, noise=noise):
        """What is known before and what is measured, as equations in angle and bias at the end."""
        equations = np.array([[1 / angle, -time / angle], [0, 1 / bias], [1 / noise, 0]])
        solution, residual, *_ = np.linalg.lstsq(equations, [0, 0, measured / noise], rcond=None)
        return solution, residual, np.sqrt(np.diag(np.linalg.inv(equations.T @ equations)))

    solution, residual, deviation = solved(time)
    if part := asked(found, "the angle"):
        assert part[0] == pytest.approx([*solution, deviation[1]])
    if part := asked(found, "the gain of the angle"):
        assert part[0] == pytest.approx([*solved(time, measured=1)[0], deviation[0]])
    if part := asked(found, "the standard deviation needed"):
        wanted = numbers(part[1])[1]
        assert solved(time, noise=part[0][0])[2][1] == pytest.approx(wanted)
    if part := asked(found, "the NIS"):
        assert part[0] == pytest.approx(residual)
    if part := asked(found, "the standard deviation before"):
        assert part[0] == pytest.approx([hypot(angle, time * bias), time * bias**2])
    if part := asked(found, "the later standard deviation of the bias"):
        assert part[0] == pytest.approx([solved(numbers(part[1])[0])[2][1]])
        assert part[0][0] < deviation[1]


@pytest.mark.parametrize("edition", EDITIONS)
def test_turned_by_hand_from_both_runs(edition):
    found = question(edition, "17")
    turns, seconds, there, back = numbers(found.given)
    known = np.linalg.solve([[360 * turns, seconds], [-360 * turns, seconds]], [there, back])
    if part := asked(found, "Larin's number"):
        assert part[0] == pytest.approx([known[0] - 1, known[1]])
    if part := asked(found, "the predicted angle"):
        more, longer = numbers(part[1])
        assert part[0] == pytest.approx([360 * more * known[0] + longer * known[1]])
    if part := asked(found, "Larin's number, with the rest,"):
        rest, during = numbers(part[1])
        assert 360 * turns * (1 + part[0][0]) + seconds * rest / during == pytest.approx(there)
        assert part[0][0] == pytest.approx(known[0] - 1, abs=0.1 / (360 * turns))
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

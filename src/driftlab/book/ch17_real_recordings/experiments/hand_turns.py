"""Larin's estimate from a sensor that a hand has turned once about each of its axes."""

from typing import NamedTuple

import numpy as np
from numpy.linalg import inv, norm

from driftlab.attitude.integration import integrate
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, positive_number
from driftlab.core.quaternion import rotate, to_rotation_vector
from driftlab.drift.recorded_turns import recorded_turn_estimate
from driftlab.drift.turn_calibration import earth_rate_offset
from driftlab.recordings.publishers import ferraris_sections, published
from driftlab.recordings.recording import Recording
from driftlab.recordings.static_detection import static_intervals

from .force_and_gravity import force_and_gravity

TURNS = ("x_rot", "y_rot", "z_rot")
SIDES = ("x_p", "x_a", "y_p", "y_a", "z_p", "z_a")
SOURCES = ("stop, assumed", "axis", "gyro bias", "gyro noise", "Earth")
"""Where the error of an estimate may come from."""
ROWS = (*SOURCES, "in quadrature", "Larin, another cut", "Larin − Ferraris")
"""By how much an estimate may move, or does."""
ESTIMATES = ("Larin, whole turn", "Larin, cut as theirs", "Ferraris", "Larin, bias left in")
"""Ways to estimate, of which the first has a standard deviation."""
POINTS = 81
"""Of a path, both ends included."""
STOP = float(np.radians(0.1))
"""How exactly a hand comes back to the heading where it began, rad: assumed in the book."""
_BESIDE = 0.5
"""Seconds of rest just before a turn that tell where gravity is."""


class _RestMeans(NamedTuple):
    """What the six rests of the session say of the sensors."""

    gyro_bias: FloatArray  # (3,), mean over all rests, rad/s
    bias_scatter: FloatArray  # (3,), standard deviation of the means of the six, rad/s
    gyro_noise: FloatArray  # (3,), standard deviation of a sample, rad/s
    force: FloatArray  # (6, 3), mean of the accelerometers in each rest, m/s^2
    gyro: FloatArray  # (6, 3), mean of the gyros, rad/s

    @property
    def force_bias(self) -> FloatArray:
        """Gravity in six opposite directions adds up to nothing; what is left is the bias."""
        return self.force.mean(axis=0)


def hand_turns(stop_standard_deviation: float = STOP) -> DataTable:
    """Turn estimates of the Ferraris session, a turn about each axis.

    All of it is of turns from rest to rest, but for what says of the publishers' sections. These
    end sooner, in one turn while the hand is still at work. `stop_standard_deviation` is that of
    the heading to which the hand comes back: assumed, no sensor sees it.
    """
    stop_standard_deviation = positive_number(stop_standard_deviation, "stop_standard_deviation")
    log, rows = published("ferraris-session", download=False), ferraris_sections(download=False)
    rests = _rests(log, [slice(*rows[side]) for side in SIDES])
    stops = static_intervals(log).rows
    turns = [_turn(log, axis, rows[name], stops, rests) for axis, name in enumerate(TURNS)]
    found = {field: np.array([turn[field] for turn in turns]) for field in turns[0]}
    gravity, duration, integral = found["gravity"], found["duration"], found["integral"]
    # The triad, a column a turn, shows what a turn about gravity would read instead of one about n.
    triad = integral.T / np.copysign(2 * np.pi, np.diag(integral))
    axis = np.einsum("ki,ij,kj->k", gravity, triad, gravity) - np.diag(triad)
    stop = np.full(3, stop_standard_deviation / (2 * np.pi))
    walk = rests.gyro_noise * np.sqrt(log.interval * duration) / (2 * np.pi)
    # An axis along the Earth's own, wherever that was: no turn can show more.
    earth = earth_rate_offset(np.pi / 4, 2 * np.pi / duration, (0.0, 1.0, 1.0))
    bias = rests.bias_scatter * duration / (2 * np.pi)
    sources = np.stack([stop, np.abs(axis), bias, walk, earth], axis=1)
    deviation, ferraris = norm(sources, axis=1), _ferraris_diagonal(log, rows, rests)
    moved = np.abs([found["estimate"] - found["by_sections"], found["by_sections"] - ferraris])
    path, added = found["path"], found["added"]
    next_axis, axis_after = "about the next axis", "about the one after it"
    return DataTable(
        {
            "turn": ([name for name in "xyz" for _ in range(POINTS)], "", "axis of the turn"),
            "tilt_next_axis": (path[..., 0].ravel(), "deg", f"tilt of the axis {next_axis}"),
            "added_next_axis": (added[..., 0].ravel(), "deg", "the same by angles added up"),
            "tilt_axis_after": (path[..., 1].ravel(), "deg", f"tilt of the axis {axis_after}"),
            "added_axis_after": (added[..., 1].ravel(), "deg", "the same by angles added up"),
            "error_by_source": (ROWS, "", "source of an error"),
            "part_of_a_turn": (
                np.stack([*sources.T, deviation, *moved], axis=1), "", "size of this error",
                ["turn about x", "turn about y", "turn about z"],
            ),
        },
        {
            "estimate": (found["estimate"], "", "Larin's (3.3), n^T Sigma n, gyro bias taken off"),
            "deviation": (deviation, "", "its standard deviation"),
            "by_sections": (found["by_sections"], "", "estimate from the publishers' sections"),
            "with_bias": (found["with_bias"], "", "estimate with the gyro bias left in"),
            # Of the Earth the most that it can do.
            "sources": (sources, "", "deviations of each turn, by source"),
            "ferraris": (ferraris, "", "Ferraris's diagonal minus one, from the sections"),
            "integral": (integral, "rad", "sums of the gyros' angles, of each turn"),
            "error": (found["error"], "rad", "rotation vector by the gyros after each turn"),
            "duration": (duration, "s", "from rest to rest"),
            "stop_standard_deviation": (
                stop_standard_deviation, "deg", "deviation of the final heading, assumed"
            ),
            "added_up": (np.abs(added[:, -1]).max(), "deg", "largest sum across the axis"),
            "come_back": (np.abs(path[:, -1]).max(), "deg", "largest rotation across the axis"),
        },
    )  # fmt: skip


def _rests(log: Recording, parts: list[slice]) -> _RestMeans:
    force, _ = force_and_gravity(log)
    means = np.array([log.gyro[rows].mean(axis=0) for rows in parts])
    return _RestMeans(
        np.concatenate([log.gyro[rows] for rows in parts]).mean(axis=0),
        means.std(axis=0, ddof=1),
        np.sqrt(np.mean([log.gyro[rows].var(axis=0, ddof=1) for rows in parts], axis=0)),
        np.array([force[rows].mean(axis=0) for rows in parts]),
        means,
    )


def _turn(
    log: Recording,
    axis: int,
    section: tuple[int, int],
    stops: list[tuple[int, int]],
    rests: _RestMeans,
) -> dict[str, FloatArray]:
    """What one turn about a body axis gives, by name."""
    begin = max(last for _, last in stops if last <= section[0])
    end = min(first for first, _ in stops if first >= section[1])
    cut = slice(section[0] - begin, section[1] - begin)
    n, across = np.eye(3)[axis], [(axis + 1) % 3, (axis + 2) % 3]
    raw = log.part(begin, end).angles()
    angles = raw - rests.gyro_bias * log.interval
    attitude = integrate(angles, "functional-iteration")
    tilts = np.cross(n, rotate(attitude, n))[:, across]
    force, beside = force_and_gravity(log)[0], round(_BESIDE / log.interval)
    before = force[begin - beside : begin].mean(axis=0) - rests.force_bias
    shown = np.linspace(0, len(angles) - 1, POINTS).round().astype(int)
    return {
        "estimate": recorded_turn_estimate(angles, n),
        "by_sections": recorded_turn_estimate(angles[cut], n),
        "with_bias": recorded_turn_estimate(raw, n),
        "integral": angles.sum(axis=0),
        "error": to_rotation_vector(attitude[-1]),
        "duration": np.array(len(angles) * log.interval),
        "path": tilts[shown],
        "added": np.cumsum(angles, axis=0)[shown][:, across],
        "gravity": before / norm(before),
    }


def _ferraris_diagonal(
    log: Recording, rows: dict[str, tuple[int, int]], rests: _RestMeans
) -> FloatArray:
    """Diagonal minus one of Ferraris's gyro matrix, as imucal 2.6.0 computes it: its K times R.

    The accelerometers, calibrated by the six rests, take gravity's effect off the gyros.
    """
    all_force, gravity = force_and_gravity(log)
    up, down = slice(0, None, 2), slice(1, None, 2)
    force_triad = (rests.force[up] - rests.force[down]).T / (2 * gravity)
    by_force = (rests.gyro[up] - rests.gyro[down]).T / (2 * gravity)
    columns = []
    for turn in (slice(*rows[name]) for name in TURNS):
        force = (all_force[turn] - rests.force_bias) @ inv(force_triad).T
        rate = log.gyro[turn] - rests.gyro_bias - force @ by_force.T
        columns.append(rate.sum(axis=0) * log.interval / (-2 * np.pi))
    diagonal: FloatArray = np.diag(columns) - 1
    return diagonal


def hand_estimates(stop_standard_deviation: float = STOP) -> DataTable:
    """Estimates by `hand_turns` beside each other; the deviation is that of the whole turn."""
    hand = hand_turns(stop_standard_deviation)
    found = np.stack([hand.estimate, hand.by_sections, hand.ferraris, hand.with_bias], axis=1)
    reach = np.outer(hand.deviation, [1.0, 0.0, 0.0, 0.0])
    turns = [f"turn about {axis}" for axis in "xyz"]
    return DataTable(
        {
            "way": (ESTIMATES, "", "to estimate"),
            "scale_error": (found, "1e-3", "scale-factor error", turns),
            "low": (found - reach, "1e-3", "one standard deviation less", turns),
            "high": (found + reach, "1e-3", "one standard deviation more", turns),
        }
    )

"""One bent triad through all four papers: drift per turn, two calibrations, and the heading."""

from functools import cache
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike
from scipy.constants import arcsecond, minute

from driftlab.attitude.coning_algorithms import coning_drift
from driftlab.book.machinery.picture import BLACK, SERIES, Picture
from driftlab.book.scenarios import SARATOV_LATITUDE as LATITUDE
from driftlab.book.scenarios import ship
from driftlab.calibration.simulation import TableTrial
from driftlab.checks import FloatArray, finite_array, finite_number
from driftlab.drift.systematic_drift import drift_per_turn
from driftlab.drift.turn_calibration import PAIR_AXES, TurnExperiment
from driftlab.frames import attitude_from_angles
from driftlab.gyrocompass.alignment import alignment_errors
from driftlab.gyrocompass.simulation import ErrorsUnderWay, take_along
from driftlab.imu import PERFECT
from driftlab.motion.vehicle import sensed_at_rest
from driftlab.quaternion import rotate
from driftlab.triad import misalignment_vector, split
from driftlab.vectors import cross_matrix

STAGES = ("as built", "after turns", "after the filter")
NON_ORTHOGONALITY: FloatArray = np.array([-30.0, 20.0, 30.0]) * arcsecond
MISALIGNMENT: FloatArray = np.array([20.0, 25.0, 20.0]) * arcsecond
AXES: FloatArray = np.vstack([np.eye(3), PAIR_AXES])
"""Axes of the drift per turn: forward, up, right, and between each two."""
AXIS_NAMES = ("f", "u", "r", "f+u", "f+r", "u+r")
TURNS = TurnExperiment(turns=1, angle_noise=1.8 * arcsecond)
"""Larin's test: a turn about each pair axis, with noise of 0.005 deg/sqrt(h) for 36 s."""
CONING_FREQUENCY, SAMPLE_INTERVAL = 5.0, 0.01
"""Of the shaking mount, Hz, and of the increments, s."""
INTERVAL = 16.0
"""Step of the voyage, s."""
SEED = 11


class Capstone(NamedTuple):
    """What is left of one triad at three stages, and what it does."""

    known: FloatArray  # (3, 6), rad: true errors, found by turns, found by the filter
    per_turn: FloatArray  # (3, 6), rad: drift per turn about AXES
    headings: FloatArray  # (n,), rad
    aligned: FloatArray  # (3, n), rad: heading error after alignment
    under_way: ErrorsUnderWay  # of three runs


def bent_triad(non_orthogonality: ArrayLike, misalignment: ArrayLike) -> FloatArray:
    """Error matrix (3, 3) of gyros from its symmetric pairs xy, xz, yz and its turn, (3,) each.

    A pair is the entry of the symmetric part: half of what the two axes miss of a right angle.
    """
    xy, xz, yz = finite_array(non_orthogonality, "non_orthogonality", 3)
    symmetric = np.array([[0.0, xy, xz], [xy, 0.0, yz], [xz, yz, 0.0]])
    return symmetric + cross_matrix(finite_array(misalignment, "misalignment", 3))


def parts(matrix: FloatArray) -> FloatArray:
    """Pairs xy, xz, yz and turn about x, y, z: six numbers of an error matrix (3, 3)."""
    pairs = split(matrix).non_orthogonality[[0, 0, 1], [1, 2, 2]]
    return np.append(pairs, misalignment_vector(matrix))


@cache
def filter_leftover() -> FloatArray:
    """What one real calibration of the default triad leaves, (3, 3): found minus true.

    The filter works in axes that the accelerometers fix, so it finds how the gyros stand to them.
    The noise it leaves does not depend on the bend to first order, so other bends get the same.
    """
    true = bent_triad(NON_ORTHOGONALITY, MISALIGNMENT)
    unit = PERFECT._replace(gyro_error=true)
    trial = TableTrial(frame="accelerometers", sample_interval=0.1).run(
        np.random.default_rng(SEED), unit=unit
    )
    leftover: FloatArray = trial.calibration.unit.gyro_error - true
    leftover.setflags(write=False)
    return leftover


def found_by_turns(bent: FloatArray) -> FloatArray:
    """Symmetric pairs xy, xz, yz (3,) that one turn about each pair axis shows."""
    return TURNS.estimate(bent, PAIR_AXES, np.random.default_rng(SEED))


def compute(
    non_orthogonality: ArrayLike = NON_ORTHOGONALITY,
    misalignment: ArrayLike = MISALIGNMENT,
    latitude: float = LATITUDE,
    turn: float = float(np.radians(90.0)),
    speed: float = 10.0,
    half_angle: float = 0.0,
    algorithm: str = "two-step-4",
) -> Capstone:
    """Follow a triad all the way.

    Errors of the triad in rad; `turn` of the ship in rad; `half_angle` of a coning of the mount
    about the right axis, rad, of which the attitude `algorithm` makes a drift.
    """
    bent = bent_triad(non_orthogonality, misalignment)
    sigma = found_by_turns(bent)
    leftover = filter_leftover()
    left = np.stack([bent, bent - bent_triad(sigma, np.zeros(3)), -leftover])
    cone = coning_drift(algorithm, finite_number(half_angle, "half_angle"), CONING_FREQUENCY,
                        SAMPLE_INTERVAL)  # fmt: skip
    shaken = np.array([0.0, 0.0, float(cone)])
    headings = np.radians(np.arange(-180.0, 180.1, 10.0))
    attitude = attitude_from_angles(headings, 0.0, 0.0)
    rate, _ = sensed_at_rest(attitude, latitude)
    drifts = rotate(attitude, rate @ np.swapaxes(left, -1, -2) + shaken)
    aligned = alignment_errors(headings, 0.0, latitude, drifts, np.zeros(3)).heading
    way = ship(latitude, speed, turn=turn, interval=INTERVAL)
    rates = way.angle_increments / way.interval
    under_way = take_along(way, rates @ np.swapaxes(left, -1, -2) + shaken, log=True)
    return Capstone(
        # Turns say nothing of the misalignment.
        np.stack([parts(bent), np.append(sigma, [np.nan] * 3), parts(bent + leftover)]),
        drift_per_turn(AXES, left[:, np.newaxis]),
        headings,
        aligned,
        under_way,
    )


def columns(data: Capstone) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the heading under way, each four minutes."""
    rows = slice(14, None, 15)
    table = {"time_s": data.under_way.times[rows]}
    for stage, error in zip(STAGES, data.under_way.heading_error, strict=True):
        table[f"heading_error_deg, {stage}"] = np.degrees(error[rows]).round(6)
    return table


class CapstonePicture(Picture[Capstone]):
    """What is known, what drifts, and what the heading has of it."""

    size = (9.8, 4.9)

    def build(self) -> None:
        panels = self.figure.subplots(2, 2)
        self.figure.subplots_adjust(0.065, 0.085, 0.985, 0.95, wspace=0.17, hspace=0.36)
        known, turns, aligned, under_way = panels.ravel()
        self.heading_panels = aligned, under_way
        known.set(title="1 the bend and what is found of it, arc seconds", ylim=(-110, 150))
        known.set_xlim(-0.6, 5.6)
        known.axhline(0, color=BLACK, linewidth=0.8)
        known.set_xticks(range(6), ["fu", "fr", "ur", "turn f", "turn u", "turn r"])
        turns.set(title="2 drift in one turn about an axis, arc seconds", ylim=(-700, 900))
        turns.set_xlim(-0.6, 5.6)
        turns.axhline(0, color=BLACK, linewidth=0.8)
        turns.set_xticks(range(6), AXIS_NAMES)
        aligned.set(title="3 heading error after alignment, arc minutes")
        aligned.set(xlabel="heading, degrees", xlim=(-180, 180))
        aligned.set_xticks(range(-180, 181, 60))
        under_way.set(title="4 heading error under way, degrees")
        under_way.set(xlabel="time, minutes", xlim=(0, 120))
        labels = ("true", "found by turns", "found by the filter")
        self.known = [self._stems(known, i, label) for i, label in enumerate(labels)]
        self.turns = [self._stems(turns, i, stage) for i, stage in enumerate(STAGES)]
        self.aligned = [self.line(aligned, **SERIES[i]) for i in range(3)]
        self.under_way = [
            self.line(under_way, **SERIES[i], label=stage) for i, stage in enumerate(STAGES)
        ]
        known.legend(loc="upper right", ncols=3, fontsize=7.5)
        turns.legend(loc="upper right", ncols=3, fontsize=7.5)
        under_way.legend(loc="lower left", ncols=3, fontsize=7.5)

    def _stems(self, panel: Axes, number: int, label: str) -> Line2D:
        """Six stems with a marker, as one line that is broken between them."""
        style = {"color": SERIES[number]["color"], "marker": "os^"[number], "markersize": 5.5}
        line = self.line(panel, **style, linewidth=2.0, markevery=(1, 3), label=label)
        line.set_xdata(np.repeat(np.arange(6) + 0.22 * (number - 1), 3))
        return line

    def update(self, data: Capstone) -> None:
        for lines, rows in ((self.known, data.known), (self.turns, data.per_turn)):
            for line, row in zip(lines, rows, strict=True):
                foot, gap = np.zeros(6), np.full(6, np.nan)
                line.set_ydata(np.stack([foot, row / arcsecond, gap], axis=-1).ravel())
        aligned, under_way = self.heading_panels
        self.set_reach(aligned, "y", 60 * np.degrees(data.aligned), (3.0, 15.0, 75.0, 400.0))
        errors = np.degrees(data.under_way.heading_error)
        self.set_reach(under_way, "y", errors, (1.0, 5.0, 25.0, 200.0))
        for line, row in zip(self.aligned, data.aligned, strict=True):
            line.set_data(np.degrees(data.headings), 60 * np.degrees(row))
        for line, error in zip(self.under_way, errors, strict=True):
            line.set_data(data.under_way.times / minute, error)

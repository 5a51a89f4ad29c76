"""Turns of a real table on the Earth: what each error of theirs does to the sigmas."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import arcminute, arcsecond, degree, hour, micro

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, finite_array, shown, whole_number
from driftlab.drift.recorded_turns import recorded_turn_estimate
from driftlab.drift.systematic_drift import drift_coefficient
from driftlab.drift.turn_calibration import earth_rate_offset, exact_turn_estimate
from driftlab.drift.weighing_designs import PAIR_AXES, YATES_AXES, fit_turns
from driftlab.earth import earth_rate
from driftlab.imu import NO_ERRORS, ImuNoise
from driftlab.increments import measure
from driftlab.motion.turntable_rotation import TurntableRotation
from driftlab.quaternion import (
    conjugate,
    cumulative_product,
    from_rotation_vector,
    multiply,
    to_rotation_vector,
)

from ..ch04_calibration_by_turns.experiments import SEED, SENSES, error_matrix

SIGMA_ON_TABLE: FloatArray = np.array([-30.0, 20.0, 30.0]) * arcsecond
"""True sigmas, rad; chapter 16 has the same triad."""
BOTH = SENSES["both"]
"""Counter-clockwise, then clockwise, about each of Yates's four axes."""
WAYS = (
    "one direction",
    "both directions",
    "one direction, common offset",
    "both directions, common offset",
)
"""Three axes, or four if an offset is solved for."""
SARATOV = 51.5 * degree
"""Latitude of the turns of a misaligned triad."""
SAMPLES = 72
"""Increments of a turn; `rotation-vector-2` needs no more."""


@dataclass(frozen=True)
class RealTable:
    """Where and how the turns are made, and the size of the errors: one standard deviation each."""

    rate: float = 10 * degree  # of the table, rad/s; a turn about each axis
    latitude: float = 37.5 * degree  # rad
    gyro_bias: float = 0.3 * degree / hour  # of each gyro, rad/s
    common_scale: float = 30 * micro  # scale-factor error of all gyros
    gyro_scale_factor: float = 5 * micro  # of each gyro besides
    overshoot: float = 5 * arcsecond  # angle by which the table goes too far in every turn, rad
    stopping: float = 1 * arcsecond  # random part of it, rad
    mounting: float = 1 * arcminute  # of the body's axis on the table, each time it is mounted, rad
    tilt: float = 1 * arcminute  # of the table's axis, rad
    angle_random_walk: float = 0.005 * degree / float(np.sqrt(hour))  # rad/sqrt(s)

    @property
    def triad(self) -> FloatArray:
        """Triad error (3, 3) without scale factors."""
        return error_matrix(SIGMA_ON_TABLE)


def earth_under_table(
    rates: ArrayLike = (10 * degree, 30 * degree, 60 * degree),
    sigma: float = float(SIGMA_ON_TABLE[0]),
    latitude: float = SARATOV,
) -> DataTable:
    """Seeming sigma of a perfect triad over the latitude, and one turn of a misaligned triad.

    Turned about the diagonal between gyros 1 and 2. The turn is at the first rate, in both
    directions; sigma is that of the two gyros.
    """
    speeds = np.atleast_1d(finite_array(rates, "rates"))
    if not (speeds > 0).all():
        raise ValueError(f"rates: expected positive numbers, got {shown(speeds)}.")
    latitudes, marked = np.arange(-85, 86, 5) * degree, np.arange(-75, 76, 25) * degree
    names = [f"{speed / degree:.3g} deg/s" for speed in speeds]
    turned = [[_estimate(np.zeros((3, 3)), speed, place) for place in marked] for speed in speeds]
    unit, there, back = error_matrix([sigma, 0, 0]), speeds[0], -speeds[0]
    directions = np.array([_error_so_far(unit, rate, latitude) for rate in (there, back)])
    return DataTable(
        {
            "latitude": (latitudes, "deg", "of the table"),
            "offset": (
                np.array([earth_rate_offset(latitudes, speed) for speed in speeds]), "arcsec",
                "seeming sigma of a perfect triad, counter-clockwise, by the formula", names,
            ),
            "turned_latitude": (marked, "deg", "at which turns are simulated"),
            "turned": (np.array(turned), "arcsec", "seeming sigma by a simulated turn", names),
            "angle": (np.arange(SAMPLES + 1) * 2 * np.pi / SAMPLES, "deg", "turned so far"),
            "direction": (directions, "arcsec", "error along the direction of the turn, over 2 pi",
                          ("counter-clockwise", "clockwise")),
            "mean": (directions.mean(axis=0), "arcsec", "of both directions"),
        },
        {
            "sigma": (sigma, "arcsec", "true sigma of the triad that makes one turn"),
            "place": (latitude, "deg", "latitude of that turn"),
            "there": (float(directions[0, -1]), "arcsec", "found counter-clockwise"),
            "back": (float(directions[1, -1]), "arcsec", "found clockwise"),
        },
    )  # fmt: skip


def _felt(triad: FloatArray, rate: float, latitude: float) -> FloatArray:
    """Increments (SAMPLES, 3) of a triad in a turn about the first pair axis."""
    true = TurntableRotation(rate, latitude=latitude).increments(PAIR_AXES[0], SAMPLES)
    return measure(true, NO_ERRORS._replace(gyro_error_matrix=triad)).angle


def _estimate(triad: FloatArray, rate: float, latitude: float) -> float:
    return float(recorded_turn_estimate(_felt(triad, rate, latitude), PAIR_AXES[0]))


def _error_so_far(triad: FloatArray, rate: float, latitude: float) -> FloatArray:
    """Error (SAMPLES + 1,) along the direction of a turn, divided by 2 pi."""
    n = np.sign(rate) * PAIR_AXES[0]
    computed = cumulative_product(from_rotation_vector(_felt(triad, rate, latitude)))
    angles = np.arange(1, SAMPLES + 1) * 2 * np.pi / SAMPLES
    true = from_rotation_vector(angles[:, np.newaxis] * n)
    along = to_rotation_vector(multiply(conjugate(true), computed)) @ n
    return np.concatenate([[0.0], along]) / (2 * np.pi)


def sigmas_by_way(estimates: FloatArray) -> FloatArray:
    """Sigmas (way, ..., 3) from estimates (..., 2, 4): both senses, Yates's four axes."""
    ways = (estimates[..., 0, :], estimates.mean(axis=-2))
    plain = [fit_turns(turns[..., :3], PAIR_AXES).sigma for turns in ways]
    with_offset = [fit_turns(turns, YATES_AXES, "common").sigma for turns in ways]
    return np.stack([*plain, *with_offset])


def budget(table: RealTable) -> tuple[dict[str, str], FloatArray]:
    """Sources with their assumed sizes, and rms errors (source, way) of the sigmas by each, rad.

    Each source by its first order, which for two is that of a product.
    """
    rates = np.broadcast_to((table.rate * np.array(BOTH))[:, np.newaxis], (2, 4))
    one, none = np.ones((2, 4)), np.zeros((2, 4))
    each_turn = np.eye(8).reshape(8, 2, 4)
    level = earth_rate(table.latitude) * [0, 1, 0]
    mounted = []
    for index, n in enumerate(YATES_AXES):
        for e in _across(n):
            one_mounting = none.copy()
            one_mounting[:, index] = 2 * e @ table.triad @ n
            one_mounting[:, index] -= (
                e @ TurntableRotation(1.0).components_at_start(level, n) / rates[:, index]
            )
            mounted.append(one_mounting)
    walk = table.angle_random_walk * np.sqrt(2 * np.pi / table.rate) / (2 * np.pi)
    of_the_method = exact_turn_estimate(YATES_AXES, table.triad)
    of_the_method = of_the_method - drift_coefficient(YATES_AXES, table.triad)
    along = YATES_AXES.T[:, np.newaxis]
    patterns = {
        "Earth's rate": (
            [earth_rate_offset(table.latitude, rates)], f"{table.latitude / degree:.3g}°"
        ),
        "scale factor, all gyros": (
            [table.common_scale * one], f"{table.common_scale / micro:.3g} ppm"
        ),
        "scale factor, each gyro": (
            table.gyro_scale_factor * along**2 * one, f"{table.gyro_scale_factor / micro:.3g} ppm"
        ),
        "gyro bias": (table.gyro_bias * along / rates,
                      f"{table.gyro_bias / degree * hour:.3g} °/h"),
        "table overshoots": ([table.overshoot / (2 * np.pi) * one],
                             f"{table.overshoot / arcsecond:.3g}″"),
        "table stops at random": (table.stopping / (2 * np.pi) * each_turn,
                                  f"{table.stopping / arcsecond:.3g}″"),
        "gyro noise": (walk * each_turn, f"{60 * np.degrees(table.angle_random_walk):.3g} °/√h"),
        "axis of the body": (table.mounting * np.array(mounted),
                             f"{table.mounting / arcminute:.3g}′"),
        "axis of the table": ([table.tilt * level[1] / rates], f"{table.tilt / arcminute:.3g}′"),
        "bias of the method": ([of_the_method * one], "second order"),
    }  # fmt: skip
    effects = []
    for pattern, _ in patterns.values():
        responses = sigmas_by_way(np.asarray(pattern))
        effects.append(np.sqrt((responses**2).sum(axis=(1, 2)) / 3))
    return {name: size for name, (_, size) in patterns.items()}, np.array(effects)


def in_quadrature(effects: FloatArray) -> FloatArray:
    """Root mean square error (way,) of all sources (source, way) together."""
    return np.sqrt((effects**2).sum(axis=0))


def simulated_turns(table: RealTable, runs: int, rng: np.random.Generator) -> FloatArray:
    """Estimates (runs, 2, 4) of turns in both senses about Yates's axes, all errors at once."""
    noise = ImuNoise(table.angle_random_walk, velocity_random_walk=0.0)
    sides = np.array([_across(n) for n in YATES_AXES])
    found = np.empty((runs, 2, 4))
    for run in found:
        tilt = table.tilt * rng.standard_normal(2)
        overshoot = table.overshoot * rng.standard_normal()
        scales = table.gyro_scale_factor * rng.standard_normal(3)
        scales += table.common_scale * rng.standard_normal()
        unit = NO_ERRORS._replace(
            gyro_error_matrix=table.triad + np.diag(scales),
            gyro_bias=table.gyro_bias * rng.standard_normal(3),
        )
        wobble = table.mounting * rng.standard_normal((4, 1, 2)) @ sides
        axes = YATES_AXES + wobble[:, 0]
        for sense, row in zip(BOTH, run, strict=True):
            turn = TurntableRotation(
                sense * table.rate,
                latitude=table.latitude,
                table_axis=(tilt[0], tilt[1], 1.0),
                angle_error=overshoot,
            )
            true = turn.increments(axes, SAMPLES)
            # Where each of the four turns stops, the last interval takes up.
            stops = sense * table.stopping * rng.standard_normal((4, 1))
            true.angle[:, -1] += stops * axes
            record = measure(true, unit, noise, rng)
            row[:] = recorded_turn_estimate(record.angle, YATES_AXES, 1, "rotation-vector-2")
    return found


def real_table(runs: int = 200, seed: int = SEED, table: RealTable = RealTable()) -> DataTable:
    """Budget over the table's rate, and simulations of the whole at three rates."""
    count = whole_number(runs, "runs", least=2)
    rng = np.random.default_rng(seed)
    rates = np.array([1, 1.5, 2, 3, 5, 7, 10, 15, 20, 30, 50, 70, 100]) * degree
    simulated_rates = rates[[2, 6, 10]]
    simulated = np.empty((len(simulated_rates), 3, len(WAYS)))
    for row, rate in zip(simulated, simulated_rates, strict=True):
        estimates = simulated_turns(replace(table, rate=rate), count, rng)
        squares = ((sigmas_by_way(estimates) - SIGMA_ON_TABLE) ** 2).mean(axis=-1)
        rms = np.sqrt(squares.mean(axis=-1))
        # The mean of the squares is near normal; its root divides by twice the root.
        half_width = 1.96 * squares.std(axis=-1) / np.sqrt(count) / (2 * rms)
        row[:] = rms, rms - half_width, rms + half_width
    expected = [in_quadrature(budget(replace(table, rate=rate))[1]) for rate in rates]
    sizes, effects = budget(table)
    with_total = np.vstack([effects, in_quadrature(effects)])
    return DataTable(
        {
            "rate": (rates, "deg_per_s", "of the table"),
            "expected": (np.transpose(expected), "arcsec", "rms error of a sigma, budget", WAYS),
            "simulated_rate": (simulated_rates, "deg_per_s", "of the table in the simulations"),
            "simulated": (np.transpose(simulated), "arcsec",
                          "rms error of a sigma over the runs, and its 95 % interval",
                          (WAYS, ("rms", "from", "to"))),
            "source": ([*sizes, "in quadrature"], "", "source of an error"),
            "effect": (with_total.T, "arcsec", "rms error of a sigma by this source", WAYS),
        },
        {
            "sizes": ([*sizes.values()], "", "assumed size of each source"),
            "runs": (count, "", "simulated calibrations at each rate"),
            "table_rate": (table.rate, "deg_per_s", "rate for which the sources are listed"),
        },
    )  # fmt: skip


def _across(n: FloatArray) -> FloatArray:
    """Two unit vectors (2, 3) at right angles to a unit vector (3,) and to each other."""
    first = np.cross(n, np.eye(3)[np.argmin(np.abs(n))])
    first /= np.linalg.norm(first)
    return np.array([first, np.cross(n, first)])

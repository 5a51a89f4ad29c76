"""Plotnikov Fig. 1, simulated from its description: heading error on a table of three angles."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.constants import arcminute, degree, g, hour, milli

from driftlab.book.machinery.figure.data_table import UNITS, DataTable
from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.checks import FloatArray, finite_array, whole_number
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import alignment_errors
from driftlab.quaternion import rotate

from .trials import turntable_heading_error

DIAL: FloatArray = np.radians(np.arange(0.0, 361.0, 15.0))
"""Stops of the table in heading and in roll, rad."""
PITCHES: FloatArray = np.radians(np.arange(-60.0, 61.0, 5.0))
"""As many stops in pitch, rad; how far the paper's table was pitched it does not say."""
STOPS: dict[str, FloatArray] = {
    name: np.stack(
        [angles if name == other else 0 * DIAL for other in ("heading", "pitch", "roll")]
    )
    for name, angles in (("heading", DIAL), ("pitch", PITCHES), ("roll", DIAL))
}
"""Heading, pitch and roll (3, n) at the stops of the three turns, rad: the others stay at zero."""
RUNS = 3
"""Times that the paper turns its table."""
LEVELLING, NORTH = 6 * arcminute, float(np.radians(0.1))
"""The paper's limits for the table: each axis is level, and its zero is North, within these."""
RANDOM = 0.01 * degree / hour
"""Deviation of an averaged gyro from stop to stop, rad/s: of the paper's 0.01 to 0.02 deg/h."""
LASTING: FloatArray = np.arange(0.0, 0.105, 0.01).round(2)
"""Deviation of the drift that each gyro keeps through all runs, deg/h."""
OFFSETS: FloatArray = np.arange(0.0, 11.0, 1.0)
"""Deviation of the offset that each accelerometer keeps through all runs, mg."""
SEED = 1
PAPER_LARGEST = 0.34
"""The paper's largest averaged error, degrees."""


TURNED = ("turns in heading", "turns in heading, pitch and roll")
"""Over which turns the largest error is taken."""
SHARES = (0.1, 0.5, 0.9)
"""Of the units, whose largest errors are shown."""


def dial_trial(
    lasting: float,
    offset: float,
    units: int,
    rng: np.random.Generator,
    random: float = RANDOM,
    latitude: float = SARATOV_LATITUDE,
) -> DataTable:
    """Turn units in heading, pitch and roll, each on a table with errors within the paper's limits.

    The drift has a lasting part and one that changes from stop to stop, rad/s; the offset lasts,
    m/s^2. The errors of a table are the same at all stops of one unit.
    """
    drift = lasting * rng.standard_normal((units, 1, 1, 3))
    bias = offset * rng.standard_normal((units, 1, 1, 3))
    tilt = rng.uniform(-LEVELLING, LEVELLING, (units, 1, 1, 2))
    north = rng.uniform(-NORTH, NORTH, (units, 1, 1))
    errors = {}
    for name, (dial, pitch, roll) in STOPS.items():
        noise = random * rng.standard_normal((units, RUNS, len(dial), 3))
        errors[name] = turntable_heading_error(
            dial, drift + noise, bias, latitude, pitch=pitch, roll=roll,
            north_error=north, tilt=tilt,
        )  # fmt: skip
    worst = [np.abs(each.mean(axis=1)).max(axis=-1) for each in errors.values()]
    largest = np.array([worst[0], np.max(worst, axis=0)])
    return DataTable(
        {},
        {
            "errors": (errors, "deg", "of the heading, by angle that turns: (units, runs, stops)"),
            "largest": (largest, "deg", "error of the mean of the runs, for both kinds of turns"),
            "drift": (drift, "deg_per_h", "that lasts"),
            "offset": (bias, "mg", "that lasts"),
            "north_error": (north, "deg", "of the table's zero"),
            "tilt": (tilt, "arcmin", "of the table about North and East"),
        },
    )


def table_and_unit(
    trial: DataTable, unit: int, latitude: float = SARATOV_LATITUDE
) -> dict[str, FloatArray]:
    """Return the heading errors (n,) of one unit and its table to first order, by turn, rad."""
    expected = {}
    for name, (dial, pitch, roll) in STOPS.items():
        local = (
            rotate(from_euler_angles(dial, pitch, roll), part[unit, 0, 0])
            for part in (trial.drift, trial.offset)
        )
        north, east = trial.tilt[unit, 0, 0]
        # A leaning table turns a pitched bow aside; the compass is right, and the dial is not.
        aside = np.tan(pitch) * (east * np.sin(dial) - north * np.cos(dial))
        aligned = alignment_errors(dial, pitch, latitude, *local).heading
        expected[name] = aligned + trial.north_error[unit, 0, 0] + aside
    return expected


def static_characteristic(
    units: int = 500,
    lasting_drift: Sequence[float] = tuple((LASTING * degree / hour).tolist()),
    lasting_offset: Sequence[float] = tuple((OFFSETS * milli * g).tolist()),
    random_drift: float = RANDOM,
    latitude: float = SARATOV_LATITUDE,
    seed: int = SEED,
) -> DataTable:
    """Turn many units on the table for each drift that lasts, and for each offset.

    The shown unit is of the drift of which the median is nearest to the paper's largest error, and
    the one of these whose largest error in the turns in heading is nearest to it.
    """
    units, rng = whole_number(units, "units"), np.random.default_rng(seed)
    drifts = finite_array(lasting_drift, "lasting_drift")
    offsets = finite_array(lasting_offset, "lasting_offset")
    drifting, offset = (
        [dial_trial(drift, bias, units, rng, random_drift, latitude) for drift, bias in sizes]
        for sizes in ([(float(s), 0.0) for s in drifts], [(0.0, float(s)) for s in offsets])
    )
    by_drift, by_offset = (
        np.stack([trial.largest for trial in each], axis=1) for each in (drifting, offset)
    )
    medians = np.degrees(np.median(by_drift[0], axis=-1))
    shown = int(np.abs(medians - PAPER_LARGEST).argmin())
    unit = int(np.abs(np.degrees(by_drift[0, shown]) - PAPER_LARGEST).argmin())
    formula = table_and_unit(drifting[shown], unit, latitude)
    columns: dict[str, tuple[Any, ...]] = {}
    for i, (name, stops) in enumerate(STOPS.items()):
        runs = drifting[shown].errors[name][unit]
        rows = [*runs, runs.mean(axis=0), formula[name]]
        names = [*(f"run {k}" for k in range(1, RUNS + 1)), "mean", "formula"]
        columns[f"{name}_stop"] = (stops[i], "deg", f"{name} of the table", (), 6)
        columns[f"{name}_error"] = (rows, "deg", "heading error of one unit there", names)
    for name, unit_shown, sizes, errors in (
        ("drift", "deg_per_h", drifts, by_drift),
        ("offset", "mg", offsets, by_offset),
    ):
        step = sizes[1] - sizes[0] if len(sizes) > 1 else UNITS[unit_shown][0]
        columns[f"lasting_{name}"] = (sizes, unit_shown, "standard deviation over the units")
        for turned, aside, largest in zip(TURNED, (-0.1, 0.1), errors, strict=True):
            quantiles, names = np.quantile(largest, SHARES, axis=-1), [f"{x:.0%}" for x in SHARES]
            at = sizes + aside * step
            columns[f"{name}_drawn_at, {turned}"] = (at, unit_shown, "both kinds side by side")
            most = "what a share of the units does not exceed"
            columns[f"largest_by_{name}, {turned}"] = (quantiles, "deg", most, names)
    columns["paper_largest_error"] = ([np.radians(PAPER_LARGEST)], "deg", "of the paper")
    return DataTable(
        columns,
        {
            "shown_drift": (drifts[shown], "deg_per_h", "drift from which the one unit is"),
            "by_drift": (by_drift, "deg", "largest errors of all units, for both kinds of turns"),
            "by_offset": (by_offset, "deg", "likewise"),
        },
    )

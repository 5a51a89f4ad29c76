"""Options that all commands share: which columns, which units, which place; and the files to write.

This is where degrees become radians.
"""

from __future__ import annotations

import argparse
import csv
import re
import shlex
from pathlib import Path
from typing import Any

import numpy as np

from driftlab.axes import checked_axes
from driftlab.recordings.guards import RULES, data_problems
from driftlab.recordings.layout import Layout
from driftlab.recordings.readers import read_csv, read_imu_tk, read_psins
from driftlab.recordings.recording import Recording

LEAST_GRAVITY, MOST_GRAVITY = 9.7, 9.9
"""What gravity may be on the Earth, m/s^2, with the poles and the highest mountains."""


def add_log_options(parser: argparse.ArgumentParser) -> None:
    """What the log is."""
    parser.add_argument(
        "log", type=Path, nargs="+", help="the log; for imu-tk the accelerometers', then the gyros'"
    )
    add = parser.add_argument_group("what the log holds").add_argument
    add("--format", choices=sorted(READERS), default="csv", help="(default: csv)")
    add(
        "--columns",
        type=words,
        metavar="A,B,C[,D,E,F]",
        help="three gyros, and three accelerometers if there are any: names in the log's head, or "
        "numbers from 1; a minus before one changes its sign (then write --columns=-a,b,c). If all "
        "three accelerometers have the wrong sign, no check can know it",
    )
    add("--gyro", type=words, metavar="A,B,C", help="the gyros alone")
    add("--accelerometer", type=words, metavar="D,E,F", help="the accelerometers")
    add(
        "--units",
        type=words,
        metavar="U[,V]",
        help="of gyros and accelerometers: deg/s,g or rad/s,m/s^2 for rates; rad,m/s or "
        "arcsec,mm/s for increments; with the size of a count before it: '1/131 deg/s'; not needed "
        "if the log's head tells them",
    )
    add(
        "--zeros",
        type=numbers,
        default=(0.0, 0.0),
        metavar="N,M",
        help="counts that stand for zero, of gyros and accelerometers",
    )
    add(
        "--time",
        type=words,
        metavar="COLUMN[,UNIT]",
        help="time stamps, with their unit (s, ms, us, ns, iso) if the head does not tell it",
    )
    add("--rate", type=number, metavar="HZ", help="samples a second, without stamps")
    add("--axes", default="", help="body axes, FRD say: forward, right, down")
    add("--latitude", type=number, metavar="DEG", help="of the place, North positive")
    add("--gravity", type=number, metavar="M/S2", help="of the place")
    add("--begin", type=number, metavar="S", help="leave out what is before")
    add("--end", type=number, metavar="S", help="leave out what is after")
    add(
        "--allow",
        type=words,
        default=(),
        metavar="DOUBT,...",
        help="go on in spite of these doubts about the log; a refusal names its own",
    )


def add_output_options(parser: argparse.ArgumentParser) -> None:
    """Where the findings go besides the terminal."""
    add = parser.add_argument_group("files to write").add_argument
    add("--report", type=Path, metavar="OUT.html", help="a page to print and keep")
    add("--csv", type=Path, metavar="OUT.csv", help="columns for a spreadsheet")
    add("--json", type=Path, metavar="OUT.json", help="the numbers for another program, SI units")
    add("--title", default="", help="title of the report: the unit's number, say")
    add("--date", default="", help="a date for the report, as you write it")
    add("--force", action="store_true", help="overwrite files that are there")


def number(text: str) -> float:
    """A number with a decimal point."""
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"expected a number such as 33.9, with a point, got {text!r}"
        ) from None


def words(text: str) -> tuple[str, ...]:
    """Words between commas; one with a comma inside stands in quotation marks, as in a CSV."""
    (row,) = csv.reader([text], skipinitialspace=True)
    return tuple(word.strip() for word in row)


def numbers(text: str) -> tuple[float, ...]:
    """Numbers between commas."""
    return tuple(number(word) for word in words(text))


def recording_of(options: argparse.Namespace) -> Recording:
    """Read the log as the options describe it."""
    _check(options)
    known = {
        "axes": options.axes,
        "latitude": None if options.latitude is None else float(np.radians(options.latitude)),
        "gravity": options.gravity,
        "allow": tuple(RULES),  # `allowed_doubts` looks at them
    }
    recording = READERS[options.format](options, known)
    if options.begin is None and options.end is None:
        return recording
    begin = 0.0 if options.begin is None else options.begin
    if not begin >= 0:
        raise ValueError(f"--begin: expected seconds from the first row on, got {begin:g}.")
    return recording.between(begin, recording.duration if options.end is None else options.end)


def allowed_doubts(recording: Recording, options: argparse.Namespace) -> tuple[str, ...]:
    """Return, for a warning, the doubts about a log that the options let through; refuse others."""
    allow = options.allow
    if unknown := [rule for rule in allow if rule not in RULES]:
        raise ValueError(f"--allow: expected some of {', '.join(RULES)}, got {unknown[0]}.")
    found = data_problems(recording)
    if refused := [doubt for doubt in found if doubt.rule not in allow]:
        rules = shlex.quote(",".join(dict.fromkeys([*allow, *(doubt.rule for doubt in refused)])))
        exchanged = options.format == "imu-tk" and "force" in {doubt.rule for doubt in refused}
        order = " Or are the two files exchanged? The accelerometers' is first." * exchanged
        raise ValueError(
            f"{recording.name}: {' '.join(map(str, refused))}{order} If the log is right all the "
            f"same, say --allow {rules}."
        )
    warnings = [*map(str, found)]
    if recording.gravity is not None and not LEAST_GRAVITY < recording.gravity < MOST_GRAVITY:
        warnings.append(
            f"--gravity: expected m/s^2 of a place on the Earth, {LEAST_GRAVITY} to "
            f"{MOST_GRAVITY}, got {recording.gravity:g}."
        )
    return tuple(warnings)


def _check(options: argparse.Namespace) -> None:
    wanted = 2 if options.format == "imu-tk" else 1
    if len(options.log) != wanted:
        kind = "two files, accelerometers and gyros," if wanted == 2 else "one file"
        raise ValueError(f"log: expected {kind} for {options.format}, got {len(options.log)}.")
    for name in KNOWN_BY_FILE[options.format]:
        if getattr(options, name) is not None:
            raise ValueError(f"--{name}: expected none with --format {options.format}, got one.")
    if len(options.zeros) != 2:
        raise ValueError(
            "--zeros: expected two numbers, of the gyros and of the accelerometers, as in "
            f"32768,32768, got {len(options.zeros)}."
        )
    if options.axes:
        try:
            checked_axes(options.axes, "--axes", "body")
        except ValueError:
            raise ValueError(
                "--axes: expected three letters of right-handed body axes, as FRD (forward, right, "
                f"down), FLU, RFU or FUR, got {options.axes!r}."
            ) from None
    if options.latitude is not None and not abs(options.latitude) <= 90:
        raise ValueError(f"--latitude: expected degrees, at most 90, got {options.latitude:g}.")


def _read_csv(options: argparse.Namespace, known: dict[str, Any]) -> Recording:
    gyro, accelerometer = _triads(options)
    if (options.time is None) == (options.rate is None):
        raise ValueError(
            "--time: expected the column of the time stamps, or --rate in Hz, and not both."
        )
    time = options.time
    if time is not None and len(time) > 2:
        raise ValueError(f"--time: expected COLUMN or COLUMN,UNIT, got {time}.")
    told = {name: getattr(options, name) for name in ("units", "zeros", "rate")}
    told["time"] = time[0] if time is not None and len(time) == 1 else time
    (log,) = options.log
    try:
        return read_csv(log, Layout(gyro, accelerometer, name=log.name, **told, **known))
    except ValueError as error:  # arguments have the names of options
        raise ValueError(re.sub(r"^(columns|units|time|rate):", r"--\1:", str(error))) from None


def _triads(options: argparse.Namespace) -> tuple[tuple[str, ...], tuple[str, ...] | None]:
    """Columns of the gyros, and of the accelerometers if there are any."""
    columns, gyro, accelerometer = options.columns, options.gyro, options.accelerometer
    if columns is not None:
        if gyro is not None or accelerometer is not None:
            raise ValueError("--columns: expected it alone, got --gyro or --accelerometer as well.")
        if len(columns) not in (3, 6):
            raise ValueError(
                f"--columns: expected three gyros, or these and three accelerometers, got "
                f"{len(columns)} columns: {', '.join(columns)}."
            )
        gyro, accelerometer = columns[:3], columns[3:] or None
    if gyro is None:
        raise ValueError(
            "--columns: expected the columns of the log, three gyros and then three "
            "accelerometers, by name or number, got none; --help ends with an example."
        )
    for option, triad in (("--gyro", gyro), ("--accelerometer", accelerometer)):
        if triad is not None and len(triad) != 3:
            raise ValueError(f"{option}: expected three columns, got {', '.join(triad)}.")
    return gyro, accelerometer


def _read_imu_tk(options: argparse.Namespace, known: dict[str, Any]) -> Recording:
    accelerometer, gyro = options.log
    units = {} if options.units is None else {"units": options.units}
    return read_imu_tk(accelerometer, gyro, zeros=options.zeros, **units, **known)


def _read_psins(options: argparse.Namespace, known: dict[str, Any]) -> Recording:
    """The file knows its place and axes; what is told besides goes before."""
    return read_psins(options.log[0], **{name: told for name, told in known.items() if told})


READERS = {"csv": _read_csv, "imu-tk": _read_imu_tk, "psins": _read_psins}
KNOWN_BY_FILE = {
    "csv": (),
    "imu-tk": ("columns", "gyro", "accelerometer", "time", "rate"),
    "psins": ("columns", "gyro", "accelerometer", "time", "rate", "units"),
}
"""Options that a format leaves nothing to say for."""

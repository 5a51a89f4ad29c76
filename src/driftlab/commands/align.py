"""``python -m driftlab align``: heading, pitch and roll of a unit at rest."""

from __future__ import annotations

import argparse
from typing import Any, NamedTuple

import numpy as np

from driftlab.checks import FloatArray
from driftlab.conventions import mirror_heading
from driftlab.core.vectors import wrap_angle
from driftlab.earth import EARTH_RATE, gravity
from driftlab.gyrocompass.alignment import Alignment, align
from driftlab.gyrocompass.inertial_alignment import InertialAlignment, align_in_inertial_frame
from driftlab.recordings.recording import Recording

from .findings import Curve, Findings, Plot, Table
from .numbers import DEGREES, RATES, Unit, with_deviation, written
from .progress import Steps
from .record import forces, moments, rates, record_plots

STEPS = 2
EXAMPLE = """\
python -m driftlab example log.csv
python -m driftlab align log.csv --columns gx,gy,gz,ax,ay,az --units deg/s,g --time t,s \
--axes FRD --latitude 59.9 --end 60"""
STRETCHES = 10
"""The record is aligned in as many parts too; their scatter is the deviation of the whole."""
DEG_PER_HOUR = RATES[1]
LATITUDE_SLACK = np.radians(0.1)
"""What a latitude found may differ without a word: deflections, places told roughly."""


class Spread(NamedTuple):
    """An alignment of the whole, those of its stretches, and what follows from their scatter."""

    rate: FloatArray
    force: FloatArray
    whole: Alignment
    parts: Alignment
    deviation: Alignment


def add_options(parser: argparse.ArgumentParser) -> None:
    """It has only the options that all commands have."""


def find(recording: Recording, options: argparse.Namespace, step: Steps) -> Findings:
    """Align a record, and say how far it can be believed."""
    if not recording.axes:
        raise ValueError("--axes: expected the body axes, FRD say, because a heading needs them.")
    step("align")
    spread = aligned(recording)
    warnings = [*_doubts(recording, spread)]
    unseen = earth_unseen(spread)
    swaying, why_not = (None, "") if unseen else _in_inertial_space(recording)
    rows = [] if unseen else _heading_rows(spread.whole.heading, spread.deviation.heading)
    rows += _level_rows(recording, spread, seen=not unseen)
    tables = [Table("From the means of the record", HEAD, tuple(rows), NOTE)]
    sentences = [unseen or _in_words(spread), why_not]
    if swaying is not None:
        tables.append(_inertial_table(recording, swaying))
        sentences.append(_compared(spread, swaying))
    step("plots")
    return Findings(
        "Alignment at rest",
        tuple(tables),
        tuple(filter(None, sentences)),
        tuple(warnings),
        _plots(recording, spread, heading=not unseen),
        _values(spread, swaying, seen=not unseen),
        _columns(recording, spread),
    )


HEAD = ("", "value", "deviation", "unit")
NOTE = (
    f"Deviations are those of a mean, from {STRETCHES} stretches of the record aligned alone; what "
    "stays the same in all of them, as a bias of a gyro, is not in them."
)


def aligned(recording: Recording) -> Spread:
    """Alignment of the whole, and deviations from its stretches."""
    if len(recording) < STRETCHES:
        raise ValueError(f"log: expected at least {STRETCHES} rows, got {len(recording)}.")
    known = recording.in_axes("FUR")
    rate, force = rates(known), forces(known)
    means = [
        np.stack([part.mean(axis=0) for part in np.array_split(rows, STRETCHES)])
        for rows in (rate, force)
    ]
    whole, parts = align(rate.mean(axis=0), force.mean(axis=0)), align(*means)
    scatter = [part - each for each, part in zip(whole, parts, strict=True)]
    angles = [wrap_angle(each) for each in scatter[:4]]
    deviation = [
        np.sqrt((each**2).sum() / (STRETCHES - 1) / STRETCHES) for each in (*angles, scatter[4])
    ]
    return Spread(means[0], means[1], whole, parts, Alignment(*deviation))


def earth_unseen(spread: Spread) -> str:
    """Why there is no heading: a sentence if the gyros do not see the Earth turn, else empty.

    A rate of the wrong size has an error at least as large as the difference. Half the Earth's rate
    may turn the heading by half a radian and more.
    """
    found = float(np.linalg.norm(spread.rate.mean(axis=0)))
    noise = float(spread.rate.std(axis=0, ddof=1).max() / np.sqrt(STRETCHES))
    words = [written(rate / DEG_PER_HOUR.size, digits=4) for rate in (found, EARTH_RATE, noise)]
    if abs(found - EARTH_RATE) > max(EARTH_RATE / 2, 3 * noise):
        return (
            f"No heading: at rest the gyros show {words[0]} deg/h, and the Earth turns by "
            f"{words[1]} deg/h. Their biases hide it; a compass needs gyros whose biases are a "
            "small part of the Earth's rate. Pitch and roll come from the accelerometers."
        )
    if noise > EARTH_RATE / 5:
        return (
            f"No heading: the mean rate is only known to {words[2]} deg/h, and the Earth turns by "
            f"{words[1]} deg/h. A longer rest, or a stiller one, may help. Pitch and roll come "
            "from the accelerometers."
        )
    return ""


def compass(heading: Any) -> FloatArray:
    """A heading of the book as a compass card has it, from North to East, 0 to 2 pi."""
    return np.mod(mirror_heading(heading), 2 * np.pi)


def _heading_rows(heading: Any, deviation: Any) -> list[tuple[str, ...]]:
    return [
        _row("heading as on a compass card, from North to East", compass(heading), deviation),
        _row("heading as in the book, from North to West", heading, deviation),
    ]


def _in_inertial_space(recording: Recording) -> tuple[InertialAlignment | None, str]:
    """The alignment that lets the base sway, or why there is none."""
    if recording.latitude is None:
        return None, (
            "With the latitude told (--latitude) the heading can also be found on a base that "
            "sways, by gravity in inertial space."
        )
    try:
        increments = recording.in_axes("FUR").increments()
        return align_in_inertial_frame(increments, recording.latitude), ""
    except ValueError as error:
        return None, f"Gravity in inertial space gives no heading: {error}"


def _inertial_table(recording: Recording, found: InertialAlignment) -> Table:
    rows = _heading_rows(found.heading, float(found.deviation))
    rows += [
        _row("pitch, bow up", found.pitch),
        _row("roll, right side down", found.roll),
        _row("level rate found", found.level_rate, None, DEG_PER_HOUR),
    ]
    note = (
        "The base may sway; the angles are those at the end. Constant biases do what they do above."
    )
    return Table("From gravity in inertial space", HEAD, tuple(rows), note)


def _compared(spread: Spread, found: InertialAlignment) -> str:
    """Whether both ways give one heading."""
    apart = abs(float(wrap_angle(found.heading - spread.whole.heading)))
    noise = float(np.hypot(found.deviation, spread.deviation.heading))
    shown = written(np.degrees(apart), digits=2)
    if apart <= 3 * noise:
        return f"The two headings differ by {shown} degrees, which noise explains."
    return (
        f"The two headings differ by {shown} degrees, more than noise explains: the base has moved."
        " Means take its turning for the Earth's; trust the heading in inertial space."
    )


def _level_rows(recording: Recording, spread: Spread, seen: bool) -> list[tuple[str, ...]]:
    whole, deviation = spread.whole, spread.deviation
    rows: list[tuple[str, ...]] = [
        _row("pitch, bow up", whole.pitch, deviation.pitch),
        _row("roll, right side down", whole.roll, deviation.roll),
    ]
    if seen:
        rows.append(_row("latitude found", whole.latitude, deviation.latitude))
        if recording.latitude is not None:
            rows.append(_row("latitude told", recording.latitude))
        rows.append(_row("level rate found", whole.level_rate, deviation.level_rate, DEG_PER_HOUR))
        if recording.latitude is not None:
            level = EARTH_RATE * np.cos(recording.latitude)
            rows.append(_row("level rate of the Earth there", level, None, DEG_PER_HOUR))
    size = float(np.linalg.norm(spread.rate.mean(axis=0)))
    rows.append(_row("whole rate found", size, None, DEG_PER_HOUR))
    rows.append(_row("whole rate of the Earth", EARTH_RATE, None, DEG_PER_HOUR))
    return rows


def _row(
    name: str, value: Any, deviation: Any = None, unit: Unit = DEGREES
) -> tuple[str, str, str, str]:
    return (name, *with_deviation(float(value), deviation, unit))


def _in_words(spread: Spread) -> str:
    heading = float(compass(spread.whole.heading))
    shown, _, _ = with_deviation(heading, float(spread.deviation.heading), DEGREES)
    return (
        f"The bow points to {shown} degrees of a compass card, which counts from North through "
        "East."
    )


def _doubts(recording: Recording, spread: Spread) -> list[str]:
    """What the record says against itself."""
    doubts = []
    place = recording.latitude
    if place is not None and not earth_unseen(spread):
        off = float(spread.whole.latitude - place)
        if abs(off) > max(3 * spread.deviation.latitude, LATITUDE_SLACK):
            doubts.append(
                f"the latitude found is {written(np.degrees(off), digits=2)} degrees off the one "
                "told. Gyros without errors on a base at rest find it. An error of the same size "
                "across the meridian turns the heading by "
                f"{written(np.degrees(abs(off) / np.cos(place)), digits=2)} degrees, and nothing "
                "shows it: do not trust the heading to less."
            )
    pull = recording.gravity
    if pull is None and place is not None:
        pull = float(gravity(place))
    size = float(np.linalg.norm(spread.force.mean(axis=0)))
    if pull is not None and abs(size / pull - 1) > 0.02:
        doubts.append(
            f"the accelerometers show {written(size, digits=4)} m/s^2 at rest, and gravity is "
            f"{written(pull, digits=4)} m/s^2."
        )
    return doubts


def _plots(recording: Recording, spread: Spread, heading: bool) -> tuple[Plot, ...]:
    if not heading:
        return record_plots(recording)
    times = _middles(recording)
    off = np.degrees(wrap_angle(spread.whole.heading - spread.parts.heading))
    curves = (
        Curve("one stretch alone", times, off, marker="o"),
        Curve("the whole", times, np.zeros_like(times), dashed=True),
    )
    title = "Heading of each stretch, less that of the whole"
    return (*record_plots(recording), Plot(title, "time, s", "deg, to the East", curves))


def _middles(recording: Recording) -> FloatArray:
    return np.array([part.mean() for part in np.array_split(moments(recording), STRETCHES)])


def _values(spread: Spread, swaying: InertialAlignment | None, seen: bool) -> dict[str, Any]:
    values: dict[str, Any] = {
        name: {"value": getattr(spread.whole, name), "deviation": getattr(spread.deviation, name)}
        for name in (Alignment._fields if seen else ("pitch", "roll"))
    }
    if seen:
        values["compass_heading"] = {
            "value": compass(spread.whole.heading),
            "deviation": spread.deviation.heading,
        }
    if swaying is not None:
        values["in_inertial_space"] = {
            "heading": swaying.heading,
            "compass_heading": compass(swaying.heading),
            "deviation": swaying.deviation,
            "pitch": swaying.pitch,
            "roll": swaying.roll,
        }
    return {**values, "mean_rate_fur": spread.rate.mean(axis=0), "earth_seen": seen}


def _columns(recording: Recording, spread: Spread) -> dict[str, Any]:
    """The stretches one by one."""
    return {
        "time_s": _middles(recording),
        "compass_heading_deg": np.degrees(compass(spread.parts.heading)),
        "pitch_deg": np.degrees(spread.parts.pitch),
        "roll_deg": np.degrees(spread.parts.roll),
        "latitude_deg": np.degrees(spread.parts.latitude),
        "level_rate_deg_per_h": spread.parts.level_rate / DEG_PER_HOUR.size,
    }

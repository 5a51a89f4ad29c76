"""``python -m driftlab align``: heading, pitch and roll of a unit at rest."""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np

from driftlab.checks import FloatArray
from driftlab.conventions import mirror_heading
from driftlab.core.vectors import wrap_angle
from driftlab.earth import EARTH_RATE
from driftlab.gyrocompass.inertial_alignment import InertialAlignment, align_in_inertial_frame
from driftlab.recordings.recording import Recording

from .example import OPTIONS
from .findings import Curve, Findings, Plot, Table
from .numbers import DEG_PER_HOUR, DEGREES, Unit, with_deviation, written
from .progress import Steps
from .record import moments, record_plots
from .stretches import FOUND, STRETCHES, Spread, aligned
from .trust import SLACK, Trust, doubts, drift_in_words, trust

STEPS = 2
EXAMPLE = (
    "python -m driftlab example log.csv\n"
    f"python -m driftlab align log.csv {OPTIONS}"
    " --axes FRD --latitude 59.9 --end 60"
)


def add_options(parser: argparse.ArgumentParser) -> None:
    """It has only the options that all commands have."""


def find(recording: Recording, options: argparse.Namespace, step: Steps) -> Findings:
    """Align a record, and say how far it can be believed."""
    if not recording.axes:
        raise ValueError("--axes: expected the body axes, FRD say, because a heading needs them.")
    step("align")
    spread = aligned(recording)
    swaying, why_not = (None, "") if spread.biased else _in_inertial_space(recording)
    known = trust(recording, spread, swaying)
    rows = [] if spread.blind else _heading_rows(spread.whole.heading, known.of_means)
    rows += _level_rows(recording, spread)
    tables = [Table("From the means of the record", HEAD, tuple(rows), NOTE)]
    sentences = [spread.blind or _in_words(spread, known), why_not]
    if swaying is not None:
        tables.append(_inertial_table(swaying, known))
        sentences += _compared(spread, swaying, known)
    if known.drift is not None:
        sentences.append(drift_in_words(known))
    step("plots")
    return Findings(
        "Alignment at rest",
        tuple(tables),
        tuple(filter(None, sentences)),
        tuple(doubts(recording, spread, known)),
        _plots(recording, spread),
        values=_values(spread, swaying, known),
        columns=_columns(recording, spread),
    )


HEAD = ("", "value", "deviation", "unit")
NOTE = (
    f"Deviations are those of a mean, from {STRETCHES} stretches of the record aligned alone; what "
    "stays the same in all of them, as a bias of an accelerometer, is not in them. That of the "
    "heading is the larger of this one and what the Earth's rate shows of a drift of the gyros."
)


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


def _inertial_table(found: InertialAlignment, known: Trust) -> Table:
    rows = _heading_rows(found.heading, known.in_inertial_space)
    rows += [
        _row("pitch, bow up", found.pitch, known.tilt),
        _row("roll, right side down", found.roll, known.tilt),
        _row("level rate found", found.level_rate, None, DEG_PER_HOUR),
    ]
    note = (
        "The base may sway; the angles are those at the end, with half of the record's drift in "
        "pitch and roll. A bias turns the heading as it does that of the means."
    )
    return Table("From gravity in inertial space", HEAD, tuple(rows), note)


def _compared(spread: Spread, found: InertialAlignment, known: Trust) -> list[str]:
    """Whether both ways give one heading, and one level."""
    if spread.blind:
        shown, _, _ = with_deviation(
            float(compass(found.heading)), known.in_inertial_space, DEGREES
        )
        return [
            f"By gravity in inertial space the bow points to {shown} degrees of a compass card."
        ]
    apart = abs(float(wrap_angle(found.heading - spread.whole.heading)))
    noise = float(np.hypot(found.deviation, spread.deviation.heading))
    shown = written(np.degrees(apart), digits=2)
    if apart <= 3 * noise:
        words = [
            f"The two headings differ by {shown} degrees, which noise explains; a bias, common to "
            "both, does not show in that."
        ]
    elif apart <= known.turn:
        words = [
            f"The two headings differ by {shown} degrees, more than noise explains, but no more "
            "than a drift of the gyros may."
        ]
    else:
        words = [
            f"The two headings differ by {shown} degrees, more than noise explains: the base has "
            "moved. Means take its turning for the Earth's; trust the heading in inertial space."
        ]
    tilt = max(
        abs(float(found.pitch - spread.whole.pitch)), abs(float(found.roll - spread.whole.roll))
    )
    if tilt > SLACK:
        words.append(
            f"Their levels differ by {written(np.degrees(tilt), digits=2)} degrees: the base has "
            "leaned, or the gyros' drift has summed up. Of a base at rest believe the means."
        )
    return words


def _level_rows(recording: Recording, spread: Spread) -> list[tuple[str, ...]]:
    whole, deviation = spread.whole, spread.deviation
    rows: list[tuple[str, ...]] = [
        _row("pitch, bow up", whole.pitch, deviation.pitch),
        _row("roll, right side down", whole.roll, deviation.roll),
    ]
    if not spread.blind:
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


def _in_words(spread: Spread, known: Trust) -> str:
    heading = float(compass(spread.whole.heading))
    shown, _, _ = with_deviation(heading, known.of_means, DEGREES)
    return (
        f"The bow points to {shown} degrees of a compass card, which counts from North through "
        "East."
    )


def _plots(recording: Recording, spread: Spread) -> tuple[Plot, ...]:
    if spread.blind:
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


def _values(spread: Spread, swaying: InertialAlignment | None, known: Trust) -> dict[str, Any]:
    values: dict[str, Any] = {
        name: {"value": getattr(spread.whole, name), "deviation": getattr(spread.deviation, name)}
        for name in (("pitch", "roll") if spread.blind else FOUND)
    }
    if not spread.blind:
        values["heading"]["deviation"] = known.of_means
        values["heading_noise_deviation"] = spread.deviation.heading
        values["compass_heading"] = {
            "value": compass(spread.whole.heading),
            "deviation": known.of_means,
        }
    if known.drift is not None:
        values["heading_bias_deviation"] = known.turn
        values["gyro_drift_deviation"] = known.drift
    if swaying is not None:
        values["in_inertial_space"] = {
            "heading": swaying.heading,
            "compass_heading": compass(swaying.heading),
            "deviation": known.in_inertial_space,
            "noise_deviation": swaying.deviation,
            "pitch": swaying.pitch,
            "roll": swaying.roll,
            "tilt_deviation": known.tilt,
        }
    return {**values, "mean_rate_fur": spread.rate.mean(axis=0), "earth_seen": not spread.biased}


def _columns(recording: Recording, spread: Spread) -> dict[str, Any]:
    """The stretches one by one."""
    parts, columns = spread.parts, {"time_s": _middles(recording)}
    if not spread.blind:
        columns["compass_heading_deg"] = np.degrees(compass(parts.heading))
        columns["latitude_deg"] = np.degrees(parts.latitude)
        columns["level_rate_deg_per_h"] = parts.level_rate / DEG_PER_HOUR.size
    angles = {"pitch_deg": np.degrees(parts.pitch), "roll_deg": np.degrees(parts.roll)}
    return {**columns, **angles}

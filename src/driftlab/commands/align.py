"""``python -m driftlab align``: heading, pitch and roll of a unit at rest."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import Any

import numpy as np

from driftlab.checks import FloatArray
from driftlab.conventions import mirror_heading
from driftlab.core.vectors import wrap_angle
from driftlab.earth import EARTH_RATE, gravity
from driftlab.gyrocompass._contradictions import sign_slip
from driftlab.gyrocompass.inertial_alignment import InertialAlignment
from driftlab.increments import Increments
from driftlab.recordings.recording import Recording

from .at_rest import FOUND, NO_INERTIAL, STRETCHES, AtRest, Samples, at_rest
from .example import OPTIONS
from .findings import Curve, Findings, Plot, Table
from .numbers import DEG_PER_HOUR, DEGREES, Unit, with_deviation, written
from .progress import Steps
from .record import forces, moments, moved_at, rates, record_plots

STEPS = 2
EXAMPLE = (
    "python -m driftlab example log.csv\n"
    f"python -m driftlab align log.csv {OPTIONS}"
    " --axes FRD --latitude 59.9 --end 60"
)
HEAD = ("", "value", "deviation", "unit")
NOTE = (
    f"Deviations are those of a mean, from {STRETCHES} stretches of the record aligned alone; what "
    "stays the same in all of them, as a bias of an accelerometer, is not in them. That of the "
    "heading is the larger of this one and what the Earth's rate shows of a drift of the gyros."
)
SWAYING_NOTE = (
    "The base may sway; the angles are those at the end, with half of the record's drift in "
    "pitch and roll. A bias turns the heading as it does that of the means."
)
SLACK = np.radians(0.1)
"""What an angle may differ without a word: deflections, places told roughly."""
UPSIDE_DOWN, STEEP = np.radians([90.0, 60.0])
"""Roll and pitch beyond which the axes told are doubted: few units are mounted so."""
WITHIN = 4.3
"""Of a deviation that stands on two numbers, for 95 errors in 100: Student's distribution."""


def find(recording: Recording, options: argparse.Namespace, step: Steps) -> Findings:
    """Align a record, and say how far it can be believed."""
    if not recording.axes:
        raise ValueError("--axes: expected the body axes, FRD say, because a heading needs them.")
    if len(recording) < STRETCHES:
        raise ValueError(f"log: expected at least {STRETCHES} rows, got {len(recording)}.")
    step("align")
    known = recording.in_axes("FUR")
    increments, why_not = _increments(known)
    samples = Samples(
        times=moments(known),
        rate=rates(known),
        force=forces(known),
        increments=increments,
        why_not=why_not,
        moved=moved_at(known),
        duration=known.duration,
        latitude=known.latitude,
        gravity=known.gravity,
        axes=recording.axes,
    )
    found = at_rest(samples)
    step("plots")
    return Findings(
        "Alignment at rest",
        tuple(_tables(found)),
        tuple(filter(None, _sentences(found))),
        () if samples.moved is not None else tuple(_doubts(found)),
        (*record_plots(recording), *_plots(found)),
        values=_values(found),
        columns=_columns(found),
    )


def _increments(known: Recording) -> tuple[Increments | None, str]:
    """What gravity in inertial space is found from, or why it cannot be."""
    if known.latitude is None:
        return None, (
            "With the latitude told (--latitude) the heading can also be found on a base that "
            "sways, by gravity in inertial space."
        )
    try:
        return known.increments(), ""
    except ValueError as error:
        return None, f"{NO_INERTIAL}{error}"


def compass(heading: Any) -> FloatArray:
    """A heading of the book as a compass card has it, from North to East, 0 to 2 pi."""
    return np.mod(mirror_heading(heading), 2 * np.pi)


def _tables(found: AtRest) -> Iterator[Table]:
    whole, deviation, told = found.whole, found.deviation, found.samples.latitude
    rows = [] if found.blind else _heading_rows(whole.heading, found.of_means)
    rows += [
        _row("pitch, bow up", whole.pitch, deviation.pitch),
        _row("roll, right side down", whole.roll, deviation.roll),
    ]
    if not found.blind:
        rows.append(_row("latitude found", whole.latitude, deviation.latitude))
        if told is not None:
            rows.append(_row("latitude told", told))
        rows.append(_row("level rate found", whole.level_rate, deviation.level_rate, DEG_PER_HOUR))
        if told is not None:
            level = EARTH_RATE * np.cos(told)
            rows.append(_row("level rate of the Earth there", level, None, DEG_PER_HOUR))
    rows += [
        _row("whole rate found", np.linalg.norm(found.rate), None, DEG_PER_HOUR),
        _row("whole rate of the Earth", EARTH_RATE, None, DEG_PER_HOUR),
    ]
    yield Table("From the means of the record", HEAD, tuple(rows), NOTE)
    swaying = found.swaying
    if swaying is not None:
        rows = [
            *_heading_rows(swaying.heading, found.in_inertial_space),
            _row("pitch, bow up", swaying.pitch, found.tilt),
            _row("roll, right side down", swaying.roll, found.tilt),
            _row("level rate found", swaying.level_rate, None, DEG_PER_HOUR),
        ]
        yield Table("From gravity in inertial space", HEAD, tuple(rows), SWAYING_NOTE)


def _heading_rows(heading: Any, deviation: Any) -> list[tuple[str, ...]]:
    return [
        _row("heading as on a compass card, from North to East", compass(heading), deviation),
        _row("heading as in the book, from North to West", heading, deviation),
    ]


def _row(name: str, value: Any, deviation: Any = None, unit: Unit = DEGREES) -> tuple[str, ...]:
    return (name, *with_deviation(float(value), deviation, unit))


def _sentences(found: AtRest) -> Iterator[str]:
    yield found.blind or (
        f"The bow points to {_points_to(found.whole.heading, found.of_means)} degrees of a compass "
        "card, which counts from North through East."
    )
    yield found.why_not
    if found.swaying is not None:
        yield from _compared(found, found.swaying)
    if found.drift is not None:
        shown = written(found.drift / DEG_PER_HOUR.size, digits=2)
        source = (
            "Level and upwards the rates differ from the Earth's by"
            if found.rates == 2
            else "The one rate that can be checked differs from the Earth's by"
        )
        yield (
            f"{source} {shown} deg/h{' (root mean square)' * (found.rates == 2)}. A drift of that "
            f"size across the meridian turns the heading by {_degrees(found.turn)} degrees, and "
            "nothing shows it."
        )


def _points_to(heading: Any, deviation: float) -> str:
    return with_deviation(float(compass(heading)), deviation, DEGREES)[0]


def _degrees(angle: float) -> str:
    return written(np.degrees(angle), digits=2)


def _compared(found: AtRest, swaying: InertialAlignment) -> Iterator[str]:
    """Whether both ways give one heading, and one level."""
    whole = found.whole
    if found.blind:
        shown = _points_to(swaying.heading, found.in_inertial_space)
        yield f"By gravity in inertial space the bow points to {shown} degrees of a compass card."
        return
    apart = abs(float(wrap_angle(swaying.heading - whole.heading)))
    noise = float(np.hypot(swaying.deviation, found.deviation.heading))
    differ = f"The two headings differ by {_degrees(apart)} degrees,"
    if apart <= 3 * noise:
        yield f"{differ} which noise explains; a bias, common to both, does not show in that."
    elif apart <= found.turn:
        yield f"{differ} more than noise explains, but no more than a drift of the gyros may."
    else:
        yield (
            f"{differ} more than noise explains: the base has moved. Means take its turning for "
            "the Earth's; trust the heading in inertial space."
        )
    tilt = max(abs(float(swaying.pitch - whole.pitch)), abs(float(swaying.roll - whole.roll)))
    if tilt > SLACK:
        yield (
            f"Their levels differ by {_degrees(tilt)} degrees: the base has leaned, or the gyros' "
            "drift has summed up. Of a base at rest believe the means."
        )


def _doubts(found: AtRest) -> Iterator[str]:
    """What the record says against itself."""
    told, pitch, roll = found.samples, float(found.whole.pitch), float(found.whole.roll)
    if abs(roll) > UPSIDE_DOWN or abs(pitch) > STEEP:
        how = "steeply" if abs(pitch) > STEEP else "upside down"
        yield (
            f"the unit lies {how}: pitch {np.degrees(pitch):.0f}, roll {np.degrees(roll):.0f} "
            f"degrees. If it did not, its axes are not {told.axes}, or the accelerometers "
            "have the other sign."
        )
    if not found.blind and told.latitude is not None:
        slip = sign_slip(float(found.whole.latitude), told.latitude, "--latitude")
        if slip:
            yield f"{slip}."
    if found.rates == 2 and found.turn > max(3 * found.deviation.heading, SLACK):
        bound = WITHIN * found.turn
        least = f"to less than {_degrees(bound)} degrees" if np.degrees(bound) < 90 else "at all"
        yield (
            "the gyros' rates differ from the Earth's by more than noise explains. Do not trust "
            f"the heading {least}: two rates tell little of the drift of a third, and its "
            f"error exceeds {WITHIN} deviations once in twenty times. Gyros with biases, or in "
            "another order or with other signs than the accelerometers, look like this."
        )
    pull = told.gravity
    if pull is None and told.latitude is not None:
        pull = float(gravity(told.latitude))
    size = float(np.linalg.norm(found.force))
    if pull is not None and abs(size / pull - 1) > 0.02:
        yield (
            f"the accelerometers show {written(size, digits=4)} m/s^2 at rest, and gravity is "
            f"{written(pull, digits=4)} m/s^2."
        )


def _plots(found: AtRest) -> Iterator[Plot]:
    if found.blind:
        return
    off = np.degrees(wrap_angle(found.whole.heading - found.parts.heading))
    curves = (
        Curve("one stretch alone", found.times, off, marker="o"),
        Curve("the whole", found.times, np.zeros_like(found.times), dashed=True),
    )
    title = "Heading of each stretch, less that of the whole"
    yield Plot(title, "time, s", "deg, to the East", curves)


def _values(found: AtRest) -> dict[str, Any]:
    values: dict[str, Any] = {
        name: {"value": getattr(found.whole, name), "deviation": getattr(found.deviation, name)}
        for name in (("pitch", "roll") if found.blind else FOUND)
    }
    if not found.blind:
        values["heading"]["deviation"] = found.of_means
        values["heading_noise_deviation"] = found.deviation.heading
        values["compass_heading"] = {
            "value": compass(found.whole.heading),
            "deviation": found.of_means,
        }
    if found.drift is not None:
        values["heading_bias_deviation"] = found.turn
        values["gyro_drift_deviation"] = found.drift
    swaying = found.swaying
    if swaying is not None:
        values["in_inertial_space"] = {
            "heading": swaying.heading,
            "compass_heading": compass(swaying.heading),
            "deviation": found.in_inertial_space,
            "noise_deviation": swaying.deviation,
            "pitch": swaying.pitch,
            "roll": swaying.roll,
            "tilt_deviation": found.tilt,
        }
    return {**values, "mean_rate_fur": found.rate, "earth_seen": not found.biased}


def _columns(found: AtRest) -> dict[str, Any]:
    """The stretches one by one."""
    parts, columns = found.parts, {"time_s": found.times}
    if not found.blind:
        columns["compass_heading_deg"] = np.degrees(compass(parts.heading))
        columns["latitude_deg"] = np.degrees(parts.latitude)
        columns["level_rate_deg_per_h"] = parts.level_rate / DEG_PER_HOUR.size
    angles = {"pitch_deg": np.degrees(parts.pitch), "roll_deg": np.degrees(parts.roll)}
    return {**columns, **angles}

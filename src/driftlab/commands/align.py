"""``python -m driftlab align``: heading, pitch and roll of a unit at rest."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np
from scipy.constants import degree, hour

from driftlab.checks import FloatArray
from driftlab.core.vectors import wrap_angle
from driftlab.earth import EARTH_RATE, gravity
from driftlab.frames import _pitch_and_roll
from driftlab.gyrocompass._contradictions import NOTHING_KNOWN, rate_contradiction, sign_slip
from driftlab.gyrocompass.alignment import Alignment, align
from driftlab.gyrocompass.inertial_alignment import InertialAlignment, align_in_inertial_frame
from driftlab.recordings.recording import Recording

from .example import OPTIONS
from .findings import DEG_PER_HOUR, DEGREES, Curve, Findings, Plot, Step, Table, Unit, written
from .record import forces, moments, moved_at, rates, record_plots

STEPS = 2
EXAMPLE = (
    "python -m driftlab example log.csv\n"
    f"python -m driftlab align log.csv {OPTIONS}"
    " --axes FRD --latitude 59.9 --end 60"
)
STRETCHES = 10  # the record is aligned in as many parts too
FOUND = Alignment._fields[:5]  # four angles and the level rate
# A drift that may turn a heading farther leaves the deviation of one of which nothing is known.
MOST = np.radians(60.0)
SLIPS = {
    1 / degree: "degrees taken for radians",
    degree: "radians taken for degrees",
    hour: "deg/h taken for deg/s",
    1 / hour: "deg/s taken for deg/h",
}  # by the factor that they make of a rate
CLOSE = 1.1  # a factor so near to that of a slip may be it
SLACK = np.radians(0.1)  # what an angle may differ without a word: deflections, places told roughly
# Roll and pitch beyond which the axes told are doubted: few units are mounted so.
UPSIDE_DOWN, STEEP = np.radians([90.0, 60.0])
WITHIN = 4.3  # deviations, for 95 errors in 100: Student's distribution with two numbers
LEVELS = "Pitch and roll come from the accelerometers."
NOTE = (
    f"Deviations are those of a mean, from {STRETCHES} stretches of the record aligned alone; what "
    "stays the same in all of them, as a bias of an accelerometer, is not in them. That of the "
    "heading is the larger of this one and what the Earth's rate shows of a drift of the gyros."
)
SWAYING_NOTE = (
    "The base may sway; the angles are those at the end, with half of the record's drift in "
    "pitch and roll. A bias turns the heading as it does that of the means."
)


class AtRest:
    """What a record at rest says of its attitude, by its means and by gravity in inertial space.

    The scatter of its stretches says how far noise leaves the means known, and the Earth's own rate
    what a drift of the gyros may do to the heading. SI and radians.
    """

    def __init__(self, record: Recording) -> None:
        """Align a record, in body axes forward, up, right."""
        self.record, self.moved = record, moved_at(record)
        rows = moments(record), rates(record), forces(record)
        stretches = [[part.mean(axis=0) for part in np.array_split(x, STRETCHES)] for x in rows]
        self.times, rate, force = map(np.stack, stretches)  # times (10,) are middles
        self.rate = rate.mean(axis=0)
        # Why the means give no heading; and whether that is the gyros' own fault, or the unit was
        # moved, so that no other method mends it.
        self.blind, self.biased = _blindness(rate, self.moved)
        # The command says in its own words how far the rates can be trusted.
        method = _levelled if self.blind else partial(align, heading_tolerance=np.inf)
        # Where the gyros do not see the Earth all but pitch and roll is NaN.
        self.whole, self.parts = method(*(x.mean(axis=0) for x in rows[1:])), method(rate, force)
        scatter = [getattr(self.parts, name) - getattr(self.whole, name) for name in FOUND]
        scatter[:4] = map(wrap_angle, scatter[:4])
        deviation = [np.sqrt((x**2).sum() / (STRETCHES - 1) / STRETCHES) for x in scatter]
        self.deviation = Alignment(*deviation)
        # By gravity in inertial space; or in a sentence why not.
        self.swaying, self.why_not = (None, "") if self.biased else _in_inertial_space(record)
        self.drift, self.turn = self._drift()
        # Deviations: of the headings the larger of noise and drift; of pitch and roll at the end
        # what the drift makes of them from the middle of the record.
        self.of_means = max(self.turn, float(self.deviation.heading))
        noise = np.nan if self.swaying is None else float(self.swaying.deviation)
        self.in_inertial_space = max(self.turn, noise)
        self.tilt = self.drift * record.duration / 2

    def _drift(self) -> tuple[float, float]:
        """Deviation of the gyros' drift, rad/s, and what that makes of the heading, rad.

        The first is from the rates that the Earth's are known for, the second for a drift across
        the meridian, and at most that of no knowledge. NaN where there is no heading.
        """
        latitude = self.record.latitude
        if not self.blind:
            level = self.whole.level_rate
            seen = rate_contradiction(level, level * np.tan(self.whole.latitude), latitude)
        elif self.swaying is not None:
            seen = rate_contradiction(self.swaying.level_rate, latitude=latitude)
        else:
            return np.nan, np.nan
        doubt = float(seen.heading_uncertainty)
        return float(seen.spurious_rate), NOTHING_KNOWN if doubt > MOST else doubt


def find(recording: Recording, options: argparse.Namespace, step: Step) -> Findings:
    """Align a record, and say how far it can be believed."""
    if not recording.axes:
        raise ValueError("--axes: expected the body axes, FRD say, because a heading needs them.")
    if len(recording) < STRETCHES:
        raise ValueError(f"log: expected at least {STRETCHES} rows, got {len(recording)}.")
    step("align")
    found = AtRest(recording.in_axes("FUR"))
    step("plots")
    return Findings(
        "Alignment at rest",
        tuple(_tables(found)),
        tuple(filter(None, _sentences(found))),
        tuple(_doubts(found, recording.axes)) if found.moved is None else (),
        (*record_plots(recording), *_plots(found)),
        values=_values(found),
        columns=_columns(found),
    )


def _levelled(rate: FloatArray, force: FloatArray) -> Alignment:
    """Pitch and roll alone."""
    pitch, roll = _pitch_and_roll(force / np.linalg.norm(force, axis=-1, keepdims=True))
    unknown = np.full(np.shape(pitch), np.nan)
    return Alignment(unknown, pitch, roll, unknown, unknown)


def _in_inertial_space(record: Recording) -> tuple[InertialAlignment | None, str]:
    """The alignment that lets the base sway, or why there is none."""
    if record.latitude is None:
        return None, (
            "With the latitude told (--latitude) the heading can also be found on a base that "
            "sways, by gravity in inertial space."
        )
    try:
        return align_in_inertial_frame(record.increments(), record.latitude), ""
    except ValueError as error:
        return None, f"Gravity in inertial space gives no heading: {error}"


def _blindness(rate: FloatArray, moved: float | None) -> tuple[str, bool]:
    """Why means (n, 3) of gyros do not see the Earth turn, and whether no other method mends that.

    Empty and False if they see it.
    """
    if moved is not None:
        return (
            f"No heading: the unit was moved at {moved:.6g} s. Choose a stretch at rest by --begin "
            "and --end; pitch and roll, too, are means over all that it did."
        ), True
    found = float(np.linalg.norm(rate.mean(axis=0)))
    noise = float(rate.std(axis=0, ddof=1).max() / np.sqrt(len(rate)))
    shown, earth, spread = (DEG_PER_HOUR.text(x, digits=4) for x in (found, EARTH_RATE, noise))
    # Such a rate has an error at least as large as the difference: half the Earth's rate may turn
    # the heading by half a radian and more.
    if abs(found - EARTH_RATE) > max(EARTH_RATE / 2, 3 * noise):
        return (
            f"No heading: at rest the gyros show {shown} deg/h, and the Earth turns by {earth} "
            f"deg/h. {_reason(found / EARTH_RATE)} {LEVELS}"
        ), True
    if noise > EARTH_RATE / 5:
        return (
            f"No heading from the means: they are known to {spread} deg/h only, and the Earth "
            f"turns by {earth} deg/h. The base was not still, or the record is too short for such "
            f"gyros. {LEVELS}"
        ), False
    return "", False


def _reason(factor: float) -> str:
    """What makes a rate wrong by a factor."""
    reason = "the logger has taken the bias off already, and with it the Earth's rate."
    if factor > 1:
        reason = (
            "their biases hide it; a compass needs gyros whose biases are a small part of the "
            "Earth's rate."
        )
    slips = [slip for one, slip in SLIPS.items() if 1 / CLOSE < factor / one < CLOSE]
    if not slips:
        return reason[0].upper() + reason[1:]
    ratio = f"{factor:.3g} times" if factor > 1 else f"1/{1 / factor:.3g} of"
    return f"That is {ratio} the Earth's rate: {slips[0]}? Or {reason}"


def _compass(heading: Any) -> FloatArray:
    """A heading of the book as a compass card has it, from North to East, 0 to 2 pi."""
    return np.mod(wrap_angle(-heading), 2 * np.pi)


def _tables(found: AtRest) -> Iterator[Table]:
    whole, deviation, latitude = found.whole, found.deviation, found.record.latitude
    told = np.nan if found.blind or latitude is None else latitude
    yield _table(
        "From the means of the record",
        NOTE,
        [
            *_heading_rows(whole.heading, found.of_means),
            ("pitch, bow up", whole.pitch, deviation.pitch, DEGREES),
            ("roll, right side down", whole.roll, deviation.roll, DEGREES),
            ("latitude found", whole.latitude, deviation.latitude, DEGREES),
            ("latitude told", told, None, DEGREES),
            ("level rate found", whole.level_rate, deviation.level_rate, DEG_PER_HOUR),
            ("level rate of the Earth there", EARTH_RATE * np.cos(told), None, DEG_PER_HOUR),
            ("whole rate found", float(np.linalg.norm(found.rate)), None, DEG_PER_HOUR),
            ("whole rate of the Earth", EARTH_RATE, None, DEG_PER_HOUR),
        ],
    )
    if (swaying := found.swaying) is not None:
        yield _table(
            "From gravity in inertial space",
            SWAYING_NOTE,
            [
                *_heading_rows(swaying.heading, found.in_inertial_space),
                ("pitch, bow up", swaying.pitch, found.tilt, DEGREES),
                ("roll, right side down", swaying.roll, found.tilt, DEGREES),
                ("level rate found", swaying.level_rate, None, DEG_PER_HOUR),
            ],
        )


def _table(title: str, note: str, rows: list[tuple[str, Any, Any, Unit]]) -> Table:
    """Values and their deviations; what is not known (NaN) is left out."""
    shown = [
        (
            name,
            unit.text(float(value), deviation),
            "" if deviation is None else unit.text(deviation, deviation),
            unit.name,
        )
        for name, value, deviation, unit in rows
        if not np.isnan(value)
    ]
    return Table(title, ("", "value", "deviation", "unit"), tuple(shown), note)


def _heading_rows(heading: Any, deviation: float) -> list[tuple[str, Any, Any, Unit]]:
    return [
        ("heading as on a compass card, from North to East", _compass(heading), deviation, DEGREES),
        ("heading as in the book, from North to West", heading, deviation, DEGREES),
    ]


def _sentences(found: AtRest) -> Iterator[str]:
    shown = DEGREES.text(float(_compass(found.whole.heading)), found.of_means)
    yield found.blind or (
        f"The bow points to {shown} degrees of a compass card, which counts from North through "
        "East."
    )
    yield found.why_not
    if found.swaying is not None:
        yield from _compared(found, found.swaying)
    if not np.isnan(found.drift):
        both = not found.blind and found.record.latitude is not None
        source = (
            "Level and upwards the rates differ"
            if both
            else "The one rate that can be checked differs"
        )
        yield (
            f"{source} from the Earth's by {DEG_PER_HOUR.text(found.drift, digits=2)} deg/h"
            f"{' (root mean square)' * both}. A drift of that size across the meridian turns the "
            f"heading by {_degrees(found.turn)} degrees, and nothing shows it."
        )


def _degrees(angle: float) -> str:
    return DEGREES.text(angle, digits=2)


def _compared(found: AtRest, swaying: InertialAlignment) -> Iterator[str]:
    """Whether both ways give one heading, and one level."""
    whole = found.whole
    if found.blind:
        shown = DEGREES.text(float(_compass(swaying.heading)), found.in_inertial_space)
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


def _doubts(found: AtRest, axes: str) -> Iterator[str]:
    """What the record says against itself."""
    pitch, roll = float(found.whole.pitch), float(found.whole.roll)
    latitude, pull = found.record.latitude, found.record.gravity
    if abs(roll) > UPSIDE_DOWN or abs(pitch) > STEEP:
        how = "steeply" if abs(pitch) > STEEP else "upside down"
        yield (
            f"the unit lies {how}: pitch {np.degrees(pitch):.0f}, roll {np.degrees(roll):.0f} "
            f"degrees. If it did not, its axes are not {axes}, or the accelerometers "
            "have the other sign."
        )
    if latitude is not None and not found.blind:
        if slip := sign_slip(float(found.whole.latitude), latitude, "--latitude"):
            yield f"{slip}."
        if found.turn > max(3 * found.deviation.heading, SLACK):
            bound = WITHIN * found.turn
            least = f"to less than {_degrees(bound)} degrees" if bound < np.pi / 2 else "at all"
            yield (
                "the gyros' rates differ from the Earth's by more than noise explains. Do not "
                f"trust the heading {least}: two rates tell little of the drift of a third, and "
                f"its error exceeds {WITHIN} deviations once in twenty times. Gyros with biases, "
                "or in another order or with other signs than the accelerometers, look like this."
            )
    if latitude is not None and pull is None:
        pull = float(gravity(latitude))
    size = float(np.linalg.norm(forces(found.record).mean(axis=0)))
    if pull is not None and abs(size / pull - 1) > 0.02:
        yield (
            f"the accelerometers show {written(size, digits=4)} m/s^2 at rest, and gravity is "
            f"{written(pull, digits=4)} m/s^2."
        )


def _plots(found: AtRest) -> Iterator[Plot]:
    if not found.blind:
        off = np.degrees(wrap_angle(found.whole.heading - found.parts.heading))
        alone = Curve("one stretch alone", found.times, off, marker="o")
        whole = Curve("the whole", found.times, np.zeros_like(found.times), dashed=True)
        title = "Heading of each stretch, less that of the whole"
        yield Plot(title, "time, s", "deg, to the East", (alone, whole))


def _values(found: AtRest) -> dict[str, Any]:
    whole, deviation, swaying = found.whole, found.deviation, found.swaying
    values: dict[str, Any] = {
        name: {"value": getattr(whole, name), "deviation": getattr(deviation, name)}
        for name in (("pitch", "roll") if found.blind else FOUND)
    }
    if not found.blind:
        values["heading"]["deviation"] = found.of_means
        values["heading_noise_standard_deviation"] = deviation.heading
        values["compass_heading"] = values["heading"] | {"value": _compass(whole.heading)}
    if not np.isnan(found.drift):
        values["heading_bias_standard_deviation"] = found.turn
        values["gyro_drift_standard_deviation"] = found.drift
    if swaying is not None:
        values["in_inertial_space"] = {
            "heading": swaying.heading,
            "compass_heading": _compass(swaying.heading),
            "deviation": found.in_inertial_space,
            "noise_standard_deviation": swaying.deviation,
            "pitch": swaying.pitch,
            "roll": swaying.roll,
            "tilt_standard_deviation": found.tilt,
        }
    return {**values, "mean_rate_fur": found.rate, "earth_rate_sensed": not found.biased}


def _columns(found: AtRest) -> dict[str, Any]:
    """The stretches one by one."""
    parts = found.parts
    columns = {
        "time_s": found.times,
        "compass_heading_deg": np.degrees(_compass(parts.heading)),
        "latitude_deg": np.degrees(parts.latitude),
        "level_rate_deg_per_h": parts.level_rate / DEG_PER_HOUR.size,
        "pitch_deg": np.degrees(parts.pitch),
        "roll_deg": np.degrees(parts.roll),
    }
    return {name: column for name, column in columns.items() if not np.isnan(column).all()}

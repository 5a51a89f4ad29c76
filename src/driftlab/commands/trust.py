"""How far the headings of an alignment can be trusted: noise, drift, and what a slip would show."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from driftlab.earth import gravity
from driftlab.gyrocompass.contradictions import NOTHING_KNOWN, rate_contradiction, sign_slip
from driftlab.gyrocompass.inertial_alignment import InertialAlignment
from driftlab.recordings.recording import Recording

from .numbers import DEG_PER_HOUR, written
from .stillness import moved_at
from .stretches import Spread

SLACK = np.radians(0.1)
"""What an angle may differ without a word: deflections, places told roughly."""
UPSIDE_DOWN, STEEP = np.radians([90.0, 60.0])
"""Roll and pitch beyond which the axes told are doubted: few units are mounted so."""
MOST = np.radians(60.0)
"""A drift that may turn a heading farther leaves the deviation of one of which nothing is known."""
WITHIN = 4.3
"""Of a deviation that stands on two numbers, for 95 errors in 100: Student's distribution."""


class Trust(NamedTuple):
    """How far headings are known: the larger of noise and drift, rad.

    Attributes
    ----------
    drift : float or None
        Deviation of the gyros' drift, rad/s, as the rates of the Earth show it that are known; None
        if there is no heading to spoil.
    turn : float
        What such a drift across the meridian makes of the heading, at most that of no knowledge.
    tilt : float
        What it makes of pitch and roll at the end, summed up from the middle of the record.
    of_means, in_inertial_space : float
        Deviations of the headings.
    rates : int
        How many known rates the drift was seen in.
    """

    drift: float | None
    turn: float
    tilt: float
    of_means: float
    in_inertial_space: float
    rates: int


def trust(recording: Recording, spread: Spread, swaying: InertialAlignment | None) -> Trust:
    """What noise and drift leave of the headings."""
    if not spread.blind:
        level = spread.whole.level_rate
        seen = rate_contradiction(level, level * np.tan(spread.whole.latitude), recording.latitude)
    elif swaying is not None and recording.latitude is not None:
        seen = rate_contradiction(swaying.level_rate, latitude=recording.latitude)
    else:
        return Trust(None, 0.0, 0.0, np.nan, np.nan, 0)
    drift = float(seen.spurious_rate)
    turn = NOTHING_KNOWN if seen.heading_doubt > MOST else float(seen.heading_doubt)
    return Trust(
        drift,
        turn,
        drift * recording.duration / 2,
        max(turn, float(spread.deviation.heading)),
        max(turn, np.nan if swaying is None else float(swaying.deviation)),
        1 if spread.blind or recording.latitude is None else 2,
    )


def drift_in_words(known: Trust) -> str:
    """What stands behind the deviation of the heading."""
    assert known.drift is not None
    shown = written(known.drift / DEG_PER_HOUR.size, digits=2)
    source = (
        "Level and upwards the rates differ from the Earth's by"
        if known.rates == 2
        else "The one rate that can be checked differs from the Earth's by"
    )
    return (
        f"{source} {shown} deg/h{' (root mean square)' * (known.rates == 2)}. A drift of that "
        f"size across the meridian turns the heading by "
        f"{written(np.degrees(known.turn), digits=2)} degrees, and nothing shows it."
    )


def doubts(recording: Recording, spread: Spread, known: Trust) -> list[str]:
    """What the record says against itself."""
    if moved_at(recording) is not None:
        return []  # means of several attitudes say nothing
    found = list(_doubts_of_axes(recording, spread))
    if known.rates == 2 and known.turn > max(3 * spread.deviation.heading, SLACK):
        bound = np.degrees(WITHIN * known.turn)
        least = f"to less than {written(bound, digits=2)} degrees" if bound < 90 else "at all"
        found.append(
            "the gyros' rates differ from the Earth's by more than noise explains. Do not trust "
            f"the heading {least}: two rates tell little of the drift of a third, and its "
            f"error exceeds {WITHIN} deviations once in twenty times."
        )
    pull = recording.gravity
    if pull is None and recording.latitude is not None:
        pull = float(gravity(recording.latitude))
    size = float(np.linalg.norm(spread.force.mean(axis=0)))
    if pull is not None and abs(size / pull - 1) > 0.02:
        found.append(
            f"the accelerometers show {written(size, digits=4)} m/s^2 at rest, and gravity is "
            f"{written(pull, digits=4)} m/s^2."
        )
    return found


def _doubts_of_axes(recording: Recording, spread: Spread) -> Iterator[str]:
    """Attitudes and latitudes that a slip of axes or signs would make."""
    pitch, roll = float(spread.whole.pitch), float(spread.whole.roll)
    if abs(roll) > UPSIDE_DOWN or abs(pitch) > STEEP:
        how = "steeply" if abs(pitch) > STEEP else "upside down"
        yield (
            f"the unit lies {how}: pitch {np.degrees(pitch):.0f}, roll {np.degrees(roll):.0f} "
            f"degrees. If it did not, its axes are not {recording.axes}, or the accelerometers "
            "have the other sign."
        )
    if spread.blind or recording.latitude is None:
        return
    slip = sign_slip(float(spread.whole.latitude), recording.latitude, "--latitude")
    if slip:
        yield f"{slip}."

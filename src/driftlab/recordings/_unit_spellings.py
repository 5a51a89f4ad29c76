"""One spelling for the many in which logs and their headers write a unit."""

from __future__ import annotations

import re

_SPELLINGS = (
    (r"[µμ]", "u"),
    (r"milli-?", "m"),
    (r"micro-?", "u"),
    (r"²|\*\*2", "^2"),
    (r"[·⋅]", "*"),
    (r"°|degrees?", "deg"),
    (r"radians?", "rad"),
    (r"met(er|re)s?", "m"),
    (r"arc-?sec(onds?)?", "arcsec"),
    (r"(?<!arc)sec(onds?)?", "s"),
    (r"(hours?|hr)$", "h"),
    (r"/s/s$|/s2$", "/s^2"),
    (r"^(m?)dps$", r"\1deg/s"),
    (r"(?<=g)s$", "*s"),
)


def spelled(text: str) -> str:
    """Return a unit's name as the tables of `driftlab.recordings.units` spell it."""
    name = re.sub(r"\s+", "", text.strip().lower())
    for pattern, usual in _SPELLINGS:
        name = re.sub(pattern, usual, name)
    return name

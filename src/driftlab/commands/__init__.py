"""Your own log: what the package makes of it, by ``python -m driftlab COMMAND log.csv``.

One flow: options make a `Recording`, a command makes `Findings` of it, and these become a table in
the terminal, a page to keep, or a file for another program. Inside are SI units and radians;
degrees are for the eyes only.
"""

COMMANDS = {
    "calibrate": "errors of a unit that was turned by hand from rest to rest, with deviations",
    "allan": "noise of a unit that lies still: Allan deviation and its five terms",
    "align": "heading, pitch and roll of a unit at rest, from its own six sensors",
    "integrate": "attitude over time, from gyros alone",
    "example": "a small log with known errors, to try the others on",
}
"""The words that may follow ``python -m driftlab``, and what each is for."""

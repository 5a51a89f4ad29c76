"""The stretches of a recording in which the unit lay still, and why they count as such.

Where a body lies still its sensors show nothing but their noise. So the windowed deviation of all
six is held against the same at the quietest stretch of the record: the detector of IMU-TK (Tedaldi,
Pretto, Menegatti 2014), with the gyros taken in, as Skog's detectors of stance have them. A hand
lets go slowly and a table rings on: what touches a move is cut off.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import maximum_filter1d

from driftlab.checks import (
    FloatArray,
    UnusualWarning,
    checked_instance,
    finite_number,
    positive_number,
    shown,
)

from .recording import Kind, Recording

_SILENT = 1e-9
"""Deviation, relative to the largest sample of a window, that does not tell rest from motion."""
_LOUDEST = {"gyro": (0.1, "rad/s"), "accelerometer": (1.0, "m/s^2")}
"""Root of the summed variances of a triad, of rates: more than the noise of any, and about what a
running engine shakes into one."""


@dataclass(frozen=True, eq=False)
class StaticIntervals:
    """Rests of a recording, with the reasons.

    Attributes
    ----------
    begin, end : ndarray of int, shape (n,)
        First row of each rest, and the first after it, settling cut off.
    interval : float
        Between the rows, s.
    gyro_noise, accelerometer_noise : float
        Deviation of a sample at the quietest stretch, root of the sum over the triad, in the units
        of the recording; that of the accelerometers is NaN if there are none.
    quietest : int
        Middle row of that stretch, of the gyros.
    window, multiple, trim, shortest : float
        As in `static_intervals`.
    loudest : ndarray, shape (n,)
        Largest windowed deviation within each rest, as a multiple of the noise.
    too_short : tuple of (int, int)
        Rows of what was quiet, but not for long enough.
    alternatives : tuple of (float, int)
        Other multiples, and how many rests these would have found.
    kind : {"rates", "increments"}
        Of the recording.
    """

    begin: np.ndarray
    end: np.ndarray
    interval: float
    gyro_noise: float
    accelerometer_noise: float
    quietest: int
    window: float
    multiple: float
    trim: float
    shortest: float
    loudest: FloatArray
    too_short: tuple[tuple[int, int], ...]
    alternatives: tuple[tuple[float, int], ...]
    kind: Kind = "rates"

    def __len__(self) -> int:
        return len(self.begin)

    @property
    def rows(self) -> list[tuple[int, int]]:
        """First row of each rest, and the first after it."""
        return [(int(b), int(e)) for b, e in zip(self.begin, self.end, strict=True)]

    @property
    def durations(self) -> FloatArray:
        """Length of each rest (n,), s."""
        return (self.end - self.begin) * self.interval

    @property
    def why(self) -> str:
        """What was found, and by which rule, in a few sentences."""
        turn, force = ("rad/s", "m/s^2") if self.kind == "rates" else ("rad", "m/s")
        noise = f"gyros {self.gyro_noise:.3g} {turn}"
        if np.isfinite(self.accelerometer_noise):
            noise += f", accelerometers {self.accelerometer_noise:.3g} {force}"
        others = ", ".join(f"{count} with {multiple:g}" for multiple, count in self.alternatives)
        one = len(self) == 1
        return (
            f"{len(self)} {'rest' if one else 'rests'}: stretches in which no window of "
            f"{self.window:g} s scatters by more than {self.multiple:g} times the noise of the "
            f"quietest window ({noise}, about {self.quietest * self.interval:.1f} s), less "
            f"{self.trim:g} s at each end for settling, if {self.shortest:g} s are left. "
            f"{len(self.too_short)} quiet stretches were too short. "
            f"Other multiples would find: {others}."
        )

    def __repr__(self) -> str:
        lines = [self.why, "rest   from s     to s   length s   loudest, times the noise"]
        for number, ((begin, end), loudest) in enumerate(zip(self.rows, self.loudest, strict=True)):
            lines.append(
                f"{number:4d} {begin * self.interval:8.2f} {end * self.interval:8.2f} "
                f"{(end - begin) * self.interval:10.2f} {loudest:10.1f}"
            )
        for begin, end in self.too_short:
            lines.append(
                f"   - {begin * self.interval:8.2f} {end * self.interval:8.2f} "
                f"{(end - begin) * self.interval:10.2f}   too short"
            )
        return "\n".join(lines)


def static_intervals(
    recording: Recording,
    *,
    window: float = 1.0,
    multiple: float = 20.0,
    trim: float | None = None,
    shortest: float = 0.5,
) -> StaticIntervals:
    """Find the stretches in which a unit lay still.

    Parameters
    ----------
    recording : Recording
        Rates or increments; the accelerometers take part if there are any.
    window : float
        Over which samples scatter, s. Longer windows miss short rests, shorter ones take the top of
        a slow swing for one.
    multiple : float
        How much more a rest may scatter than the quietest window of the record. A hand that holds
        the unit trembles, so it may be a lot; a move scatters by hundreds.
    trim : float, optional
        Cut off each end of a quiet stretch for settling, s; half a window at least, one window if
        not given. The windows that make the stretch may themselves touch a move.
    shortest : float
        Of what is left after that, s.

    Returns
    -------
    StaticIntervals
        At least one; its `why` and its `repr` say what was found and why.

    Raises
    ------
    ValueError
        If the record is shorter than two windows, no rest is left, or a triad shows no noise at
        all, so that there is nothing to measure with.

    Warns
    -----
    UnusualWarning
        If even the quietest window scatters by more than sensors do at rest: then the unit perhaps
        never lay still, and what is found are but its calmer moments.

    Notes
    -----
    A stretch is quiet where, for both triads, the root of the sum of the three windowed variances
    is below `multiple` times its least value in the record.
    A record without any move is a single rest, and so is a steady turn as far as gyros and
    accelerometers can tell: a constant rate scatters as little as none.

    Examples
    --------
    >>> from driftlab.recordings.recording import Recording
    >>> gyro = 1e-3 * np.random.default_rng(1).standard_normal((1500, 3))
    >>> gyro[500:800, 2] += 0.5 * np.sin(np.linspace(0, np.pi, 300))
    >>> found = static_intervals(Recording(gyro, None, 0.01, "rates"))
    >>> found.rows, found.durations
    ([(100, 423), (877, 1400)], array([3.23, 5.23]))
    """
    checked_instance(recording, Recording, "recording")
    seconds, times = positive_number(window, "window"), positive_number(multiple, "multiple")
    if times <= 1:
        raise ValueError(f"multiple: expected more than 1, got {shown(multiple)}.")
    cut = seconds if trim is None else finite_number(trim, "trim")
    if cut < 0.5 * seconds:  # less, and two rests might share rows
        raise ValueError(
            f"trim: expected at least half a window, {seconds / 2:g}, got {shown(trim)}."
        )
    least = positive_number(shortest, "shortest")
    width = max(3, round(seconds / recording.interval))
    if len(recording) < 2 * width:
        raise ValueError(
            f"recording: expected at least two windows of {seconds:g} s, "
            f"got {recording.duration:g} s."
        )
    gyro = _windowed_deviation(recording.gyro, width, "gyro")
    scatter, force_noise = gyro / gyro.min(), np.nan
    if recording.accelerometer is not None:
        force = _windowed_deviation(recording.accelerometer, width, "accelerometer")
        force_noise = float(force.min())
        scatter = np.maximum(scatter, force / force_noise)
    _warn_if_never_still(recording, {"gyro": float(gyro.min()), "accelerometer": force_noise})
    trimmed, wanted = round(cut / recording.interval), max(2, round(least / recording.interval))

    def found(limit: float) -> tuple[list[tuple[int, int]], list[tuple[int, int]]]:
        """Rests, and quiet stretches that are too short."""
        quiet = np.concatenate([[False], scatter < limit, [False]]).astype(int)
        first, after = np.flatnonzero(np.diff(quiet) == 1), np.flatnonzero(np.diff(quiet) == -1)
        # The windows from the first to the last of a stretch cover `width` - 1 rows more.
        rows = [
            (int(b) + trimmed, int(e) + width - 1 - trimmed)
            for b, e in zip(first, after, strict=True)
        ]
        kept = [(b, e) for b, e in rows if e - b >= wanted]
        apart = trimmed - width // 2  # between the middle of the last window and the cut
        return kept, [(b - apart, e + apart) for b, e in rows if e - b < wanted]

    kept, rejected = found(times)
    if not kept:
        longest = (max((e - b for b, e in rejected), default=0) + width) * recording.interval
        raise ValueError(
            f"recording: expected a rest of {least + 2 * cut:g} s, settling included, in which no "
            f"window of {seconds:g} s scatters by more than {times:g} times the noise of the "
            f"quietest one, got {longest:.2g} s at most: try a larger multiple or a shorter rest."
        )
    return StaticIntervals(
        begin=np.array([b for b, _ in kept]),
        end=np.array([e for _, e in kept]),
        interval=recording.interval,
        gyro_noise=float(gyro.min()),
        accelerometer_noise=force_noise,
        quietest=int(np.argmin(gyro)) + width // 2,
        window=seconds,
        multiple=times,
        trim=cut,
        shortest=least,
        loudest=np.array([_loudest(scatter, b, e, width) for b, e in kept]),
        too_short=tuple(rejected),
        alternatives=tuple((m, len(found(m)[0])) for m in (times / 2, times * 2)),
        kind=recording.kind,
    )


def _windowed_deviation(rows: FloatArray, width: int, name: str) -> FloatArray:
    """Root of the summed variances of a triad in each window that fits, by its first row."""
    # A window is the end of one block and the beginning of the next. Sums that ran along the whole
    # record would bring the rounding of large samples into windows that have none of them.
    count = len(rows) - width + 1
    blocks = np.concatenate([rows, np.zeros((-len(rows) % width, 3))]).reshape(-1, width, 3)
    mean, square = (part[:, ::-1].reshape(-1, 3)[:count] for part in _growing(blocks[:, ::-1]))
    next_mean, next_square = (part.reshape(-1, 3)[width - 1 :][:count] for part in _growing(blocks))
    beyond = np.arange(count)[:, np.newaxis] % width  # rows in the next block
    between = beyond * (width - beyond) / width * (next_mean - mean) ** 2
    square = square + np.where(beyond > 0, next_square, 0.0) + between
    deviation = np.sqrt(np.maximum(square.sum(axis=1) / width, 0.0))
    largest = maximum_filter1d(np.abs(rows).max(axis=1), width)[width // 2 :][:count]
    silent = deviation <= _SILENT * largest
    if silent.any():
        row = int(np.argmax(silent))
        raise ValueError(
            f"recording.{name}: expected noise in every window, got {width} equal rows from row "
            f"{row}: a sensor that hangs, or one too coarse to show its noise in so short a window?"
        )
    return deviation


def _growing(blocks: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Means of the first 1, 2, ... rows of each block (m, n, 3), and sums of squares about them."""
    off = blocks - blocks[:, :1]
    rows = np.arange(1.0, blocks.shape[1] + 1)[:, np.newaxis]
    mean = np.cumsum(off, axis=1) / rows
    return blocks[:, :1] + mean, np.cumsum(off**2, axis=1) - rows * mean**2


def _warn_if_never_still(recording: Recording, noise: dict[str, float]) -> None:
    """Warn if what passes for the noise of a triad is larger than that of any."""
    share = 1.0 if recording.kind == "rates" else recording.interval
    for name, (most, unit) in _LOUDEST.items():
        if noise[name] / share > most:
            warnings.warn(
                f"recording.{name}: expected a moment of rest, where samples scatter by less than "
                f"{most:g} {unit}, got {noise[name] / share:.2g} {unit} in the quietest window: "
                "did the unit ever lie still, and is the unit of the numbers right?",
                UnusualWarning,
                stacklevel=3,
            )


def _loudest(scatter: FloatArray, begin: int, end: int, width: int) -> float:
    """Largest scatter of the windows that lie in a rest, or of the one in its middle."""
    last = end - width + 1
    if last <= begin:
        middle = (begin + end - width) // 2
        return float(scatter[min(max(middle, 0), len(scatter) - 1)])
    return float(scatter[begin:last].max())

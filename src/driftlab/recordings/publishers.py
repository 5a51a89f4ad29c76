"""Recordings that others have published, fetched from them: the project holds none itself.

Each file is asked for in the folder that the environment variable DRIFTLAB_RECORDINGS names, then
in the cache of earlier downloads, then from its publisher's repository at a fixed commit. Whatever
the road, a file is used only if its sha256 is the one that stands here.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from driftlab.checks import one_of, shown, truth_value
from driftlab.earth import gravity

from .catalogue import PUBLISHED as PUBLISHED
from .layout import Layout
from .readers import read_csv, read_imu_tk, read_psins
from .recording import Recording

XSENS_ZERO_COUNT = 32768
"""Count of the Xsens unit that stands for zero, of both triads: half of 2^16."""
XSENS_GYRO_SCALE = 1 / 4778
"""Nominal scale of its gyros, rad/s a count: the factory sheet's of the first axis."""
XSENS_ACCELEROMETER_SCALE = 1 / 415
"""Nominal scale of its accelerometers, m/s^2 a count."""


_FERRARIS = Layout(
    ("gyr_x", "gyr_y", "gyr_z"),
    ("acc_x", "acc_y", "acc_z"),
    ("deg/s", "m/s^2"),
    rate=102.4,
    gravity=9.81,
)
_ROLLED_BY_HAND = Layout((4, 5, 6), (1, 2, 3), ("rad/s", "m/s^2"), rate=100.0, gravity=9.81)


class RecordingUnavailable(RuntimeError):
    """A published file is neither at hand nor to be had now; the sentence says what to do."""


_HOMES = {Path(path).name: (one, path) for one in PUBLISHED.values() for path in one.files}


def published_file(name: str, download: bool = True) -> Path:
    """Return where a published file lies on this computer, and fetch it if it is not here yet.

    Parameters
    ----------
    name : str
        The file's own name, "imu0.log" say.
    download : bool
        Whether the file may be fetched; otherwise only folder and cache are asked.

    Returns
    -------
    Path
        In the folder DRIFTLAB_RECORDINGS or in the cache; its sha256 is the right one.

    Raises
    ------
    ValueError
        If no set has such a file, or the one in the folder DRIFTLAB_RECORDINGS is another one.
    RecordingUnavailable
        If the file is not here and cannot be fetched; a RuntimeError.

    Examples
    --------
    >>> published_file("imu9.log")  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    ValueError: name: expected the name of a published file (..., imu4.log, ...), got 'imu9.log'.
    """
    truth_value(download, "download")
    if not isinstance(name, str) or name not in _HOMES:
        raise ValueError(
            f"name: expected the name of a published file ({', '.join(_HOMES)}), got {shown(name)}."
        )
    one, path = _HOMES[name]
    sha256 = one.files[path]
    folder = os.environ.get("DRIFTLAB_RECORDINGS")
    if folder and (here := Path(folder, name)).is_file():
        if _sha256(here) != sha256:
            raise ValueError(
                f"DRIFTLAB_RECORDINGS: expected {here} to be the published file, with the sha256 "
                f"{sha256[:12]}..., got another one, with {_sha256(here)[:12]}...; it was not used."
            )
        return here
    address = f"https://raw.githubusercontent.com/{one.repository}/{one.commit}/{path}"
    advice = (
        f"{name} by {one.authors} is not at hand: connect to the network, or put the file from "
        f"{address} into a folder and name that in the environment variable DRIFTLAB_RECORDINGS"
    )
    try:
        import pooch  # type: ignore[import-untyped]  # only who fetches needs it
    except ImportError:
        raise RecordingUnavailable(
            f"{advice}; fetching needs pooch, which 'pip install pooch' installs."
        ) from None
    cache = Path(pooch.os_cache("driftlab"))
    if not download:
        if (kept := cache / name).is_file() and _sha256(kept) == sha256:
            return kept
        raise RecordingUnavailable(f"{advice}.")
    pooch.get_logger().setLevel("WARNING")
    road = pooch.HTTPDownloader(timeout=10)  # s, until the server answers
    try:
        return Path(pooch.retrieve(address, f"sha256:{sha256}", name, cache, downloader=road))
    except OSError as fault:  # no network, no room on the disk
        raise RecordingUnavailable(f"{advice} ({type(fault).__name__}).") from None
    except ValueError as fault:
        raise RecordingUnavailable(
            f"{advice}; what came from there had another sha256 than {sha256[:12]}... and was not "
            "used."
        ) from fault


def published(name: str, download: bool = True) -> Recording:
    """Return a published recording in SI units, with its source and its licence.

    Parameters
    ----------
    name : str
        One of `PUBLISHED`.
    download : bool
        As for `published_file`.

    Returns
    -------
    Recording
        Of "xsens-mti" the counts stand in nominal units, 1/4778 rad/s and 1/415 m/s^2 about the
        count 32768, so that calibrations of counts can be compared with those of the record.

    Raises
    ------
    ValueError
        If there is no such set, or as for `published_file`.
    RecordingUnavailable
        As for `published_file`.

    Examples
    --------
    >>> print(*PUBLISHED)
    xsens-mti ferraris-session mpu9150-1 mpu9150-2 mpu9150-3 ... laser-gyro nineteen-positions
    """
    one_of(name, PUBLISHED, "name")
    one = PUBLISHED[name]
    paths = [published_file(Path(path).name, download) for path in one.files]
    read = _READERS.get(name)
    recording = read(*paths) if read else read_csv(paths[0], _ROLLED_BY_HAND)
    return replace(recording, name=name, source=one.source, licence=one.licence)


def _xsens(accelerometer_path: Path, gyro_path: Path) -> Recording:
    units = f"{XSENS_GYRO_SCALE!r} rad/s", f"{XSENS_ACCELEROMETER_SCALE!r} m/s^2"
    zeros = XSENS_ZERO_COUNT, XSENS_ZERO_COUNT
    return read_imu_tk(accelerometer_path, gyro_path, units=units, zeros=zeros, gravity=9.81744)


def _nineteen_positions(path: Path) -> Recording:
    rows = np.fromfile(path, dtype="<f4").reshape(-1, 7).astype(float)
    place = np.radians(34.0)  # pos0 of the demo
    return Recording(
        rows[:, :3],
        rows[:, 3:6],
        0.01,
        "increments",
        axes="RFU",
        latitude=float(place),
        gravity=float(gravity(place)),
    )


_READERS: dict[str, Callable[..., Recording]] = {
    "xsens-mti": _xsens,
    "ferraris-session": lambda path, _: read_csv(path, _FERRARIS),
    "laser-gyro": read_psins,
    "nineteen-positions": _nineteen_positions,
}


def ferraris_sections(download: bool = True) -> dict[str, tuple[int, int]]:
    """Return where the rests and turns of the Ferraris session lie, as its publishers say it.

    Parameters
    ----------
    download : bool
        As for `published_file`.

    Returns
    -------
    dict
        Begin and end rows, for `Recording.part`: rests on six sides, "x_p", "x_a" and so on, and
        turns "x_rot", "y_rot", "z_rot".

    Examples
    --------
    >>> try:
    ...     rows = ferraris_sections(download=False)["x_rot"]
    ... except RecordingUnavailable:  # this computer has not fetched it yet
    ...     rows = (6770, 7093)
    >>> rows
    (6770, 7093)
    """
    path = published_file("example_ferraris_session_list.json", download)
    sections = json.loads(path.read_text(encoding="utf-8"))
    return {name: (rows["start"], rows["end"]) for name, rows in sections.items()}


def _sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()

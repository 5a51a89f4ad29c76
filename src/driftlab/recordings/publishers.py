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
from dataclasses import dataclass, replace
from pathlib import Path

from .csv_reader import read_csv
from .imu_tk_reader import read_imu_tk
from .psins_reader import read_psins
from .recording import Recording

XSENS_ZERO_COUNT = 32768
"""Count of the Xsens unit that stands for zero, of both triads: half of 2^16."""
XSENS_GYRO_SCALE = 1 / 4778
"""Nominal scale of its gyros, rad/s a count: the factory sheet's of the first axis."""
XSENS_ACCELEROMETER_SCALE = 1 / 415
"""Nominal scale of its accelerometers, m/s^2 a count."""


class RecordingUnavailable(RuntimeError):
    """A published file is neither at hand nor to be had now; the sentence says what to do."""


@dataclass(frozen=True)
class PublishedSet:
    """A recording that somebody has published, and under which conditions.

    Attributes
    ----------
    name : str
        As `published` takes it.
    title, description : str
        What it is, in a few words and in a few sentences.
    authors : str
        Whom to name where it is shown.
    licence, licence_stated : str
        SPDX identifier, and where and how the publisher says it.
    repository, commit : str
        On GitHub, and the commit that the files are taken from.
    files : dict
        The sha256 of each file under its path in the repository.
    publication : str
        The paper or program that it was published with.
    """

    name: str
    title: str
    description: str
    authors: str
    licence: str
    licence_stated: str
    repository: str
    commit: str
    files: dict[str, str]
    publication: str

    @property
    def source(self) -> str:
        """Authors and repository, as a caption would name them.

        Examples
        --------
        >>> PUBLISHED["ferraris-session"].source
        'A. Küderle, N. Roth, R. Richer: github.com/mad-lab-fau/imucal at 8716e4c50bbb'
        """
        return f"{self.authors}: github.com/{self.repository} at {self.commit[:12]}"


def _mpu9150(number: int, sha256: str) -> PublishedSet:
    return PublishedSet(
        name=f"mpu9150-{number}",
        title=f"MPU-9150 number {number} of five, rolled by hand",
        description="A small MEMS unit at 100 Hz for 160 s: rests, and 22 moves by hand between "
        "them. Accelerometers in m/s^2, gyros in rad/s. Gravity as the authors' code has it.",
        authors="A. Mikov, S. Reginya, A. Moschevikin",
        licence="MIT",
        licence_stated="MIT License, Copyright (c) 2020 Aleksandr Mikov (LICENSE)",
        repository="mikoff/imu-calib",
        commit="12dff577725dbc7bd7161431e4142b6249395fec",
        files={f"data/imu{number - 1}.log": sha256},
        publication="In-situ gyroscope calibration based on accelerometer data, ICINS 2020, "
        "doi:10.23919/ICINS43215.2020.9133804; with a table of all five units",
    )


PUBLISHED = {
    one.name: one
    for one in (
        PublishedSet(
            name="xsens-mti",
            title="Xsens MTi in 38 poses held by hand",
            description="Raw counts at 100 Hz for 512 s: the unit lies still for 45 s, and is then "
            "moved from pose to pose. Gravity as the program's example has it.",
            authors="A. Pretto, D. Tedaldi",
            licence="BSD-2-Clause",
            licence_stated="'BSD License' (README), its two clauses in the headers of the sources, "
            "Copyright (c) 2014, Alberto Pretto",
            repository="Kyle-ak/imu_tk",
            commit="7780270fb9a227c79323199303f23989e689a89d",
            files={
                "bin/test_data/xsens_acc.mat": "335a234736ff4dd8741118283d5d4cd3"
                "89ac54b04d00e6cd8d48ca3e532b7510",
                "bin/test_data/xsens_gyro.mat": "e0d6cc7ccbc996aba3dae5063e97360a"
                "8b765ad1dffd02eae8ec69820eb37c1d",
            },
            publication="Tedaldi, Pretto, Menegatti, A robust and easy to implement method for IMU "
            "calibration without external equipments, ICRA 2014; with the program IMU-TK",
        ),
        PublishedSet(
            name="ferraris-session",
            title="Six rests, and one whole turn about each axis, by hand",
            description="A MEMS unit at 102.4 Hz for 101 s, put on each of its six sides and "
            "turned once about each axis. Gyros in deg/s, accelerometers in m/s^2; a second file "
            "says where the nine sections lie. Gravity as the program has it.",
            authors="A. Küderle, N. Roth, R. Richer",
            licence="MIT",
            licence_stated="MIT License, Copyright (c) 2018 MaD-Lab Erlangen (LICENSE)",
            repository="mad-lab-fau/imucal",
            commit="8716e4c50bbb7044918b747f38b26cb0a6420910",
            files={
                "example_data/example_ferraris_session.csv": "18a3b4f83b9526bc9ce9c32461c4e7c7"
                "87ea239596ad091ce0d293662c0aae3d",
                "example_data/example_ferraris_session_list.json": "d21e4170b7918ea05d8fa6f247d6"
                "94250275f42ede28224535c328dad1ca8ace",
            },
            publication="imucal, a Python library to calibrate 6 DOF IMUs; its method: Ferraris, "
            "Grimaldi, Parvis, Sensors and Materials 7, 1995",
        ),
        _mpu9150(1, "b99da3fe9018966b1cd37cb26426f9c0b57be6fe84f33614b649f40246f3de01"),
        _mpu9150(2, "cfeeed0ae5298d86697fd17884597094b41f341aa061521d0b2d8beca2ae4943"),
        _mpu9150(3, "71ec21151637aa012eae8f182675fa5b4dfc0b2151c59a4ddfeb11d408e47fcb"),
        _mpu9150(4, "b03fbd25c0d6b4f35efb512823785a50ca1a1084a9df27a8156813be38cc8d7c"),
        _mpu9150(5, "760d1bb14d13896bb389e4234e694c4d34678764ee8cf1486cc876aecdb4a02b"),
        PublishedSet(
            name="laser-gyro",
            title="Ring-laser unit on a vehicle that stands, engine and people on board",
            description="Pulses of three ring-laser gyros and three accelerometers at 100 Hz for "
            "1847 s near Xi'an. The file's own heading, -90.6 degrees, it calls maybe inaccurate.",
            authors="Gongmin Yan",
            licence="BSD-2-Clause",
            licence_stated="BSD 2-clause license, Copyright (c) 2009-2015, Gongmin Yan "
            "(README, section 2)",
            repository="WangShanpeng/PSINS",
            commit="c1706f136d1a8dc64245e851cc77c8cac00a94b6",
            files={
                "data/lasergyro.imu": "5de921e75f690c91ce6b7d3e811e547e"
                "050c4f1d000f648f537a59521206ba4d"
            },
            publication="PSINS, Precise Strapdown Inertial Navigation System toolbox",
        ),
    )
}
"""Every published recording that the book uses, under its name."""

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
    if name not in _HOMES:
        raise ValueError(
            f"name: expected the name of a published file ({', '.join(_HOMES)}), got {name!r}."
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
        raise RecordingUnavailable(f"{advice} ({type(fault).__name__}).") from fault
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
    >>> for one in PUBLISHED.values():
    ...     print(one.name, "-", one.licence)
    xsens-mti - BSD-2-Clause
    ferraris-session - MIT
    mpu9150-1 - MIT
    mpu9150-2 - MIT
    mpu9150-3 - MIT
    mpu9150-4 - MIT
    mpu9150-5 - MIT
    laser-gyro - BSD-2-Clause
    """
    if name not in PUBLISHED:
        raise ValueError(f"name: expected one of {', '.join(PUBLISHED)}, got {name!r}.")
    one = PUBLISHED[name]
    paths = [published_file(Path(path).name, download) for path in one.files]
    recording = _READERS.get(name, _rolled_by_hand)(*paths)
    return replace(recording, name=name, source=one.source, licence=one.licence)


def _xsens(accelerometer_path: Path, gyro_path: Path) -> Recording:
    return read_imu_tk(
        accelerometer_path,
        gyro_path,
        units=(f"{XSENS_GYRO_SCALE!r} rad/s", f"{XSENS_ACCELEROMETER_SCALE!r} m/s^2"),
        zeros=(XSENS_ZERO_COUNT, XSENS_ZERO_COUNT),
        gravity=9.81744,
    )


def _ferraris(path: Path, _: Path) -> Recording:
    return read_csv(
        path,
        gyro=("gyr_x", "gyr_y", "gyr_z"),
        accelerometer=("acc_x", "acc_y", "acc_z"),
        units=("deg/s", "m/s^2"),
        rate=102.4,
        gravity=9.81,
    )


def _rolled_by_hand(path: Path) -> Recording:
    return read_csv(
        path,
        gyro=(4, 5, 6),
        accelerometer=(1, 2, 3),
        units=("rad/s", "m/s^2"),
        rate=100.0,
        gravity=9.81,
    )


_READERS: dict[str, Callable[..., Recording]] = {
    "xsens-mti": _xsens,
    "ferraris-session": _ferraris,
    "laser-gyro": read_psins,
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

    Raises
    ------
    RecordingUnavailable
        As for `published_file`.

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

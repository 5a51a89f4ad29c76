"""Which published recordings the book uses: from whom, which licence, and exactly which files."""

from __future__ import annotations

from dataclasses import dataclass


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
        """Authors and repository, as a caption would name them."""
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
            title="Xsens MTi in 38 poses, moved by hand",
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
        PublishedSet(
            name="nineteen-positions",
            title="Simulated unit on a turntable in nineteen positions, of the toolbox's own demo",
            description="Made by the toolbox from ideal increments and known constants: seven "
            "columns of 32-bit numbers, angles in rad, velocities in m/s, times in s, 100 Hz for "
            "982 s. Latitude 34 degrees; axes right, forward, up; no noise.",
            authors="Gongmin Yan",
            licence="BSD-2-Clause",
            licence_stated="BSD 2-clause license, Copyright (c) 2009-2015, Gongmin Yan "
            "(README, section 2)",
            repository="WangShanpeng/PSINS",
            commit="c1706f136d1a8dc64245e851cc77c8cac00a94b6",
            files={
                "data/imusysclbt.bin": "7d7ad569bc46d7f3b58dfd57471e8919"
                "2937ae604ab3e1d982d8332f8de38623"
            },
            publication="PSINS, demos/test_system_calibration_19pos.m, after Xie Bo (2011)",
        ),
    )
}
"""Every published recording that the book uses, under its name."""

"""Published files are found, checked, or asked for in one sentence; none is used unchecked."""

import hashlib
import shutil
import sys

import numpy as np
import pytest

from driftlab.recordings import (
    PUBLISHED,
    RecordingUnavailable,
    data_problems,
    ferraris_sections,
    published,
    published_file,
)
from support import recording_or_skip

LOG, SHA256 = "imu0.log", PUBLISHED["mpu9150-1"].files["data/imu0.log"]


@pytest.fixture
def nowhere(tmp_path, monkeypatch):
    """No folder, an empty cache, and a network that does not answer."""
    import pooch

    def no_network(*_, **__):
        raise ConnectionError("no network")

    monkeypatch.delenv("DRIFTLAB_RECORDINGS", raising=False)
    monkeypatch.setattr(pooch, "os_cache", lambda _: tmp_path / "cache")
    monkeypatch.setattr(pooch.HTTPDownloader, "__call__", no_network)
    return tmp_path


def test_every_file_is_pinned():
    names = [name.rpartition("/")[2] for one in PUBLISHED.values() for name in one.files]
    assert len(set(names)) == len(names) == 11
    for name, one in PUBLISHED.items():
        assert one.name == name
        assert all(len(sha256) == 64 for sha256 in one.files.values())
        assert len(one.commit) == 40
        assert one.licence in ("MIT", "BSD-2-Clause")


@pytest.mark.parametrize("download", [True, False])
def test_a_file_that_is_nowhere_is_asked_for_in_one_sentence(nowhere, download):
    with pytest.raises(
        RecordingUnavailable, match=r"^imu0\.log by A\. Mikov.* DRIFTLAB_RECORDINGS"
    ):
        published("mpu9150-1", download)


def test_without_pooch_the_sentence_says_how_to_install_it(nowhere, monkeypatch):
    monkeypatch.setitem(sys.modules, "pooch", None)
    with pytest.raises(
        RecordingUnavailable, match=r"fetching needs pooch, which 'pip install pooch'"
    ):
        published_file(LOG)


def test_another_file_of_that_name_is_never_used(nowhere, monkeypatch):
    (nowhere / LOG).write_text("1 2 3 4 5 6\n")
    monkeypatch.setenv("DRIFTLAB_RECORDINGS", str(nowhere))
    with pytest.raises(ValueError, match=rf"^DRIFTLAB_RECORDINGS: .* {SHA256[:12]}.* not used"):
        published_file(LOG)
    monkeypatch.delenv("DRIFTLAB_RECORDINGS")
    cache = nowhere / "cache"
    cache.mkdir()
    shutil.move(nowhere / LOG, cache / LOG)
    with pytest.raises(RecordingUnavailable, match="not at hand"):
        published_file(LOG, download=False)


def test_what_the_network_sends_is_checked(nowhere, monkeypatch):
    import pooch

    def other_file(_, address, output_file, __, **___):
        assert address.endswith("/12dff577725dbc7bd7161431e4142b6249395fec/data/imu0.log")
        with open(output_file, "w") as file:
            file.write("404")

    monkeypatch.setattr(pooch.HTTPDownloader, "__call__", other_file)
    with pytest.raises(RecordingUnavailable, match=r"another sha256 than b99da3fe9018.* not used"):
        published_file(LOG)


def test_a_download_is_kept_and_found_again(nowhere, monkeypatch):
    import pooch

    content = b"1 2 3 4 5 6\n"
    sha256 = hashlib.sha256(content).hexdigest()
    monkeypatch.setitem(PUBLISHED["mpu9150-1"].files, "data/imu0.log", sha256)

    def sent(_, __, output_file, ___, **____):
        with open(output_file, "wb") as file:
            file.write(content)

    monkeypatch.setattr(pooch.HTTPDownloader, "__call__", sent)
    assert published_file(LOG).read_bytes() == content
    assert published_file(LOG, download=False) == nowhere / "cache" / LOG


def test_unknown_names_are_refused():
    with pytest.raises(ValueError, match=r"^name: expected one of xsens-mti, .* got 'xsens'"):
        published("xsens")


# Rows, interval, kind; of the first row the gyro's and the accelerometer's first value in the file,
# turned into SI units by hand; all as a text editor shows it.
@pytest.mark.parametrize(
    ("name", "rows", "interval", "gyro", "force"),
    [
        ("xsens-mti", 51175, 0.01, (32786 - 32768) / 4778, (33108 - 32768) / 415),
        ("ferraris-session", 10376, 1 / 102.4, np.radians(-0.6103515625), 10.332114257812501),
        ("mpu9150-1", 15969, 0.01, 0.03515, -8.42090),
        ("mpu9150-5", 15968, 0.01, -0.01065, 0.16765),
        ("laser-gyro", 184718, 0.01, 0.0, 0.0),
    ],
)
def test_published_recordings_are_in_si_units(name, rows, interval, gyro, force):
    recording = recording_or_skip(name)
    assert (len(recording), recording.interval) == (rows, pytest.approx(interval, rel=1e-12))
    assert recording.gyro[0, 0] == pytest.approx(gyro, rel=1e-12)
    assert recording.accelerometer[0, 0] == pytest.approx(force, rel=1e-12)
    assert recording.licence == PUBLISHED[name].licence
    assert PUBLISHED[name].authors in recording.source


def test_sections_of_the_ferraris_session_are_whole_turns():
    session = recording_or_skip("ferraris-session")
    sections = ferraris_sections(download=False)
    assert len(sections) == 9
    for axis, name in enumerate("xyz"):
        angle = session.part(*sections[f"{name}_rot"]).angles()[:, axis].sum()
        # The errors of scale of such a sensor are a few percent.
        assert np.degrees(abs(angle)) == pytest.approx(360, rel=0.05)


def test_the_two_xsens_files_keep_their_uneven_stamps():
    steps = np.diff(recording_or_skip("xsens-mti").times)
    assert (steps.min(), steps.max()) == (pytest.approx(0.009), pytest.approx(0.0104))


def test_the_laser_gyro_knows_its_place():
    recording = recording_or_skip("laser-gyro")
    assert np.degrees(recording.latitude) == pytest.approx(34.246048)
    assert (recording.kind, recording.axes) == ("increments", "RFU")
    # By the header's g and scale the accelerometers feel the gravity of the place to 0.1 mg.
    size = np.linalg.norm(recording.accelerometer.mean(axis=0)) / recording.interval
    assert size == pytest.approx(recording.gravity, rel=1e-4)


@pytest.mark.parametrize("name", PUBLISHED)
def test_nothing_speaks_against_a_published_recording(name):
    found = {doubt.rule for doubt in data_problems(recording_or_skip(name))}
    # Sensors without noise, simulated, repeat themselves at rest as no real one does.
    assert found <= ({"stuck", "clipped"} if name == "nineteen-positions" else set())

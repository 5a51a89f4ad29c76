"""Logs in every form that loggers write are read to the last digit, or refused by their line."""

import os
import re
import threading
import tracemalloc

import numpy as np
import pytest
from hypothesis import given, strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from driftlab.recordings import Layout, read_csv
from driftlab.recordings._text_form import header
from driftlab.recordings._time_stamps import spacing_of_stamps
from driftlab.recordings.readers import _read_table

GYRO, FORCE = ("gyr_x", "gyr_y", "gyr_z"), ("acc_x", "acc_y", "acc_z")
UNITS = ("rad/s", "m/s^2")
HEADER = "t,gyr_x,gyr_y,gyr_z,acc_x,acc_y,acc_z"
ROWS = [
    "0.00,0.1,0.2,0.3,0.4,0.5,9.7",
    "0.01,0.2,0.3,0.4,0.5,0.6,9.8",
    "0.02,0.3,0.4,0.5,0.6,0.7,9.9",
]


@pytest.fixture
def log(tmp_path):
    """Writes a log and reads it, by default with columns, units and rate that fit."""

    def read(lines, *, encoding="utf-8", end="\n", **changes):
        path = tmp_path / "log.csv"
        path.write_bytes(end.join(lines).encode(encoding))
        given = {"gyro": GYRO, "accelerometer": FORCE, "units": UNITS, "rate": 100.0} | changes
        return read_csv(path, **given)

    return read


def test_a_layout_is_as_good_as_its_fields_and_serves_many_logs(log, tmp_path):
    named = log([HEADER, *ROWS], gravity=9.81)
    layout = Layout(GYRO, FORCE, UNITS, rate=50, gravity=9.81)
    again = read_csv(tmp_path / "log.csv", layout, rate=100.0)
    assert_array_equal(again.gyro, named.gyro)
    assert (again.interval, again.gravity, again.name) == (0.01, 9.81, "log")
    with pytest.raises(ValueError, match=r"^layout: expected a Layout, got"):
        read_csv(tmp_path / "log.csv", {"gyro": GYRO})


@pytest.fixture(scope="module")
def long_log():
    """Values (n, 6) of a log of many blocks, and its lines with a stamp before them."""
    values = np.random.default_rng(1).normal([0, 0, 0, 0, 0, 20], size=(40_000, 6))
    return values, [f"{i / 100},{','.join(map(str, row))}" for i, row in enumerate(values.tolist())]


@pytest.mark.parametrize(
    ("form", "code"),
    [
        (lambda text: text, "utf-8"),
        (lambda text: text[:-1], "utf-8-sig"),
        (lambda text: text, "utf-16"),
        (lambda text: "# °C\n" + text.replace("\n", "  \r\n") + "# end\r\n", "latin-1"),
        (lambda text: text.replace(",", ";").replace(".", ","), "utf-8"),
        (lambda text: '"' + text.replace(",", '","').replace("\n", '"\n"')[:-1], "utf-8"),
        (lambda text: text.replace("\n", ",ok\n") + ",,,,\n" * 30_000, "utf-8"),
    ],
)
def test_a_long_log_in_any_form_takes_150_bytes_a_row(tmp_path, long_log, form, code):
    (values, lines), path = long_log, tmp_path / "log.csv"
    rows = len(values)
    path.write_text(form("\n".join([HEADER, *lines, ""])), code)
    tracemalloc.start()
    try:
        found = read_csv(
            path, gyro=GYRO, accelerometer=FORCE, units=UNITS, time=("t", "s"), allow=["force"]
        )
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert_array_equal(np.hstack([found.gyro, found.accelerometer]), values)
    assert peak < 150 * rows


def test_a_fault_far_behind_is_found_by_its_line(tmp_path, long_log):
    lines, path = [HEADER, *long_log[1]], tmp_path / "log.csv"
    lines[39_000] += ",1"
    path.write_text("\n".join([*lines, ""]))
    with pytest.raises(ValueError, match=r"^log.csv, line 39001: expected 7 cells as in line 2"):
        read_csv(path, gyro=GYRO, units="rad/s", time=("t", "s"))
    lines[39_000] = lines[100]
    path.write_text("\n".join([*lines, ""]))
    with pytest.raises(ValueError, match=r"^log.csv, line 39001: expected a time stamp after"):
        read_csv(path, gyro=GYRO, units="rad/s", time=("t", "s"))


@pytest.mark.parametrize("ending", ["csv.gz", "bz2", "xz"])
def test_text_is_read_whatever_the_name_of_its_file(tmp_path, ending):
    path = tmp_path / f"log.{ending}"
    path.write_text("\n".join([HEADER, *ROWS, ""]))
    assert len(read_csv(path, gyro=GYRO, units="rad/s", rate=100)) == len(ROWS)


@pytest.mark.parametrize(("first", "label"), [(2**60 + 1, ""), (2**60 + 1, ",ok"), (10**20, "")])
def test_whole_numbers_beyond_those_of_floats_are_exact(tmp_path, first, label):
    path = tmp_path / "log.csv"
    path.write_text("\n".join(f"{first + i * (10**7 + i)},1,2,{i}{label}" for i in range(9)) + "\n")
    found = read_csv(path, gyro=(2, 3, 4), units="rad/s", time=(1, "ns"))
    assert_array_equal(found.times, [1e-9 * (i * (10**7 + i)) for i in range(9)])


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes of a name")
def test_a_pipe_is_read_once(tmp_path):
    pipe = tmp_path / "log.csv"
    os.mkfifo(pipe)
    writing = threading.Thread(target=pipe.write_text, args=("\n".join([HEADER, *ROWS, ""]),))
    writing.start()
    found = read_csv(pipe, gyro=GYRO, units="rad/s", rate=100)
    writing.join()
    assert_array_equal(found.gyro[:, 2], [0.3, 0.4, 0.5])


def refused(log, words, lines, **changes):
    with pytest.raises(ValueError, match=re.escape(words)):
        log(lines, **changes)


@st.composite
def forms(draw):
    """One of the ways to write the same numbers, and how to ask for them then."""
    rng = np.random.default_rng(draw(st.integers(0, 999)))
    values = rng.normal(size=(draw(st.integers(1, 9)), 6))
    values[:, 5] += 20
    order = draw(st.permutations(range(6)))
    signs = np.array([draw(st.sampled_from((1, -1))) for _ in range(6)])
    delimiter = draw(st.sampled_from(",;\t ")) + " " * draw(st.integers(0, 2))
    comma = delimiter[0] != "," and draw(st.booleans())
    quote = draw(st.sampled_from(("", '"')))
    comment = draw(
        st.sampled_from(("", "# my log 12 34\n", "% by me\n%\n", "// Rate: 100.0Hz\n\n"))
    )
    named = draw(st.booleans())
    columns = [(GYRO + FORCE)[place] for place in order]
    form = draw(st.sampled_from((repr, "{:+.17e}".format, "{:24.17g}".format)))
    lines = [delimiter.join(f"{quote}{name}{quote}" for name in columns)] if named else []
    for row in values * signs:
        cells = [f"{quote}{form(float(row[place])).strip()}{quote}" for place in order]
        lines.append(delimiter.join(cell.replace(".", "," if comma else ".") for cell in cells))
    end = draw(st.sampled_from(("\n", "\r\n", "\r")))
    text = comment + "\n".join(lines) + "\n" * draw(st.integers(0, 3))
    encoding = draw(st.sampled_from(("utf-8", "utf-8-sig", "utf-16", "latin-1")))
    wanted = [
        f"{'-' * bool(sign < 0)}{name if named else order.index(place) + 1}"
        for place, (name, sign) in enumerate(zip(GYRO + FORCE, signs, strict=True))
    ]
    return values, text.replace("\n", end).encode(encoding), wanted


@given(forms())
def test_any_form_is_read_to_the_last_digit(tmp_path_factory, form):
    values, content, wanted = form
    path = tmp_path_factory.getbasetemp() / "any_form.csv"
    path.write_bytes(content)
    read = read_csv(
        path, gyro=wanted[:3], accelerometer=wanted[3:], units=UNITS, rate=50, allow=["force"]
    )
    assert_array_equal(read.gyro, values[:, :3])
    assert_array_equal(read.accelerometer, values[:, 3:])
    assert read.gyro.flags.c_contiguous  # sums of rows in another order round otherwise
    assert read.interval == 0.02


def test_units_and_time_come_from_a_header_as_phyphox_writes_it(log):
    header = '"Time (s)","Gyroscope x (rad/s)","Gyroscope y (rad/s)","Gyroscope z (rad/s)"'
    columns = ["Gyroscope x", "Gyroscope y", "-gyroscope Z"]
    told = {"gyro": columns, "accelerometer": None, "units": None, "rate": None, "time": "Time"}
    read = log([header, "0.5,1,2,3", "0.6,1,2,4", "0.7,1,2,5"], **told)
    assert read.interval == pytest.approx(0.1)
    assert_array_equal(read.gyro[:, 2], [-3, -4, -5])


def test_units_may_stand_in_a_line_of_their_own(log):
    lines = ["t;a;b;c", "ms;°/s;°/s;°/s", "0;180;0;0", "10;180;0;0"]
    told = {"gyro": "abc", "accelerometer": None, "units": None, "rate": None, "time": "t"}
    refused(log, "gyro: expected three columns, got 'abc'", lines, **told)
    read = log(lines, **told | {"gyro": list("abc")})
    assert_allclose(read.gyro[0], [np.pi, 0, 0])
    assert read.interval == pytest.approx(0.01)


def test_counts_have_a_size_and_a_zero(log):
    lines = [HEADER, "0,32768,33030,32768,100,100,8292"]
    read = log(lines, units=("1/131 deg/s", "1/8192 g"), zeros=(32768, 100))
    assert_allclose(np.degrees(read.gyro), [[0, 2, 0]])
    assert_allclose(read.accelerometer, [[0, 0, 9.80665]])


def test_labels_beside_the_numbers_do_no_harm(log):
    rows = [f"2024-05-01 12:00:0{i},{i},2,3,0,0,9.8,ok" for i in range(3)]
    read = log([f"{HEADER},state", *rows], rate=None, time=("t", "iso"))
    assert (read.interval, read.times, len(read)) == (1.0, None, 3)


@pytest.mark.parametrize(
    ("unit", "stamps"),
    [
        ("s", [1.7e9, 1.7e9 + 0.5, 1.7e9 + 1.0]),
        ("ms", [100, 600, 1100]),
        ("us", [0, 500000, 1000000]),
        ("ns", [1700000000000000000, 1700000000500000000, 1700000001000000000]),
        ("iso", ["2024-05-01T12:00:59Z", "2024-05-01T12:00:59.5Z", "2024-05-01T12:01:00Z"]),
    ],
)
def test_stamps_have_units(log, unit, stamps):
    lines = [HEADER, *(f"{stamp},1,2,3,0,0,9.8" for stamp in stamps)]
    read = log(lines, rate=None, time=("t", unit))
    assert read.interval == pytest.approx(0.5, rel=1e-6)


def test_jitter_is_kept_and_rounding_is_not(log):
    rng = np.random.default_rng(2)
    even = np.arange(500) / 102.4
    for stamps, kept in ((even + 1e-3 * rng.uniform(size=500), True), (even.round(3), False)):
        lines = [HEADER, *(f"{stamp!r},1,2,3,0,0,9.8" for stamp in stamps.tolist())]
        read = log(lines, rate=None, time=("t", "s"), allow=["stuck"])
        assert (read.times is not None) == kept
        if kept:
            assert_allclose(read.times, stamps - stamps[0], atol=1e-12)
        else:  # a line through stamps with errors of up to half a millisecond
            assert read.interval == pytest.approx(1 / 102.4, rel=1e-5)


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        (
            [HEADER, ROWS[0], "0.01,0.2"],
            "log.csv, line 3: expected 7 cells as in line 2, got 2: '0.01,0.2'.",
        ),
        (
            ["# a", HEADER, *ROWS[:2], "", "0,1,2,x,0,0,9.8"],
            "line 6: expected a number in column gyr_z, got 'x'.",
        ),
        (
            [HEADER, ROWS[0], "0,1,2,,0,0,9.8"],
            "line 3: expected a number in column gyr_z, got an empty cell.",
        ),
        (
            [HEADER, ROWS[0], "0,1,2,NaN,0,0,9.8"],
            "line 3: expected a number in column gyr_z, got 'NaN'.",
        ),
        (
            [HEADER, ROWS[0], "0,1,2,-inf,0,0,9.8"],
            "line 3: expected a number in column gyr_z, got '-inf'.",
        ),
        ([HEADER, *ROWS, HEADER], "line 5: expected a number in column gyr_x, got 'gyr_x'."),
        (
            [HEADER, ROWS[0], "0,1,2,1_0,0,0,9.8"],
            "line 3: expected a number in column gyr_z, got '1_0'.",
        ),
        ([HEADER, ROWS[0], ROWS[1][:-6]], "line 3: expected 7 cells as in line 2, got 6"),
        ([HEADER], "log.csv: expected lines of numbers, got none in 1 lines."),
        ([""], "log.csv: expected lines of numbers, got an empty file."),
    ],
)
def test_a_bad_line_is_refused_by_its_number(log, lines, words):
    refused(log, words, lines)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"gyro": ("gyr_x", "gyr_y", "gyr_w")}, "columns: expected t, gyr_x, gyr_y, gyr_z, acc_x"),
        ({"gyro": (0, 1, 2)}, "or a number from 1 to 7 for log.csv, got 0."),
        ({"units": None}, "units: expected one of deg/s, mdeg/s, rad/s"),
        ({"units": ("furlong", "g")}, "for gyros, perhaps with the size of a count before it"),
        ({"units": ("deg/s", "0 g")}, "for accelerometers, perhaps with the size"),
        ({"units": "deg/s"}, "units: expected one for each of gyro, accelerometer, got 'deg/s'."),
        ({"units": ("deg/s", "m/s")}, "got rates of the gyros with increments over each interval"),
        ({"rate": None}, "time, interval, rate: expected one of them, got None, None and None."),
        (
            {"interval": 0.01},
            "time, interval, rate: expected one of them, got None, 0.01 and 100.0",
        ),
        ({"rate": -5.0}, "rate: expected a positive number, got -5.0."),
        (
            {"rate": None, "time": ("t", "h")},
            "units: expected one of s, ms, us, ns for time, got 'h'.",
        ),
        ({"rate": None, "time": ("t", "iso")}, "line 2: expected a date and time such as"),
        ({"zeros": (1, 2, 3)}, "zeros: expected shape"),
        ({"allow": ("hope",)}, "allow: expected some of force, rate, half turn"),
        ({"latitude": 59.9}, "latitude: expected rad"),
        (
            {"units": ("rad/s", "g")},
            "log: accelerometer: expected a median size near gravity, 9.81",
        ),
    ],
)
def test_a_bad_question_is_refused_in_a_sentence(log, changes, words):
    refused(log, words, [HEADER, *ROWS], **changes)


def test_the_header_is_not_contradicted(log):
    lines = [HEADER.replace("_x", "_x [deg/s]", 1), *ROWS]
    refused(log, "units: expected deg/s for gyro, as the header of log.csv has it", lines)
    assert len(log(lines, units=("dps", "m/s²"))) == 3
    refused(
        log,
        "units: expected one unit for all columns of gyro, got '' and 'deg/s'",
        lines,
        units=None,
    )


def test_two_columns_of_one_name_are_told_by_number(log):
    lines = [HEADER.replace("gyr_z", "gyr_y"), *ROWS]
    refused(
        log,
        "columns: expected one column 'gyr_y' in log.csv, got 2: say it by number.",
        lines,
        gyro=("gyr_x", "gyr_y", 4),
    )
    assert len(log(lines, gyro=(2, 3, 4))) == 3


@pytest.mark.parametrize(
    ("stamps", "words"),
    [
        (
            [0, 10, 10, 20],
            "line 4: expected a time stamp after that of the line before, got the same",
        ),
        (
            [0, 10, 5, 20],
            "line 4: expected a time stamp after that of the line before, got 0.005 s earlier",
        ),
        (
            [0, 10, 20, 50],
            "line 5: expected no gap longer than 1.5 times the usual 0.01 s (longest_gap), got",
        ),
    ],
)
def test_stamps_that_do_not_go_on_are_refused_by_their_line(log, stamps, words):
    lines = [HEADER, *(f"{stamp},1,2,3,0,0,9.8" for stamp in stamps)]
    refused(log, words, lines, rate=None, time=("t", "ms"))


def test_a_gap_that_is_asked_for_is_let_through(log):
    lines = [HEADER, *(f"{stamp},1,2,3,0,0,9.8" for stamp in (0, 10, 20, 50, 60))]
    told = {"rate": None, "time": ("t", "ms"), "longest_gap": 4}
    refused(
        log, "times: expected steps of about 0.01 s, got one of 0.03 s after row 3", lines, **told
    )
    refused(log, 'allow=("gap",) lets it through', lines, **told | {"longest_gap": 2})
    assert len(log(lines, **told | {"longest_gap": 2}, allow=["gap"]).angles()) == 6
    assert_allclose(log(lines, **told, allow=["gap"]).times, [0, 0.01, 0.02, 0.05, 0.06])


@given(st.text(alphabet=',;\t "#%-+.eE0123456789xn\n', max_size=60))
def test_whatever_stands_in_a_file_it_is_read_or_refused_in_a_sentence(tmp_path_factory, text):
    path = tmp_path_factory.getbasetemp() / "whatever.csv"
    path.write_text(text)
    reason = ""
    try:
        table = _read_table(path)
        rows = table.numbers(range(table.width))
    except ValueError as error:
        reason = str(error)
    if reason:
        assert re.fullmatch(r"whatever\.csv(, line \d+)?: expected .*\.", reason)
    else:
        assert np.isfinite(rows).all()
        assert rows.shape[1] == table.width


def test_a_file_that_ends_inside_a_number_is_refused(log):
    rows = [f"{i},0.125,0.{i:03d},0.375,0.5,0.5,9.8{i:02d}" for i in range(30)]
    assert len(log([HEADER, *rows], allow=["dead"])) == 30  # many files lack the last end of line
    rows[-1] = rows[-1][:-2]
    refused(log, "log.csv, line 31: expected a last cell of 5 characters or more", [HEADER, *rows])
    assert len(log([HEADER, *rows, ""], allow=["dead"])) == 30


@pytest.mark.parametrize("shortest", [3, 4, 5])
def test_a_last_cell_as_short_as_that_of_any_other_line_is_no_part_of_a_number(log, shortest):
    """Last cells of 4 to 7 characters, and at the end, without an end of line, one of another."""
    rows = [f"{i},0.125,0.{i:03d},0.375,0.5,0.5,9.8{'0' * (1 + i % 4)}" for i in range(28)]
    rows.append("28,0.125,0.028,0.375,0.5,0.5,9.8000"[: shortest - 6])
    if shortest < 4:
        refused(log, "line 30: expected a last cell of 4 characters or more", [HEADER, *rows])
    else:
        assert len(log([HEADER, *rows], allow=["dead"])) == 29


@pytest.mark.parametrize("delimiter", [",", ";", "\t", " "])
def test_two_numbers_in_a_line_are_a_table_and_one_is_none(tmp_path, delimiter):
    path = tmp_path / "log.csv"
    path.write_text("\n".join(delimiter.join(row) for row in (("t", "w"), "12", "34", "")))
    table = _read_table(path)
    assert (table.names, table.width) == (("t", "w"), 2)
    assert_array_equal(table.numbers([0, 1]), [[1, 2], [3, 4]])
    path.write_text("w\n1\n3\n")
    with pytest.raises(ValueError, match=r"^log.csv: expected lines of numbers, got none in 3"):
        _read_table(path)


@pytest.mark.parametrize(
    ("lines", "names", "units"),
    [
        (["t,wx,ok"], ["t", "wx", "ok"], ["", "", ""]),
        (["t [ms],wx (rad/s),ok"], ["t", "wx", "ok"], ["ms", "rad/s", ""]),
        (["my,own,log", "t,wx,ok", "ms,,"], ["t", "wx", "ok"], ["ms", "", ""]),
        (["s,g,mg", "ms,,"], ["s", "g", "mg"], ["ms", "", ""]),  # units as names
        (["ms,,"], ["", "", ""], ["ms", "", ""]),
        (["a log", "[ms],(rad/s),(g)"], ["", "", ""], ["ms", "rad/s", "g"]),
        (["t [ms],wx"], ["t", "wx", ""], ["ms", "", ""]),  # lines of numbers end with a comma
        (["t,wx,ok", "ms,rad/s"], ["t", "wx", "ok"], ["ms", "rad/s", ""]),
        (["t"], [], ["", "", ""]),
        (["t,wx,ok,more"], [], ["", "", ""]),
        ([], [], ["", "", ""]),
    ],
)
def test_names_and_units_of_three_columns_come_from_one_or_two_lines(lines, names, units):
    assert header(lines, ",", 3) == (tuple(names), tuple(units))


def test_a_delimiter_after_the_last_number_makes_no_other_columns(log):
    read = log([HEADER, *(f"{row}," for row in ROWS)])
    assert_array_equal(read.accelerometer[:, 2], [9.7, 9.8, 9.9])


@pytest.mark.parametrize("rate", [102.4, 119.0, 256.0, 400.0, 416.0, 600.0])
def test_equal_steps_that_were_rounded_to_milliseconds_have_the_rate_they_had(rate):
    stamps = np.round(np.arange(1000) / rate, 3)
    interval, times = spacing_of_stamps(stamps, 1.5, "row {}".format)
    assert (times, 1 / interval) == (None, pytest.approx(rate, rel=1e-5))


@pytest.mark.parametrize(
    ("steps", "mean"),
    [
        ([10, 10, 10], 10),
        ([10, 9, 10], 29 / 3),
        ([2, 3, 2], 7 / 3),
        ([10, 10, 16], None),
        ([10, 10, 20], None),
        ([10, 11, 9], None),  # three sizes
        ([10, 10, 9] * 100 + [10, 10, 10] * 100, None),  # two rates, off a line
    ],
)
def test_stamps_of_two_steps_are_kept_unless_a_lost_digit_explains_them(steps, mean):
    stamps = np.cumsum([0, *steps * 9]) / 1000
    interval, times = spacing_of_stamps(stamps, 2.0, "row {}".format)
    if mean is None:
        assert_array_equal(times, stamps)
        assert interval == np.median(steps) / 1000
    else:
        # The first and the last step bend a line that is fitted to so few of them.
        assert (times, interval) == (None, pytest.approx(mean / 1000, rel=1e-3))


def test_of_many_columns_the_nearest_are_named(log):
    names = [f"field.angular_velocity.{i}" for i in range(20)]
    lines = [",".join(["%time", *names]), ",".join("1" * 21), ",".join("2" * 21)]
    told = {"accelerometer": None, "units": "rad/s"}
    wrong = ["angular_velocity.1", *names[1:3]]
    refused(log, "expected one of 21 names (field.angular_velocity.1", lines, gyro=wrong, **told)
    read = log(lines, gyro=names[:3], rate=None, time=("%time", "s"), **told)
    assert read.interval == 1.0


def test_of_whole_stamps_no_nanosecond_is_lost(log):
    cells = [row.partition(",")[2] for row in ROWS]
    rows = [f"{1_714_564_800_000_000_000 + 10_000_137 * row},{cells[row % 3]}" for row in range(9)]
    lines = [HEADER.replace("t,", "t (ns),", 1), *rows]
    found = log(lines, time="t", rate=None)
    assert (found.interval, found.times) == (0.010000137, None)
    words = "time: expected ns for column 't', as log.csv has it, got 'ms'"
    refused(log, words, lines, time=("t", "ms"), rate=None)

"""Tables in memory, by stand-ins for those of pandas and xarray, which benchmarks/peers has."""

from datetime import UTC, datetime, timedelta, timezone

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from driftlab.recordings import from_dataframe

COUNT = 300
RNG = np.random.default_rng(21)
RATES = 0.01 * RNG.standard_normal((COUNT, 3))
FORCES = 0.01 * RNG.standard_normal((COUNT, 3)) + [0.0, 0.0, 9.8]
NAMES = ("gx", "gy", "gz", "ax", "ay", "az")
COLUMNS = dict(zip(NAMES, np.hstack([RATES, FORCES]).T, strict=True))
DATES = np.datetime64("2024-05-01T12:00") + np.arange(COUNT) * np.timedelta64(10, "ms")
GIVEN = {"gyro": NAMES[:3], "accelerometer": NAMES[3:], "units": ("rad/s", "m/s^2")}


class Series:
    """A column that is no array."""

    def __init__(self, values, attrs=None):
        self.values, self.attrs = np.asarray(values), attrs or {}

    def to_numpy(self):
        return self.values


class Frame:
    """As of pandas: columns by place, and an index."""

    def __init__(self, columns, index=None, name=None):
        self.columns, self.data = list(columns), list(columns.values())
        self.iloc = self
        self.index = Series(np.arange(COUNT) if index is None else index)
        self.index.name = name

    def __getitem__(self, key):
        return Series(self.data[key[1]])


class Variable(Series):
    dims = ("time",)


class Dataset:
    """As of xarray: variables with units, and coordinates."""

    def __init__(self, variables, time, **attrs):
        units = ["rad/s"] * 3 + ["m/s^2"] * 3
        pairs = zip(variables.items(), units, strict=True)
        self.data_vars = {name: Variable(v, {"units": unit}) for (name, v), unit in pairs}
        self.dims, self.coords = ("time",), {"time": Series(time, attrs)}


FRAMES = {
    "mapping": (COLUMNS | {"when": DATES}, {"time": "when"}),
    "milliseconds": (COLUMNS | {"t": 10 * np.arange(COUNT)}, {"time": ("t", "ms")}),
    "objects": (COLUMNS | {"t": (10 * np.arange(COUNT)).astype(object)}, {"time": ("t", "ms")}),
    "rate": (COLUMNS, {"rate": 100.0}),
    "index of dates": (Frame(COLUMNS, DATES), {}),
    "index of spans": (Frame(COLUMNS, DATES - DATES[0]), {}),
    "named index": (Frame(COLUMNS, DATES, "when"), {"time": "when"}),
    "index of seconds": (Frame(COLUMNS, np.arange(COUNT) / 100), {"time": ("index", "s")}),
    "Dataset": (Dataset(COLUMNS, DATES), {"units": None}),
    "Dataset, seconds": (Dataset(COLUMNS, np.arange(COUNT) / 100, units="s"), {}),
    "levels": (
        Frame({("imu", name): values for name, values in COLUMNS.items()}, DATES),
        {"gyro": ("imu gx", "imu gy", "imu gz"), "accelerometer": (4, 5, 6)},
    ),
}


@pytest.mark.parametrize("form", FRAMES)
def test_every_table_gives_the_same_recording(form):
    frame, changes = FRAMES[form]
    found = from_dataframe(frame, **(GIVEN | changes))
    assert_array_equal(found.gyro, RATES)
    assert_array_equal(found.accelerometer, FORCES)
    assert (found.interval, found.kind, found.times) == (0.01, "rates", None)


def test_columns_go_by_name_with_signs_and_units_in_whatever_order_they_stand():
    table = {f"{name} (mrad/s)": COLUMNS[name] for name in ("gz", "gx", "gy")}
    found = from_dataframe(table, gyro=("gx", "-gy", "gz"), interval=0.01, axes="FRD", name="mine")
    np.testing.assert_allclose(found.gyro, 1e-3 * RATES * [1, -1, 1], rtol=1e-15)
    assert (found.axes, found.name, found.accelerometer) == ("FRD", "mine", None)


def test_jitter_stays_in_the_times():
    stamps = np.arange(COUNT) * 0.01 + RNG.uniform(-1e-3, 1e-3, COUNT)
    found = from_dataframe(COLUMNS | {"t": stamps}, **GIVEN, time=("t", "s"))
    np.testing.assert_allclose(found.times, stamps - stamps[0], atol=1e-15)


def changed(name, row, value, kind=float):
    values = COLUMNS[name].astype(kind)
    values[row] = value
    return COLUMNS | {name: values}


@pytest.mark.parametrize("size", [1_714_564_800_000_000_000, 2**63])
@pytest.mark.parametrize("kind", ["int64", "uint64", object])
def test_of_whole_stamps_no_nanosecond_is_lost(size, kind):
    if kind == "int64":
        size = min(size, 2**62)
    stamps = [size + 10_000_137 * row for row in range(COUNT)]
    found = from_dataframe(COLUMNS | {"t": np.array(stamps, kind)}, **GIVEN, time=("t", "ns"))
    assert (found.interval, found.times) == (0.010000137, None)


ZONES = [timezone(timedelta(hours=hours)) for hours in (0, 2, -5)]
AWARE = [
    (datetime(2024, 5, 1, tzinfo=UTC) + row * timedelta(milliseconds=10)).astimezone(ZONES[row % 3])
    for row in range(COUNT)
]


def test_dates_of_python_have_a_time_zone_or_none():
    for dates in (AWARE, [date.replace(tzinfo=None) for date in AWARE[::3]]):
        log = {name: values[: len(dates)] for name, values in COLUMNS.items()}
        found = from_dataframe(log | {"when": dates}, **GIVEN, time="when")
        steps = dates[1] - dates[0]
        assert found.interval == steps.total_seconds()


class Arrow:
    """As of pyarrow: columns without names, and their names."""

    column_names = tuple(COLUMNS)
    columns = tuple(Series(values) for values in COLUMNS.values())


def test_a_table_of_arrow():
    found = from_dataframe(Arrow(), **GIVEN, rate=100.0)
    assert_array_equal(found.gyro, RATES)
    assert_array_equal(found.accelerometer, FORCES)


@pytest.mark.parametrize(
    ("name", "index"),
    [
        ("t (ms)", 10 * np.arange(COUNT)),
        ("time [s]", DATES),
        ("gx", DATES),  # as a column is
        (None, DATES),
    ],
)
@pytest.mark.parametrize("more", [{}, {"index": np.arange(COUNT)}])
def test_an_index_that_says_its_unit_is_the_time(name, index, more):
    found = from_dataframe(Frame(COLUMNS | more, index, name), **GIVEN)
    assert_array_equal(found.gyro, RATES)
    assert (found.interval, found.times) == (0.01, None)


def numbered(*names):
    return Frame(dict(zip(names, COLUMNS.values(), strict=True)))


def test_numbers_count_columns_unless_they_name_another():
    given = GIVEN | {"gyro": (1, 2, "-3"), "accelerometer": (4, 5, 6), "rate": 100.0}
    for names in (NAMES, (1, 2, 3, 4, 5, 6), ("1", "2", "3", "4", "5", "6")):
        found = from_dataframe(numbered(*names), **given)
        assert_array_equal(found.gyro, RATES * [1, 1, -1])
        assert_array_equal(found.accelerometer, FORCES)
    for names, which in (((0, 1, 2, 3, 4, 5), 2), ((3, 2, 1, 4, 5, 6), 3)):
        with pytest.raises(ValueError, match=f"got 1, which names column {which} and counts"):
            from_dataframe(numbered(*names), **given)
    with pytest.raises(ValueError, match="a number from 1 to 6 for table, got 7"):  # the index
        from_dataframe(numbered(*NAMES), **(given | {"gyro": (5, 6, 7)}))


def masked(values):
    return np.ma.array(values, mask=np.arange(COUNT) == 7)


UNLIKE = {"wx [rad/s]": Variable(RATES[:, 0], {"units": "deg/s"})}
LOST = np.delete(DATES, 100)
WRONG = {
    "no table": (RATES, {}, "frame: expected a DataFrame, a Dataset.*, got ndarray"),
    "no time": (COLUMNS, {}, "time, interval, rate: expected one of them, got None"),
    "plain index": (Frame(COLUMNS), {}, "an index of int64 without a unit"),
    "NaN": (changed("gz", 7, np.nan), {"rate": 100.0}, "row 8: expected a number.*'gz', got 'nan'"),
    "text": (changed("gz", 7, "x", object), {"rate": 1.0}, "row 8: expected a number.*got 'x'"),
    "empty": (changed("az", 0, None, object), {"rate": 1.0}, "row 1: expected a .*got 'None'"),
    "texts": (COLUMNS | {"gx": ["a"] * COUNT}, {"rate": 1.0}, "numbers in column 'gx', got <U1"),
    "gap": (
        {n: np.delete(v, 100) for n, v in COLUMNS.items()} | {"when": LOST},
        {"time": "when"},
        "table, row 101: expected no gap longer than 1.5 times the usual 0.01 s",
    ),
    "no date": (
        COLUMNS | {"when": np.where(np.arange(COUNT) == 3, np.datetime64("NaT"), DATES)},
        {"time": "when"},
        "row 4: expected a date and time, got none",
    ),
    "numbers for dates": (COLUMNS | {"t": np.arange(COUNT)}, {"time": ("t", "iso")}, "got int64"),
    "unit of stamps": (COLUMNS | {"t": np.arange(COUNT)}, {"time": "t"}, "expected a unit beside"),
    "another unit": (Dataset(COLUMNS, DATES), {"units": ("deg/s", "g")}, "expected rad/s for gyro"),
    "g": (Frame(COLUMNS, DATES), {"units": ("rad/s", "g")}, "m/s.2 taken for g"),
    "unknown": (COLUMNS, {"gyro": ("gx", "gy", "wz"), "rate": 1.0}, "columns: expected .*'wz'"),
    "masked": (COLUMNS | {"gz": masked(RATES[:, 2])}, {"rate": 1.0}, "row 8: .*'gz', got 'None'"),
    "masked date": (COLUMNS | {"when": masked(DATES)}, {"time": "when"}, "row 8: .*time, got none"),
    "two units": (COLUMNS | UNLIKE, {"rate": 1.0}, "one unit .* 'wx .* the attribute 'deg/s'"),
    "two units of time": (
        COLUMNS | {"t (ms)": np.arange(COUNT)},
        {"time": ("t", "s")},
        "time: expected ms for column 't', as table has it, got 's'",
    ),
    "mixed dates": (
        COLUMNS | {"when": [AWARE[0], "later", *AWARE[2:]]},
        {"time": "when"},
        "row 2: expected a date and time, got none",
    ),
    "no columns": ({}, {"rate": 1.0}, "^frame: expected rows of numbers, got an empty table"),
    "no rows": ({n: [] for n in COLUMNS}, {"rate": 1.0}, "^frame: expected rows of numbers, got"),
    "ragged": (COLUMNS | {"t": [1, 2]}, {"rate": 1.0}, r"equal length, got shape \(2,\) for 't'"),
}


@pytest.mark.parametrize("slip", WRONG)
def test_a_wrong_table_is_refused_in_a_sentence(slip):
    frame, changes, words = WRONG[slip]
    with pytest.raises(ValueError, match=words):
        from_dataframe(frame, **(GIVEN | changes))


@pytest.mark.parametrize("changed", [["gx"], [*COLUMNS]], ids=["one", "all"])
def test_a_channel_of_two_dimensions_is_refused(changed):
    frame = Dataset(COLUMNS, DATES)
    for name in changed:
        frame.data_vars[name].dims = ("time", "axis")
    with pytest.raises(ValueError, match="variables have one dimension, the same for all"):
        from_dataframe(frame, **GIVEN)

"""Logs in the tables of pandas and xarray themselves, and their columns wherever arrays go in."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from driftlab.allan import allan_deviation
from driftlab.attitude import integrate
from driftlab.recordings import from_dataframe

pandas = pytest.importorskip("pandas", reason='"python3 lab.py peers" fetches it')

COUNT = 300
RNG = np.random.default_rng(21)
VALUES = 0.01 * RNG.standard_normal((COUNT, 6)) + [0, 0, 0, 0, 0, 9.8]
NAMES = ["gx", "gy", "gz", "ax", "ay", "az"]
GIVEN = {"gyro": NAMES[:3], "accelerometer": NAMES[3:], "units": ("rad/s", "m/s^2")}
WHEN = pandas.date_range("2024-05-01", periods=COUNT, freq="10ms")
FRAME = pandas.DataFrame(VALUES, columns=NAMES, index=WHEN)


def assert_same(frame, **changes):
    found = from_dataframe(frame, **(GIVEN | changes))
    assert_array_equal(np.hstack([found.gyro, found.accelerometer]), VALUES)
    assert (found.interval, found.times) == (0.01, None)


def test_a_dataframe_with_every_kind_of_time():
    assert_same(FRAME)
    assert_same(FRAME[NAMES[::-1]])
    assert_same(FRAME.tz_localize("Europe/Vienna"))
    assert_same(FRAME.set_index(WHEN - WHEN[0]))
    assert_same(FRAME.rename_axis("when"), time="when")
    assert_same(FRAME.reset_index(names="when"), time="when")
    assert_same(FRAME.rename_axis("time [s]"))
    assert_same(FRAME.set_axis(np.arange(COUNT) * 10).rename_axis("t (ms)"))
    stamps = 1_714_564_800_000_000_000 + np.arange(COUNT) * 10_000_000
    assert_same(FRAME.assign(t=stamps), time=("t", "ns"))
    dates = FRAME.tz_localize("Europe/Vienna").index.to_pydatetime()
    assert_same(FRAME.assign(when=pandas.Series(dates, WHEN, object)), time="when")
    assert_same(FRAME.assign(t=np.arange(COUNT) * 10).convert_dtypes(), time=("t", "ms"))
    levels = pandas.MultiIndex.from_product([["gyro", "force"], ["x", "y", "z"]])
    triads = {"gyro": ("gyro x", "gyro y", "gyro z"), "accelerometer": ("force x", "force y", 6)}
    assert_same(FRAME.set_axis(levels, axis=1), **triads)


def test_faults_are_found_by_row_and_column():
    for frame, words in (
        (FRAME.where(VALUES[7] != VALUES), "row 8: expected a number in column 'gx', got 'nan'"),
        (FRAME.drop(WHEN[100]), "row 101: expected no gap"),
        (FRAME.rename(columns={"gy": "gx"}), "expected one column 'gx' in table, got 2"),
        (FRAME["gx"], "expected a DataFrame, .* got Series"),
        (FRAME.reset_index(drop=True), "an index of int64 without a unit"),
    ):
        with pytest.raises(ValueError, match=words):
            from_dataframe(frame, **GIVEN)


def test_columns_without_names_have_numbers_that_count_others():
    frame = pandas.DataFrame(VALUES, index=WHEN)
    with pytest.raises(ValueError, match="got 1, which names column 2 and counts another"):
        from_dataframe(frame, **(GIVEN | {"gyro": (1, 2, 3), "accelerometer": (4, 5, 6)}))
    assert_same(frame.set_axis(range(1, 7), axis=1), gyro=(1, 2, 3), accelerometer=(4, 5, 6))


def test_tables_of_polars_and_of_pyarrow():
    pyarrow = pytest.importorskip("pyarrow", reason='"python3 lab.py peers" fetches it')
    columns = dict(zip(NAMES, VALUES.T, strict=True)) | {"when": WHEN.to_numpy()}
    assert_same(pyarrow.table(columns), time="when")
    polars = pytest.importorskip("polars", reason='"python3 lab.py peers" fetches it')
    assert_same(polars.DataFrame(columns), time="when")
    assert_same(polars.DataFrame(columns), time=7, gyro=(1, 2, 3), accelerometer=(4, 5, 6))


def test_columns_go_in_as_arrays():
    rows = FRAME[NAMES[:3]]
    assert_array_equal(integrate(rows), integrate(VALUES[:, :3]))
    found, expected = (allan_deviation(one, 0.01) for one in (FRAME["gx"], VALUES[:, 0]))
    assert_array_equal(found.deviation, expected.deviation)


def test_a_dataset_and_a_dataarray():
    xarray = pytest.importorskip("xarray", reason='"python3 lab.py peers" fetches it')
    units = ["rad/s"] * 3 + ["m/s^2"] * 3
    columns = {
        name: ("time", values, {"units": unit})
        for name, values, unit in zip(NAMES, VALUES.T, units, strict=True)
    }
    dataset = xarray.Dataset(columns, coords={"time": WHEN})
    assert_same(dataset, units=None)
    seconds = ("time", np.arange(COUNT) / 100, {"units": "s"})
    assert_same(dataset.assign_coords(time=seconds), units=None)
    with pytest.raises(ValueError, match="expected rad/s for gyro, as the header of table has it"):
        from_dataframe(dataset, **(GIVEN | {"units": ("deg/s", "m/s^2")}))
    channels = xarray.DataArray(
        VALUES, dims=("time", "channel"), coords={"time": WHEN, "channel": NAMES}
    )
    assert_same(channels)
    with pytest.raises(ValueError, match="expected a Dataset whose variables have one dimension"):
        from_dataframe(dataset.assign(both=channels), **GIVEN)

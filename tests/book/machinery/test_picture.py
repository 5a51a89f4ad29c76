"""What the pictures of all chapters share: tables of curves."""

import numpy as np

from driftlab.book.machinery.picture import long_table


def test_long_table_keeps_every_curve() -> None:
    table = long_table({"a": ([1, 2], [3, 4]), "b": ([5], 6.0)})
    assert table["curve"] == ["a", "a", "b"]
    np.testing.assert_array_equal(table["x"], [1, 2, 5])
    np.testing.assert_array_equal(table["y"], [3, 4, 6])

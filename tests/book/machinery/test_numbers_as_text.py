"""How numbers are written for a reader, and kept in a table's columns."""

from typing import NamedTuple

import numpy as np
import pytest

from driftlab.book.machinery.arrays_table import from_columns, to_columns
from driftlab.book.machinery.units import angle_text, number_text


@pytest.mark.parametrize(
    ("number", "text"),
    [(0.0123, "0.0123"), (104.2, "104"), (6502.0, "6500"), (3.21e-7, "3.21·10⁻⁷"), (0.0, "0")],
)
def test_a_number_has_three_digits(number, text):
    assert number_text(number) == text


@pytest.mark.parametrize(
    ("angle", "text"),
    [
        (0.05, "2.86°"),
        (0.001, "3.44′"),
        (1e-5, "2.06″"),
        (1e-13, "2.06·10⁻⁸″"),
        (1e-17, "0″"),
        (float("nan"), "–"),
    ],
)
def test_an_angle_has_three_digits_and_a_unit_that_suits_it(angle, text):
    assert angle_text(angle) == text


class Found(NamedTuple):
    mean: float
    parts: np.ndarray


def test_arrays_come_back_from_their_columns():
    table = to_columns(Found(2.0, np.array([[1.0, 3.0]])))
    assert table["array"] == ["mean", "parts", "parts"]
    assert table["index"] == ["", "0 0", "0 1"]
    table = {name: [str(cell) for cell in column] for name, column in table.items()}
    table = {name: [*column, ""] for name, column in table.items()}  # as beside a longer column
    again = from_columns(Found)(table)
    assert again.mean == 2.0
    np.testing.assert_array_equal(again.parts, [[1.0, 3.0]])

"""How numbers are written for a reader."""

import pytest

from driftlab.book.machinery.panel.units import angle_text, number_text


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

"""Wrong answers to the exercises of chapter 08."""

WAITED = 11.92  # minutes until 0.003°/√h times their root is 0.00673 °/h times the minutes

WRONG = {
    "8.1": [
        ("acdf", r"\(a\) trusts a table"),
        ("bcdf", r"\(b\) trusts a spline"),
        ("cdef", r"\(e\) is false"),
        ("cf", "something else is too"),
        ("ae", "^not yet. More than one statement"),
    ],
    "8.2": [
        ([27 / 40, 9 / 20, 27 / 40], "Miller"),
        ([57 / 80, 57 / 80, 33 / 80], "first increment and the last"),
        ([57 / 40, 33 / 40, 57 / 40], "one common factor"),
        ([-57 / 320, -33 / 320, -57 / 320], "belong to k"),
    ],
    "8.3": [
        (WAITED / 60, "this is in h"),
        (60 * (WAITED / 60) ** 0.5, "is to be squared"),
        (60 * WAITED, "this is in s"),
        (3600 / WAITED, "upside down"),
        (5.4e-3, "for pairs of samples"),
    ],
}

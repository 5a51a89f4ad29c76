"""Wrong answers to the exercises of chapter 15."""

WRONG = {
    "15.1": [
        ([0.366, 0.1981, 2.29e-4], "slower than an undamped one"),
        ([0.344, 159.7, 2.743e-4], "times the frequency"),
        ([0.344, 0.1233, 1.341e-4], "Only the level part"),
        ([0.34409, 0.198112, 86.2837], "whole rate"),
        ([0.34409, 0.0072467, 0.0049870], "tilt of the horizon"),
    ],
    "15.2": [
        (0.0006, "without any outliers"),
        (0.5, "Too large, by about a power of ten"),
        (0.945, "the share of those that are not meant"),
        (5.6, "this is in %"),
        (0.0777, "n - 1 below"),
    ],
    "15.3": [
        ([0.197, 0.0673, 75.3], "the limit grows as well"),
        ([0.197, 0.197, 86.4], "four times, not once"),
        ([0.197, 0.197, 82.7], "not twice"),
        ([0.197, 0.197, 67.6], "change of speed"),
        ([11.28, 11.28, 75.3], "in radians"),
        ([0.1, 0.1, 50], r"^not yet"),
    ],
    "15.4": [
        ("abcd", r"^not yet. \(d\)"),
        ("abce", r"\(e\)"),
        ("abcf", r"\(f\)"),
        ("ab", "something else is too"),
        ("df", "^not yet. More than one statement"),
    ],
    "15.5": [
        (0.2, "the change of speed does not"),
        (1.0, "two manoeuvres"),
        (0.0, "a little damping"),
        (0.5, "^not yet"),
    ],
}

"""Wrong answers to the exercises of chapter 05."""

WRONG = {
    "5.1": [
        (-24.034, "^not yet. The sign"),
        (35.77, "level part"),
        (-35.8, "^not yet. Two slips"),
        (150.9, "in one of the two turns"),
        (43.09, "whole rate of the Earth"),
        (302.0, "divides it by the angle"),
        (48.07, "the number of turns does not matter"),
        (1.1652e-4, "in arc seconds; this is in radians"),
    ],
    "5.2": [
        ("abcd", r"\(c\) has only the part"),
        ("abde", r"\(e\) forgets"),
        ("abdf", r"\(f\) takes two different things"),
        ("ab", "something else is too"),
        ("cf", "^not yet. More than one statement"),
    ],
    "5.3": [
        ([6, 0.25, 0.75], "Count all unknowns"),
        ([8, 0.25, 0.75], "Eight were enough in the text"),
        ([9, 0.25, 0.25], "do not weigh alike"),
        ([12, 0.25, 0.75], "fewer do"),
        ([10, 0.25, 0.75], "no tenth unknown"),
        ([9, 0.5, 1.5], "one direction only"),
        ([9, 0.25, 0.5], "without unknown scale factors"),
        ([9, 0.25, 2 / 3], "one common scale factor"),
        ([9, 0.5, 0.8660], "standard deviations"),
        ([9, 0.75, 0.25], "exchanged"),
    ],
}

"""Wrong answers to the exercises of chapter 18."""

import numpy as np

WRONG = {
    "18.1": [
        (4.88e-4, "is for 32 bits"),
        (4.2e-8, "half as far apart"),
        (2.98e-8, "half of the distance"),
        (1.05e-8, "an angle and its half"),
        (5.6e-17, "goes with the square"),
        (1e-6, "not yet"),
    ],
    "18.2": [
        (16, "fourth order of the pair"),
        (32, "with an odd number"),
        (128, "power of a single window"),
        (256, "window of six"),
        (1 / 61.7, "the old one over the new"),
        (50, "not yet"),
    ],
    "18.3": [
        (0, "another one at each moment"),
        (-90, "on its left"),
        (270, "do not add up"),
        (-270, "whole turn makes no difference"),
        (-np.pi / 2, "in radians, and of the opposite sign"),
        (180, "angle and its half"),
    ],
}

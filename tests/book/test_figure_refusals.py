"""What a figure cannot be drawn with is refused in a sentence that names the parameter."""

import numpy as np
import pytest

from driftlab.book import figures
from driftlab.motion import Sway
from support import recording_or_skip

ZERO, ONE, NAN = np.zeros(3), np.eye(3), np.full((3, 3), np.nan)
LEANS = [[0, 1, 0], [0, 0, 0], [0, 0, 0]]
STRANGE = {"mine": lambda g: None}
REFUSED = [
    ("01-error-motion", {"duration": 0.0}, "^duration: expected a number"),
    ("01-error-motion", {"tolerance": -1}, "^tolerance: expected a number above 0"),
    ("02-roots", {"size": -0.1}, "^size: expected a number of at"),
    ("02-roots", {"shape": np.eye(2)}, "^shape: expected shape"),
    ("02-roots", {"direction": ZERO}, "^direction: expected nonzero"),
    ("03-drift-history", {"direction": ZERO}, "^direction: expected nonzero"),
    ("03-drift-history", {"samples_per_turn": 0}, "^samples_per_turn: expected a"),
    ("03-drift-history", {"turns": 0}, "^turns: expected"),
    ("03-drift-by-symmetry", {"skew": ONE}, "^skew: expected a skew matrix, got"),
    ("03-drift-by-symmetry", {"symmetric": LEANS}, "^symmetric: expected a"),
    ("03-drift-map", {"error_matrix": NAN}, "^error_matrix: expected finite"),
    ("04-turn-estimates", {"plan": "guess"}, "^plan: expected one of three pair"),
    ("04-turn-estimates", {"repeats": 0}, "^repeats: expected"),
    ("04-turn-estimates", {"axis_error": -1e-4}, "^axis_error: expected"),
    ("04-turn-estimates", {"senses": "left"}, "^senses: expected one of one, both, got 'left'"),
    ("04-turn-estimates", {"gyro_bias": 1e-6}, "^table: expected a TurntableRotation, .* got None"),
    ("04-turn-bias", {"angle_noise": 0}, "^angle_noise: expected"),
    (
        "04-larin-digits",
        {"texts": ("1e-3",)},
        "^texts: expected 7 numbers such as '-0.216e-7'",
    ),
    ("04-larin-digits", {"steps": ()}, "^steps: expected at least one number of steps, got none"),
    ("04-larin-free-numbers", {"factors": (-1, 1)}, "^factors: expected"),
    ("04-larin-free-numbers", {"factors": (2, 1)}, "^factors: expected the lowest before the high"),
    ("04-weighing-designs", {"noise": 0}, "^noise: expected"),
    ("05-earth-under-table", {"rates": (0.1, -0.1)}, "^rates: expected positive numbers, got"),
    ("05-real-table", {"runs": 1}, "^runs: expected"),
    ("06-cayley-map", {"angle": 7.0}, "^angle: expected at most a whole turn either way"),
    ("06-circles", {"nearest": 0.0}, "^nearest: expected"),
    ("06-circles", {"paths": 0}, "^paths: expected"),
    ("06-riccati-turns", {"misses": ()}, "^misses: expected one or two distances, got 0"),
    ("06-riccati-turns", {"misses": [-1.0]}, "^misses: expected"),
    ("06-riccati-turns", {"turns": 0}, "^turns: expected"),
    ("06-riccati-turns", {"tolerances": [0.0]}, "^tolerances: expected"),
    ("06-riccati-turns", {"tolerances": ()}, "^tolerances: expected one at least, got none"),
    ("07-coning-drift", {"algorithms": ["euler"]}, "^algorithms: expected one of picard-1"),
    ("07-coning-drift", {"half_angle": -1.0}, "^half_angle: "),
    ("07-coning-drift", {"algorithms": STRANGE}, "what <lambda> returned"),
    ("07-algorithm-orders", {"motions": {"walk": 3}}, "^motions: expected a Motion, .* got 3"),
    ("07-algorithm-orders", {"motions": Sway(0.1, 0.5)}, "^motions: expected a mapping from names"),
    ("18-first-steps", {"rate": 0.0}, "^rate: expected"),
    ("18-first-steps", {"steps": 2}, "^steps: expected"),
    ("18-short-word", {"motions": ["walk"]}, "^motions: expected some of cone of 1°.* got 'walk'"),
    ("07-coning-area", {"half_angle": 2}, "^half_angle: expected an angle from 0 to pi/2, got 2"),
    ("07-coning-area", {"samples": 5}, "^samples: expected an even number, got 5"),
    ("09-carried-level", {"latitudes": (0.0, 1.6)}, "^latitude: expected"),
    ("09-stops", {"every": 0.0}, "^every: expected a"),
    ("09-stops", {"duration": 60.0}, "^duration / every: expected"),
    ("09-position-error", {"duration": 0.0}, "^duration: expected a"),
    ("09-position-error", {"latitude": 1.6}, "^latitude: expected"),
    ("10-split-triad", {"gyro_error_matrix": np.eye(2)}, "^gyro_error_matrix: "),
    ("10-plane-split", {"gyros": 0.1}, "^gyros: "),
    ("10-plane-axes", {"accelerometers": [0.1, np.nan]}, "^accelerometers: "),
    ("10-equivalent-start", {"scheme": "+90X"}, "^scheme: "),
    ("10-equivalent-start", {"direction": (0, 0, 0)}, "^direction: "),
    ("13-alignment-terms", {"pitch": 2.0}, "^pitch: expected an angle within pi/2, got 2"),
    ("13-averaging-window", {"white": (2e-6, 1e-6)}, "^white: expected a quiet gyro and a noi"),
    ("13-over-the-vertical", {"step": 0.0}, "^step: "),
    ("13-two-positions", {"units": 1}, "^units: "),
    ("16-damped-turn", {"ratios": (0.5, -0.5)}, "^damping: expected"),
    ("17-hand-estimates", {"stop_standard_deviation": 0}, "^stop_standard_deviation: expected"),
    ("17-hand-turns", {"stop_standard_deviation": 0}, "^stop_standard_deviation: expected a posit"),
    ("17-parked-car", {"lengths": (70, 60, 300)}, "^lengths: expected three that grow, from"),
    ("17-parked-car", {"lengths": (70, 180, 900)}, "^lengths: .* at least 3, got .*900"),
    ("17-allan-plots", {"cheap_from": 5}, "^cheap_from: .* a tenth of the rest, .* got 5"),
    ("17-allan-plots", {"dear_rest": (1e4, 2e4)}, "begin, end: expected times of the record"),
]


@pytest.mark.parametrize(("name", "parameters", "sentence"), REFUSED)
def test_a_figure_refuses_what_it_cannot_be_drawn_with(name, parameters, sentence):
    for recording in figures.figure_definitions(name[:2])[name].recordings:
        recording_or_skip(recording)
    with pytest.raises((ValueError, TypeError), match=sentence):
        figures.figure(name, **parameters)

"""Parameters other than the published ones, with which each figure is drawn in the tests.

One line a figure: what a reader would change first, and little enough to compute in a second.
"""

from typing import Any

import numpy as np

from driftlab.book.ch04_calibration_by_turns.experiment_numbers import IN_THE_COPY
from driftlab.book.ch05_rate_table_on_earth.experiments import RealTable
from driftlab.checks import FloatArray
from driftlab.imu import ImuNoise
from driftlab.motion import Scheme, Sway


def plain(g: FloatArray) -> FloatArray:
    """A reader's own algorithm: two increments and no correction."""
    return g[0::2] + g[1::2]


LEANING = [[0, 1e-3, 0], [0, 0, 5e-4], [0, 0, 0]]

SHORT = Scheme("+90X +90X +90Y +90Z", dwell=15.0)

VARIATIONS: dict[str, dict[str, Any]] = {
    "01-error-motion": {"rate": [0, 0, 0.2], "measured_rate": [0.02, 0, 0.21], "duration": 120.0},
    "02-roots": {"size": 0.3, "shape": np.array(LEANING) / 1e-3, "direction": [0, 1, 1]},
    "03-globe-of-axes": {"error_matrix": np.array(LEANING), "full_colour": 5e-4},
    "03-turning-block": {"error_matrix": 20 * np.array(LEANING), "exaggeration": 10},
    "03-drift-history": {"error_matrix": 20 * np.array(LEANING), "turns": 3, "exaggeration": 10},
    "03-drift-by-symmetry": {"symmetric": np.diag([1, 2, 3]), "symmetric_axis": [0, 0, 1]},
    "03-drift-map": {"error_matrix": np.array(LEANING)},
    "07-algorithm-orders": {
        "algorithms": {"mine": plain, "two-step-4": "two-step-4"},
        "motions": {"roll of 5°": Sway(0.09, 0.5)},
    },
    "07-coning-area": {"samples": 12, "half_angle": 0.7},
    "07-polynomials": {"rate": 0.6},
    "07-trap-on-a-cone": {"algorithm": "two-step-4", "half_angle": 0.3, "rounds": 1},
    "07-coning-drift": {"algorithms": {"mine": plain, "picard-1": "picard-1"}, "half_angle": 0.1},
    "08-between-samples": {"samples": 3.0},
    "08-more-samples": {"samples_a_round": (6, 10)},
    "08-sculling": {"swing": 0.05, "periods": 2},
    "08-pseudo-coning": {"late": 1e-3, "frequency": 5.0},
    "18-functional-iteration": {"windows": (6,), "runs": 2},
    "07-last-stages": {"samples_a_round": 12},
    "08-noise-and-band": {"half_angle": 0.03, "seconds": 2.0, "runs": 2},
    "18-first-steps": {"rate": 100.0, "steps": 4},
    "18-rod": {"along": 0.5, "points": 4},
    "18-short-word": {"motions": ("steady turn",), "steps": 20, "starts": 2},
    "09-carried-level": {"latitudes": (-0.2, 0.3, 0.8)},
    "09-stops": {"latitude": -1.0, "every": 120.0, "duration": 1200.0},
    "09-position-error": {"gyro_bias": 1e-6, "latitude": -1.0, "duration": 36000.0},
    "10-equivalent-start": {"scheme": Scheme("+90X +90Y", dwell=2.0), "direction": (1, 1, 0)},
    "10-plane-axes": {"gyros": (-0.4, 0.7), "accelerometers": (0.1, 0.5)},
    "10-plane-split": {"gyros": (-0.4, 0.7)},
    "10-split-triad": {"gyro_error_matrix": np.array(LEANING)},
    "13-alignment-budget": {"pitch": 0.2, "gyro_bias": (0.0, 0.0, 1e-6)},
    "13-alignment-terms": {"latitude": -0.7, "gyro_bias_nue": (0.0, 0.0, 1e-6)},
    "13-averaging-window": {"white": (1e-7, 1e-5), "moving_average": 150, "runs": 4},
    "13-over-the-vertical": {"aside": 0.05, "latitude": 1.0, "runs": 10},
    "13-two-positions": {"white": 1e-6, "duration": 120.0, "units": 10},
    "16-capstone": {"misalignment": (0.0, 1e-3, 0.0), "latitude": 1.0, "turn": -1.0},
    "16-damped-turn": {"ratios": (0.2, 1.0), "latitude": -0.5},
    "17-allan-plots": {"cheap_rest": (150.0, 157.0), "dear_rest": (0.0, 200.0), "dear_from": 0.5},
    "17-hand-estimates": {"stop_standard_deviation": np.radians(0.5)},
    "17-hand-turns": {"stop_standard_deviation": np.radians(0.5)},
    "17-parked-car": {"lengths": (30.0, 120.0, 240.0)},
    "03-closed-motions": {"error_matrix": LEANING, "half_angle": 0.2, "repeats": 2},
    "04-turn-bias": {"error_matrix": 10 * np.array(LEANING), "runs": 5, "angle_noise": 1e-4},
    "04-turn-estimates": {"plan": "four axes, least squares", "repeats": 3},
    "04-larin-digits": {"texts": IN_THE_COPY, "steps": (100,)},
    "04-larin-free-numbers": {"largest_step_error": 1e-9, "factors": (0.9, 1.3)},
    "04-weighing-designs": {"runs": 50, "sigma": [1e-3, 0, 0], "offset": 1e-4},
    "05-earth-under-table": {"rates": (0.1,), "sigma": 1e-4, "latitude": -0.7},
    "05-real-table": {"runs": 2, "table": RealTable(rate=0.5, gyro_bias=1e-5)},
    "06-cayley-map": {"angle": -1.0, "axis": [0, 0, 1]},
    "06-circles": {"nearest": 0.8, "paths": 3},
    "06-riccati-turns": {"misses": [0.1], "turns": 2, "steps": 50, "tolerances": [1e-4, 1e-5]},
    "14-ship-under-way": {"speed": 5.0, "turn": -1.5, "window": "gathering way"},
    "11-error-growth": {"scheme": SHORT, "latitude": 0.5},
    "11-calibration-errors": {"scheme": SHORT, "seed": 2},
    "12-neglected-terms": {"units": 2, "spread": 1e-3, "ratio": 2.0, "dwell": 3.0},
    "11-designed-scheme": {
        "random_schemes": 3,
        "draws": 1,
        "units": 2,
        "positions": 8,
        "duration": 330.0,
    },
    "12-filter-consistency": {"runs": 3, "scheme": SHORT, "assumed_noise": ImuNoise(1e-5)},
    "12-in-place": {"scheme": SHORT, "duration": 3000.0, "latitude": 0.9},
    "12-in-place-claim": {"units": 2, "sizes": [1e-3], "duration": 300.0, "dwell": 1.0},
    "11-scheme-directions": {"schemes": (SHORT,)},
    "12-many-runs": {"states": 3, "runs": 7, "factor": 0.8},
    "12-reference-velocity": {"velocities": (1e-4, 1e-2), "latitude": 0.5},
    "12-assumed-noise": {"velocities": (1e-4, 1e-3), "scheme": SHORT, "seed": 4},
    "12-varying-biases": {"instabilities": (1e-5, 1e-4), "units": 2, "dwell": 3.0},
    "12-size-effect": {
        "arm": 0.1,
        "sizes": [0.05, 0.2],
        "rates": [0.5],
        "dwell": 1.0,
        "velocities": [1e-4],
    },
    "11-table-observability": {"scheme": SHORT, "frame": "averaged", "latitude": 0.6},
    "14-ballistic-error": {"latitude": 1.2, "speed": 30.0, "stiff": 4.0},
    "15-damping": {"gyro_bias_body": [0.0, 0.0, 5e-7], "damping": 0.2, "current": (1.0, 2.0)},
    "15-frequency-response": {"latitude": 0.3, "damping": 0.9, "driven_periods": [600.0]},
    "14-operating-formula": {"pitch": 0.3, "speed": 10.0, "turn": -0.5},
    "14-operation": {"gyro_bias_body": [0.0, 2e-6, 0.0], "latitude": 1.0, "speed_log": True},
    "15-restarts": {"restarts": 5, "window": 50, "trials": 500},
    "15-settling": {"runs": 3, "tilt": [1e-3, 0.0, 2e-3], "angle_random_walk": 1e-6},
    "15-settling-at-sea": {"periods": [9.0], "turns": [0.0, 2.0], "units": 3, "latitude": 0.5},
    "15-static-characteristic": {
        "units": 20,
        "lasting_drift": [1e-7, 2e-6],
        "lasting_offset": [0.0, 0.01],
        "random_drift": 1e-7,
    },
    "15-would-it-pass": {"latitudes": [0.5], "damping": 0.3, "worse": 3.0},
}

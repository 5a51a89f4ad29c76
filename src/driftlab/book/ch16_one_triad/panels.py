"""The slider panel of chapter 16."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from scipy.constants import arcminute, arcsecond, degree

from driftlab.attitude.coning_algorithms import ALGORITHMS
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Explorer, Values
from driftlab.book.machinery.panel.results import Results
from driftlab.book.machinery.panel.sensor_controls import BODY_AXES, slider_value
from driftlab.book.machinery.panel.units import degrees_text
from driftlab.book.scenarios import QUARTER_TURN, SARATOV_LATITUDE

from .experiments import MISALIGNMENT, NON_ORTHOGONALITY, STAGES, calibration_stages
from .figures.capstone import CapstonePicture

PAIRS = ("forward-up", "forward-right", "up-right")


class CapstoneExplorer(Explorer):
    """One bent triad, from the bend to the heading."""

    title = "One triad through all four papers"
    picture_class = CapstonePicture
    controls = (
        *(
            Control(f"pair_{i}", f"{pair}, ″", slider_value(value, arcsecond), -100.0, 100.0, 1.0,
                    group="non-orthogonality")
            for i, (pair, value) in enumerate(zip(PAIRS, NON_ORTHOGONALITY, strict=True))
        ),
        *(
            Control(f"turn_{axis}", f"about {axis}, ″", slider_value(value, arcsecond), -100.0,
                    100.0, 1.0, group="misalignment")
            for axis, value in zip(BODY_AXES, MISALIGNMENT, strict=True)
        ),
        Control("latitude", "latitude, °", slider_value(SARATOV_LATITUDE, degree), -85.0, 85.0,
                0.5, group="ship"),
        Control("turn", "ship turns by, °", slider_value(QUARTER_TURN, degree), -360.0, 360.0,
                5.0, group="ship"),
        Control("cone", "mount shakes by, ′", 0.0, 0.0, 10.0, 0.1, group="ship"),
        Control("algorithm", "attitude algorithm", "two-step-4", choices=tuple(ALGORITHMS),
                group="ship"),
    )  # fmt: skip
    presets: ClassVar = {
        "Bent and turned": {},
        "The puzzle": {
            **{f"pair_{i}": 0.0 for i in range(3)}, **{f"turn_{axis}": 0.0 for axis in BODY_AXES},
            "pair_0": -15.0, "turn_right": 15.0,
        },
        "Bent only": {f"turn_{axis}": 0.0 for axis in BODY_AXES},
        "Turned as a whole": {f"pair_{i}": 0.0 for i in range(3)},
        "Straight": {
            **{f"pair_{i}": 0.0 for i in range(3)}, **{f"turn_{axis}": 0.0 for axis in BODY_AXES}
        },
        "The ship turns right round": {"turn": 360.0},
        "A shaking mount, no correction": {"cone": 3.0, "algorithm": "picard-1"},
        "A shaking mount, corrected": {"cone": 3.0},
    }  # fmt: skip
    look_for: ClassVar = {
        "Bent and turned": "Follow one bend from left to right: where does each stage catch it?",
        "The puzzle": "Your guess from the beginning of the chapter: how far off is the heading?",
        "Bent only": "The triad is bent and sits straight. Which calibration helps?",
        "Turned as a whole": "The triad is square and sits askew. Which calibration helps now?",
        "Straight": "Nothing is bent. What is there left to see?",
        "The ship turns right round": "A whole turn at sea. Where has the swing gone?",
        "A shaking mount, no correction": "Change the algorithm. Can a calibration make up for it?",
        "A shaking mount, corrected": "The same shaking. What does the correction leave?",
    }

    def compute(self, values: Values) -> DataTable:
        return calibration_stages(
            np.array([values[f"pair_{i}"] for i in range(3)]) * arcsecond,
            np.array([values[f"turn_{axis}"] for axis in BODY_AXES]) * arcsecond,
            float(np.radians(values["latitude"])),
            float(np.radians(values["turn"])),
            half_angle=values["cone"] * arcminute,
            algorithm=values["algorithm"],
        )

    def numbers(self, table: DataTable) -> Results:
        drift, aligned, under_way = (
            np.abs(errors).max(axis=-1)
            for errors in (table.shown("drift"), table.shown("aligned_error"), table.heading_error)
        )
        return Results(
            ("heading error under way, as built", degrees_text(under_way[0])),
            [
                (stage, f"{drift[i]:.1f}″", f"{aligned[i]:.3f}′", degrees_text(under_way[i]))
                for i, stage in enumerate(STAGES)
            ],
            ("drift in a turn", "aligned heading", "under way"),
        )

    def call(self, values: Values) -> str:
        pairs = [values[f"pair_{i}"] for i in range(3)]
        turns = [values[f"turn_{axis}"] for axis in BODY_AXES]
        return (
            "import numpy as np\n"
            "from scipy.constants import arcminute, arcsecond\n"
            "from driftlab.book.ch16_one_triad.experiments import calibration_stages\n"
            f"stages = calibration_stages(np.array({pairs}) * arcsecond,\n"
            f"    np.array({turns}) * arcsecond,\n"
            f"    *np.radians([{values['latitude']}, {values['turn']}]),\n"
            f"    half_angle={values['cone']} * arcminute, algorithm={values['algorithm']!r})\n"
            "print(*np.degrees(abs(stages.heading_error).max(axis=-1)))"
        )


PANELS = (CapstoneExplorer,)

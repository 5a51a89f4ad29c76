"""The slider panel of chapter 07."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from driftlab.attitude.coning_algorithms import ALGORITHMS, CONING_ALGORITHMS
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Explorer, Values
from driftlab.book.machinery.panel.results import ABSENT, Results
from driftlab.book.machinery.panel.units import angle_text
from driftlab.motion.profiles import Motion

from .experiments import DURATION, MOTIONS, SAMPLE_RATES, SHIP, algorithm_errors
from .figures.algorithm_laboratory import AlgorithmLaboratoryPicture

WORDS = {"64 bits": False, "32 bits": True}
ON_THE_SHIP = {
    "motion": "swaying ship",
    "amplitude": round(float(np.degrees(SHIP.amplitude)), 6),
    "frequency": SHIP.frequency,
}


class AlgorithmLaboratoryExplorer(Explorer):
    """Attitude algorithms on a motion of one's choice."""

    title = "Algorithm laboratory: error of attitude from angle increments"
    picture_class = AlgorithmLaboratoryPicture
    controls = (
        Control("motion", "motion", "coning", choices=tuple(MOTIONS), group="motion"),
        Control("amplitude", "amplitude, °", 1.0, 0.5, 60.0, 0.5, group="motion"),
        Control("frequency", "frequency, Hz", 1.0, 0.1, 3.0, 0.1, group="motion"),
        Control("rate", "sample rate, Hz", 96, stops=SAMPLE_RATES, group="computer"),
        Control("word", "word length", "64 bits", choices=tuple(WORDS), group="computer"),
        *(
            Control(name, name, name in CONING_ALGORITHMS, group="algorithms")
            for name in ALGORITHMS
        ),
    )  # fmt: skip
    presets: ClassVar = {
        "Narrow cone": {},
        "Wide cone": {"amplitude": 60.0},
        "Swaying ship": ON_THE_SHIP,
        "Fixed axis": {"motion": "fixed axis", "amplitude": 57.0, "frequency": 0.5},
        "Short word": {**ON_THE_SHIP, "word": "32 bits"},
        "Too few samples": {"amplitude": 5.0, "frequency": 3.0, "rate": 12},
        "Functional iteration": {
            "amplitude": 10.0, "frequency": 3.0, "functional-iteration": True,
        },
    }  # fmt: skip
    look_for: ClassVar = {
        "Narrow cone": "Which curves lie on each other? Untick some to find out.",
        "Wide cone": "The same cone, opened wide. Which curves have changed their slope?",
        "Swaying ship": "Put the algorithms in order. Does the order hold at every sample rate?",
        "Fixed axis": "No coning at all. Why do some algorithms still do worse than others?",
        "Short word": "More samples, less error? Follow the curves to the right.",
        "Too few samples": "Four samples a turn of the cone. Is there anything left to choose?",
        "Functional iteration": "One more algorithm. Lower the sample rate: how long does it lead?",
    }

    @staticmethod
    def _motion(values: Values) -> Motion:
        kind = MOTIONS[values["motion"]]
        return kind(float(np.radians(values["amplitude"])), values["frequency"])

    def compute(self, values: Values) -> DataTable:
        ticked = tuple(name for name in ALGORITHMS if values[name])
        if not ticked:
            raise ValueError("algorithms: expected at least one ticked, got none.")
        return algorithm_errors(
            self._motion(values), values["rate"], ticked, short_word=WORDS[values["word"]]
        )

    def numbers(self, table: DataTable) -> Results:
        worst = {name: error.max() for name, error in table.error.items()}
        best = min(worst, key=lambda name: np.nan_to_num(worst[name], nan=np.inf))
        orders = {name: f"{order:.2f}" for name, order in table.orders.items() if order is not None}
        rows = [
            (name, angle_text(worst.get(name, np.nan)), orders.get(name, ABSENT))
            for name in ALGORITHMS
        ]
        headline = f"least error, by {best}", angle_text(worst[best])
        return Results(headline, rows, ("largest error", "order"))

    def call(self, values: Values) -> str:
        kind = MOTIONS[values["motion"]].__name__
        short = WORDS[values["word"]]
        names = [name for name in ALGORITHMS if values[name]]
        function = "integrate_finite_word" if short else "integrate"
        rate = values["rate"]
        count = round(DURATION * rate)
        return (
            "import numpy as np\n"
            f"from driftlab.attitude import {function}\n"
            f"from driftlab.motion import {kind}\n"
            "from driftlab.quaternion import conjugate, multiply, rotation_angle\n"
            f"motion = {kind}(np.radians({values['amplitude']}), {values['frequency']})\n"
            f"increments = motion.increments(1 / {rate}, {count})\n"
            f"for name in {names}:\n"
            f"    attitude = {function}(increments, name, start=motion.attitude(0.0))\n"
            f"    samples = {count} // len(attitude)\n"
            f"    ends = samples * np.arange(1, len(attitude) + 1) / {rate}\n"
            "    error = rotation_angle(multiply(conjugate(motion.attitude(ends)), attitude))\n"
            "    print(name, 3600 * np.degrees(error.max()), 'arc seconds')"
        )


PANELS = (AlgorithmLaboratoryExplorer,)

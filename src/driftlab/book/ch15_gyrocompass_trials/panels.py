"""The slider panel of chapter 15."""

from typing import ClassVar

import numpy as np
from scipy.constants import degree, hour, knot, minute

from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Explorer, Values
from driftlab.book.machinery.panel.results import ABSENT, Results
from driftlab.book.machinery.panel.sensor_controls import slider_value
from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.gyrocompass.noise import GyroNoise
from driftlab.gyrocompass.type_test import COARSE, LIMITS, Gyrocompass, TypeTest, marine_type_test

from .figures.type_tests import BarsPicture


class TypeTestExplorer(Explorer):
    """A compass on the tests of the marine standards: a bar for each, as share of its limit.

    Parameters
    ----------
    preset : str, optional
        Name of the preset to open with. Single values are set afterwards, as in
        ``explorer.set(latitude=80.0)``, by the names that ``explorer.values`` shows.
    """

    title = "Would it pass?"
    picture_class = BarsPicture
    controls = (
        Control("drift", "lasting drift, °/h", 0.05,
                stops=(0.0, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0),
                group="level gyros"),
        Control("gauss_markov", "at each start, °/h", 0.01,
                stops=(0.0, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0), group="level gyros"),
        Control("walk", "random walk, °/√h", 0.0003,
                stops=(0.0, 0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3), group="level gyros"),
        Control("alignment", "alignment, min", 1.0, stops=(0.5, 1.0, 2.0, 5.0, 10.0, 30.0),
                group="instrument"),
        Control("damping", "damping ratio", 0.0, 0.0, 1.0, 0.05, group="instrument"),
        Control("latitude", "latitude, °", slider_value(SARATOV_LATITUDE, degree), -85.0, 85.0,
                0.5, group="trials"),
        Control("speed", "speed, kn", 70.0, 10.0, 70.0, 5.0, group="trials"),
        Control("log", "a log tells the velocity", False, group=""),
    )  # fmt: skip
    presets: ClassVar = {
        "The paper's compass": {},
        "80 degrees North": {"latitude": 80.0},
        "Damped without a log": {"damping": 0.5},
        "Damped by a log": {"damping": 0.5, "log": True},
        "A tactical gyro": {"drift": 1.0, "gauss_markov": 0.3, "walk": 0.03},
        "A MEMS gyro": {"drift": 10.0, "gauss_markov": 3.0, "walk": 0.3},
    }
    look_for: ClassVar = {
        "The paper's compass": "Move the latitude alone. Which bars stay, and which grow?",
        "80 degrees North": "Which limits are failed, and what do they have in common?",
        "Damped without a log": "At the quay all is well. What is not?",
        "Damped by a log": "What has the log made good, and what does the drift still do?",
        "A tactical gyro": "How many times better must the gyros be? Look for the longest bar.",
        "A MEMS gyro": "Is there anything that a longer alignment can do?",
    }

    def compute(self, values: Values) -> TypeTest:
        noise = GyroNoise(
            white=values["walk"] * degree / np.sqrt(hour),
            gauss_markov=values["gauss_markov"] * degree / hour, interval=1.0,
        )  # fmt: skip
        compass = Gyrocompass(
            gyro_bias=(0.0, 0.0, values["drift"] * degree / hour),
            gyro_noise=noise,
            damping=values["damping"],
            speed_log=values["log"],
            alignment_time=values["alignment"] * minute,
        )
        latitude, speed = float(np.radians(values["latitude"])), values["speed"] * knot
        return marine_type_test(compass, latitude, speed=speed, steps=COARSE)

    def numbers(self, data: TypeTest) -> Results:
        rows = []
        for test, share in data.shares.items():
            measured, limit = data.measured[test], LIMITS[test].at(data.latitude)
            if np.isinf(measured):
                shown = "never"
            elif test == "settling":
                shown = f"{measured / hour:.2f} h"
            else:
                shown = f"{np.degrees(measured):.4f}°"
            most = f"{limit / hour:.2f} h" if test == "settling" else f"{np.degrees(limit):.3f}°"
            rows.append((test, shown, most, ABSENT if np.isinf(share) else f"{share:.3f}"))
        kept = sum(data.passed.values())
        return Results(
            ("limits kept", f"{kept} of {len(rows)}"),
            rows,
            ("measured", "limit", "share"),
            "The gyros' noise is drawn once; another draw gives other numbers.",
        )

    def call(self, values: Values) -> str:
        return (
            "import numpy as np\n"
            "from scipy.constants import degree, hour, knot, minute\n"
            "from driftlab.gyrocompass import COARSE, Gyrocompass, GyroNoise, marine_type_test\n"
            f"noise = GyroNoise(white={values['walk']} * degree / np.sqrt(hour),\n"
            f"    gauss_markov={values['gauss_markov']} * degree / hour, interval=1.0)\n"
            f"compass = Gyrocompass((0.0, 0.0, {values['drift']} * degree / hour), noise,\n"
            f"    damping={values['damping']}, speed_log={values['log']},\n"
            f"    alignment_time={values['alignment']} * minute)\n"
            f"found = marine_type_test(compass, np.radians({values['latitude']}),\n"
            f"    speed={values['speed']} * knot, steps=COARSE)\n"
            "print(np.degrees(found.measured['turn']))"
        )


PANELS = (TypeTestExplorer,)

"""Panel of a navigator at rest: errors of its sensors and its start, and where they lead."""

from typing import ClassVar

import numpy as np
from scipy.constants import arcminute, arcsecond, degree, g, hour, knot, micro

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Explorer, Values
from driftlab.book.machinery.panel.results import Results
from driftlab.book.machinery.panel.units import number_text
from driftlab.book.scenarios import TABLE_LATITUDE

from .experiments import SETTABLE, mission
from .figures.mission import MissionPicture

GYRO_STOPS = (0.0, 0.001, 0.002, 0.005, 0.008, 0.01, 0.02, 0.05, 0.1, 0.5, 1.0, 5.0, 10.0)
ACCELEROMETER_STOPS = (0.0, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 500.0, 1000.0, 5000.0)
TILT_STOPS = (0.0, 0.1, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 60.0, 200.0, 1000.0)
AZIMUTH_STOPS = (0.0, 0.1, 0.5, 1.0, 2.0, 5.0, 10.0, 60.0)


class MissionExplorer(Explorer):
    """Errors of the sensors and of the start, and where they lead.

    Eight causes of error at rest, carried to position and heading along a mission.

    Parameters
    ----------
    preset : str, optional
        Name of the preset to open with. Single values are set afterwards, as in
        ``explorer.set(latitude=60.0)``, by the names that ``explorer.values`` shows.
    """

    title = "From sensor error to mission"
    picture_class = MissionPicture
    controls = (
        Control("gyro_east", "East, °/h", 0.01, stops=GYRO_STOPS, group="gyro bias"),
        Control("gyro_north", "North, °/h", 0.0, stops=GYRO_STOPS, group="gyro bias"),
        Control("gyro_up", "Up, °/h", 0.0, stops=GYRO_STOPS, group="gyro bias"),
        Control("push_east", "East, µg", 0.0, stops=ACCELEROMETER_STOPS, group="accelerometer"),
        Control("push_north", "North, µg", 0.0, stops=ACCELEROMETER_STOPS, group="accelerometer"),
        Control("tilt_east", "tilt about East, ″", 0.0, stops=TILT_STOPS, group="at the start"),
        Control("tilt_north", "tilt about North, ″", 0.0, stops=TILT_STOPS, group="at the start"),
        Control("azimuth", "azimuth, ′", 0.0, stops=AZIMUTH_STOPS, group="at the start"),
        Control(
            "latitude", "latitude, °", float(np.degrees(TABLE_LATITUDE)), -80.0, 80.0, 0.5,
            group="mission",
        ),
        Control("hours", "duration, h", 4.0, 0.5, 48.0, 0.5, group="mission"),
    )  # fmt: skip
    presets: ClassVar = {
        "0.01 °/h about East": {},
        "Navigation grade": {
            "gyro_north": 0.01, "gyro_up": 0.01, "push_east": 50.0, "push_north": 50.0,
            "tilt_east": 10.0, "tilt_north": 10.0, "azimuth": 2.0,
        },
        "A calibrated unit": {
            "gyro_east": 0.008, "gyro_north": 0.008, "gyro_up": 0.008, "push_east": 0.5,
            "push_north": 0.5, "tilt_east": 0.1, "tilt_north": 0.1, "azimuth": 2.0,
        },
        "Tactical grade": {
            "gyro_east": 1.0, "gyro_north": 1.0, "gyro_up": 1.0, "push_east": 1000.0,
            "push_north": 1000.0, "tilt_east": 200.0, "tilt_north": 200.0, "azimuth": 60.0,
            "hours": 1.0,
        },
        "MEMS": {
            "gyro_east": 10.0, "gyro_north": 10.0, "gyro_up": 10.0, "push_east": 5000.0,
            "push_north": 5000.0, "tilt_east": 1000.0, "tilt_north": 1000.0, "azimuth": 60.0,
            "hours": 0.5,
        },
        "Foucault": {"gyro_east": 0.0, "tilt_north": 60.0, "latitude": 60.0, "hours": 14.0},
        "100 µg": {"gyro_east": 0.0, "push_east": 100.0, "hours": 24.0},
        "A day and a night": {"hours": 48.0},
        "Without end": {"gyro_east": 0.0, "gyro_up": 0.01, "hours": 48.0},
        "The gyro of the puzzle": {
            "gyro_east": 0.0, "gyro_north": 0.01, "latitude": 45.0, "hours": 10.0,
        },
    }  # fmt: skip
    look_for: ClassVar = {
        "0.01 °/h about East": "How many nautical miles an hour? Then try other latitudes.",
        "Navigation grade": "Which row is the largest after four hours? Set it to zero.",
        "A calibrated unit": "Gyros of 0.008 °/h: does it keep one nautical mile an hour?",
        "Tactical grade": "After an hour: which sensor should be bought better?",
        "MEMS": "Half an hour. When is it farther off than a nautical mile?",
        "Foucault": "The plane of the swing turns. Half a turn: after how many hours at 30°?",
        "100 µg": "One accelerometer, one day. Where does it never go?",
        "A day and a night": "The error comes back. When, and what does the slow curve do?",
        "Without end": "One curve goes on and on. Which of the three gyro biases does not do this?",
        "The gyro of the puzzle": "Which curve goes on, and which part of it swings?",
    }

    @staticmethod
    def _causes(values: Values) -> list[float]:
        drift, push = degree / hour, micro * g
        return [
            values["tilt_east"] * arcsecond, values["tilt_north"] * arcsecond,
            values["azimuth"] * arcminute, 0.0, 0.0, 0.0, 0.0,
            values["gyro_east"] * drift, values["gyro_north"] * drift, values["gyro_up"] * drift,
            values["push_east"] * push, values["push_north"] * push,
        ]  # fmt: skip

    def compute(self, values: Values) -> DataTable:
        return mission(
            self._causes(values), float(np.radians(values["latitude"])), values["hours"] * hour
        )

    def numbers(self, table: DataTable) -> Results:
        (east,), (north,) = table.shown("end")
        ends = (
            ("East, nmi", east),
            ("North, nmi", north),
            ("heading, ′", table.shown("heading_error")),
        )
        rows: list[tuple[str, ...]] = [(name, f"{value:.2f}", "", "", "") for name, value in ends]
        for name, sizes in zip(table.causes, table.shown("parts"), strict=True):
            rows.append((name, *(f"{size:.2f}" for size in sizes)))
        # As many rows whatever the values, so that nothing below them moves.
        rows += [("", "", "", "", "")] * (len(ends) + len(SETTABLE) - len(rows))
        return Results(
            ("radial error rate, nmi an hour", number_text(table.rate / knot)),
            rows,
            ("at the end", "line, nmi a day", "24 hours, nmi", "Schuler, nmi"),
        )

    def call(self, values: Values) -> str:
        causes = ", ".join(f"{cause:.6g}" for cause in self._causes(values))
        return (
            "import numpy as np\n"
            "from driftlab.calibration import static_errors  # causes as in STATIC_ERROR_SOURCES\n"
            f"causes = [{causes}]\n"
            f"times, latitude = [{values['hours'] * hour}], np.radians({values['latitude']})\n"
            "east, north = static_errors(times, latitude, causes).position[0] / 1852\n"
            "print(east, north)  # nautical miles"
        )


PANELS = (MissionExplorer,)
"""Chapter 09."""

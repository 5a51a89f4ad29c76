"""Panels of a unit on the table: what can be known of it, and a calibration as it goes."""

from itertools import groupby
from typing import ClassVar

import numpy as np
from scipy.constants import degree, g, hour, micro

from driftlab.body_frames import BODY_FRAMES, GYRO_FRAMES
from driftlab.book.machinery.figure.data_table import UNITS, DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Explorer, Values
from driftlab.book.machinery.panel.results import Results
from driftlab.book.machinery.panel.units import number_text
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration import ERROR_MODELS, FULL
from driftlab.imu import ImuNoise
from driftlab.motion.scheme import EIGHTEEN_ROTATIONS, NINETEEN_POSITIONS, Scheme

from ..experiments import PARAMETERS, calibration_history, state_unit, table_observability
from ..figures.calibration_run import CalibrationRunPicture, table_says
from ..figures.table_observability import TableObservabilityPicture

STATES = {
    "all 30": FULL,
    **{f"27, {frame}": ERROR_MODELS[frame] for frame in BODY_FRAMES},
}
STARTS = ("Up East North", "East North Up", "North Up East")


class ObservabilityExplorer(Explorer):
    """What a rotation scheme of one's own can show."""

    title = "Observability laboratory: what a rotation scheme can show"
    picture_class = TableObservabilityPicture
    controls = (
        Control(
            "rotations", "rotations", NINETEEN_POSITIONS.rotations,
            examples=(EIGHTEEN_ROTATIONS.rotations, "+90X +90Y +90Z", "+90Z", ""),
        ),
        Control("start", "x, y, z at first", STARTS[0], choices=STARTS, group="scheme"),
        Control("dwell", "pause, s", 120.0, 10.0, 300.0, 10.0, group="scheme"),
        Control("rate", "turn rate, °/s", 10.0, 2.0, 40.0, 1.0, group="scheme"),
        Control("states", "states", "27, averaged", choices=tuple(STATES), group="filter"),
        Control(
            "latitude", "latitude, °", float(np.degrees(TABLE_LATITUDE)), -80.0, 80.0, 0.5,
            group="filter",
        ),
        Control("gyro", "gyro, 10⁻³ °/√h", 5.0, 0.0, 50.0, 0.5, group="noise"),
        Control("accelerometer", "accel., µg/√Hz", 5.0, 0.0, 100.0, 1.0, group="noise"),
        Control("velocity", "velocity, mm/s", 10.0, 1.0, 100.0, 1.0, group="noise"),
    )  # fmt: skip
    presets: ClassVar = {
        "19 positions, 27 states": {},
        "19 positions, all 30": {"states": "all 30"},
        "18 rotations": {"rotations": EIGHTEEN_ROTATIONS.rotations, "start": "East North Up"},
        "18 rotations, bad start": {
            "rotations": EIGHTEEN_ROTATIONS.rotations, "start": "North Up East"
        },
        "About one axis only": {"rotations": "+90Z +90Z +90Z +90Z"},
        "Hurried": {"dwell": 10.0, "rate": 40.0},
    }  # fmt: skip
    look_for: ClassVar = {
        "19 positions, 27 states": "Which sensor error is known best afterwards, and which least?",
        "19 positions, all 30": "Three directions stay hidden. Which deviations show it?",
        "18 rotations": "One rotation fewer, another order. Is anything lost?",
        "18 rotations, bad start": "The same rotations from another start. What is lost now?",
        "About one axis only": "The table turns about z alone. What can it never find out?",
        "Hurried": "Short pauses, fast turns. Which errors mind, and which do not?",
    }

    @staticmethod
    def _scheme(values: Values) -> Scheme:
        x, y, z = values["start"].split()
        rate = float(np.radians(values["rate"]))
        return Scheme(values["rotations"], (x, y, z), values["dwell"], rate)

    def compute(self, values: Values) -> DataTable:
        noise = ImuNoise(
            values["gyro"] * 1e-3 * degree / float(np.sqrt(hour)),
            values["accelerometer"] * micro * g,
            values["velocity"] * 1e-3,
        )
        return table_observability(
            self._scheme(values),
            STATES[values["states"]],
            noise,
            float(np.radians(values["latitude"])),
        )

    def numbers(self, table: DataTable) -> Results:
        size = len(table.names)
        rows = [("not observable", "; ".join(table.descriptions) or "nothing")]
        # One row for each kind of error, so that the table is as long for any states.
        errors = zip(table.names[6:], table.after[6:], strict=True)
        for kind, members in groupby(errors, key=lambda error: error[0].rsplit(" ", 1)[0]):
            names, sizes = zip(*members, strict=True)
            scale, sign = UNITS[state_unit(names[0])]
            places = ", ".join(name.rsplit(" ", 1)[1] for name in names)
            values = ", ".join(number_text(float(size / scale)) for size in sizes)
            rows.append((f"{kind} {places}, {sign.strip()}", values))
        return Results(
            ("states that this scheme shows", f"{size - table.unobservable} of {size}"), rows
        )

    def call(self, values: Values) -> str:
        model = STATES[values["states"]]
        name = "FULL" if model is FULL else f"ERROR_MODELS[{model.frame!r}]"
        imported = "FULL" if model is FULL else "ERROR_MODELS"
        start = tuple(values["start"].split())
        return (
            "import numpy as np\n"
            f"from driftlab.calibration import {imported}, linearize_along, unobservable_subspace\n"
            "from driftlab.motion import Scheme\n"
            f"scheme = Scheme({values['rotations']!r}, {start},\n"
            f"                dwell={values['dwell']}, rate=np.radians({values['rate']}))\n"
            f"linearized = linearize_along(scheme, np.radians({values['latitude']}), {name})\n"
            "print(unobservable_subspace(linearized).descriptions)"
        )


class CalibrationRunExplorer(Explorer):
    """One sensor error after the other, all along a calibration."""

    title = "A calibration, sensor error by sensor error"
    picture_class = CalibrationRunPicture
    controls = (
        Control("parameter", "sensor error", "gyro bias x", choices=PARAMETERS, group="what"),
        Control(
            "frame", "body axes", "averaged", choices=GYRO_FRAMES, group="what"
        ),
        Control("minute", "moment, min", 40.0, 0.0, 40.0, 0.5, group="when"),
    )  # fmt: skip
    presets: ClassVar = {
        "Gyro bias": {},
        "Gyro scale": {"parameter": "gyro scale x"},
        "Gyro non-orthogonality": {"parameter": "gyro off-diagonal 1"},
        "Accelerometer bias": {"parameter": "accelerometer bias x"},
        "Accelerometer installation": {"parameter": "accelerometer off-diagonal xy"},
    }
    look_for: ClassVar = {
        "Gyro bias": "When does the deviation fall? Look at the table's turns below.",
        "Gyro scale": "In which minute does it become known, and what does the table do then?",
        "Gyro non-orthogonality": "It needs turns of a certain kind. Which ones?",
        "Accelerometer bias": "A bias hides behind a tilt. Which positions tell them apart?",
        "Accelerometer installation": "Compare its fall with that of the bias. What comes first?",
    }

    def compute(self, values: Values) -> DataTable:
        return calibration_history(values["parameter"], values["frame"], values["minute"])

    def numbers(self, table: DataTable) -> Results:
        sign = UNITS[state_unit(table.name)][1].strip()
        unit = sign if sign == "″" else f" {sign}"
        error, *rows = (
            (table.entry(each).meaning, f"{table.shown(each):.4f}{unit}")
            for each in ("error_now", "true", "estimate", "three_deviations")
        )
        said = ("the table", table_says(table.shown("moment")))
        rows = [("in these body axes", table.name), *rows, table.row("moment", ".1f"), said]
        return Results(error, rows)

    def call(self, values: Values) -> str:
        return (
            "from driftlab.book.ch11_kalman_calibration.experiments import calibration_history\n"
            f"history = calibration_history({values['parameter']!r}, {values['frame']!r}, "
            f"{values['minute']})\n"
            "print(history.name, history.estimate, history.three_deviations)  # in SI units"
        )

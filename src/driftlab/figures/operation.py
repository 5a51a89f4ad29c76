"""A ship's gyrocompass for two hours: alignment, gathering way, a turn; and the error formula."""

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike
from scipy.constants import arcminute, degree, hour, minute

from ..checks import FloatArray, finite_array, finite_number
from ..earth import EARTH_RATE, gravity
from ..gyrocompass import OperatingHeadingError, align, operating_heading_error, speed_deviation
from ..gyrocompass_operation import Horizon, Tuning, horizon_of, operate
from ..horizon_axes import EARTH_RADIUS, geographic_rate, level_coriolis, wrapped
from ..quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    rotate,
    to_rotation_vector,
)
from ..voyage import Voyage, sensed_at_rest, smooth_step, voyage
from .alignment_budget import LATITUDE
from .picture import BLACK, SERIES, Picture

DURATION = 2 * hour
INTERVAL = 4.0
"""Step of the simulation, s. The increments hold the motion exactly, and what is shown swings
within minutes and hours, so that a long step will do; `tests` compare it with ten a second."""
UNDER_WAY = (10 * minute, 2 * minute)
"""Beginning and length of gathering way, s."""
TURN = (50 * minute, 4 * minute)
"""Beginning and length of the turn, s."""
DRIFT: FloatArray = np.array([0.01, 0.03, 0.01]) * degree / hour


class ErrorsUnderWay(NamedTuple):
    """Errors of a compass under way, each (n,) at the same times."""

    times: FloatArray  # s
    heading_error: FloatArray  # rad: shown minus true, the speed deviation taken out
    deviation: FloatArray  # rad: the speed deviation
    formula: OperatingHeadingError  # terms, rad
    tilt: FloatArray  # (n, 2), rad: of the horizon about North and East
    yaw_error: FloatArray  # rad
    compass_error: FloatArray  # rad


def ship(
    latitude: float, speed: float, course: float, turn: float, interval: float, pitch: float = 0.0
) -> Voyage:
    """Return the voyage of a ship that lies still, gathers way along its course, and turns."""
    times = interval * np.arange(round(DURATION / interval) + 1)
    heading = course + turn * smooth_step(times, *TURN)
    way = finite_number(speed, "speed") * smooth_step(times, *UNDER_WAY)
    # A positive heading is West of North.
    velocity = np.stack([way * np.cos(heading), -way * np.sin(heading)], axis=-1)
    return voyage(latitude, velocity, heading, pitch, interval=interval)


def compute(
    latitude: float = LATITUDE,
    speed: float = 10.0,
    course: float = 0.0,
    turn: float = float(np.radians(90.0)),
    drift: ArrayLike = DRIFT,
    offset: ArrayLike = (0.0, 0.0, 0.0),
    *,
    tuning_factor: float = 1.0,
    damping: float = 0.0,
    tilt: float = 0.0,
    pitch: float = 0.0,
    log: bool = False,
    interval: float = INTERVAL,
) -> ErrorsUnderWay:
    """Take a compass along a voyage of a ship.

    `drift` and `offset` (3,) are those of gyros and accelerometers in body axes, in SI. The other
    arguments are those of `ship` and of `take_along`.
    """
    way = ship(latitude, speed, course, turn, interval, pitch)
    drifts, offsets = finite_array(drift, "drift", 3), finite_array(offset, "offset", 3)
    return take_along(
        way,
        np.broadcast_to(drifts, way.angle_increments.shape),
        offsets,
        tuning_factor=tuning_factor,
        damping=damping,
        tilt=tilt,
        log=log,
    )


def take_along(
    way: Voyage,
    drift: FloatArray,
    offset: FloatArray,
    *,
    tuning_factor: float = 1.0,
    damping: float = 0.0,
    tilt: float = 0.0,
    log: bool = False,
) -> ErrorsUnderWay:
    """Align a compass at the beginning of a voyage, let it work, and look at its errors.

    `drift` (n, 3) is that of each interval, rad/s in body axes, `offset` (3,) that of the
    accelerometers, m/s^2. `tuning_factor` is k2 R, `damping` the damping ratio of the horizon's
    swing, `tilt` an error of the aligned horizon about East, rad. With a `log` the computer knows
    velocity and latitude, takes `level_coriolis` out of the specific force, and turns in azimuth as
    it must.
    """
    latitude, interval = float(way.latitude[0]), way.interval
    pull = float(gravity(latitude))
    rate, up = sensed_at_rest(way.attitude[0], latitude)
    aligned = align(rate + drift[0], up + offset)
    start = horizon_of(aligned)
    bent = multiply(from_rotation_vector([0.0, 0.0, -tilt]), start.attitude)
    swing = np.sqrt(pull / EARTH_RADIUS * tuning_factor)
    force = way.velocity_increments + interval * offset
    azimuth_rate = np.asarray(EARTH_RATE * np.sin(aligned.latitude))
    if log:
        vertical = geographic_rate(way.latitude, way.velocity)[:, 1]
        azimuth_rate = 0.5 * (vertical[1:] + vertical[:-1])
        north, east = np.moveaxis(level_coriolis(way.latitude, way.velocity), -1, 0)
        known = np.stack([north, np.zeros_like(north), east], axis=-1)
        # In body axes, like the specific force; the mean of both ends is that of the interval.
        known = rotate(conjugate(way.attitude), known)
        force = force - interval * 0.5 * (known[1:] + known[:-1])
    found = operate(
        Horizon(bent, start.rate),
        way.angle_increments + interval * drift,
        force,
        interval,
        Tuning(2 * damping * float(swing) / pull, tuning_factor / EARTH_RADIUS),
        azimuth_rate,
    )
    return errors_of(found.attitude, found.rate, way, drift)


def errors_of(
    attitude: FloatArray, rate: FloatArray, way: Voyage, drift: FloatArray
) -> ErrorsUnderWay:
    """Errors of a horizon (n, 4) with level rates (n, 2), and what the formula makes of them."""
    true = way.attitude[1:]
    # Turned by minus the vector that turns the components.
    tilt = -to_rotation_vector(multiply(attitude, conjugate(true)))[:, [0, 2]]
    pitch, heading = _pitch_and_heading(true)
    deviation = speed_deviation(way.latitude[1:], way.velocity[1:])
    compass_error = wrapped(np.arctan2(rate[:, 1], rate[:, 0]) - deviation)
    yaw_error = wrapped(_pitch_and_heading(attitude)[1] - heading)
    formula = operating_heading_error(
        way.latitude[1:],
        way.velocity[1:],
        tilt,
        np.gradient(tilt, way.interval, axis=0),
        rotate(true, drift)[:, [0, 2]],
        yaw_error,
        heading,
        pitch,
    )
    return ErrorsUnderWay(
        way.times[1:],
        yaw_error + compass_error,
        deviation,
        formula,
        tilt,
        yaw_error,
        compass_error,
    )


def _pitch_and_heading(attitude: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Pitch and heading (n,) from where the bow points."""
    north, up, east = np.moveaxis(rotate(attitude, np.array([1.0, 0.0, 0.0])), -1, 0)
    return np.arctan2(up, np.hypot(north, east)), np.arctan2(-east, north)


def columns(data: ErrorsUnderWay) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, each two minutes."""
    rows = slice(29, None, 30)
    return {
        "time_s": data.times[rows],
        "heading_error_deg": np.degrees(data.heading_error[rows]).round(7),
        "formula_deg": np.degrees(data.formula.heading[rows]).round(7),
        "speed_deviation_deg": np.degrees(data.deviation[rows]).round(7),
        "tilt_north_arcmin": (data.tilt[rows, 0] / arcminute).round(6),
        "tilt_east_arcmin": (data.tilt[rows, 1] / arcminute).round(6),
        "yaw_error_deg": np.degrees(data.yaw_error[rows]).round(7),
        "compass_angle_error_deg": np.degrees(data.compass_error[rows]).round(7),
    }


def shade_manoeuvres(panel: Axes) -> None:
    """Shade the times, in minutes, at which the ship gathers way and turns."""
    for begin, length in (UNDER_WAY, TURN):
        panel.axvspan(begin / minute, (begin + length) / minute, color="#ececec", zorder=0)


class OperationPicture(Picture[ErrorsUnderWay]):
    """Heading error, tilts of the horizon, and the two halves of the heading error."""

    size = (10.5, 3.9)

    def build(self) -> None:
        panels = self.figure.subplots(1, 3)
        self.figure.subplots_adjust(0.06, 0.14, 0.985, 0.91, wspace=0.2)
        heading, tilt, halves = self.panels = panels
        for panel in panels:
            panel.set(xlabel="time, minutes", xlim=(0, DURATION / minute))
            panel.set_xticks(range(0, 121, 20))
            shade_manoeuvres(panel)
        heading.set(title="heading error, degrees")
        tilt.set(title="tilt of the horizon, arc minutes")
        halves.set(title="errors of its two parts, degrees")
        self.error = self.line(heading, color=SERIES[0]["color"], linewidth=3.0, alpha=0.6,
                               label="simulated")  # fmt: skip
        self.formula = self.line(heading, color=BLACK, linewidth=1.0, label="formula")
        self.deviation = self.line(halves, **SERIES[3], label="speed deviation")
        self.north = self.line(tilt, **SERIES[0], label="about North")
        self.east = self.line(tilt, **SERIES[1], label="about East")
        self.yaw = self.line(halves, **SERIES[2], label="yaw psi")
        self.compass = self.line(halves, **SERIES[4], label="compass angle Psi_K")
        for panel in (heading, tilt):
            panel.legend(loc="lower left")
        halves.legend(loc="upper left")

    def update(self, data: ErrorsUnderWay) -> None:
        minutes = data.times / minute
        heading, tilt, halves = self.panels
        self.reach(heading, "y", np.degrees(data.heading_error), (1.0, 5.0, 25.0, 200.0))
        self.reach(tilt, "y", data.tilt / arcminute, (3.0, 15.0, 75.0, 1000.0))
        parts = [data.yaw_error, data.compass_error, data.deviation]
        self.reach(halves, "y", np.degrees(parts), (3.0, 15.0, 75.0, 200.0))
        self.error.set_data(minutes, np.degrees(data.heading_error))
        self.formula.set_data(minutes, np.degrees(data.formula.heading))
        self.deviation.set_data(minutes, np.degrees(data.deviation))
        self.north.set_data(minutes, data.tilt[:, 0] / arcminute)
        self.east.set_data(minutes, data.tilt[:, 1] / arcminute)
        self.yaw.set_data(minutes, np.degrees(data.yaw_error))
        self.compass.set_data(minutes, np.degrees(data.compass_error))

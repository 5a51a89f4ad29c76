"""The published figures of chapter 10, with their captions."""

import numpy as np
from scipy.constants import arcminute, degree, hour

from driftlab.book.ch09_aligning_a_gyrocompass.experiments import WHITE
from driftlab.book.machinery.arrays_table import from_columns, to_columns
from driftlab.book.machinery.publish import FigureDefinition
from driftlab.book.machinery.scene.published import scene_figure
from driftlab.book.scenarios import SCHULER_PERIOD, TURN
from driftlab.checks import FloatArray
from driftlab.gyrocompass.simulation import HeadingErrors
from driftlab.recordings.publishers import PUBLISHED

from .. import experiments
from ..scenes.ship import ShipUnderWayView, most_off, ship_under_way
from . import (
    block_diagram,
    frequency_response,
    horizons,
    operating_formula,
    operation,
    pulses,
    restarts,
    settling,
    static_characteristic,
    type_tests,
)


def _largest(values: FloatArray) -> float:
    return float(np.degrees(np.abs(values).max()))


def _settling_caption(data: experiments.Settling) -> str:
    return (
        "Left: a horizon that is half a degree out of level and does not know where North is "
        f"settles; the heading error ends at {np.degrees(data.settling_heading[-1]):.1g} degrees. "
        f"Right: {len(data.heading)} such runs with gyro noise, left to Schuler's tuning. The "
        "noise of the last moment becomes a swing, and new noise feeds it; the formula says one "
        "deviation."
    )


def _pulses_caption(data: experiments.CountedPulses) -> str:
    whole, read = (np.degrees(each.std()) for each in (data.by_whole, data.by_integrals))
    one = PUBLISHED["laser-gyro"]
    return (
        "A ring-laser unit on a parked car, its horizon damped as for levelling. One pulse of its "
        f"accelerometers is {1000 * data.pulse:.1f} mm/s; through k1 that is, for one interval, "
        f"{data.pulse_rate:.1f} times the Earth's rate. Read from the whole rate, the heading has "
        f"a standard deviation of {whole:.0f} degrees; read from the integrals, of {read:.3f}. "
        f"Recording: {one.source} ({one.licence})."
    )


def _block_caption(_: object) -> str:
    return (
        "The levelling loop about East. The force that is felt turns the horizon, by k1 at once "
        "and by k2 in time; gravity feeds the tilt back. The ship's acceleration comes in twice, "
        "as a force and as a turn of the true horizon; the drift of the gyro turns the horizon; a "
        "log takes out of the damping what it explains. The heading is read behind the integral."
    )


def _response_caption(data: experiments.FrequencyResponse) -> str:
    compared = experiments.gain_and_lead(data).values()
    gap = max(float(np.nanmax(np.abs(each[:, 0]))) for each in compared)
    return (
        "Above left: the poles; on the turning Earth the undamped pair splits. Then gains over the "
        "period, from two days on the left to some seconds. Schuler's tuning, and a damped horizon "
        "with a log, do not feel accelerations at all and are missing in those plots. Circles: "
        "the simulated compass, driven with waves; its gains are those of the lines within "
        f"{gap:.1%}. Thin: the same error of the accelerometers in the whole rate."
    )


def _operation_caption(data: HeadingErrors) -> str:
    gap = _largest(data.heading_error - data.formula.heading)
    return (
        "A ship gathers way to the North and turns West (shaded); gyros drift by a few hundredths "
        f"of a degree per hour. The heading error reaches {_largest(data.heading_error):.2f} "
        f"degrees, the formula follows within {gap:.1g}. The yaw runs away and the compass angle "
        f"takes it back. The speed error, up to {_largest(data.speed_error):.1f} degrees, is "
        "counted apart."
    )


def _ballistic_caption(data: experiments.Horizons) -> str:
    tilts = [np.abs(run.tilt).max() / arcminute for run in data.runs.values()]
    damped = _largest(list(data.runs.values())[-1].heading_error)
    return (
        "One voyage, perfect sensors, five horizons. Schuler's tuning does not feel that the ship "
        f"gathers way; what tilts it by up to {tilts[0]:.1f} arc minutes is the Coriolis force, "
        f"and with a log to take that out {tilts[1]:.1g} are left. Other tunings tilt by up to "
        f"{max(tilts[2:]):.0f}. The damped one leans while the ship gathers way, and what it "
        f"does about it afterwards is a heading error of {damped:.1f} degrees."
    )


def _damping_caption(data: experiments.Horizons) -> str:
    undamped, alone, damped, wrong = (np.degrees(run.heading_error) for run in data.runs.values())
    swing = SCHULER_PERIOD / 2 / next(iter(data.runs.values())).times[0]
    rings, stays = (np.ptp(error[-round(swing) :]) for error in (undamped, damped))
    return (
        "The same voyage with gyros that drift by a few hundredths of a degree per hour. Undamped, "
        f"the swing that the turn begins goes on: {rings:.2f} degrees of heading from top to "
        f"bottom in the last half period. Damped by the log's velocity, {stays:.2f} of it are "
        f"left. Damped without a log, the heading runs off by {np.abs(alone).max():.1f} degrees, "
        "beyond the axes, after the ship has gathered way. The log with errors tells "
        f"{experiments.LOG_SCALE:.0%} too much and does not see a current of "
        f"{experiments.CURRENT[0]:g} m/s to the North; it is off by up to "
        f"{np.abs(wrong - damped).max():.2f} degrees from the run with "
        "the true log."
    )


def _formula_caption(data: experiments.OperatingFormula) -> str:
    before = data.run.times < TURN[0]
    without = [_largest(gap[before]) for gap in data.gaps[1:]]
    return (
        "Everything wrong at once on a fast craft with its bow up. Left: the error of the compass "
        f"angle, up to {_largest(data.run.compass_error):.1f} degrees, and the formula's terms, "
        "given the tilts and the yaw error of the simulation. Right: until the turn at most "
        f"{_largest(data.gaps[0][before]):.2g} degrees are missing with all terms, and "
        f"{min(without):.2g} or more without any one of them. After it the craft goes nearly West, "
        "and the term with the velocity North fades."
    )


def _static_caption(data: experiments.StaticCharacteristic) -> str:
    kinds = ((data.lasting, data.by_drift), (data.offsets, data.by_offset))
    drift, offset = (
        [float(np.interp(experiments.PAPER_LARGEST, middle, lasting)) for middle in middles]
        for lasting, middles in (
            (lasting, np.degrees(np.median(largest, axis=-1))) for lasting, largest in kinds
        )
    )
    return (
        "The paper's Fig. 1, simulated from its description; its own plot is lost. Above: one "
        "unit, three runs around the dial, and the mean of three in turns of pitch and roll. "
        "Below: the largest error of the averaged characteristic over random units. The paper's "
        f"{experiments.PAPER_LARGEST:g} degrees are the median if each gyro keeps a drift with a "
        f"deviation of {drift[0]:.3f} degrees per hour, or each accelerometer an offset of "
        f"{offset[0]:.1f} mg; if the turns in pitch and roll count as well, {drift[1]:.3f} or "
        f"{offset[1]:.1f}."
    )


def _restarts_caption(data: experiments.Restarts) -> str:
    readings = experiments.spread_readings(data.ranges)
    taken, _, least, *_ = (probability for _, probability in readings.values())
    averaged = data.deviations[:, 1] / (degree / hour)
    return (
        "The paper's Fig. 2, simulated from its description; its own plot is lost. Left: one "
        f"series, with gyro noise of {WHITE[0]:g} degrees per hour a sample, "
        f"averaged. Middle: noise of {WHITE[1]:g} degrees per hour a sample; "
        f"after the average {averaged[1]:.3f}, and {averaged[0]:.3f} where it was "
        f"{WHITE[0]:g}. Right: of "
        f"{experiments.TRIALS} normal samples {taken:.1%} have a range of at least 0.3 over 0.054, "
        f"and {least:.0%} one that could be rounded to it. If the spread means six deviations, "
        f"{6 * experiments.PAPER_DEVIATION:.2f} degrees, there is nothing to explain."
    )


def _type_tests_caption(data: experiments.TypeTests) -> str:
    paper, by_log, alone, cheap = data.shares.values()
    valid = data.latitudes <= type_tests.BEYOND
    worst = max(paper, key=lambda test: paper[test][valid].max())
    failed = sum(shares[valid].max() > 1 for shares in cheap.values())
    return (
        "What four compasses use up of the limits of IMO A.821(19), by simulation; the dotted line "
        "is the latitude up to which they hold. The paper's compass, reconstructed, is nearest to "
        f"a limit in the {worst} test, at {paper[worst][valid].max():.2f} of it, and fails it "
        "nearer to the pole, because this limit has no secant of the latitude. Damped by a log it "
        f"stays below {max(shares[valid].max() for shares in by_log.values()):.2f}. Damped without "
        f"a log it turns with {alone['turn'][valid].max():.1f} times the limit. With gyros "
        f"{experiments.WORSE:g} times worse it fails {failed} of the {len(cheap)} tests; what "
        "never settles stands at the upper edge."
    )


FIGURES = (
    scene_figure(
        "10-ship-under-way",
        ship_under_way,
        ShipUnderWayView,
        "A ship turns; published for a whole circle. Its compass carries a horizon and a needle "
        "with it, in dashes, as far as they are wrong.",
        most_off,
    ),
    FigureDefinition(
        "10-settling",
        experiments.settling_and_swing,
        settling.draw,
        settling.columns,
        _settling_caption,
    ),
    FigureDefinition(
        "10-pulses",
        experiments.counted_pulses,
        pulses.draw,
        to_columns,
        _pulses_caption,
        from_columns(experiments.CountedPulses),
        ("laser-gyro",),
    ),
    FigureDefinition("10-block-diagram", lambda: None, block_diagram.draw, None, _block_caption),
    FigureDefinition(
        "10-frequency-response",
        experiments.frequency_response,
        frequency_response.draw,
        frequency_response.columns,
        _response_caption,
    ),
    FigureDefinition(
        "10-ballistic-error",
        experiments.ballistic_errors,
        horizons.drawn_within(6.0, 6.0),
        horizons.columns,
        _ballistic_caption,
    ),
    FigureDefinition(
        "10-damping",
        experiments.damping_at_sea,
        horizons.drawn_within(0.4, 0.5),
        horizons.columns,
        _damping_caption,
    ),
    FigureDefinition(
        "10-operation",
        experiments.errors_under_way,
        operation.OperationPicture.draw,
        operation.columns,
        _operation_caption,
    ),
    FigureDefinition(
        "10-operating-formula",
        experiments.operating_formula,
        operating_formula.draw,
        operating_formula.columns,
        _formula_caption,
    ),
    FigureDefinition(
        "10-static-characteristic",
        experiments.static_characteristic,
        static_characteristic.draw,
        static_characteristic.columns,
        _static_caption,
    ),
    FigureDefinition(
        "10-restarts",
        experiments.restart_series,
        restarts.draw,
        restarts.columns,
        _restarts_caption,
    ),
    FigureDefinition(
        "10-would-it-pass",
        experiments.type_tests,
        type_tests.draw,
        type_tests.columns,
        _type_tests_caption,
    ),
)

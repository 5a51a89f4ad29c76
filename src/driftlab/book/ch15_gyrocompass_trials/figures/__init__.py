"""The published figures of chapter 15, with their captions."""

import numpy as np
from scipy.constants import minute

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.publish import FigureDefinition
from driftlab.book.scenarios import SCHULER_PERIOD
from driftlab.checks import FloatArray
from driftlab.gyrocompass.type_test import LIMITS
from driftlab.recordings.publishers import PUBLISHED

from .. import experiments
from . import (
    block_diagram,
    damping,
    frequency_response,
    pulses,
    restarts,
    settling,
    settling_at_sea,
    static_characteristic,
    type_tests,
)


def _largest(values: FloatArray) -> float:
    return float(np.degrees(np.abs(values).max()))


def _settling_caption(data: DataTable) -> str:
    tilt, heading_error = (data.shown(f"settling_{name}") for name in ("tilt", "heading_error"))
    return (
        f"Left: a horizon that is {tilt[0]:.1f} degrees out of level and does not know where North "
        f"is settles; the heading error ends at {heading_error[-1]:.1g} degrees. Right: "
        f"{len(data.heading_error)} such runs with gyro noise, left to Schuler's tuning. The noise "
        "of the last moment becomes a swing, and new noise feeds it; the formula says one "
        "deviation."
    )


def _pulses_caption(data: DataTable) -> str:
    whole, read = (np.degrees(each.std()) for each in (data.by_whole_rate, data.by_integrals))
    one = PUBLISHED["laser-gyro"]
    return (
        "A ring-laser unit on a parked car, its horizon damped as for levelling. One count of the "
        f"file is {1000 * data.count[0]:.1f} mm/s; a pulse of its accelerometers is "
        f"{data.pulse[0] / data.count[0]:.0f} counts, through k1 up to "
        f"{data.pulse_over_earth_rate[0]:.0f} times the Earth's rate. Single values of the whole "
        f"rate give a heading with a standard deviation of {whole:.0f} degrees; the integrals, of "
        f"{read:.3f}. Recording: {one.source} ({one.licence})."
    )


def _block_caption(_: object) -> str:
    return (
        "The levelling loop about East. The force that is felt turns the horizon, by k1 at once "
        "and by k2 in time; gravity feeds the tilt back. The ship's acceleration comes in twice, "
        "as a force and as a turn of the true horizon; the drift of the gyro turns the horizon; a "
        "log takes out of the damping what it explains. The heading is read behind the integral."
    )


def _response_caption(data: DataTable) -> str:
    gap = max(float(np.nanmax(np.abs(each[:, 0]))) for each in data.gain_and_lead.values())
    return (
        "Above left: the poles; on the turning Earth the undamped pair splits. Then gains over the "
        "period, from two days on the left to some seconds. Schuler's tuning, and a damped horizon "
        "with a log, do not feel accelerations at all and are missing in those plots. Circles: the "
        f"simulated compass, driven with waves; its gains are those of the lines within {gap:.1%}. "
        "Thin: the same error of the accelerometers in the whole rate."
    )


def _damping_caption(data: DataTable) -> str:
    undamped, alone, damped, wrong = (np.degrees(run.heading_error) for run in data.runs.values())
    swing = SCHULER_PERIOD / 2 / next(iter(data.runs.values())).times[0]
    beyond = ", beyond the axes," if np.abs(alone).max() > damping.damping_reach(data)[1] else ""
    rings, stays = (np.ptp(error[-round(swing) :]) for error in (undamped, damped))
    return (
        "A voyage with gyros that drift, published for a few hundredths of a degree per hour. "
        f"Undamped, the swing that the turn begins goes on: {rings:.2f} degrees of heading from "
        f"top to bottom in the last half period. Damped by the log's velocity, {stays:.2f} of it "
        f"are left. Damped without a log, the heading runs off by {np.abs(alone).max():.1f} "
        f"degrees{beyond} after the ship has gathered way. The log with errors tells "
        f"{data.speed_log_scale_factor:.0%} too much and does not see a current of "
        f"{np.hypot(*data.current):g} m/s; it is off by up to "
        f"{np.abs(wrong - damped).max():.2f} degrees from the run with the true log."
    )


def _static_caption(data: DataTable) -> str:
    drift, offset = (
        [
            _where(experiments.PAPER_LARGEST, middle, data.shown(f"lasting_{name}"), form)
            for middle in np.degrees(np.median(getattr(data, f"by_{name}"), axis=-1))
        ]
        for name, form in (("drift", ".3f"), ("offset", ".1f"))
    )
    return (
        "The paper's Fig. 1, simulated from its description; its own plot is lost. Above: one "
        "unit, three runs around the dial, and the mean of three in turns of pitch and roll. "
        "Below: the largest error of the averaged characteristic over random units. The paper's "
        f"{experiments.PAPER_LARGEST:g} degrees are the median if each gyro keeps a drift with a "
        f"deviation of {drift[0]} degrees per hour, or each accelerometer an offset of {offset[0]} "
        f"mg; if the turns in pitch and roll count as well, {drift[1]} or {offset[1]}."
    )


def _where(wanted: float, values: FloatArray, at: FloatArray, form: str) -> str:
    """Say where rising values are as wanted, or that they are not."""
    if wanted < values[0]:
        return f"less than {at[0]:{form}}"
    if wanted > values[-1]:
        return f"more than {at[-1]:{form}}"
    return f"{np.interp(wanted, values, at):{form}}"


def _restarts_caption(data: DataTable) -> str:
    readings = experiments.spread_readings(data.ranges)
    taken, _, least, *_ = (probability for _, probability in readings.values())
    averaged = data.shown("standard_deviations")[:, 1]
    weak, strong = data.shown("white")
    return (
        "The paper's Fig. 2, simulated from its description; its own plot is lost. Left: one "
        f"series, with gyro noise of {weak:g} degrees per hour a sample, averaged. Middle: noise "
        f"of {strong:g} degrees per hour a sample; after the average {averaged[1]:.3f}, and "
        f"{averaged[0]:.3f} where it was {weak:g}. Right: of {len(data.ranges)} normal samples "
        f"{taken:.1%} have a range of at least 0.3 over 0.054, and {least:.0%} one that could be "
        f"rounded to it. If the spread means six deviations, {6 * experiments.PAPER_DEVIATION:.2f} "
        "degrees, there is nothing to explain."
    )


def _type_tests_caption(data: DataTable) -> str:
    paper, by_log, alone, cheap = data.shares.values()
    valid = np.abs(data.shown("latitudes")) <= type_tests.BEYOND
    valid |= not valid.any()
    worst = max(paper, key=lambda test: paper[test][valid].max())
    fails = paper[worst][~valid].max(initial=0.0) > 1
    beyond = ", and fails it nearer to the pole" if fails else ""
    if fails and not LIMITS[worst].secant:
        beyond += ", because this limit has no secant of the latitude"
    failed = sum(shares[valid].max() > 1 for shares in cheap.values())
    return (
        "What four compasses use up of the limits of IMO A.821(19), by simulation; the dotted line "
        "is the latitude up to which they hold. The first, published for the paper's as it is "
        f"reconstructed, is nearest to a limit in the {worst} test, at "
        f"{paper[worst][valid].max():.2f} of it{beyond}. Damped by a log it stays below "
        f"{max(shares[valid].max() for shares in by_log.values()):.2f}. Damped without a log it "
        f"turns with {alone['turn'][valid].max():.1f} times the limit. With gyros {data.worse:g} "
        f"times worse it fails {failed} of the {len(cheap)} tests; what never settles stands at "
        "the upper edge."
    )


def _settling_at_sea_caption(data: DataTable) -> str:
    _, soft, schuler, inertial = np.max(data.settling, axis=1) / minute
    by_frame, by_filter, _ = np.degrees(data.deviation)
    return (
        "IMO A.821(19), 4.2.1, by simulation, published for latitude 51.5° and horizons with a "
        "damping ratio of 0.7. Left: a stiff one never keeps the limit while the waves last; a "
        f"soft one does after {soft:.0f} minutes at the latest, one with Schuler's period after "
        f"{schuler:.0f}, gravity in inertial space after {inertial:.1f}. "
        "Middle: why. Right: units with gyros that drift, aligned on a ship that sways and turns "
        "in the middle of the record. By the widest turn the spread falls from "
        f"{by_filter[0]:.2f} to {by_filter[-1]:.2f} degrees with a filter; in inertial "
        f"space it is {by_frame.min():.2f} or more."
    )


FIGURES = (
    FigureDefinition("15-damping", experiments.damping_at_sea, damping.draw, _damping_caption),
    FigureDefinition(
        "15-block-diagram", lambda: None, block_diagram.draw, _block_caption, columns=None
    ),
    FigureDefinition(
        "15-frequency-response",
        experiments.frequency_response,
        frequency_response.draw,
        _response_caption,
    ),
    FigureDefinition(
        "15-pulses",
        experiments.counted_pulses,
        pulses.draw,
        _pulses_caption,
        recordings=("laser-gyro",),
    ),
    FigureDefinition(
        "15-settling", experiments.settling_and_swing, settling.draw, _settling_caption
    ),
    FigureDefinition(
        "15-static-characteristic",
        experiments.static_characteristic,
        static_characteristic.draw,
        _static_caption,
    ),
    FigureDefinition("15-restarts", experiments.restart_series, restarts.draw, _restarts_caption),
    FigureDefinition(
        "15-would-it-pass", experiments.type_tests, type_tests.draw, _type_tests_caption
    ),
    FigureDefinition(
        "15-settling-at-sea",
        experiments.settling_at_sea,
        settling_at_sea.draw,
        _settling_at_sea_caption,
        kept=True,
    ),
)

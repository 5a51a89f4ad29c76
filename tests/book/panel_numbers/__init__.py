"""What must stand beside the picture of each panel, computed without the panel and its figure.

The functions in the modules beside this one, one module a chapter, go from the values of a
panel's controls straight to the numerics. What is on display must be the same rows, words and
units, with as many digits; only the last one may differ by one.
"""

import html
import re
from collections.abc import Callable

from driftlab.book.machinery.panel.panel import Explorer

from . import (
    ch01,
    ch02,
    ch03,
    ch04,
    ch05,
    ch06,
    ch07,
    ch09,
    ch10,
    ch11,
    ch12,
    ch13,
    ch14,
    ch15,
    ch16,
    ch17,
)
from .values import Rows, Values

NUMBER = r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?"


def shown_numbers(results: str) -> Rows:
    """Names and values in the HTML of a panel's headline and table.

    In a table of several columns a value is called by its row and column.
    """
    text = html.unescape
    rows = [
        (text(name), text(value))
        for name, value in re.findall(r"<span>([^<]*)</span> <b>([^<]*)</b>", results)
    ]
    columns = [text(title) for title in re.findall(r"<th scope=.col.>([^<]*)</th>", results)]
    for name, cells in re.findall(r"<th scope=.row.>([^<]*)</th>(.*?)</tr>", results):
        values = [text(value) for value in re.findall(r"<td>([^<]*)</td>", cells)]
        names = [f"{text(name)}: {column}" for column in columns] or [text(name)] * len(values)
        rows += zip(names, values, strict=True)
    return rows


def results_of(panel: Explorer) -> Rows:
    """What a panel shows."""
    return shown_numbers(panel.headline.value + panel.text.value)


def assert_shown(panel: str, values: Values, shown: Rows) -> None:
    """Fail unless what a panel shows is what the numerics give."""
    for _, text in shown:
        assert not re.search(r"-0(\.0*)?(?![\d.])", text), f"a negative zero: {text}"
    expected = BY_PANEL[panel](values)
    assert [name for name, _ in shown] == [name for name, _ in expected]
    for (name, text), (_, right) in zip(shown, expected, strict=True):
        assert_same_text(text, right, name)


def seconds_of(text: str) -> float:
    """Seconds of arc that an angle of a panel stands for."""
    number, _, power = text[:-1].partition("·10")
    raised = "".join("-0123456789"["⁻⁰¹²³⁴⁵⁶⁷⁸⁹".index(digit)] for digit in power)
    return float(number) * 10.0 ** int(raised or 0) * {"°": 3600, "′": 60, "″": 1}[text[-1]]


TINY = re.compile(r"[\d.]+·10⁻([⁷⁸⁹]|¹.)″")
"""A small angle; of it 1e-9 seconds of arc, some twenty roundings of a radian, are rounding."""


def assert_same_text(shown: str, expected: str, name: str) -> None:
    """Fail unless two texts differ by rounding only."""
    if TINY.fullmatch(shown) and TINY.fullmatch(expected):
        number = expected.partition("·")[0]
        last = seconds_of(expected) / float(number) / 10 ** len(number.partition(".")[2])
        gap = abs(seconds_of(shown) - seconds_of(expected))
        assert gap < max(1.01 * last, 1e-9), f"{name}: {shown}, expected {expected}"
        return
    assert re.sub(NUMBER, "#", shown) == re.sub(NUMBER, "#", expected), f"{name}: {shown}"
    pairs = zip(re.findall(NUMBER, shown), re.findall(NUMBER, expected), strict=True)
    for ours, theirs in pairs:
        digits = [len(number.partition("e")[0].partition(".")[2]) for number in (ours, theirs)]
        assert digits[0] == digits[1], f"{name}: {shown}, expected {expected}"
        place = 10.0 ** (int(theirs.partition("e")[2] or 0) - digits[1])
        assert abs(float(ours) - float(theirs)) < 1.01 * place, f"{name}: {shown} not {expected}"


BY_PANEL: dict[str, Callable[[Values], Rows]] = {
    "ErrorMotionExplorer": ch01.error_motion,
    "RootsExplorer": ch02.roots,
    "DriftExplorer": ch03.drift,
    "TurnCalibrationExplorer": ch04.turn_calibration,
    "EarthTurnsExplorer": ch05.turns_on_earth,
    "CayleyMapExplorer": ch06.cayley_map,
    "AlgorithmLaboratoryExplorer": ch07.algorithm_laboratory,
    "SplitExplorer": ch10.split_triad,
    "ObservabilityExplorer": ch11.observability,
    "CalibrationRunExplorer": ch11.calibration,
    "MissionExplorer": ch09.mission,
    "ConsistencyExplorer": ch12.consistency,
    "AlignmentBudgetExplorer": ch13.alignment_budget,
    "GyrocompassExplorer": ch14.gyrocompass,
    "TypeTestExplorer": ch15.type_test,
    "CapstoneExplorer": ch16.capstone,
    "AllanExplorer": ch17.allan,
}

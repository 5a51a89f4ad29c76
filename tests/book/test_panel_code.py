"""The code that a panel shows, run by itself, gives what the panel is about."""

import ast
import contextlib
import io
import random
import re

import numpy as np
import pytest
from scipy.constants import arcsecond, degree, g, hour, micro

from driftlab import book
from driftlab.book import (
    AlignmentBudgetExplorer,
    CapstoneExplorer,
    GyrocompassExplorer,
    TypeTestExplorer,
)
from driftlab.book.machinery.panel.panel import Explorer
from driftlab.book.panels import EXPLORERS
from driftlab.drift.characteristic_equation import asymptotic_roots
from driftlab.drift.error_kinematics import error_quaternion
from driftlab.drift.systematic_drift import drift_per_revolution
from grouped import opened
from panel_numbers import NUMBER, results_of, seconds_of
from panel_numbers.ch02 import SHAPES
from panel_numbers.ch04 import turn_calibration
from panel_numbers.ch05 import turns_on_earth
from panel_numbers.ch06 import cayley_map
from panel_numbers.ch07 import algorithm_laboratory
from panel_numbers.ch09 import mission
from panel_numbers.ch10 import split_triad
from panel_numbers.ch11 import calibration, observability
from panel_numbers.ch12 import consistency
from panel_numbers.ch17 import allan
from panel_numbers.values import ABSENT, Values, axis_of, listed


def outcome_of(code: str) -> tuple[np.ndarray, str]:
    """All numbers that the lines of a code give or print, and what they print."""
    printed, names, found = io.StringIO(), {}, []
    with contextlib.redirect_stdout(printed):
        for line in ast.parse(code).body:
            if isinstance(line, ast.Expr):
                value = eval(compile(ast.Expression(line.value), "", "eval"), names)
                parts = value if isinstance(value, tuple) else (value,)
                found += [np.ravel(part) for part in parts if part is not None]
            else:
                exec(compile(ast.Module([line], []), "", "exec"), names)
    text = printed.getvalue()
    found.append(np.array(re.findall(NUMBER, text), float))
    return np.concatenate(found), text


def error_at_the_end(values: Values) -> np.ndarray:
    rate = np.radians(listed(values, "rate1 rate2 rate3"))
    error = np.radians(listed(values, "error1 error2 error3"))
    return error_quaternion(rate, rate + error, 60.0)


def first_order_roots(values: Values) -> np.ndarray:
    return asymptotic_roots(axis_of(values), values["size"] * SHAPES[values["shape"]])


def drift(values: Values) -> np.ndarray:
    entries = [values[f"m{row}{column}"] for row in (1, 2, 3) for column in (1, 2, 3)]
    return drift_per_revolution(axis_of(values), 1e-3 * np.reshape(entries, (3, 3)))


def estimates(values: Values) -> list[float]:
    if values["noise"]:
        return []
    rows = turns_on_earth if "earth" in values else turn_calibration
    return [1e-3 * float(text) for name, text in rows(values) if re.match("σ[₁₂₃]: found", name)]


def cayley(values: Values) -> np.ndarray:
    rows = [row for row in cayley_map(values) if re.match("component.*dimension 3", row[0])]
    return np.array([float(text) for _, text in rows if text != "∞"])


def worst_errors(values: Values) -> list[float]:
    return [
        seconds_of(text)
        for name, text in algorithm_laboratory(values)
        if name.endswith("largest error") and text != ABSENT
    ]


def estimate(values: Values) -> float:
    (text,) = (text for name, text in calibration(values) if name == "estimate")
    number, unit = re.fullmatch(r"(-?[\d.]+)(.*)", text).groups()
    sizes = {" °/h": degree / hour, " ppm": micro, "″": arcsecond, " µg": micro * g}
    return float(number) * sizes[unit]


def lowest_point(values: Values) -> list[float]:
    height, time = re.findall(r"([\d.]+) (?:°/h|s)", allan(values)[0][1])
    return [float(height), float(time)]


def place_at_the_end(values: Values) -> list[float]:
    said = dict(mission(values))
    return [float(said[f"{way}, nmi: at the end"]) for way in ("East", "North")]


def mean_and_bounds(values: Values) -> list[float]:
    return [float(number) for _, text in consistency(values)[:2] for number in text.split(" and ")]


CASES = (
    ("ErrorMotionExplorer", error_at_the_end, {"rel": 1e-9, "abs": 1e-12}),
    ("RootsExplorer", first_order_roots, {"rel": 1e-12}),
    ("DriftExplorer", drift, {"rel": 1e-12}),
    ("TurnCalibrationExplorer", estimates, {"abs": 6e-8}),
    ("EarthTurnsExplorer", estimates, {"abs": 6e-8}),
    ("CayleyMapExplorer", cayley, {"abs": 1e-3, "rel": 1e-3}),
    ("AlgorithmLaboratoryExplorer", worst_errors, {"rel": 0.01}),
    ("CalibrationRunExplorer", estimate, {"abs": 1e-9}),
    ("MissionExplorer", place_at_the_end, {"rel": 1e-4, "abs": 6e-3}),
    ("ConsistencyExplorer", mean_and_bounds, {"abs": 6e-4}),
    ("AllanExplorer", lowest_point, {"rel": 0.01}),
)
PRINTED = (
    (AlignmentBudgetExplorer, "heading: exact"),
    (GyrocompassExplorer, "heading: at the end"),
    (TypeTestExplorer, "turn: measured"),
    (CapstoneExplorer, "heading error under way, as built"),
)
IN_WORDS = {"SplitExplorer", "ObservabilityExplorer"}
"""Panels with a test of their own below."""


def test_the_code_of_no_panel_is_forgotten() -> None:
    tested = {name for name, *_ in CASES} | {e.__name__ for e, _ in PRINTED} | IN_WORDS
    assert tested == {explorer.__name__ for explorer in EXPLORERS}


@pytest.mark.slow
@pytest.mark.usefixtures("no_pixels")
@pytest.mark.parametrize(
    ("name", "expected", "tolerance"),
    [pytest.param(*case, id=case[0], marks=pytest.mark.xdist_group(case[0])) for case in CASES],
)
def test_code_gives_the_numbers_of_its_panel(name, expected, tolerance) -> None:
    panel = opened(getattr(book, name))
    rng = random.Random(5)
    for _ in range(4):
        for control in panel.controls:
            steps = round((control.high - control.low) / control.step)
            place = control.low + control.step * rng.randint(1, steps - 1)
            listed_place = control.options and rng.choice(control.options)
            free_place = type(control.start)(round(place, 9))
            panel.set(**{control.name: listed_place if control.options else free_place})
        found, _ = outcome_of(panel.call(panel.values))
        for number in np.ravel(expected(panel.values)):
            assert any(other == pytest.approx(number, **tolerance) for other in found)


def test_code_of_the_split_gives_its_parts() -> None:
    panel = book.SplitExplorer("Typical unit")
    panel.set(kxy=35.0, kzx=-60.0)
    found, _ = outcome_of(panel.call(panel.values))
    rows = split_triad(panel.values)
    expected = [float(text) for name, text in rows if name.startswith("misalignment")]
    np.testing.assert_allclose(found, expected, atol=0.05)


def test_code_of_the_laboratory_of_schemes_names_what_is_unobservable() -> None:
    panel = book.ObservabilityExplorer("About one axis only")
    _, printed = outcome_of(panel.call(panel.values))
    (unobservable,) = (
        words for name, words in observability(panel.values) if name == "not observable"
    )
    assert unobservable != "nothing"
    assert all(words in printed for words in unobservable.split("; "))


@pytest.mark.slow
@pytest.mark.usefixtures("no_pixels")
@pytest.mark.parametrize(
    ("panel_class", "name"),
    [
        pytest.param(e, name, id=e.__name__, marks=pytest.mark.xdist_group(e.__name__))
        for e, name in PRINTED
    ],
)
def test_panels_of_part_four_say_what_their_code_prints(
    panel_class: type[Explorer], name: str
) -> None:
    """The call beside the picture, run by itself, gives the panel's number."""
    panel = opened(panel_class)
    for preset in panel_class.presets:
        panel.preset.value = preset
        found = dict(results_of(panel))[name]
        if found == ABSENT:  # no heading in a vertical body
            assert preset == "Vertical"
            continue
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            exec(panel.call(panel.values), {})
        printed = float(re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", output.getvalue())[0])
        assert float(found[:-1]) == pytest.approx(printed, abs=1e-4), preset

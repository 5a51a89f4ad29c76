"""The figure and the panel of a real table: its budget by hand, its simulation, its presets."""

from importlib import import_module

import numpy as np
import pytest
from scipy.constants import arcsecond, degree, hour

from driftlab.book.ch05_rate_table_on_earth.experiments import (
    WAYS,
    RealTable,
    budget,
    sigmas_by_way,
    simulated_turns,
)
from driftlab.book.ch05_rate_table_on_earth.figures.real_table import LOWEST
from driftlab.book.machinery.figure.publish import PublishedFigure
from driftlab.drift.weighing_designs import YATES_AXES
from driftlab.earth import EARTH_RATE
from driftlab.motion.turntable_rotation import TurntableRotation
from published import published

ONE, BOTH, OFFSET, BOTH_AND_OFFSET = WAYS
ERRORS = set(RealTable.__dataclass_fields__) - {"rate", "latitude"}
QUIET = dict.fromkeys(ERRORS, 0.0)


def by_source(table: RealTable) -> dict[str, dict[str, float]]:
    sizes, effects = budget(table)
    rows = (dict(zip(WAYS, row, strict=True)) for row in effects / arcsecond)
    return dict(zip(sizes, rows, strict=True))


def test_budget_by_hand() -> None:
    """Ten degrees a second, 37.5 degrees: each source that has a formula of one line."""
    table, rows = RealTable(), by_source(RealTable())
    assert rows["Earth's rate"][ONE] == pytest.approx(52.46, abs=0.01)
    assert rows["scale factor, all gyros"][BOTH] == pytest.approx(30e-6 / arcsecond, rel=1e-9)
    # Each pair axis has the mean of two scale factors, or of two biases times the root of two.
    each = 5e-6 / np.sqrt(2) / arcsecond
    assert rows["scale factor, each gyro"][ONE] == pytest.approx(each, rel=1e-9)
    bias = 0.3 * degree / hour / (10 * degree) / arcsecond
    assert rows["gyro bias"][ONE] == pytest.approx(bias, rel=1e-9)
    assert rows["table overshoots"][ONE] == pytest.approx(5 / (2 * np.pi), rel=1e-9)
    # Variance 1, a half by two senses, 2 by the offset (exercise 4.4), 1 by both.
    walk = table.angle_random_walk * 6 / (2 * np.pi) / arcsecond
    noise = [rows["gyro noise"][way] for way in WAYS]
    np.testing.assert_allclose(noise, walk * np.sqrt([1, 0.5, 2, 1]), rtol=1e-9)
    tilted = 60 * EARTH_RATE * np.cos(37.5 * degree) / (10 * degree)
    assert rows["axis of the table"][ONE] == pytest.approx(tilted, rel=1e-9)


@pytest.mark.parametrize(
    ("field", "source"),
    [
        ("common_scale", "scale factor, all gyros"),
        ("gyro_scale_factor", "scale factor, each gyro"),
        ("gyro_bias", "gyro bias"),
        ("overshoot", "table overshoots"),
        ("stopping", "table stops at random"),
        ("angle_random_walk", "gyro noise"),
        ("mounting", "axis of the body"),
        ("tilt", "axis of the table"),
    ],
)
def test_each_row_against_a_simulation_of_its_source_alone(
    field: str, source: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The simulation of the whole would not notice the smaller ones."""
    # The package of experiments has a function of the module's name.
    module = import_module(simulated_turns.__module__)
    monkeypatch.setattr(module, "SAMPLES", 16)
    runs = 100
    alone = RealTable(**QUIET | {field: getattr(RealTable(), field)})
    found = sigmas_by_way(simulated_turns(alone, runs, np.random.default_rng(1)))
    nothing = simulated_turns(RealTable(**QUIET), 1, np.random.default_rng(1))
    errors = found - sigmas_by_way(nothing)
    rms = dict(zip(WAYS, np.sqrt((errors**2).mean(axis=(-1, -2))) / arcsecond, strict=True))
    for way, effect in by_source(RealTable())[source].items():
        # One random number a run at least; five standard deviations of the root mean square. What
        # is cured to first order leaves less than a hundredth.
        spread = 5 / np.sqrt(2 * runs) * effect
        assert rms[way] == pytest.approx(effect, abs=max(spread, 0.01 * rms[ONE]))


@pytest.mark.parametrize(
    ("source", "left"),
    [
        ("Earth's rate", {ONE}),
        ("axis of the table", {ONE}),
        ("scale factor, all gyros", {ONE, BOTH}),
        ("table overshoots", {ONE, BOTH}),
        ("gyro bias", {ONE, OFFSET}),
        ("scale factor, each gyro", set(WAYS)),
        ("table stops at random", set(WAYS)),
    ],
)
def test_what_each_way_cures(source: str, left: set[str]) -> None:
    effects = by_source(RealTable())[source]
    assert {way for way, effect in effects.items() if effect > 1e-9} == left


@pytest.mark.parametrize("rate", [1.0, 5.0, 30.0])
def test_second_order_of_the_estimate_on_a_table(rate: float) -> None:
    """Half the square of what stands across, and the products with the Earth, as derived."""
    table = RealTable(rate * degree, **QUIET)
    (found,) = simulated_turns(table, 1, np.random.default_rng(0))
    for sense, row in zip((1, -1), found, strict=True):
        w = sense * table.rate
        for n, estimate in zip(YATES_AXES, row, strict=True):
            turning = EARTH_RATE * np.array([0, np.cos(table.latitude), np.sin(table.latitude)])
            seen = TurntableRotation(w).components_at_start(turning, n) / w
            bent = table.triad @ n
            along, across = n @ bent, bent - (n @ bent) * n
            first = along + n @ seen
            second = across @ across / 2 + along * (n @ seen) - across @ seen
            # Third order: cubes of at most 5e-3, with the factor of the tangent, pi squared.
            size = np.linalg.norm(seen) + np.linalg.norm(bent)
            assert abs(estimate - first - second) < 4 * size**3 + 2e-12
            if rate == 30.0:
                assert abs(second) > 50 * (4 * size**3)


@published("05-real-table")
def test_simulation_agrees_with_the_budget(figure: PublishedFigure) -> None:
    data = figure.data
    expected = data.expected[:, np.searchsorted(data.rate, data.simulated_rate)]
    rms, low, _ = np.moveaxis(data.simulated, 1, 0)
    # Half an interval is 1.96 deviations, estimated from the runs; twelve of them, so allow four.
    assert (np.abs(rms - expected) < 4 / 1.96 * (rms - low)).all()
    at_ten = data.expected[:, data.rate.tolist().index(10 * degree)]
    np.testing.assert_allclose(at_ten, data.effect[:, -1], rtol=1e-12)
    caption = figure.definition.caption(data)
    assert "Largest sources: Earth's rate (one direction); scale factor, all gyros (both" in caption
    assert "0.5 arc seconds remain at 10 deg/s" in caption


@published("05-real-table")
def test_figure_says_what_each_way_leaves(figure: PublishedFigure) -> None:
    effects = figure.data.effect[:, :-1]  # without that of all
    assert [figure.data.source[i] for i in effects.argmax(axis=1)] == [
        "Earth's rate",
        "scale factor, all gyros",
        "gyro bias",
        "scale factor, each gyro",
    ]
    # A row without a mark has its reason in the caption.
    assert effects.min() < LOWEST * arcsecond
    assert f"below {LOWEST:g} arc seconds" in figure.caption
    # In one direction the Earth is nearly everything.
    assert effects[0, 0] > 8 * effects[0, 1:].max()

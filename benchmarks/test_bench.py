"""The measuring itself: ratios and their intervals, verdicts, the page; and the floor in C."""

from time import sleep

import numpy as np
import pytest
from scipy.stats import binom

from driftlab.attitude import integrate
from driftlab.calibration import kalman
from driftlab.increments import Increments
from driftlab.strapdown import navigate, stationary_state
from speed import floor, page
from speed.measuring import Contender, Row, largest_angle, measure, median_ratio, verdict


@pytest.mark.parametrize("count", [6, 9, 20, 101])
def test_the_interval_is_the_narrowest_with_its_confidence(count: int) -> None:
    _, low, high = median_ratio(np.arange(count)[::-1] + 1.0, np.ones(count))
    assert high == count + 1 - low  # as many values above as below
    covered = 1 - 2 * binom.cdf([low - 1, low], count, 0.5)
    assert covered[0] >= 0.95 > covered[1]


def test_ratios_are_of_rounds_and_few_have_all_of_them_for_an_interval() -> None:
    disturbed = np.array([1.0, 50.0, 7.0])
    assert median_ratio(np.array([3.0, 1.0, 2.0]) * disturbed, disturbed) == (2, 1, 3)


@pytest.mark.parametrize(
    ("ratio", "theirs", "ours", "said"),
    [
        ((3, 2, 4), 1e-12, 1e-12, "slower"),
        ((3, 2, 4), 1e-12, 1e-9, "**slower, more exact**"),
        ((0.3, 0.2, 0.4), 1e-9, 1e-12, "faster, less exact"),
        ((0.3, 0.2, 0.4), 1.9e-12, 1e-12, "**faster**"),
        ((1, 0.9, 1.1), None, 1e-12, "**as fast**"),
        ((3, 2, 4), 1e-17, 9e-16, "slower"),  # below what anyone would notice
    ],
)
def test_who_is_ahead(ratio: tuple, theirs: float | None, ours: float, said: str) -> None:
    assert verdict(page.Ratio(*ratio), theirs, ours, 1e-15) == said


def test_contenders_run_in_turn_and_the_page_says_who_is_ahead(tmp_path) -> None:
    order: list[str] = []

    def contender(name: str, seconds: float, part: float = 1.0) -> Contender:
        def run() -> None:
            order.append(name)
            sleep(seconds)

        return Contender(name, run, lambda found: 1e-9, part)

    def missing() -> Contender:
        raise ImportError("No module named 'missing'")

    row = Row("a row", contender("ours", 0.05), [lambda: contender("theirs", 0.003), missing],
              [lambda: contender("half", 0.05, 0.5)], error_in="rad")  # fmt: skip
    found = measure(row, 4)
    assert order[-9:] == ["ours", "theirs", "half"] * 3
    assert [line.ratio.median > 1 for line in found.lines] == [False, False, True]
    text = page.page({"Subject": [found]}, "A machine.")
    assert "- Subject, a row: theirs is faster, " in text
    assert "| | time | times ours | error, rad | |" in text
    assert "Left out: No module named 'missing'." in text
    assert [page.time(each) for each in (61.0, 9.996e-4, 2e-11)] == [
        "61.0 s",
        "1.00 ms",
        "0.020 ns",
    ]
    page.write_picture({"Subject": [found]}, tmp_path / "speed.svg")
    assert "<svg" in (tmp_path / "speed.svg").read_text("utf-8")


def test_the_floor_computes_the_same() -> None:
    try:
        floor.library()
    except ImportError as missing:
        pytest.skip(str(missing))
    rng = np.random.default_rng(1)
    rows = 0.1 * rng.normal(size=(120, 3))
    for name in ("picard-1", "two-step-4"):
        assert largest_angle(floor.attitude(rows, name), integrate(rows, name)) < 1e-14
    angle, velocity = 0.01 * rng.normal(size=(2, 12000, 3)) + [[[0, 0, 0]], [[0, 0, 0.098]]]
    start = stationary_state(0.6, [0.0, 0.6, 0.0, 0.8], 3.138)._replace(
        velocity=np.array([300.0, 9, 1])
    )
    found = floor.navigate(start, 0.01, angle, velocity)
    ours = navigate(start, Increments(0.01, angle, velocity))
    assert ours.longitude.min() < -3 < 3 < ours.longitude.max()  # past the date line
    # Rounding of positions as large as the Earth is 1e-9 m.
    within = (1e-14, 1e-14, 1e-6, 1e-8, 1e-12)
    for theirs, expected, allowed in zip(found, ours, within, strict=True):
        np.testing.assert_allclose(theirs, expected, rtol=0, atol=allowed)
    root = rng.normal(size=(27, 27))
    transitions = np.eye(6, 27) + 0.01 * rng.normal(size=(9, 6, 27))
    measured = rng.normal(size=(3, 27)), np.diag([1.0, 2.0, 3.0]), rng.normal(size=3)
    after = root @ root.T
    for transition in transitions:
        after = kalman.predict(after, transition, np.eye(6))
        after = kalman.correct(after, measured[2], *measured[:2]).covariance
    found = floor.filter_steps(root @ root.T, transitions, np.eye(6), *measured)
    np.testing.assert_allclose(found, after, rtol=1e-9, atol=1e-9)

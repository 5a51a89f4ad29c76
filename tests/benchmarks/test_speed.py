"""The measuring itself: ratios, intervals, slopes, verdicts, the page, and the floor in C."""

import re
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import binom
from speed import floor, page, plot, words
from speed.attitude import cone, extended_product
from speed.filtering import Steps, extended_covariance
from speed.growth import Growth, power_law
from speed.measuring import (
    Contender,
    Result,
    Row,
    Target,
    Timing,
    measure,
    median_interval,
    ratio,
)
from speed.verdicts import ahead_of, is_met, verdict

from driftlab.attitude import CONING_ALGORITHMS, integrate
from driftlab.core import loops
from driftlab.increments import Increments
from driftlab.quaternion import cumulative_product
from driftlab.strapdown import at_rest, navigate


def row(**more: object) -> Row:
    return Row("attitude", "a row", Contender("ours", lambda: None), **more)


def result(
    ours: float, theirs: float, errors: tuple[float, float], target: Target | None = None
) -> Result:
    """Ours and one peer, whose times vary by some percent together."""
    shared = np.linspace(1.0, 1.1, 9)
    return Result(
        row(targets=[target] if target else [], rounding=1e-15),
        Timing("ours", ours * shared, errors[0]),
        [Timing("peer", theirs * shared, errors[1])],
    )


def test_ratios_are_of_rounds_and_not_of_medians() -> None:
    disturbed = np.array([1.0, 50.0, 1.0, 7.0, 1.0, 1.0, 3.0])
    found = ratio(Timing("a", 2.0 * disturbed), Timing("b", disturbed))
    assert found == pytest.approx((2.0, 2.0, 2.0))


@pytest.mark.parametrize("count", [6, 9, 20, 101])
def test_the_interval_is_the_narrowest_of_order_statistics_with_the_confidence(count: int) -> None:
    low, high = median_interval(np.arange(count)[::-1] + 1.0)
    cut = int(low) - 1
    assert high == count - cut  # as many values above as below

    def covered(cut: int) -> float:
        return 1 - 2 * binom.cdf(cut, count, 0.5)

    assert covered(cut) >= 0.95 > covered(cut + 1)


def test_the_interval_holds_the_median_of_a_lopsided_distribution() -> None:
    rng = np.random.default_rng(2)
    held = 0
    for values in rng.exponential(size=(400, 9)):
        low, high = median_interval(values)
        held += low <= np.log(2) <= high
    assert held / 400 == pytest.approx(1 - 2 * binom.cdf(1, 9, 0.5), abs=0.03)


def test_few_values_are_all_of_them() -> None:
    assert median_interval(np.array([3.0, 1.0, 2.0])) == (1.0, 3.0)


def test_contenders_run_in_turn_and_a_part_is_scaled_up() -> None:
    order: list[str] = []

    def contender(name: str, part: float = 1.0) -> Contender:
        def run() -> str:
            order.append(name)
            # Long enough to be timed alone.
            np.linalg.svd(np.ones((150, 150)))
            return name

        return Contender(name, run, lambda found: float(len(found)), part)

    found = measure(
        Row("attitude", "", contender("a"), [contender("bc")], [contender("d", 0.5)]), 4
    )
    assert [found.ours.error, found.peers[0].error, found.floor[0].error] == [1, 2, 1]
    assert all(len(each.seconds) == 4 for each in (found.ours, *found.peers, *found.floor))
    names = [name for i, name in enumerate(order) if i == 0 or name != order[i - 1]]
    assert names[-9:] == ["a", "bc", "d"] * 3


def test_a_power_law_has_its_exponent() -> None:
    sizes = np.array([1e2, 1e3, 1e4, 1e5, 1e6])
    assert power_law(sizes, 3e-9 * sizes**1.5) == pytest.approx((1.5, 1.5, 1.5))
    slope = power_law(sizes, sizes * [1.1, 0.9, 1.0, 1.1, 0.9])
    assert slope.low < 1 < slope.high


@pytest.mark.parametrize(
    ("ours", "theirs", "errors", "said", "ahead"),
    [
        (1, 3, (1e-12, 1e-12), "slower", True),
        (1, 3, (1e-12, 1e-9), "slower, less exact", True),
        (1, 3, (1e-9, 1e-12), "slower, **more exact**", False),
        (3, 1, (1e-12, 1e-9), "faster, less exact", True),
        (3, 1, (1e-12, 1.9e-12), "**faster**", False),
        (3, 1, (1e-9, 1e-12), "**faster, more exact**", False),
        (1, 1, (1e-12, 1e-12), "as fast", False),
        (1, 3, (9e-16, 1e-17), "slower", True),  # below what anyone would notice
    ],
)
def test_a_fast_wrong_answer_loses(
    ours: float, theirs: float, errors: tuple[float, float], said: str, ahead: bool
) -> None:
    found = result(ours, theirs, errors)
    assert verdict(found, found.peers[0]) == said
    assert ahead_of(found, found.peers[0]) is ahead


def test_targets() -> None:
    found = result(2.5, 1.0, (0, 0))
    assert is_met(found, Target(3.0, "peer"))
    assert not is_met(found, Target(2.0, "peer"))
    assert is_met(found, Target(2.7))
    assert not is_met(found, Target(2.5))  # seconds: the median is 5 % above
    assert is_met(found, Target(3.0, "left out")) is None


def test_the_page_says_where_others_are_ahead(tmp_path: Path) -> None:
    losing = result(3.0, 1.0, (1e-12, 1e-12), Target(2.0, "peer"))
    growth = Growth("navigation", np.array([1, 10, 100, 1000, 10000]), np.logspace(-6, -2, 5))
    text = page.page([losing], [growth], 0.0)
    ahead = text.split("## Where others are ahead")[1].split("##")[0]
    assert "a row: peer is faster, 0.33 (0.33 to 0.33) times ours." in ahead
    assert "| Attitude: a row | ahead of every peer, as exact | 0 of 1, **missed** |" in text
    assert "at most 2.0 times peer | 3.0 (3.0 to 3.0), **missed** |" in text
    assert "1.00 (1.00 to 1.00) | 1.00 |" in text
    plot.write_plot([losing], [growth], tmp_path / "speed.svg")
    assert "<svg" in (tmp_path / "speed.svg").read_text("utf-8")


def test_the_page_of_a_winner_is_content() -> None:
    text = page.page([result(1.0, 3.0, (1e-12, 1e-12))], [], 0.0)
    assert "Nowhere" in text
    assert "missed" not in text
    assert "believe the ratios" not in text
    assert "believe the ratios" in page.page([], [], 1e3)


@pytest.mark.parametrize(
    ("seconds", "said"),
    [(61.0, "61.0 s"), (0.0123, "12.3 ms"), (9.996e-4, "1.00 ms"), (2.3e-6, "2.30 µs"),
     (4.5e-9, "4.50 ns"), (2e-11, "0.020 ns")],
)  # fmt: skip
def test_times_in_words(seconds: float, said: str) -> None:
    assert words.time(seconds) == said


def test_digits_without_powers_of_ten() -> None:
    assert [words.digits(x) for x in (0, 1234.0, 0.999, 0.0345)] == ["0", "1200", "1.0", "0.035"]


def test_references_of_the_rows() -> None:
    increments, true = cone(120)
    np.testing.assert_allclose(
        integrate(increments, "rotation-vector-3"), true[2::3], rtol=0, atol=1e-6
    )
    steps = 0.1 * np.random.default_rng(1).normal(size=(50, 4)) + [0, 0, 0, 1]
    exact = extended_product(steps).astype(float)
    np.testing.assert_allclose(cumulative_product(steps), exact, rtol=1e-13)


@pytest.fixture(scope="module")
def compiled() -> None:
    try:
        floor.library()
    except floor.NoCompiler as missing:
        pytest.skip(str(missing))


@pytest.mark.usefixtures("compiled")
class TestFloor:
    def test_a_copy(self) -> None:
        values = np.random.default_rng(1).normal(size=(10, 3))
        copied = floor.copy(values)
        assert copied is not values
        np.testing.assert_array_equal(copied, values)

    @pytest.mark.parametrize("name", CONING_ALGORITHMS)
    def test_attitudes(self, name: str) -> None:
        increments = 0.1 * np.random.default_rng(1).normal(size=(120, 3))
        np.testing.assert_allclose(
            floor.attitude(increments, name), integrate(increments, name), rtol=0, atol=1e-14
        )

    def test_navigation(self) -> None:
        rng = np.random.default_rng(1)
        angle = 0.01 * rng.normal(size=(12000, 3))
        velocity = 0.02 * rng.normal(size=(12000, 3)) + [0.0, 0.0, 0.098]
        start = at_rest(0.6, [0.0, 0.6, 0.0, 0.8], 3.138)._replace(velocity=np.array([300.0, 9, 1]))
        found = floor.navigate(start, 0.01, angle, velocity)
        ours = navigate(start, Increments(0.01, angle, velocity))
        for theirs, expected, within in zip(
            found, ours, (1e-14, 1e-14, 1e-6, 1e-8, 1e-12), strict=True
        ):
            np.testing.assert_allclose(theirs, expected, rtol=0, atol=within)
        assert ours.longitude.min() < -3 < 3 < ours.longitude.max()  # past the date line

    def test_steps_of_a_filter(self) -> None:
        rng = np.random.default_rng(1)
        root = rng.normal(size=(27, 27))
        steps = Steps(
            root @ root.T, np.eye(6, 27) + 0.01 * rng.normal(size=(20, 6, 27)), np.eye(6),
            rng.normal(size=(3, 27)), np.diag([1.0, 2.0, 3.0]), rng.normal(size=3),
        )  # fmt: skip
        after = steps.covariance
        for transition in steps.transitions:
            after = loops.predict(after, transition, steps.noise)
            correction, after, _ = loops.correct(
                after, steps.innovation, steps.observation, steps.observation_noise
            )
        found = floor.filter_steps(*steps)
        np.testing.assert_allclose(found[0], after, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(found[1], correction, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(after, extended_covariance(steps).astype(float), atol=1e-9)


def test_without_a_compiler_there_is_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(floor.shutil, "which", lambda _: None)
    with pytest.raises(floor.NoCompiler, match=re.escape("there is no C compiler")):
        floor.compiler_command()

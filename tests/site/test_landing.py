"""The first page: its moving picture computes what the package does, and obeys hand and keys."""

import json
import re

import numpy as np
import pytest

from driftlab.drift import drift_per_revolution

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("site-landing")]
LEAN = np.radians(8.0)  # of the first gyro towards axis 2, as the page opens
TIMES_LESS = 100
FIRST, TURN = 0, 3  # of the tips
PASSED = "([least]) => Number(document.querySelector('#hero input').value) > least"


@pytest.fixture
def still(browser, site):
    """The first page from a disk, for a reader who wants little motion."""
    context = browser.new_context(reduced_motion="reduce", viewport={"width": 1280, "height": 900})
    page = context.new_page()
    page.goto((site / "index.html").as_uri())
    yield page
    context.close()


def leaning(angle: float) -> np.ndarray:
    """Error matrix of a triad whose first gyro leans to axis 2."""
    error = np.zeros((3, 3))
    error[0] = np.cos(angle) - 1, np.sin(angle), 0
    return error


def numbers(page) -> list[float]:
    """The three drifts as the page says them, in degrees, minutes of arc and degrees an hour."""
    texts = page.locator("#hero dd").all_inner_texts()
    return [float(re.match(r"[−\d.]+", text)[0].replace("−", "-")) for text in texts]


def computed(error_as_drawn: np.ndarray, less: np.ndarray, axis) -> list[float]:
    """The same by the package, at one turn a minute."""
    drawn, small = (
        np.degrees(drift_per_revolution(axis, error)) for error in (error_as_drawn, less)
    )
    return [round(float(x), 1) for x in (drawn, 60 * small, 60 * small)]


def moment(page) -> float:
    return float(page.locator("#hero input").input_value())


def test_its_drift_is_that_of_the_package(page, site):
    random = np.random.default_rng(22)
    sizes = 10.0 ** random.uniform(-6, -0.5, (300, 1, 1))
    errors = sizes * random.uniform(-1, 1, (300, 3, 3))
    axes = random.normal(size=(300, 3))
    axes /= np.linalg.norm(axes, axis=1)[:, np.newaxis]
    page.goto((site / "index.html").as_uri())
    cases = [[errors[k].tolist(), axes[k].tolist()] for k in range(300)]
    answers = page.evaluate(f"({json.dumps(cases)}).map(([M, n]) => Drift.perTurn(M, n))")
    of_package = [
        float(drift_per_revolution(n, error)) for error, n in zip(errors, axes, strict=True)
    ]
    assert np.max(np.abs(np.subtract(answers, of_package))) < 1e-14
    assert np.max(np.abs(np.subtract(answers, of_package)) / sizes.ravel()) < 1e-14


def test_after_whole_turns_the_two_attitudes_are_apart_by_the_drift(page, site):
    page.goto((site / "index.html").as_uri())
    error, axis = leaning(0.1), [0.6, 0.8, 0.0]
    apart = "([M, n]) => [1, 2, 3].map((turns) => Drift.error(M, n, 2 * Math.PI * turns))"
    angles = page.evaluate(apart, [error.tolist(), axis])
    assert angles == pytest.approx(
        drift_per_revolution(axis, error) * np.array([1, 2, 3]), abs=1e-12
    )


def test_it_moves_at_once_and_stops(page, site):
    page.goto((site / "index.html").as_uri())
    page.wait_for_function(PASSED, arg=[0.1])
    page.get_by_role("button", name="Pause").click()
    stopped = moment(page)
    page.wait_for_timeout(100)  # some frames
    assert moment(page) == stopped
    page.get_by_role("button", name="Play").click()
    page.wait_for_function(PASSED, arg=[stopped])
    assert page.complaints == []


def test_whoever_wants_little_motion_finds_it_still_and_full_of_meaning(still):
    assert still.get_by_role("button", name="Play").is_visible()
    assert moment(still) == 3
    left = 3 * np.degrees(drift_per_revolution([1, 1, 0], leaning(LEAN)))
    assert f"believes it {left:.1f}° too far" in still.locator(".hero-says").inner_text()


def test_the_numbers_are_those_of_the_package_before_and_after_keys(still):
    less = leaning(LEAN / TIMES_LESS)
    assert numbers(still) == computed(leaning(LEAN), less, [1, 1, 0])
    still.locator("#hero select").select_option("10")
    assert numbers(still)[2] == pytest.approx(
        np.degrees(600 * drift_per_revolution([1, 1, 0], less)), abs=0.05
    )
    tip = still.locator(".handle").nth(FIRST)
    tip.focus()
    for _ in range(40):
        still.keyboard.press("ArrowRight")
    assert float(tip.get_attribute("aria-valuenow")) == pytest.approx(15.0)  # and no farther
    assert "towards axis 2" in tip.get_attribute("aria-valuetext")
    before = numbers(still)
    still.locator(".handle").nth(TURN).focus()
    still.keyboard.press("ArrowUp")
    assert numbers(still) != before


def test_a_tip_is_dragged(still):
    tip = still.locator(".handle").nth(FIRST)
    said, before = numbers(still), tip.get_attribute("transform")
    box = tip.locator("circle").last.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    still.mouse.move(x, y)
    still.mouse.down()
    still.mouse.move(x + 5, y + 12)
    still.mouse.up()
    assert tip.get_attribute("transform") != before
    assert numbers(still) != said
    still.get_by_role("button", name="Start again").click()
    assert tip.get_attribute("transform") == before
    assert moment(still) == 0


def test_beyond_half_a_turn_it_says_how_far_apart_the_attitudes_are(still):
    for i, key in enumerate(["ArrowRight", "ArrowLeft", "ArrowRight"]):
        still.locator(".handle").nth(i).focus()
        for _ in range(20):
            still.keyboard.press(key)
    still.get_by_role("button", name="The worst axis").click()
    still.locator("#hero input").fill("5")
    said = still.locator(".hero-says").inner_text()
    counted, apart = (float(x) for x in re.findall(r"([\d.]+)°", said))
    assert counted > 180
    assert apart == pytest.approx(abs((counted + 180) % 360 - 180), abs=0.15)
    assert still.locator(".hero-scale").inner_text().endswith("at most 180.0°")


def test_the_worst_axis_and_one_without_drift(still):
    still.get_by_role("button", name="The worst axis").click()
    stretches = np.linalg.svd(np.eye(3) + leaning(LEAN), compute_uv=False)
    worst = max(np.abs(stretches - 1)) * 360
    assert abs(numbers(still)[0]) == pytest.approx(worst, abs=0.05)
    still.get_by_role("button", name="An axis without drift").click()
    assert numbers(still) == [0, 0, 0]
    assert "in its computer it is, too" in still.locator(".hero-says").inner_text()


def test_the_worst_axis_is_the_worst_however_small_the_bend(still):
    random = np.random.default_rng(23)
    leans = np.radians(10.0 ** random.uniform(-2, 1, (100, 3, 1)))
    across = np.cross(np.eye(3), random.normal(size=(100, 3, 3)))
    across /= np.linalg.norm(across, axis=2, keepdims=True)
    errors = (np.cos(leans) - 1) * np.eye(3) + np.sin(leans) * across
    axes = still.evaluate("(errors) => errors.map((M) => Drift.worst(M))", errors.tolist())
    for error, axis in zip(errors, axes, strict=True):
        stretches = np.linalg.svd(np.eye(3) + error, compute_uv=False)
        worst = 2 * np.pi * max(np.abs(stretches - 1))
        assert abs(drift_per_revolution(axis, error)) == pytest.approx(worst, rel=1e-3)
    straight = still.evaluate("Drift.worst([[0, 0, 0], [0, 0, 0], [0, 0, 0]])")
    assert np.linalg.norm(straight) == pytest.approx(1)


COUNTED = """
  window.waiting = new Set();
  window.most = 0;
  const [ask, cancel] = [requestAnimationFrame, cancelAnimationFrame];
  window.requestAnimationFrame = (does) => {
    const id = ask((now) => { waiting.delete(id); does(now); });
    if (does.name === 'frame') waiting.add(id); // others ask for frames, too
    most = Math.max(most, waiting.size);
    return id;
  };
  window.cancelAnimationFrame = (id) => { waiting.delete(id); cancel(id); };
"""
"""How many frames the moving picture waits for at once, at most."""


def test_one_frame_follows_another(browser, site):
    context = browser.new_context()
    page = context.new_page()
    page.add_init_script(COUNTED)
    page.goto((site / "index.html").as_uri())
    page.wait_for_function(PASSED, arg=[0.1])
    assert page.evaluate("most") == 1
    context.close()


def test_fingers_find_what_to_press(browser, site):
    context = browser.new_context(viewport={"width": 390, "height": 844}, has_touch=True)
    page = context.new_page()
    page.goto((site / "index.html").as_uri())
    for part in page.locator("#hero button, #hero .grip").all():
        box = part.bounding_box()
        assert min(box["width"], box["height"]) >= 43, part
        assert box["x"] >= 0, part
        assert box["x"] + box["width"] <= 390, part
    last = page.get_by_role("button", name="Start again").bounding_box()
    assert last["y"] + last["height"] < 844  # in view with the triad
    page.get_by_role("button", name="Pause").tap()
    assert page.get_by_role("button", name="Play").is_visible()
    context.close()


def test_without_scripts_it_says_so_and_stands_still(browser, site):
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto((site / "index.html").as_uri())
    assert "Without them it stands still" in page.locator("#hero").inner_text()
    picture = page.locator("#hero img")
    assert picture.is_visible()
    assert (site / picture.get_attribute("src")).is_file()
    context.close()


def test_it_says_how_large_the_pdf_is_and_leads_to_ones_work(page, site):
    page.goto((site / "index.html").as_uri())
    size = (site / "drift-lab.pdf").stat().st_size / 1e6
    assert f"(PDF, {size:.0f} MB)" in page.locator(".doors").inner_text()
    if (site / "live").exists():
        assert page.locator("a[href='live/my-work.html']").count() == 1

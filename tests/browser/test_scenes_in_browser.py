"""Every living scene in a page: what is drawn there is what the package says, at every moment."""

import re

import numpy as np
import pytest
from notebook_page import FRAME, NotebookPage, wait_until

from driftlab.book.machinery.scene.stage import Stage, View
from driftlab.book.machinery.scene.svg import flat_corners, part_path, still
from driftlab.book.machinery.scene.view import SceneExplorer
from driftlab.book.panels import SCENES

SHOW_ALL = """
from ipywidgets import VBox
from driftlab.book.panels import SCENES
VBox([scene() for scene in SCENES])
"""
SCENE = "document.querySelectorAll('.dl-scene')[{}].driftlab"
# By view and part: where it is, and whether it is seen.
DRAWN = """scene => scene.views.map(view => view.drawn.map(({ element }) => [
  element.getAttribute("d"), element.getAttribute("cx") ?? element.getAttribute("x"),
  element.getAttribute("cy") ?? element.getAttribute("y"), element.getAttribute("visibility"),
]))"""
TABLE = "scene => [...scene.table.rows].map(row => [...row.cells].map(cell => cell.textContent))"
PLAY = f"""async scene => {{
  scene.goTo(0);
  scene.play();
  const before = scene.moment, start = performance.now();
  while (scene.moment === before && performance.now() - start < 5000) {{
    await {FRAME};
  }}
  scene.pause();
  return [before, scene.moment];
}}"""
TOLERANCE = 0.011
"""Both sides round to two decimals, and a tie may go either way."""

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("scenes")]


@pytest.fixture(scope="module")
def page(notebook: NotebookPage) -> NotebookPage:
    """All scenes of the book, one below the other."""
    notebook.show(SHOW_ALL)
    found = "() => document.querySelectorAll('.dl-scene').length"
    wait_until(
        notebook.page, lambda: notebook.page.evaluate(found) == len(SCENES), "all the scenes"
    )
    return notebook


def ask(page: NotebookPage, index: int, function: str):
    return page.page.evaluate(f"({function})({SCENE.format(index)})")


def numbers(path: str) -> np.ndarray:
    return np.array(re.findall(r"-?\d+(?:\.\d+)?", path), float)


def assert_drawn(view: View, stage: Stage, moment: int, drawn: list) -> None:
    """Fail unless every part of a view is where the package says."""
    for part, (path, x, y, seen) in zip(view.parts, drawn, strict=True):
        corners = flat_corners(view, part, stage, moment)
        if part.kind in ("dot", "label"):
            np.testing.assert_allclose([float(x), float(y)], corners[0], rtol=0, atol=TOLERANCE)
            continue
        expected = part_path(part, corners)
        assert re.sub(r"[^MLZ]", "", path) == re.sub(r"[^MLZ]", "", expected)
        np.testing.assert_allclose(numbers(path), numbers(expected), rtol=0, atol=TOLERANCE)
        if part.kind == "face":
            x_flat, y_flat = corners.T
            area = np.sum(x_flat * np.roll(y_flat, -1) - y_flat * np.roll(x_flat, -1))
            there = moment >= part.since
            if abs(area) > 1:  # neither edge on nor nearly so
                assert (seen == "visible") == (there and area < 0)


@pytest.mark.parametrize("index", range(len(SCENES)), ids=[scene.__name__ for scene in SCENES])
def test_every_place_on_the_screen_is_a_number_of_the_package(
    page: NotebookPage, index: int
) -> None:
    scene: SceneExplorer = SCENES[index]()
    stage = scene.view.stage(scene.compute(scene.values))
    last = len(stage.times) - 1
    for moment in (0, last // 3, last):
        ask(page, index, f"scene => scene.goTo({moment})")
        for view, drawn in zip(stage.views, ask(page, index, DRAWN), strict=True):
            assert_drawn(view, stage, moment, drawn)
        table = [[readout.name, readout.said(moment)] for readout in stage.readouts]
        assert ask(page, index, TABLE) == table
    assert page.all_trouble() == []


@pytest.mark.parametrize("index", range(len(SCENES)), ids=[scene.__name__ for scene in SCENES])
def test_curves_are_those_of_the_still(page: NotebookPage, index: int) -> None:
    scene = SCENES[index]()
    stage = scene.view.stage(scene.compute(scene.values))
    written = re.findall(r'class="dl-curve[^"]* dl-future" d="([^"]*)"', still(stage))
    curves = "scene => scene.plots.flatMap(p => [...p.svg.querySelectorAll('.dl-future')].map(c => c.getAttribute('d')))"  # noqa: E501
    shown = ask(page, index, curves)
    assert len(shown) == len(written) == sum(len(plot.curves) for plot in stage.plots)
    for ours, theirs in zip(shown, written, strict=True):
        np.testing.assert_allclose(numbers(ours), numbers(theirs), rtol=0, atol=TOLERANCE)


def test_they_play_and_stop(page: NotebookPage) -> None:
    for index in range(len(SCENES)):
        before, after = ask(page, index, PLAY)
        assert after > before, SCENES[index].__name__
    assert page.all_trouble() == []


def test_a_handle_obeys_the_arrow_keys_and_keeps_the_focus(page: NotebookPage) -> None:
    """The kernel answers with a new stage, and the sliders of the panel have moved with it."""
    (index,) = (i for i, scene in enumerate(SCENES) if scene.__name__ == "TurningBlock")
    shown = page.page.locator(".driftlab-panel").nth(index)
    ask(page, index, "scene => scene.goTo(0)")
    headline = shown.locator(".driftlab-headline")
    before = headline.inner_text()
    handle = shown.locator('[data-handle="axis of the turns"]')
    handle.focus()
    for _ in range(8):
        page.page.keyboard.press("ArrowUp")
    wait_until(page.page, lambda: headline.inner_text() != before, "another drift")
    assert handle.evaluate("element => document.activeElement === element")
    assert shown.locator("select").first.input_value() == "own values"
    assert page.all_trouble() == []


RAISED = """scene => {
  const view = scene.views.find(each => each.svg.querySelector('[data-handle]'));
  const handle = view.svg.querySelector('[data-handle]');
  const latitude = () => {
    const { place } = view.seen(handle.dataset.handle);
    return Math.asin(place[1] / Math.hypot(...place)) * 180 / Math.PI;
  };
  const last = scene.stage.times.length - 1;
  return [0, 0.3, 0.6, 1].map(part => {
    scene.goTo(Math.round(part * last));
    const before = latitude();
    const key = before < 0 ? 'ArrowUp' : 'ArrowDown';
    handle.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true }));
    return Math.abs(latitude() - before);
  });
}"""
"""How many degrees of the view one key asks for, at four moments of a scene."""


def test_a_key_asks_for_two_degrees_wherever_a_handle_is(page: NotebookPage) -> None:
    handled = [
        i for i in range(len(SCENES)) if "data-handle" in ask(page, i, "s => s.viewsBox.outerHTML")
    ]
    assert handled
    for index in handled:
        np.testing.assert_allclose(ask(page, index, RAISED), 2.0, err_msg=SCENES[index].__name__)


def test_the_kernel_is_told_where_a_scene_stands(page: NotebookPage) -> None:
    index = 0
    slider = page.page.locator(".dl-bar input").nth(index)
    ask(page, index, "scene => scene.goTo(0)")
    slider.focus()
    for _ in range(3):
        page.page.keyboard.press("ArrowRight")
    assert ask(page, index, "scene => [scene.moment, scene.model.get('moment')]") == [3, 3]
    page.page.keyboard.press(" ")
    assert ask(page, index, "scene => !!scene.playing")
    page.page.keyboard.press(" ")
    assert not ask(page, index, "scene => !!scene.playing")

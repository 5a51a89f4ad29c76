"""Every living scene in a page: what is drawn there is what the package says, at every moment."""

import re

import numpy as np
import pytest
from notebook_page import FRAME, wait_until
from places import Place
from twin import Panel

from driftlab.book.machinery.scene.stage import Stage, View
from driftlab.book.machinery.scene.svg import flat_corners, part_path, still
from driftlab.book.panels import SCENES

SCENE = "document.querySelector('.dl-scene').driftlab"
# By view and part: where it is, and whether it is seen.
DRAWN = """scene => scene.views.map(view => view.drawn.map(({ element }) => [
  element.getAttribute("d"), element.getAttribute("cx") ?? element.getAttribute("x"),
  element.getAttribute("cy") ?? element.getAttribute("y"), element.getAttribute("visibility"),
]))"""
TABLE = "scene => [...scene.table.rows].map(row => [...row.cells].map(cell => cell.textContent))"
CURVES = """scene => scene.plots.flatMap(
  plot => [...plot.svg.querySelectorAll(".dl-future")].map(curve => curve.getAttribute("d"))
)"""
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
# How many degrees of the view one key asks for, at four moments of a scene.
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
TOLERANCE = 0.011
"""Both sides round to two decimals, and a tie may go either way."""

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("browser")]


def scenes(*names: str) -> pytest.MarkDecorator:
    places = [Place("", 0, name, ()) for name in names]
    return pytest.mark.parametrize("panel", places, ids=names, indirect=True)


def ask(panel: Panel, function: str):
    return panel.shown.page.evaluate(f"({function})({SCENE})")


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


@scenes(*(each.__name__ for each in SCENES))
def test_every_place_on_the_screen_is_a_number_of_the_package(panel: Panel) -> None:
    """It plays, a key asks for two degrees, and each control goes to both ends."""
    twin = panel.twin
    stage = twin.view._shown
    last = len(stage.times) - 1
    for moment in (0, last // 3, last):
        ask(panel, f"scene => scene.goTo({moment})")
        for view, drawn in zip(stage.views, ask(panel, DRAWN), strict=True):
            assert_drawn(view, stage, moment, drawn)
        table = [[readout.name, readout.said(moment)] for readout in stage.readouts]
        assert ask(panel, TABLE) == table
    written = re.findall(r'class="dl-curve[^"]* dl-future" d="([^"]*)"', still(stage))
    shown = ask(panel, CURVES)
    assert len(shown) == len(written) == sum(len(plot.curves) for plot in stage.plots)
    for ours, theirs in zip(shown, written, strict=True):
        np.testing.assert_allclose(numbers(ours), numbers(theirs), rtol=0, atol=TOLERANCE)
    before, after = ask(panel, PLAY)
    assert after > before
    panel.sweep(apart=type(twin).__name__ == "BoxOnTheWayNorth")
    if "data-handle" in ask(panel, "scene => scene.viewsBox.outerHTML"):
        np.testing.assert_allclose(ask(panel, RAISED), 2.0)


@scenes("TurningBlock")
def test_a_handle_obeys_the_arrow_keys_and_keeps_the_focus(panel: Panel) -> None:
    """The kernel answers with a new stage, and the sliders of the panel have moved with it."""
    shown, page = panel.shown, panel.shown.page
    ask(panel, "scene => scene.goTo(0)")
    before = shown.numbers()
    handle = shown.panel.locator('[data-handle="axis of the turns"]')
    handle.focus()
    for _ in range(8):
        page.keyboard.press("ArrowUp")
    wait_until(page, lambda: shown.numbers() != before, "another drift")
    assert handle.evaluate("element => document.activeElement === element")
    assert shown.preset() == "own values"


@scenes("TurningBlock")
def test_the_kernel_is_told_where_a_scene_stands(panel: Panel) -> None:
    page = panel.shown.page
    ask(panel, "scene => scene.goTo(0)")
    page.locator(".dl-bar input").focus()
    for _ in range(3):
        page.keyboard.press("ArrowRight")
    assert ask(panel, "scene => [scene.moment, scene.model.get('moment')]") == [3, 3]
    page.keyboard.press(" ")
    assert ask(panel, "scene => !!scene.playing")
    page.keyboard.press(" ")
    assert not ask(panel, "scene => !!scene.playing")

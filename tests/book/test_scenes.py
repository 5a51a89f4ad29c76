"""Every living scene: sound wherever its controls are, and each handle where it is drawn."""

import contextlib
import io
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from driftlab.book.machinery.panel.panel import ERROR_CLASS
from driftlab.book.machinery.scene.stage import Stage
from driftlab.book.machinery.scene.svg import animation, place, still
from driftlab.book.machinery.scene.view import SceneExplorer, nearest
from grouped import every_scene, opened

SPAN = 0.2
"""A curve that fills less of its plot at every preset is not drawn to be seen."""


def stage_of(scene: SceneExplorer) -> Stage:
    return scene.view.stage(scene.compute(scene.values))


def handles_of(stage: Stage) -> dict[str, np.ndarray]:
    """Places of all handles at the first moment, in the axes of what they turn with."""
    return {
        part.handle: np.reshape(part.points, (-1, 3))[0]
        for view in stage.views
        for part in view.parts
        if part.handle
    }


def assert_sound(scene: SceneExplorer) -> None:
    assert ERROR_CLASS not in scene.message.value
    assert "nan" not in scene.headline.value + scene.text.value


def same(one: Any, two: Any) -> bool:
    """Whether two stages are equal, their numbers to rounding.

    Where an array lies in memory decides the last digit of some products with OpenBLAS 0.3.27.
    """
    if isinstance(one, memoryview):
        a, b = np.frombuffer(one), np.frombuffer(two)
        return a.shape == b.shape and np.allclose(a, b, rtol=1e-12, atol=1e-12, equal_nan=True)
    if isinstance(one, dict):
        return one.keys() == two.keys() and all(same(one[key], two[key]) for key in one)
    if isinstance(one, list | tuple):
        return len(one) == len(two) and all(map(same, one, two))
    return one == two


@pytest.mark.slow
@every_scene
def test_sound_at_all_presets_and_at_the_ends_of_all_controls(scene_class) -> None:
    """A handle dragged to where it is moves nothing; curves fill their plots, and none leaves."""
    scene = opened(scene_class)
    controls = {control.name: control for control in scene.controls}
    filled: dict[str, float] = {}
    for preset in scene.presets:
        scene.preset.value = preset
        assert_sound(scene)
        stage = stage_of(scene)
        for handle, point in handles_of(stage).items():
            for name, value in scene.dragged(handle, point).items():
                here, slider = scene.values[name], controls[name]
                assert abs(nearest(slider, value) - here) <= 1.01 * slider.step, (preset, handle)
        for plot in stage.plots:
            values = np.concatenate([curve.values for curve in plot.curves])
            values = values[np.isfinite(values)]
            margin = 1e-9 * (plot.high - plot.low)
            assert values.min() >= plot.low - margin, (preset, plot.title)
            assert values.max() <= plot.high + margin, (preset, plot.title)
            share = np.ptp(values) / (plot.high - plot.low)
            filled[plot.title] = max(share, filled.get(plot.title, 0.0))
    assert all(share > SPAN for share in filled.values()), filled
    scene.reset.click()
    before, shown = scene.values, scene.view.widget.stage
    for control in scene.controls:
        for end in control.options or control.examples or (control.low, control.high):
            scene.set(**{control.name: end})
            assert_sound(scene)
        scene.set(**{control.name: before[control.name]})
    assert same(scene.view.widget.stage, shown), "the stage depends on the way to the values"


@every_scene
def test_every_handle_can_be_dragged(scene_class) -> None:
    scene = opened(scene_class)
    rng = np.random.default_rng(1)
    moved = set()
    for handle, point in handles_of(stage_of(scene)).items():
        scene.reset.click()
        before = scene.values
        direction = point + 0.3 * np.linalg.norm(point) * rng.normal(size=3)
        scene._asked(None, {"handle": handle, "direction": direction.tolist()}, [])
        assert_sound(scene)
        if scene.values != before:
            moved.add(handle)
    assert moved == set(handles_of(stage_of(scene)))


@every_scene
def test_a_scene_opens_with_code_that_runs_and_a_still_that_plays(scene_class) -> None:
    """The faces of a solid, drawn alike, look away from its middle."""
    scene = opened(scene_class)
    with contextlib.redirect_stdout(io.StringIO()):
        exec(scene.call(scene.values), {})
    stage = stage_of(scene)
    ElementTree.fromstring(still(stage, 0))
    drawn = ElementTree.fromstring(animation(stage, 5))
    values = [a.get("values") for a in drawn.iter("{http://www.w3.org/2000/svg}animate")]
    assert {value.count(";") for value in values} == {4}
    solids: dict[tuple[str, str], list[np.ndarray]] = {}
    for view in stage.views:
        for part in view.parts:
            if part.kind == "face" and part.style in ("block", "globe"):
                solids.setdefault((part.style, part.track), []).append(place(part, stage, 0))
    for faces in solids.values():
        if len(faces) < 6:
            continue
        middle = np.mean([face.mean(axis=0) for face in faces], axis=0)
        for face in faces:
            normal = np.cross(face[2] - face[0], face[3] - face[1])
            assert normal @ (face.mean(axis=0) - middle) > 0


def test_a_handle_beyond_a_slider_stops_at_its_end() -> None:
    control = opened(next(iter(every_scene.args[1])).values[0]).controls[0]
    assert nearest(control, 1e9) == control.high
    assert nearest(control, -1e9) == control.low
    assert nearest(control, control.low + 1.4 * control.step) == pytest.approx(
        control.low + control.step
    )


@pytest.mark.slow
@every_scene
def test_a_key_moves_each_handle_though_a_step_of_its_slider_is_larger(scene_class) -> None:
    """By half a degree, as the arrow keys do with Shift: in some direction, and that way."""
    for name, place_before in handles_of(stage_of(opened(scene_class))).items():
        moved = []
        for axis in np.eye(3):
            scene = opened(scene_class)
            across = np.cross(place_before, axis)
            wanted = place_before + np.radians(0.5) * across
            before = scene.values
            scene._asked(None, {"handle": name, "direction": wanted.tolist(), "key": True}, None)
            if scene.values != before:
                moved.append((handles_of(stage_of(scene))[name] - place_before) @ across)
        assert moved, name
        assert min(moved) > -1e-12, f"{name} goes the other way"

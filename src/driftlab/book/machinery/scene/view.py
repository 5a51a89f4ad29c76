"""A living scene in a panel: the widget that plays a stage, and handles that move the sliders."""

from __future__ import annotations

from collections.abc import Mapping
from importlib.resources import files
from math import copysign
from typing import Any, ClassVar

import anywidget
import numpy as np
import traitlets

from driftlab.checks import FloatArray

from ..one_at_a_time import one_at_a_time
from ..panel.control import Control
from ..panel.panel import Explorer, Values
from .stage import Stage
from .svg import STYLE, still

SCRIPTS = ("arrays.js", "space.js", "curves.js", "scene.js")
"""The script in the page, in pieces of one idea each; a widget carries it as one text."""


class SceneWidget(anywidget.AnyWidget):
    """Plays a stage in the page."""

    _esm = "\n".join((files(__package__) / name).read_text("utf-8") for name in SCRIPTS)
    _css = STYLE
    stage = traitlets.Dict().tag(sync=True)  # what `Stage.message` returns
    moment = traitlets.Int(0).tag(sync=True)  # the moment that is shown, as soon as it stands still
    # whether it plays by itself when the reader first sees it
    autoplay = traitlets.Bool(False).tag(sync=True)
    # whether the kernel computes; what takes long is shown pale
    busy = traitlets.Bool(False).tag(sync=True)


class SceneView:
    """What draws a scene for an explorer; subclasses say which `stage` shows the data."""

    autoplay: ClassVar[bool] = False

    def __init__(self) -> None:
        self.widget = SceneWidget(autoplay=self.autoplay)

    def stage(self, data: Any) -> Stage:
        """Return what is shown of an experiment's data."""
        raise NotImplementedError

    def show(self, data: Any) -> None:
        """Bring the widget up to date."""
        self._shown = self.stage(data)
        self.widget.stage = self._shown.message()

    def still(self) -> tuple[bytes, str]:
        """Return the last moment as SVG, and what kind of file it is."""
        return still(self._shown).encode(), "svg+xml"


class SceneExplorer(Explorer):
    """A panel whose picture is a scene; a handle in it moves the sliders, and they move it."""

    picture_class: ClassVar[type[SceneView]]

    def __init__(
        self, preset: str | None = None, *, presets: Mapping[str, Values] | None = None
    ) -> None:
        super().__init__(preset, presets=presets)
        self.view.widget.on_msg(self._asked)

    def redraw(self) -> None:
        self.view.widget.busy = True
        try:
            super().redraw()
        finally:
            self.view.widget.busy = False

    def dragged(self, handle: str, direction: FloatArray) -> Values:
        """Return the values of the controls that bring a handle into a direction (3,).

        The direction is in the axes of what the handle turns with; its length is that of the
        handle's place. Values beyond a control's ends are moved to them.
        """
        raise NotImplementedError

    @one_at_a_time
    def _asked(self, _: Any, message: dict[str, Any], __: Any) -> None:
        try:
            values = self.dragged(message["handle"], np.array(message["direction"], float))
            controls = {control.name: control for control in self.controls}
            wanted = {name: nearest(controls[name], value) for name, value in values.items()}
            if message.get("key") and wanted.items() <= self.values.items():
                wanted |= _one_step(controls, self.values, values)
            self.set(**wanted)
        finally:
            self.view.widget.send({"done": True})  # now it may ask again


def _one_step(
    controls: Mapping[str, Control], now: Mapping[str, Any], wanted: Mapping[str, Any]
) -> Values:
    """Move by a step the control that is asked to go farthest: a key is less than half a step."""
    steps = {name: (value - now[name]) / controls[name].step for name, value in wanted.items()}
    name = max(steps, key=lambda each: abs(steps[each]))
    if not steps[name]:
        return {}
    control, way = controls[name], copysign(1.0, steps[name])
    if control.options:
        farther = [each for each in control.options if (each - now[name]) * way > 0]
        return {name: min(farther, key=lambda each: abs(each - now[name]), default=now[name])}
    return {name: nearest(control, now[name] + way * control.step)}


def nearest(control: Control, value: float) -> float:
    """Return the value of a slider that is nearest to `value`."""
    if control.options:
        return min(control.options, key=lambda option: abs(option - value))
    steps = round((min(max(value, control.low), control.high) - control.low) / control.step)
    return round(control.low + steps * control.step, 9)

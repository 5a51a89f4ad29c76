"""What the book's panels ask of ipywidgets and anywidget, for a page that has neither.

Widgets here have values and observers, and can be described to a page as plain data: each has an
identifier, a kind and the state that would be shown. `install` puts them where Python looks for
the two packages. There is no kernel and no message of Jupyter: a page calls functions of `panels`,
which tell it what has changed since.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from importlib.machinery import ModuleSpec
from itertools import count
from types import ModuleType
from typing import Any
from weakref import WeakValueDictionary

import traitlets
from traitlets import Any as AnyTrait, Bool, CFloat, CInt, Int, Tuple, Unicode

WIDGETS: WeakValueDictionary[str, Widget] = WeakValueDictionary()
"""All there are, by identifier."""

_numbers = count()
_changed: dict[str, dict[str, Any]] = {}
_messages: list[tuple[str, Any]] = []


def taken() -> tuple[dict[str, dict[str, Any]], list[tuple[str, Any]]]:
    """Return what has changed since the last time, and the messages to scripts in the page."""
    changed = {each: _plain(state) for each, state in _changed.items()}
    messages = list(_messages)
    _changed.clear()
    _messages.clear()
    return changed, messages


def _plain(value: Any) -> Any:
    if isinstance(value, Widget):
        return value.described()
    if isinstance(value, dict):
        return {name: _plain(each) for name, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(each) for each in value]
    return value


class Widget(traitlets.HasTraits):
    """Anything with a state; what the page shows of it is tagged ``sync``, as in ipywidgets."""

    def __init__(self, **state: Any) -> None:
        self.id = str(next(_numbers))
        WIDGETS[self.id] = self
        super().__init__(**state)

    def notify_change(self, change: Any) -> None:
        """Remember the change for the page, then tell the observers."""
        if self.traits()[change["name"]].metadata.get("sync"):
            _changed.setdefault(self.id, {})[change["name"]] = change["new"]
        super().notify_change(change)

    def described(self) -> dict[str, Any]:
        """Return the widget, and all in it, as plain data."""
        kind = next(each for each in type(self).__mro__ if each.__module__ == __name__)
        state = {name: _plain(getattr(self, name)) for name in self.traits(sync=True)}
        return {"id": self.id, "kind": kind.__name__, "state": state}

    def received(self, message: Any) -> None:
        """Take what the page says that is no value."""
        raise NotImplementedError(f"{type(self).__name__} expects no message, got {message!r}.")


class Layout(Widget):
    """Whether a widget is shown; where it stands is the page's to say, by its classes."""

    display = Unicode(None, allow_none=True).tag(sync=True)

    def __init__(self, display: str | None = None, **_: Any) -> None:
        super().__init__(display=display)


class DOMWidget(Widget):
    """A widget that has a place in the page."""

    layout = AnyTrait().tag(sync=True)
    style = AnyTrait()
    classes = Tuple().tag(sync=True)
    description = Unicode().tag(sync=True)
    tooltip = Unicode(None, allow_none=True).tag(sync=True)

    def __init__(self, *, layout: Any = None, **state: Any) -> None:
        super().__init__(layout={} if layout is None else layout, **state)

    @traitlets.validate("layout")
    def _a_layout(self, proposal: Any) -> Layout:
        value = proposal["value"]
        return value if isinstance(value, Layout) else Layout(**value)

    def add_class(self, name: str) -> DOMWidget:
        """Give it an HTML class."""
        if name not in self.classes:
            self.classes = (*self.classes, name)
        return self


class ValueWidget(DOMWidget):
    """A widget with a value, which may be given as the first argument."""

    value = AnyTrait().tag(sync=True)

    def __init__(self, *value: Any, **state: Any) -> None:
        super().__init__(**({"value": value[0]} if value else {}), **state)


class HTML(ValueWidget):
    """Text with marks."""

    value = Unicode().tag(sync=True)


class Image(ValueWidget):
    """The file of a picture."""

    value = traitlets.Bytes().tag(sync=True)
    format = Unicode("png").tag(sync=True)
    width = traitlets.CUnicode().tag(sync=True)


class Checkbox(ValueWidget):
    """A box to tick."""

    value = Bool().tag(sync=True)
    indent = Bool(True)


class Text(ValueWidget):
    """A line of text."""

    value = Unicode().tag(sync=True)
    continuous_update = Bool(True)


class Bounded(ValueWidget):
    """A number between two ends, to which it is moved."""

    min: Any
    max: Any

    @traitlets.validate("value")
    def _within(self, proposal: Any) -> Any:
        return max(self.min, min(self.max, proposal["value"]))


class FloatSlider(Bounded):
    """A number on a scale."""

    value = CFloat().tag(sync=True)
    min = CFloat(0.0).tag(sync=True)
    max = CFloat(100.0).tag(sync=True)
    step = CFloat(0.1).tag(sync=True)
    readout_format = Unicode(".2f").tag(sync=True)


class IntSlider(Bounded):
    """A whole number on a scale."""

    value = CInt().tag(sync=True)
    min = CInt(0).tag(sync=True)
    max = CInt(100).tag(sync=True)
    step = CInt(1).tag(sync=True)
    readout_format = Unicode("d").tag(sync=True)


class Selection(ValueWidget):
    """One of several values; the page knows their labels, and which of them it is."""

    value = AnyTrait()
    labels = Tuple().tag(sync=True)
    index = Int(None, allow_none=True).tag(sync=True)

    def __init__(self, *, options: Iterable[Any] = (), **state: Any) -> None:
        pairs = [each if isinstance(each, tuple) else (str(each), each) for each in options]
        self._values = [value for _, value in pairs]
        if "value" not in state and pairs:
            state["value"] = self._values[0]
        super().__init__(labels=tuple(label for label, _ in pairs), **state)
        self._follow()

    @traitlets.validate("value")
    def _known(self, proposal: Any) -> Any:
        value = proposal["value"]
        if value is not None and value not in self._values:
            raise traitlets.TraitError(f"expected one of {self._values}, got {value!r}.")
        return value

    @traitlets.observe("value")
    def _follow(self, _: Any = None) -> None:
        self.index = None if self.value not in self._values else self._values.index(self.value)

    @traitlets.observe("index")
    def _lead(self, change: Any) -> None:
        self.value = None if change["new"] is None else self._values[change["new"]]


class Dropdown(Selection):
    """A menu."""


class SelectionSlider(Selection):
    """A slider that stops at its values only."""


class Button(DOMWidget):
    """Something to press."""

    def __init__(self, **state: Any) -> None:
        self._handlers: list[Callable[[Button], Any]] = []
        super().__init__(**state)

    def on_click(self, handler: Callable[[Button], Any]) -> None:
        """Let `handler` be called with the button when it is pressed."""
        self._handlers.append(handler)

    def click(self) -> None:
        """Press it."""
        for handler in self._handlers:
            handler(self)

    def received(self, message: Any) -> None:
        """Be pressed in the page."""
        self.click()


class Box(DOMWidget):
    """Widgets together."""

    children = Tuple().tag(sync=True)

    def __init__(self, children: Iterable[Widget] = (), **state: Any) -> None:
        super().__init__(children=tuple(children), **state)


class VBox(Box):
    """Widgets below each other."""


class HBox(Box):
    """Widgets beside each other."""


class AnyWidget(DOMWidget):
    """A widget that brings its own script; the page runs it as it is."""

    _esm = ""
    _css = ""

    def __init__(self, **state: Any) -> None:
        self._listeners: list[Callable[[Any, Any, Any], Any]] = []
        super().__init__(**state)

    def described(self) -> dict[str, Any]:
        """Return the widget with its script and style."""
        return {**super().described(), "script": self._esm, "style": self._css}

    def on_msg(self, listener: Callable[[Any, Any, Any], Any]) -> None:
        """Let `listener` be called with what the script sends: widget, message, no buffers."""
        self._listeners.append(listener)

    def send(self, message: Any, buffers: Any = None) -> None:
        """Send something to the script."""
        _messages.append((self.id, message))

    def received(self, message: Any) -> None:
        """Take what the script sends."""
        for listener in self._listeners:
            listener(self, message, [])


def install() -> None:
    """Let ``import ipywidgets`` and ``import anywidget`` find what is here."""
    mine = [each for each in globals().values() if isinstance(each, type)]
    widgets = [each for each in mine if issubclass(each, Widget) and each is not AnyWidget]
    for name, offered in (("ipywidgets", widgets), ("anywidget", [AnyWidget])):
        module = ModuleType(name, __doc__)
        module.__spec__ = ModuleSpec(name, None)  # or nobody could ask whether it is installed
        for each in offered:
            setattr(module, each.__name__, each)
        sys.modules[name] = module

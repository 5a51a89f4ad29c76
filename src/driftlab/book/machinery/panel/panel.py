"""What every slider panel of the book is made of.

An explorer is a picture, a list of controls, and one function from the controls' values to the
picture's data. What draws is a `View`: a Matplotlib picture that is redrawn at each move, or a
widget that lives in the page. Results stand in a table beside the controls, and a line under the
title says what to look for. There is no output area to swallow an error: bad values show a sentence
in the panel, and anything unforeseen shows its traceback there and is raised again.
"""

import html
import traceback
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar, Protocol

import ipywidgets as widgets

from ..figure.picture import Picture
from ..figure.picture_file import PICTURES, ending_of, how_to_save, picture_file
from ..figure.sheet import Sheet
from ..one_at_a_time import one_at_a_time
from .control import Control
from .control_rows import control_rows, with_class
from .matplotlib_view import MatplotlibView
from .page import Page
from .presets import Values as Values, check_values, offered_presets
from .results import Results
from .still import display_with_still, still

ERROR_CLASS = "driftlab-error"
"""HTML class of a traceback in a panel; the tests look for it."""

PANEL_CLASS = "driftlab-panel"
"""HTML class of every panel; page.js and page.css look for it and for what begins like it."""

OWN_VALUES = "Your own values: say first what you expect, then move one thing at a time."
"""What stands under the title when the values are no preset's."""


class View(Protocol):
    """What draws the data of an explorer."""

    widget: widgets.DOMWidget

    def show(self, data: Any) -> None:
        """Bring the widget up to date."""

    def still(self) -> tuple[bytes, str]:
        """Return what is shown as the file of a picture, and its kind: "jpeg", "svg+xml"."""


class Explorer(widgets.VBox):
    """A slider panel; subclasses say which controls, picture and computation.

    Show it as the last line of a cell. Its values can be read and set in code as well:
    ``explorer.values`` and ``explorer.set(size=0.1)``. What it shows goes into a paper by
    ``explorer.save("picture.pdf", width=3.5)``.

    It opens with the preset that is named, or the first one. Presets of your own stand before the
    book's: ``DriftExplorer(presets={"My triad": {"m12": 1.0}})`` opens with yours.
    """

    title: ClassVar[str]
    picture_class: ClassVar[type[Picture] | type[View]]
    controls: ClassVar[Sequence[Control]]
    presets: ClassVar[Mapping[str, Values]]
    """By name, the values that differ from the controls' own."""
    look_for: ClassVar[Mapping[str, str]] = {}
    """By preset, a question or an invitation: what is to be looked at."""

    def compute(self, values: Values) -> Any:
        """Return the picture's data. A `ValueError` becomes a sentence in the panel."""
        raise NotImplementedError

    def numbers(self, data: Any) -> Results:
        """Return what stands beside the picture, with units."""
        raise NotImplementedError

    def call(self, values: Values) -> str:
        """Return the Python lines that compute the same."""
        raise NotImplementedError

    def __init__(
        self, preset: str | None = None, *, presets: Mapping[str, Values] | None = None
    ) -> None:
        """Open the panel with a preset; any other values come by the sliders or by `set`."""
        offered = offered_presets(self.controls, self.presets, presets or {})
        if preset is not None and preset not in offered:
            raise ValueError(f"preset: expected one of {', '.join(offered)}, got {preset!r}.")
        self._widgets = {control.name: control.widget() for control in self.controls}
        starts = {control.name: control.start for control in self.controls}
        self._presets = {name: {**starts, **values} for name, values in offered.items()}
        opening = self._presets[preset or next(iter(offered))]
        self._setting = False  # whether it is this object that moves the widgets
        self._results = Results(("", ""), ())
        self.page = Page(layout={"display": "none"})
        self.view = self._new_view()
        self.view.widget.add_class("driftlab-picture")
        self.guide = widgets.HTML()
        self.message = widgets.HTML()
        self.headline = with_class(widgets.HTML(), "driftlab-headline")
        self.text = widgets.HTML()
        self.code = widgets.HTML()
        drawn = issubclass(self.picture_class, Picture)
        self.paper = widgets.HTML(how_to_save(type(self).__name__, drawn=drawn))
        self.preset = widgets.Dropdown(
            options=[("own values", ""), *((name, name) for name in self._presets)],
            description="preset",
        )
        self.reset = widgets.Button(description="Reset", tooltip="Back to the values at the start")
        for widget in self._widgets.values():
            widget.observe(self._moved, "value")
        self.preset.observe(self._preset_chosen, "value")
        self.reset.on_click(lambda _: self.set(**opening))
        rows = [widgets.HBox([self.preset, self.reset])]
        rows += control_rows(self.controls, self._widgets)
        title = widgets.HTML(f"<h4>{html.escape(self.title)}</h4>")
        work = [
            with_class(widgets.VBox([title, self.guide, self.message]), "driftlab-title"),
            # The picture stands above the sliders, so that it does not move away from them.
            self.view.widget,
            with_class(
                widgets.Box(
                    [
                        with_class(widgets.VBox([self.headline, self.text]), "driftlab-results"),
                        with_class(widgets.VBox(rows), "driftlab-controls"),
                    ]
                ),
                "driftlab-lower",
            ),
        ]
        super().__init__(
            [self.page, with_class(widgets.Box(work), "driftlab-work"), self.code, self.paper]
        )
        self.add_class(PANEL_CLASS)
        self.set(**opening)

    def _new_view(self) -> View:
        if issubclass(self.picture_class, Picture):
            return MatplotlibView(self.picture_class(), self.page)
        return self.picture_class()

    @property
    def values(self) -> dict[str, Any]:
        """The values of all controls."""
        # A browser counts in steps and sends back, say, 0.19999999999999998.
        return {
            name: round(widget.value, 9) if isinstance(widget.value, float) else widget.value
            for name, widget in self._widgets.items()
        }

    @one_at_a_time
    def set(self, **values: Any) -> None:
        """Set some controls and redraw once."""
        check_values(self.controls, values)
        self._setting = True
        try:
            for name, value in values.items():
                self._widgets[name].value = value
        finally:
            self._setting = False
        self._moved()

    def save(self, path: str | Path, width: float | None = None) -> Path:
        """Save the picture of what the panel shows now as .pdf, .svg or .png, a scene as .svg only.

        The width is in inches, 3.5 for a column, 7.2 for a page; as on a screen if not given.
        """
        path, sheet = Path(path), Sheet(width)
        if issubclass(self.picture_class, Picture):
            ending = ending_of(path, PICTURES)
            figure = self.picture_class.draw(self._shown, sheet).figure
            if sheet.on_paper and figure.get_figwidth() != sheet.width:
                only = "this picture, which is laid out for a screen"
                raise ValueError(f"width: expected None for {only}, got {width!r}.")
            picture = picture_file(figure, ending, sheet, self.title, self.page.alt)
        else:
            picture, kind = self.view.still()
            ending_of(path, [kind.partition("+")[0]])
            if sheet.on_paper:
                raise ValueError(f"width: expected None for what plays on a page, got {width!r}.")
        path.write_bytes(picture)
        return path

    @one_at_a_time
    def _moved(self, _: Any = None) -> None:
        if not self._setting:
            self._name_preset()
            self.redraw()

    @one_at_a_time
    def _preset_chosen(self, change: Any) -> None:
        if change["new"] and not self._setting:
            self.set(**self._presets[change["new"]])

    def _name_preset(self) -> None:
        """Let the preset menu say what the values are, and the line below the title go with it."""
        matching = [name for name, preset in self._presets.items() if preset == self.values]
        name = matching[0] if matching else ""
        self._setting = True
        self.preset.value = name
        self._setting = False
        self._looking = self.look_for.get(name, "") if name else OWN_VALUES
        self.guide.value = f"<p class='driftlab-guide'>{html.escape(self._looking)}</p>"

    def redraw(self) -> None:
        """Compute and show the picture, the numbers and the code for the present values."""
        try:
            self._show(self.values)
        except Exception:
            trace = html.escape(traceback.format_exc())
            self._say(f"<pre role='alert' class='{ERROR_CLASS}'>{trace}</pre>")
            raise

    def _show(self, values: Values) -> None:
        try:
            data = self.compute(values)
        except ValueError as refusal:
            reason = html.escape(str(refusal))
            excuse = "No picture for these values; the one below is the last."
            self._say(f"<p role='alert' class='driftlab-guide'>{excuse} {reason}</p>")
            self._tell(self._results.blank())
            self.code.value = ""
            return
        self.view.show(data)
        self._shown = data
        self._results = self.numbers(data)
        self._tell(self._results)
        self.code.value = f"<pre>{html.escape(self.call(values))}</pre>"
        self._say("")

    def _tell(self, results: Results) -> None:
        self.headline.value, self.text.value = results.headline_html(), results.table_html()
        headline = f"{results.headline[0]}: {results.headline[1]}"
        self.page.alt = f"{self.title}. {self._looking} {headline}"

    def _say(self, message: str) -> None:
        """Show a sentence in place of what to look for; with none, that again."""
        self.message.value = message
        self.message.layout.display = None if message else "none"
        self.guide.layout.display = "none" if message else None

    def _ipython_display_(self) -> None:
        """The live panel, and for pages that cannot show it, its picture."""
        picture, kind = self.view.still()
        text = self.page.alt
        instead = still(picture, kind, text, type(self).__name__, self.values)
        display_with_still(self, instead, text)

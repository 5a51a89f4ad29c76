"""What every slider panel of the book is made of.

An explorer is a `Picture`, a list of controls, and one function from the controls' values to the
picture's data. The picture is a Matplotlib figure kept for the panel's life: its background is
drawn once, and anew only if the axes have changed their reach, a move of a slider redraws only the
artists that move, and the result goes as a JPEG into an image widget: at this quality nobody sees
the difference, and a PNG takes several times as long to make. There is no output area to flicker or
to swallow an error: bad values show a sentence in the panel, and anything unforeseen shows its
traceback there and is raised again.
"""

import base64
import html
import io
import re
import traceback
from collections.abc import Mapping, Sequence
from importlib.resources import files
from typing import Any, ClassVar

import ipywidgets as widgets
import matplotlib
from matplotlib.backends.backend_agg import FigureCanvasAgg
from PIL import Image

from .control import Control
from .picture import STYLE, Picture

ERROR_CLASS = "driftlab-error"
"""HTML class of a traceback in a panel; the tests look for it."""

PANEL_CLASS = "driftlab-panel"
"""HTML class of every panel; the script and the style below look for it."""

FOCUS_STYLE = (
    f"<style>.{PANEL_CLASS} :focus-visible "
    "{ outline: 2px solid currentColor !important; outline-offset: 1px; }</style>"
)
"""Where the keyboard is must be seen on every kind of control."""

ACCESSIBILITY_SCRIPT = (files(__package__) / "accessibility.js").read_text("utf-8")

PIXEL_RATIO = 1.25
"""Pixels of the picture for one of the page: more are sharper, and take longer to compress."""

Values = Mapping[str, Any]


class Explorer(widgets.VBox):
    """A slider panel; subclasses say which controls, picture and computation.

    Show it as the last line of a cell. Its values can be read and set in code as well:
    ``explorer.values`` and ``explorer.set(size=0.1)``.

    Parameters
    ----------
    preset : str, optional
        Name of the preset to open with, and to go back to on Reset; the first if not given.
    """

    title: ClassVar[str]
    picture_class: ClassVar[type[Picture[Any]]]
    controls: ClassVar[Sequence[Control]]
    presets: ClassVar[Mapping[str, Values]]
    """By name, the values that differ from the controls' own."""

    def compute(self, values: Values) -> Any:
        """Return the picture's data. A `ValueError` becomes a sentence in the panel."""
        raise NotImplementedError

    def numbers(self, data: Any) -> Sequence[tuple[str, str]]:
        """Return what stands beside the picture: names and formatted values with units."""
        raise NotImplementedError

    def call(self, values: Values) -> str:
        """Return the Python lines that compute the same."""
        raise NotImplementedError

    def __init__(self, preset: str | None = None) -> None:
        if preset is not None and preset not in self.presets:
            raise ValueError(f"preset: expected one of {', '.join(self.presets)}, got {preset!r}.")
        self._widgets = {control.name: control.widget() for control in self.controls}
        starts = {control.name: control.start for control in self.controls}
        self._presets = {name: {**starts, **values} for name, values in self.presets.items()}
        opening = self._presets[preset or next(iter(self.presets))]
        self._setting = False  # whether it is this object that moves the widgets
        self._picture = self.picture_class()
        for artist in self._picture.moving:
            artist.set_animated(True)
        canvas = self._picture.figure.canvas
        assert isinstance(canvas, FigureCanvasAgg)
        width, _ = canvas.get_width_height()
        self._picture.figure.dpi = PIXEL_RATIO * self._picture.figure.dpi
        self._canvas = canvas
        self._picture.rescaled = True  # nothing has been drawn yet

        fitting = {"max_width": "100%", "margin": "0"}
        self.image = widgets.Image(format="jpeg", width=width, layout=fitting)
        self.message = widgets.HTML()
        self.text = widgets.HTML()
        self.code = widgets.HTML()
        self.preset = widgets.Dropdown(
            options=[("own values", ""), *((name, name) for name in self._presets)],
            description="preset",
        )
        self.reset = widgets.Button(description="Reset", tooltip="Back to the values at the start")
        for widget in self._widgets.values():
            widget.observe(self._moved, "value")
        self.preset.observe(self._preset_chosen, "value")
        self.reset.on_click(lambda _: self.set(**opening))
        super().__init__(
            [
                _script(ACCESSIBILITY_SCRIPT),
                widgets.HTML(f"{FOCUS_STYLE}<b>{html.escape(self.title)}</b>"),
                widgets.HBox([self.preset, self.reset]),
                # The picture stands above the sliders, so that it does not move away from them.
                self.image,
                self.message,
                self.text,
                *self._rows(),
                self.code,
            ]
        )
        self.add_class(PANEL_CLASS)
        self.set(**opening)

    def _rows(self) -> list[widgets.Box]:
        """The controls by group: boxes to tick and lines of text across, sliders in columns."""
        groups: dict[str, list[Control]] = {}
        for control in self.controls:
            groups.setdefault(control.group, []).append(control)
        across, columns = [], []
        for group, members in groups.items():
            heading = [widgets.HTML(_compact(html.escape(group)))] if group else []
            row = [*heading, *(self._widgets[control.name] for control in members)]
            if all(control.is_box for control in members):
                across.append(widgets.HBox(row, layout={"flex_flow": "row wrap"}))
            elif all(control.examples for control in members):
                across.append(widgets.VBox(row))
            else:
                # As many columns as the page has room for; the sliders share what is left over.
                columns.append(widgets.VBox(row, layout={"flex": "1 1 26em", "max_width": "40em"}))
        return [*across, widgets.HBox(columns, layout={"flex_flow": "row wrap"})]

    @property
    def values(self) -> dict[str, Any]:
        """The values of all controls."""
        # A browser counts in steps and sends back, say, 0.19999999999999998.
        return {
            name: round(widget.value, 9) if isinstance(widget.value, float) else widget.value
            for name, widget in self._widgets.items()
        }

    def set(self, **values: Any) -> None:
        """Set some controls and redraw once.

        Raises
        ------
        ValueError
            If there is no such control, or its value is out of range.
        """
        controls = {control.name: control for control in self.controls}
        for name, value in values.items():
            if name not in controls:
                raise ValueError(f"values: expected names from {', '.join(controls)}, got {name}.")
            controls[name].check(value)
        self._setting = True
        try:
            for name, value in values.items():
                self._widgets[name].value = value
        finally:
            self._setting = False
        self._moved()

    def _moved(self, _: Any = None) -> None:
        if not self._setting:
            self._name_preset()
            self.redraw()

    def _preset_chosen(self, change: Any) -> None:
        if change["new"] and not self._setting:
            self.set(**self._presets[change["new"]])

    def _name_preset(self) -> None:
        """Let the preset menu say what the values are."""
        matching = [name for name, preset in self._presets.items() if preset == self.values]
        self._setting = True
        self.preset.value = matching[0] if matching else ""
        self._setting = False

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
            excuse = "No picture for these values; the one above is the last."
            self._say(f"<p role='alert'>{excuse} {reason}</p>")
            self.text.value = self.code.value = ""
            return
        self._picture.update(data)
        self.image.value = self._jpeg()
        self.text.value = _table(self.numbers(data))
        self.code.value = f"<pre>{html.escape(self.call(values))}</pre>"
        self._say("")

    def _say(self, message: str) -> None:
        self.message.value = message
        self.message.layout.display = None if message else "none"

    def _repr_mimebundle_(self, **options: Any) -> Any:
        """The live panel, and for pages that cannot show one, its picture."""
        bundle = super()._repr_mimebundle_(**options)
        return {**bundle, "image/jpeg": base64.b64encode(self.image.value).decode()}

    def _draw_background(self) -> None:
        with matplotlib.rc_context(STYLE):
            self._canvas.draw()
        self._background = self._canvas.copy_from_bbox(self._picture.figure.bbox)
        self._picture.rescaled = False

    def _jpeg(self) -> bytes:
        canvas = self._canvas
        if self._picture.rescaled:
            self._draw_background()
        canvas.restore_region(self._background)
        with matplotlib.rc_context(STYLE):
            for artist in self._picture.moving:
                artist.axes.draw_artist(artist)  # type: ignore[union-attr]
        buffer = io.BytesIO()
        pixels = canvas.buffer_rgba()
        # X: the fourth byte means nothing. The picture is opaque.
        picture = Image.frombuffer("RGBX", canvas.get_width_height(), pixels, "raw", "RGBX", 0, 1)
        # Colours as fine as the rest, or thin coloured lines would fade.
        picture.save(buffer, format="jpeg", quality=90, subsampling=0)
        return buffer.getvalue()


def _script(code: str) -> widgets.Output:
    """Return a widget that runs JavaScript in the page and shows nothing."""
    output = {
        "output_type": "display_data",
        "data": {"application/javascript": code},
        "metadata": {},
    }
    return widgets.Output(outputs=(output,), layout={"display": "none"})


def _compact(content: str, style: str = "") -> str:
    """Content of an HTML widget in lines closer than those of a slider."""
    return f"<div style='line-height: 1.5; {style}'>{content}</div>"


def _table(numbers: Sequence[tuple[str, str]]) -> str:
    # Cells of a fixed width: what the values are does not move what stands below.
    cells = ""
    for name, number in numbers:
        # What rounds to zero has no sign.
        value = re.sub(r"-(0(\.0*)?)(?![\d.e])", r"\1", number)
        # What does not fit into a column has two, or a row for itself.
        length = len(name) + len(value)
        width = "21.5em" if length < 40 else "43em" if length < 80 else "100%"
        cells += (
            f"<span style='flex: 0 0 {width}; max-width: 100%'>"
            f"{html.escape(name)} <b>{html.escape(value)}</b></span>"
        )
    return _compact(cells, "display: flex; flex-wrap: wrap")

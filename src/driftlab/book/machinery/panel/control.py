"""One quantity of a slider panel that the reader can change: a slider, a menu, a box or a text."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import ipywidgets as widgets

from driftlab.checks import finite_array

STOPS_CLASS = "driftlab-stops"
"""HTML class of a slider with stops; the script in the page looks for it."""
TOOLTIP = "tooltip" if hasattr(widgets.DOMWidget, "tooltip") else "description_tooltip"
"""What ipywidgets calls the name of a slider that shows on hovering; the latter before 8.0."""


@dataclass(frozen=True)
class Control:
    """One quantity the reader can change."""

    name: str  # key in the values handed to `Explorer.compute`
    label: str  # what stands before the slider, with the unit
    start: Any  # value wherever a preset does not say another one. A bool makes a box to tick
    low: float = 0.0  # of a slider
    high: float = 1.0  # of a slider
    step: float = 0.1  # of a slider
    stops: Sequence[float] = ()  # for a slider that stops at these values only
    choices: Sequence[str] = ()  # for a menu instead of a slider
    # for a line of text instead of a slider; any text goes, these are good ones
    examples: Sequence[str] = ()
    group: str = ""  # heading of the column in which the control stands

    @property
    def options(self) -> Sequence[Any]:
        """All values there are; empty for a range and for text."""
        return (False, True) if self.is_box else self.choices or self.stops

    @property
    def is_box(self) -> bool:
        """Whether it is a box to tick."""
        return isinstance(self.start, bool)

    @property
    def is_slider(self) -> bool:
        """Whether it is a slider: no box, menu or line of text."""
        return not (self.is_box or self.choices or self.examples)

    @property
    def full_name(self) -> str:
        """Label with the group: what hovering shows, and what a screen reader says."""
        return f"{self.group}: {self.label}" if self.group else self.label

    def widget(self) -> widgets.ValueWidget:
        """Make the widget: a slider (whole-numbered if `start` is), a menu, a box or a text."""
        common = {
            "value": self.start,
            "description": self.label,
            TOOLTIP: self.full_name,
            "style": {"description_width": "9.5em"},
            "layout": {"width": "auto"},
        }
        if self.is_box:
            # The label stands beside the box, not before it, so it needs no column of its own.
            box = {**common, "style": {"description_width": "0"}, "layout": {"width": "auto"}}
            return widgets.Checkbox(indent=False, **box)
        if self.examples:
            # Taken when the reader presses Enter or leaves the line, not at each letter.
            return widgets.Text(continuous_update=False, **common)
        if self.choices:
            return widgets.Dropdown(options=self.choices, **common)
        if self.stops:
            options = [(f"{stop:g}", stop) for stop in self.stops]
            slider = widgets.SelectionSlider(options=options, **common)
            slider.add_class(STOPS_CLASS)
            return slider
        ends = {"min": self.low, "max": self.high, "step": self.step}
        if isinstance(self.start, int):
            return widgets.IntSlider(**ends, **common)
        # As many decimals as a step has, and two at least.
        decimals = max(2, len(f"{self.step:f}".rstrip("0").partition(".")[2]))
        return widgets.FloatSlider(readout_format=f".{decimals}f", **ends, **common)

    def check(self, value: Any) -> None:
        """Refuse a value that the widget would refuse or silently move."""
        if self.options:
            if value not in self.options:
                listed = ", ".join(map(str, self.options))
                raise ValueError(f"{self.name}: expected one of {listed}, got {value!r}.")
        elif self.examples:
            if not isinstance(value, str):
                raise ValueError(f"{self.name}: expected text, got {value!r}.")
        else:
            whole = isinstance(self.start, int)
            if not self.low <= finite_array(value, self.name) <= self.high or (whole and value % 1):
                raise ValueError(
                    f"{self.name}: expected a {'whole ' * whole}number from {self.low} to "
                    f"{self.high}, got {value!r}."
                )

"""Values of a panel's controls that have a name: the book's presets, and a teacher's own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from .control import Control

Values = Mapping[str, Any]


def check_values(controls: Sequence[Control], values: Values, argument: str = "values") -> None:
    """Refuse what is no control's name, or out of its range."""
    known = {control.name: control for control in controls}
    for name, value in values.items():
        if name not in known:
            raise ValueError(f"{argument}: expected names from {', '.join(known)}, got {name}.")
        known[name].check(value)


def offered_presets(
    controls: Sequence[Control], book: Mapping[str, Values], own: Mapping[str, Values]
) -> dict[str, Values]:
    """Return the presets of a panel, your own first; one with a name of the book's replaces it."""
    if not isinstance(own, Mapping) or not all(isinstance(v, Mapping) for v in own.values()):
        raise ValueError(f"presets: expected values by control for each name, got {own!r}.")
    for values in own.values():
        check_values(controls, values, "presets")
    return {**own, **{name: values for name, values in book.items() if name not in own}}

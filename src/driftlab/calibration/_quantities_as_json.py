"""Quantities with units as JSON, and back, with a sentence for what is not as expected."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

import driftlab
from driftlab.checks import FloatArray, finite_array


def written(
    schema: str, head: dict[str, str], convention: str, quantities: dict[str, Any]
) -> dict[str, Any]:
    """Quantities by name, each a unit, a value and perhaps a deviation, with what they mean."""
    plain = {}
    for key, (unit, value, deviation) in quantities.items():
        plain[key] = {"unit": unit, "value": _plain(value, key)}
        if deviation is not None:
            plain[key]["deviation"] = _plain(deviation, key)
    return {
        "schema": schema,
        **head,
        "convention": convention,
        "written_by": f"driftlab {driftlab.__version__}",
        "quantities": plain,
    }


def _plain(value: Any, name: str) -> Any:
    # A fit that had no unknown of a kind has no number of it.
    array = np.asarray(value, float)
    return (finite_array(array, name) if array.size else array).tolist()


def parsed(source: str | Path) -> dict[str, Any]:
    """The dictionary in a text or a file, or in the values that a command wrote."""
    text = source.read_text(encoding="utf-8") if isinstance(source, Path) else source
    if not isinstance(text, str):
        raise ValueError(f"source: expected a text or a Path, got {type(source).__name__}.")
    try:
        document = json.loads(text)
    except json.JSONDecodeError as error:
        hint = "" if text.lstrip().startswith("{") else "; a file is named by a Path"
        raise ValueError(f"source: expected JSON, got {error}{hint}.") from None
    values = document.get("values") if isinstance(document, dict) else None
    if isinstance(values, dict) and "calibration" in values:
        document = values["calibration"]
    if not isinstance(document, dict):
        raise ValueError(f"source: expected a calibration, got a {type(document).__name__}.")
    return document


def quantities_of(
    document: dict[str, Any], units: dict[str, str], needed: tuple[str, ...]
) -> tuple[dict[str, FloatArray], dict[str, FloatArray]]:
    """Values and standard deviations by name."""
    quantities = document.get("quantities")
    if not isinstance(quantities, dict):
        raise ValueError(f"quantities: expected some by name, got {quantities!r:.60}.")
    if missing := [key for key in needed if key not in quantities]:
        raise ValueError(f"quantities: expected {', '.join(needed)}, got no {missing[0]}.")
    values, deviations = {}, {}
    for key, said in quantities.items():
        if key not in units:
            raise ValueError(f"quantities: expected some of {', '.join(units)}, got {key!r}.")
        if not isinstance(said, dict) or "value" not in said:
            raise ValueError(f"{key}: expected a unit and a value, got {said!r:.60}.")
        if said.get("unit") != units[key]:
            raise ValueError(f"{key}: expected the unit {units[key]}, got {said.get('unit')!r}.")
        values[key] = _numbers(said["value"], key)
        if "deviation" in said:
            deviations[key] = _numbers(said["deviation"], f"{key}, deviation")
    if deviations and (missing := [key for key in needed if key not in deviations]):
        raise ValueError(f"{missing[0]}: expected a deviation, as others have one, got none.")
    return values, deviations


def _numbers(value: Any, name: str) -> FloatArray:
    return finite_array(value, name) if value != [] else np.zeros(0)


def check_convention(document: dict[str, Any], expected: str) -> None:
    """Refuse numbers that mean something else."""
    if document.get("convention") != expected:
        raise ValueError(f"convention: expected {expected!r}, got {document.get('convention')!r}.")


def word_of(document: dict[str, Any], key: str) -> str:
    """A text by its name; empty if there is none."""
    if not isinstance(word := document.get(key, ""), str):
        raise ValueError(f"{key}: expected text, got {word!r:.60}.")
    return word

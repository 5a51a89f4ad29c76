"""Quantities with units as JSON, and back, with a sentence for what is not as expected."""

from __future__ import annotations

import json
from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np

import driftlab
from driftlab.axes import checked_axes
from driftlab.checks import FloatArray, checked_text, finite_array


def written(
    schema: str, head: dict[str, str], convention: str, quantities: dict[str, Any]
) -> dict[str, Any]:
    """Quantities by name, each a unit, a value and perhaps a deviation, with what they mean."""
    plain = {}
    for key, (unit, value, deviation) in quantities.items():
        plain[key] = {"unit": unit, "value": _plain(value, key)}
        if deviation is not None:
            plain[key]["deviation"] = _deviation(deviation, np.asarray(value), key).tolist()
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
    if array.size:
        return finite_array(array, name).tolist()
    # Of shape (0, 3) the 3 would be lost.
    if 0 in array.shape[:-1]:
        raise ValueError(f"{name}: expected at least one fit, got shape {array.shape}.")
    return array.tolist()


def parsed(source: str | Path) -> dict[str, Any]:
    """The dictionary in a text or a file, or in the values that a command wrote."""
    text = source.read_text(encoding="utf-8") if isinstance(source, Path) else source
    if not isinstance(text, str):
        raise ValueError(f"source: expected a text or a Path, got {type(source).__name__}.")
    try:
        document = json.loads(text, object_pairs_hook=_once)
    except json.JSONDecodeError as error:
        hint = "" if text.lstrip().startswith("{") else "; a file is named by a Path"
        raise ValueError(f"source: expected JSON, got {error}{hint}.") from None
    values = document.get("values") if isinstance(document, dict) else None
    if isinstance(values, dict) and "calibration" in values:
        document = values["calibration"]
    if not isinstance(document, dict):
        raise ValueError(f"source: expected a calibration, got a {type(document).__name__}.")
    return document


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise ValueError(f"source: expected each name once, got {twice!r} again.")
    return found


def quantities_of(
    document: dict[str, Any],
    units: dict[str, str],
    needed: tuple[str, ...],
    uncertain: tuple[str, ...] = (),
) -> tuple[dict[str, FloatArray], dict[str, FloatArray]]:
    """Values by name, and standard deviations of those that are `uncertain`, all or none."""
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
        fields = ("unit", "value", "deviation")[: 3 if key in uncertain else 2]
        if unknown := [field for field in said if field not in fields]:
            raise ValueError(f"{key}: expected {', '.join(fields)}, got {unknown[0]!r}.")
        if said.get("unit") != units[key]:
            raise ValueError(f"{key}: expected the unit {units[key]}, got {said.get('unit')!r}.")
        values[key] = _numbers(said["value"], key)
        if "deviation" in said:
            deviations[key] = _deviation(said["deviation"], values[key], key)
    if deviations and (missing := [key for key in uncertain if key not in deviations]):
        raise ValueError(f"{missing[0]}: expected a deviation, as others have one, got none.")
    return values, deviations


def _numbers(value: Any, name: str) -> FloatArray:
    # A fit that had no unknown of a kind has [] for it, or [] for each of several.
    if value == [] or (isinstance(value, list) and all(each == [] for each in value)):
        return np.zeros(np.shape(value))
    return finite_array(value, name)


def _deviation(value: Any, of: FloatArray, name: str) -> FloatArray:
    array = finite_array(value, f"{name}, deviation")
    if (
        not array.ndim or array.shape != of.shape[of.ndim - array.ndim :]
    ):  # one may serve many units
        raise ValueError(
            f"{name}: expected a deviation of the shape of its value, got shapes {array.shape} and "
            f"{of.shape}."
        )
    if array.min() < 0:
        raise ValueError(f"{name}: expected deviations of at least 0, got {array.min():g}.")
    return array


def check_convention(document: dict[str, Any], expected: str) -> None:
    """Refuse numbers that mean something else."""
    if document.get("convention") != expected:
        raise ValueError(f"convention: expected {expected!r}, got {document.get('convention')!r}.")


def check_sizes(fit: dict[str, FloatArray]) -> None:
    """Refuse what is no fit of turns: other than three sigmas, a covariance of other unknowns."""
    finite_array(fit["sigma"], "sigma", 3)
    unknowns = (np.atleast_1d(fit[key]) for key in ("sigma", "scale", "gyro_bias", "earth_rate"))
    size = sum(each.shape[-1] for each in unknowns)
    finite_array(fit["covariance"], "covariance", size, size)


def check_axes_and_date(axes: str, date: str) -> None:
    """Refuse texts that are none, unless they are empty."""
    if checked_text(axes, "axes"):
        checked_axes(axes, "axes")
    try:
        if date:
            datetime.fromisoformat(date)
    except ValueError:
        raise ValueError(
            f"date: expected a date such as 2024-05-01 or 2024-05-01T12:00, got {date!r}."
        ) from None


def word_of(document: dict[str, Any], key: str) -> str:
    """A text by its name; empty if there is none."""
    if not isinstance(word := document.get(key, ""), str):
        raise ValueError(f"{key}: expected text, got {word!r:.60}.")
    return word

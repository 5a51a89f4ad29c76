"""Calibrations as JSON: a small text that says each quantity's unit and what its numbers mean.

What is kept is what another program, or oneself in a year, needs to use a calibration: the errors
of a unit, their standard deviations, the choice of axes and the sign convention, all in SI units
and radians. Numbers come back to the last digit.
"""

from __future__ import annotations

import json
from dataclasses import fields
from datetime import datetime
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import driftlab
from driftlab.axes import checked_axes
from driftlab.checks import FloatArray, checked_instance, checked_text, finite_array, finite_number
from driftlab.drift.weighing_designs import TurnFit
from driftlab.higher_order_errors import (
    NO_HIGHER_ORDER_ERRORS,
    TERMS,
    HigherOrderErrors,
    checked_higher_order_errors,
)
from driftlab.imu import ImuErrors, ImuNoise, checked_imu_errors, checked_usual_imu_errors

from .calibration_history import Calibration
from .multi_position import MultiPositionCalibration

_SCHEMA = "driftlab calibration 1"
"""Form of the text; the number counts up when an older program would misread it."""
_TURN_SCHEMA = "driftlab turn fit 1"
_CONVENTION = (
    "measured = (I + error)(true + felt besides) + bias; rows of an error matrix are sensors, "
    "columns what they feel of"
)
_TURN_CONVENTION = "sigma is half of what axes 1 2, 1 3 and 2 3 miss of a right angle"
_UNITS = {
    "gyro_bias": "rad/s",
    "gyro_error_matrix": "1",
    "accelerometer_bias": "m/s^2",
    "accelerometer_error_matrix": "1",
    **{term.field: term.unit for term in TERMS.values()},
    "angle_random_walk": "rad/sqrt(s)",
    "velocity_random_walk": "(m/s)/sqrt(s)",
    "reference_velocity": "m/s",
    "gyro_bias_instability": "rad/s",
    "gyro_correlation_time": "s",
    "accelerometer_bias_instability": "m/s^2",
    "accelerometer_correlation_time": "s",
}
_TURN_UNITS = {
    "sigma": "1",
    "scale_factor": "1",
    "gyro_bias": "rad/s",
    "earth_rate": "rad/s",
    "covariance": "variances of an estimate, SI",
    "residuals": "1",
}
_FORMER = {
    "gyro_error": "gyro_error_matrix",
    "accelerometer_error": "accelerometer_error_matrix",
    "scale": "scale_factor",
}
"""Names in texts of version 0.2.0."""
_NOISE = tuple(field.name for field in fields(ImuNoise))
_WHITE = _NOISE[:3]  # those that are always written


class KeptCalibration(NamedTuple):
    """What a text of `to_json` says of an inertial unit.

    Attributes
    ----------
    imu_errors : ImuErrors
        Biases and error matrices, SI units.
    standard_deviations : ImuErrors or None
        Their standard deviations, if they are known.
    higher_order : HigherOrderErrors or None
        Errors beyond bias and matrix, if there are any.
    noise : ImuNoise or None
        Of the sensors, if it was kept.
    body_axes : str
        How the body axes lie in the unit, "averaged" say; empty if nobody said.
    axes : str
        Where they point, as in `driftlab.axes`, "FRD" say; empty if nobody said.
    name, date : str
        What, as one likes to say it, and when, as `to_json` has it; empty if nobody said.
    """

    imu_errors: ImuErrors
    standard_deviations: ImuErrors | None = None
    higher_order: HigherOrderErrors | None = None
    noise: ImuNoise | None = None
    body_axes: str = ""
    axes: str = ""
    name: str = ""
    date: str = ""


def to_json(
    found: ImuErrors | Calibration | MultiPositionCalibration | KeptCalibration | TurnFit,
    *,
    axes: str = "",
    noise: ImuNoise | None = None,
    name: str = "",
    date: str = "",
) -> str:
    """Write a calibration as JSON, each quantity with its unit.

    Parameters
    ----------
    found : ImuErrors or Calibration or MultiPositionCalibration or KeptCalibration or TurnFit
        The errors of a unit, or what `calibrate`, `calibrate_multi_position` or `fit_turns` found;
        of a calibration its end, with the standard deviations.
    axes : str
        Where the body axes point, as in `driftlab.axes`.
    noise : ImuNoise, optional
        Of the sensors, to be kept beside.
    name : str
        Which unit, or what else one would look for.
    date : str
        When, as 2024-05-01 or 2024-05-01T12:00; no clock is asked.

    Returns
    -------
    str
        Text of a file, which `from_json` reads.

    Raises
    ------
    ValueError
        If `found` is something else, its numbers are not finite or those of no unit; `axes` are
        none or `date` is no date.

    Examples
    --------
    >>> from driftlab.imu import TYPICAL_ERRORS
    >>> text = to_json(TYPICAL_ERRORS, axes="FRD", name="unit 7", date="2024-05-01")
    >>> for line in text.splitlines()[1:5]:
    ...     print(line.strip())
    "schema": "driftlab calibration 1",
    "name": "unit 7",
    "date": "2024-05-01",
    "axes": "FRD",
    """
    document = _document(found, axes=axes, noise=noise, name=name, date=date)
    return json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def from_json(source: str | Path) -> KeptCalibration | TurnFit:
    """Read a calibration that `to_json` wrote, or ``python -m driftlab calibrate --json``.

    Parameters
    ----------
    source : str or Path
        The text itself, or the path of a file that has it.

    Returns
    -------
    KeptCalibration or TurnFit
        The same numbers, to the last digit.

    Raises
    ------
    ValueError
        If it is no such text: of another schema, with another unit or convention, without a
        quantity that must be there, with one that is there twice or has an unknown field, or with
        numbers of a wrong shape; or as for `to_json`.
    OSError
        If the file cannot be read.

    Examples
    --------
    >>> from driftlab.imu import TYPICAL_ERRORS
    >>> kept = from_json(to_json(TYPICAL_ERRORS))
    >>> bool((kept.imu_errors.gyro_error_matrix == TYPICAL_ERRORS.gyro_error_matrix).all())
    True
    >>> from_json(to_json(TYPICAL_ERRORS).replace("rad/s", "deg/s"))
    Traceback (most recent call last):
        ...
    ValueError: gyro_bias: expected the unit rad/s, got 'deg/s'.
    """
    document = _parsed(source)
    schema = document.get("schema")
    if schema == _TURN_SCHEMA:
        _check_convention(document, _TURN_CONVENTION)
        values, _ = _quantities_of(document, _TURN_UNITS, tuple(_TURN_UNITS))
        _check_sizes(values)
        return TurnFit(**values)
    if schema != _SCHEMA:
        raise ValueError(f"schema: expected {_SCHEMA!r} or {_TURN_SCHEMA!r}, got {schema!r}.")
    _check_convention(document, _CONVENTION)
    values, standard_deviations = _quantities_of(
        document, _UNITS, ImuErrors._fields, ImuErrors._fields
    )
    higher = {key: values[key] for key in HigherOrderErrors._fields if key in values}
    noise = {key: finite_number(values[key], key) for key in _NOISE if key in values}
    if noise and (missing := [key for key in _WHITE if key not in noise]):
        raise ValueError(f"quantities: expected all of {', '.join(_WHITE)}, got no {missing[0]}.")
    kept = KeptCalibration(
        checked_usual_imu_errors(ImuErrors(*(values[key] for key in ImuErrors._fields))),
        checked_imu_errors(ImuErrors(**standard_deviations)) if standard_deviations else None,
        checked_higher_order_errors(NO_HIGHER_ORDER_ERRORS._replace(**higher)) if higher else None,
        ImuNoise(**noise) if noise else None,
        *(_word_of(document, key) for key in ("body_axes", "axes", "name", "date")),
    )
    _check_axes_and_date(kept.axes, kept.date)
    return kept


def _document(
    found: ImuErrors | Calibration | MultiPositionCalibration | KeptCalibration | TurnFit,
    *,
    axes: str = "",
    noise: ImuNoise | None = None,
    name: str = "",
    date: str = "",
) -> dict[str, Any]:
    """What `to_json` writes, as a dictionary."""
    if noise is not None:
        checked_instance(noise, ImuNoise, "noise")
    words = {"name": name, "date": date}
    head = {key: checked_text(word, key) for key, word in words.items()} | {"axes": axes}
    _check_axes_and_date(axes, date)
    if isinstance(found, TurnFit):
        values = {key: (unit, getattr(found, key), None) for key, unit in _TURN_UNITS.items()}
        return _written(_TURN_SCHEMA, head, _TURN_CONVENTION, values)
    kept = _kept(found)
    head = {key: word or getattr(kept, key) for key, word in head.items()}
    _check_axes_and_date(head["axes"], head["date"])
    quantities: dict[str, Any] = {}
    spread = (
        None if kept.standard_deviations is None else checked_imu_errors(kept.standard_deviations)
    )
    for key, value in checked_usual_imu_errors(kept.imu_errors)._asdict().items():
        quantities[key] = (_UNITS[key], value, spread and getattr(spread, key))
    if kept.higher_order is not None:
        for key, value in checked_higher_order_errors(kept.higher_order)._asdict().items():
            if value.any():  # what is zero need not be known to the program that reads it
                quantities[key] = (_UNITS[key], value, None)
    noise = noise or kept.noise
    for key in _NOISE if noise else ():
        if getattr(noise, key) or key in _WHITE:
            quantities[key] = (_UNITS[key], getattr(noise, key), None)
    return _written(_SCHEMA, head | {"body_axes": kept.body_axes}, _CONVENTION, quantities)


def _kept(
    found: ImuErrors | Calibration | MultiPositionCalibration | KeptCalibration,
) -> KeptCalibration:
    """What is kept of a unit or of a calibration."""
    if isinstance(found, KeptCalibration):
        return found
    if isinstance(found, ImuErrors):
        return KeptCalibration(found)
    if isinstance(found, MultiPositionCalibration):
        # There G acts beside (I + K), here within.
        inverse = np.linalg.inv(np.eye(3) + found.imu_errors.gyro_error_matrix)
        higher = NO_HIGHER_ORDER_ERRORS._replace(gyro_g_sensitivity=inverse @ found.sensitivity)
        felt = higher if found.sensitivity.any() else None
        return KeptCalibration(
            found.imu_errors, found.standard_deviations, felt, body_axes=found.body_axes
        )
    if isinstance(found, Calibration):
        model, state = found.model, found.state[..., -1, :]
        each = model.imu_errors(np.eye(model.size))
        covariance = found.covariance[..., -1, :, :]
        standard_deviations = ImuErrors(
            *(_deviations(covariance, np.asarray(one), value.shape) for one, value in
              zip(each, found.imu_errors, strict=True))
        )  # fmt: skip
        felt = model.higher_order_errors(state) if model.higher_order else None
        return KeptCalibration(
            found.imu_errors, standard_deviations, felt, body_axes=model.frame or ""
        )
    raise ValueError(
        "found: expected ImuErrors, a Calibration, a MultiPositionCalibration or a TurnFit, "
        f"got {type(found).__name__}."
    )


def _deviations(covariance: FloatArray, each: FloatArray, shape: tuple[int, ...]) -> FloatArray:
    """Standard deviations of quantities that the states add up to; `each` are their shares."""
    shares = each.reshape(len(each), -1)
    variances = np.einsum("...ij,ia,ja->...a", covariance, shares, shares)
    return np.sqrt(np.maximum(variances, 0.0)).reshape(shape)


def _written(
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


def _parsed(source: str | Path) -> dict[str, Any]:
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


def _quantities_of(
    document: dict[str, Any],
    units: dict[str, str],
    needed: tuple[str, ...],
    uncertain: tuple[str, ...] = (),
) -> tuple[dict[str, FloatArray], dict[str, FloatArray]]:
    """Values by name, and standard deviations of those that are `uncertain`, all or none."""
    quantities = document.get("quantities")
    if not isinstance(quantities, dict):
        raise ValueError(f"quantities: expected some by name, got {quantities!r:.60}.")
    for old, new in _FORMER.items():
        if old in quantities and new not in quantities:
            quantities[new] = quantities.pop(old)
    if missing := [key for key in needed if key not in quantities]:
        raise ValueError(f"quantities: expected {', '.join(needed)}, got no {missing[0]}.")
    values, standard_deviations = {}, {}
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
            standard_deviations[key] = _deviation(said["deviation"], values[key], key)
    if standard_deviations and (
        missing := [key for key in uncertain if key not in standard_deviations]
    ):
        raise ValueError(f"{missing[0]}: expected a deviation, as others have one, got none.")
    return values, standard_deviations


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


def _check_convention(document: dict[str, Any], expected: str) -> None:
    """Refuse numbers that mean something else."""
    if document.get("convention") != expected:
        raise ValueError(f"convention: expected {expected!r}, got {document.get('convention')!r}.")


def _check_sizes(fit: dict[str, FloatArray]) -> None:
    """Refuse what is no fit of turns: other than three sigmas, a covariance of other unknowns."""
    finite_array(fit["sigma"], "sigma", 3)
    unknowns = (
        np.atleast_1d(fit[key]) for key in ("sigma", "scale_factor", "gyro_bias", "earth_rate")
    )
    size = sum(each.shape[-1] for each in unknowns)
    finite_array(fit["covariance"], "covariance", size, size)


def _check_axes_and_date(axes: str, date: str) -> None:
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


def _word_of(document: dict[str, Any], key: str) -> str:
    """A text by its name; empty if there is none."""
    if not isinstance(word := document.get(key, ""), str):
        raise ValueError(f"{key}: expected text, got {word!r:.60}.")
    return word

"""Rows of the panel of chapter 17."""

import numpy as np

from driftlab.allan import allan_deviation
from driftlab.noise_terms import NoiseTerms

from .values import ABSENT, Rows, Values, listed, three_digits

TERMS = (
    ("quantisation", "″", np.pi / 648000),
    ("angle random walk", "°/√h", np.pi / 180 / 60),
    ("bias instability", "°/h", np.pi / 648000),
    ("rate random walk", "°/h/√h", np.pi / 648000 / 60),
    ("rate ramp", "°/h²", np.pi / 648000 / 3600),
)


def allan(values: Values) -> Rows:
    sizes = listed(values, "quantisation walk flicker rate_walk ramp")
    noise = NoiseTerms(*(float(size * unit) for size, (*_, unit) in zip(sizes, TERMS, strict=True)))
    step = values["length"] * 60 / 4096
    rates = noise.samples(4096, step, np.random.default_rng(values["run"]))
    found = allan_deviation(rates, step)
    freedom = found.degrees_of_freedom
    t = found.averaging_times
    flat = 2 * np.log(2) / np.pi * np.ones_like(t)
    curves = np.array([3 / t**2, 1 / t, flat, t / 3, t**2 / 2])
    scales = np.array([unit for *_, unit in TERMS])
    parts = curves * ((sizes * scales) ** 2)[:, None]
    rows = []
    for (name, unit, scale), part, curve, size in zip(TERMS, parts, curves, sizes, strict=True):
        share = np.where(freedom > 5, part / np.maximum(parts.sum(axis=0), 1e-300), 0)
        read = "nowhere" if size else ABSENT
        if share.max() > 0.9:
            place = share.argmax()
            read = three_digits(found.deviation[place] / np.sqrt(curve[place]) / scale)
        put_in = three_digits(size) if size else ABSENT
        rows += [(f"{name}, {unit}: put in", put_in), (f"{name}, {unit}: read", read)]
    place = found.deviation.argmin()
    height = three_digits(found.deviation[place] * 648000 / np.pi)
    lowest = f"{height} °/h at {three_digits(t[place])} s" if found.deviation.any() else ABSENT
    return [("lowest point", lowest), *rows]

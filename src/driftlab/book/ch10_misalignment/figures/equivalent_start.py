"""A misaligned triad against an ideal one that starts wrong; Wu (16)-(36), not linearised."""

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import GREY, GUIDE, SERIES, decades

from ..experiments import LEAST, SPEEDS, TILTS

LEFT = {
    "skew_triad": "attitude, skew",
    "turned_triad": "attitude, turned",
    "two_skew_triads": "velocity, skew",
}


@from_table
def draw(drawing: Drawing) -> None:
    """Draw attitude and velocity error over time, and what the first order leaves out."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        "abc", (10.5, 4.0), (0.06, 0.3, 0.985, 0.91), spaces=(0.27, 0.2), column_height=8.2,
        page_height=3.4,
    )  # fmt: skip
    tilt, speed, left = panels.values()
    tilt.set(title="attitude error", xlabel="time, minutes", ylabel="arc seconds")
    speed.set(title="velocity error", xlabel="time, minutes", ylabel="m/s")
    top = decades([getattr(table, name) for name in LEFT], LEAST, 1e2)[1]
    left.set(title="left by first order", xscale="log", yscale="log", ylim=(LEAST, top))
    left.set(xlabel="misalignment, rad", ylabel="rad, or m/s")
    left.plot(table.size, 1e-3 * table.size**2, color=GREY, linewidth=0.8, label=GUIDE)
    left.text(table.size[-1], 3e-8, "slope 2", color=GREY, ha="right")
    labels = *TILTS[:3], "$C\\kappa - C(0)\\kappa$"
    for name, label, style in zip(TILTS, labels, SERIES, strict=False):
        drawing.curve(tilt, "time", f"attitude_error, {name}", **style, label=label)
    tilt.lines[-1].set(linewidth=3.5, alpha=0.5)
    for name, style in zip(SPEEDS, SERIES, strict=False):
        drawing.curve(speed, "time", f"velocity_error, {name}", **style, label=name)
    for (name, label), style, marker in zip(LEFT.items(), SERIES, "os^", strict=False):
        look = {**style, "marker": marker, "markersize": 4, "label": label}
        drawing.curve(left, "size", name, **look)
    for panel in panels.values():
        below = {None: -0.17, True: -0.3, False: -0.2}[sheet.narrow if sheet.on_paper else None]
        panel.legend(
            loc="upper center",
            bbox_to_anchor=(0.5, below),
            ncols=1 if sheet.on_paper and not sheet.narrow else 2,
        )

"""Panels with one fault each, to prove that the tests in the browser would see it."""

import io
import time
from dataclasses import replace

from PIL import Image

from driftlab.book import RootsExplorer


class Blinking(RootsExplorer):
    """Shows nothing for a moment before each new picture."""

    title = "blinking"

    def compute(self, values):
        if self.view.widget.value:
            size = Image.open(io.BytesIO(self.view.widget.value)).size
            blank = io.BytesIO()
            Image.new("RGB", size, "white").save(blank, format="png")
            self.view.widget.value = blank.getvalue()
            time.sleep(0.1)
        return super().compute(values)


class Growing(RootsExplorer):
    """Its picture has another size for another axis."""

    title = "growing"

    def compute(self, values):
        self.view.widget.width = "500" if values["azimuth"] > 50 else "400"
        return super().compute(values)


class Raising(RootsExplorer):
    """Raises for some axes."""

    title = "raising"

    def compute(self, values):
        if values["azimuth"] > 50:
            raise ZeroDivisionError("on purpose")
        return super().compute(values)


class Wordy(RootsExplorer):
    """Has a label too long for its place."""

    title = "wordy"
    controls = (
        *RootsExplorer.controls[:-1],
        replace(RootsExplorer.controls[-1], label="elevation of the axis over the plane, degrees"),
    )


class Nameless(RootsExplorer):
    """Goes without the script that names its sliders and keeps the keys for them."""

    title = "nameless"

    def __init__(self):
        super().__init__()
        self.children = self.children[1:]

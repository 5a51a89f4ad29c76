"""The moving picture of the first page: the scene of chapter 03, computed when the site is built.

Its still is one like those of the chapters, and comes alive in place as they do. Until then
``landing.js`` plays the scene, by the book's own script, from the arrays that are written here.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from nbformat.v4 import new_code_cell, new_output

from driftlab.book import TurningBlock
from driftlab.book.machinery.panel.still import still
from driftlab.book.machinery.scene.view import SceneWidget
from reading.outputs import STOOD, Outputs

PRESETS = ("The puzzle", "About the third edge", "About the other diagonal")
CAPTION = (
    "<figcaption>A block turns about an axis; dashed, where its computer believes it to be."
    '</figcaption></figure><script src="_static/landing.js"></script>'
)


def still_of_landing(outputs: Outputs) -> str:
    """Return the still as HTML, and the script that takes its place where scripts run."""
    block = TurningBlock(PRESETS[0])
    html = still(*block.view.still(), block.page.alt, "TurningBlock", block.values)
    output = new_output("display_data", {"text/html": html, "text/plain": ""})  # type: ignore[no-untyped-call]
    (shown,) = outputs.shown(new_code_cell(outputs=[output]))  # type: ignore[no-untyped-call]
    return str(shown.data["text/html"]).replace(STOOD, CAPTION)


def script_of_landing() -> str:
    """Return the script: the book's own that draws scenes, what it draws, and what plays it.

    It is a classic script, so that a page opened from a disk has it too.
    """
    shown = {name: _shown(TurningBlock(name)) for name in PRESETS}
    draws = SceneWidget._esm.replace("export default", "const scene =")
    plays = Path(__file__).with_name("landing.js").read_text("utf-8")
    stages = json.dumps({"presets": shown, "style": SceneWidget._css}, separators=(",", ":"))
    return f"(() => {{\n{draws}\nconst LANDING = {stages};\n{plays}}})();\n"


def _shown(block: TurningBlock) -> dict[str, Any]:
    """A preset: what to look for, and its stage with one number and one curve, without handles."""
    stage = {**block.view.widget.stage}
    stage |= {"plots": stage["plots"][:1], "readouts": stage["readouts"][:1]}
    for view in stage["views"]:
        for part in view["parts"]:
            part["handle"] = ""
    name = block.preset.value
    return {"look": block.look_for[name], "stage": _plain(stage)}


def _plain(value: Any) -> Any:
    """Arrays as lists of numbers with five digits: a screen shows fewer."""
    if isinstance(value, memoryview):
        return [float(f"{x:.5g}") for x in np.frombuffer(value)]
    if isinstance(value, dict):
        return {name: _plain(each) for name, each in value.items()}
    return [_plain(each) for each in value] if isinstance(value, list | tuple) else value

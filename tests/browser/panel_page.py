"""One panel in a page, a slider panel or a scene: what a reader sees of it and does to it."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from notebook_page import FRAME, PATIENCE
from PIL import Image

from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import PANEL_CLASS, Explorer
from panel_numbers import shown_numbers

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page

# At rest the kernel owes no answer, and some frames in a row find the panel as it was: ipywidgets
# holds a move back while the kernel works on the one before. Until then no frames are asked for.
SETTLE = f"""async (panel, [frames, patience]) => {{
  const image = panel.querySelector("img");
  const place = () => Object.values(panel.getBoundingClientRect().toJSON());
  const state = () => [image?.src, panel.textContent, ...place()].join();
  const end = performance.now() + 1000 * patience;
  let before, same = 0;
  while (same < frames) {{
    if (performance.now() > end) throw new Error("the panel does not come to rest");
    if (window.unanswered.size) await new Promise(resolve => setTimeout(resolve, 10));
    await {FRAME};
    const loaded = !image || image.complete;
    same = !window.unanswered.size && loaded && state() === before ? same + 1 : 0;
    before = state();
  }}
}}"""

PICTURE = """async (panel) => {
  const bytes = await (await fetch(panel.querySelector("img").src)).bytes();
  let text = "";
  for (let i = 0; i < bytes.length; i += 32768) {
    text += String.fromCharCode(...bytes.subarray(i, i + 32768));
  }
  return btoa(text);
}"""

RESULTS = "panel => panel.querySelector('.driftlab-results').innerHTML"

# By the name of each control: what its readout, menu, line or box says.
SHOWN = """panel => [
  ...[...panel.querySelectorAll(".driftlab-controls [role=slider]")].map(handle => [
    handle.ariaLabel, handle.closest(".widget-slider").querySelector(".widget-readout").textContent,
  ]),
  ...[...panel.querySelectorAll(".driftlab-controls :is(select, input)")].map(input => [
    input.labels[0].innerText,
    input.type === "checkbox" ? input.checked : input.value.replaceAll("\u00a0", " "),
  ]),
]"""

GRIP = """handle => {
  const box = handle.getBoundingClientRect();
  const track = handle.closest(".noUi-base").getBoundingClientRect();
  return [box.x + box.width / 2, box.y + box.height / 2, track.left, track.right];
}"""

FOCUSED_NAME = """() => {
  const element = document.activeElement;
  if (element.getAttribute("role") === "textbox") return "";  // a readout; its slider came before
  return element.ariaLabel ?? element.labels?.[0]?.innerText ?? "";
}"""

# Size of the picture and its place in the panel.
PLACE = """panel => {
  const picture = panel.querySelector(".driftlab-picture");
  const [box, around] = [picture, picture.parentElement].map(e => e.getBoundingClientRect());
  return [box.width, box.height, box.x - around.x];
}"""

# Text wider than its box, and boxes that stick out of the panel or the panel out of the cell.
CUT_OFF = """panel => {
  const found = [];
  const texts = "label, .widget-readout, select, button, span, b, pre";
  for (const element of panel.querySelectorAll(texts)) {
    if (element.scrollWidth > element.clientWidth + 1 && element.clientWidth) {
      found.push(element.textContent);
    }
  }
  const room = panel.closest(".jp-OutputArea-output").getBoundingClientRect();
  const boxes = ".driftlab-picture, label, input, select, button, span, .slider";
  for (const element of panel.querySelectorAll(boxes)) {
    const box = element.getBoundingClientRect();
    if (!box.width) continue;  // not shown
    if (box.left < room.left - 1 || box.right > room.right + 1) found.push(element.outerHTML);
  }
  return found;
}"""


class PanelPage:
    """A panel, found by its title.

    Parameters
    ----------
    page : Page
    explorer_class : type of Explorer
        What the panel is meant to be.
    """

    def __init__(self, page: Page, explorer_class: type[Explorer]) -> None:
        self.page = page
        self.explorer_class = explorer_class
        heading = page.get_by_text(explorer_class.title, exact=True)
        # An exercise may repeat the panel of its chapter, below it.
        self.panel = page.locator(f".{PANEL_CLASS}").filter(has=heading).first
        self.image = self.panel.locator(".driftlab-picture")
        self.image.wait_for()
        # The elements themselves: to find them again takes longer than most questions to them.
        self._element = self.panel.element_handle()
        self._preset = self.panel.get_by_role("combobox", name="preset").element_handle()
        self.settle()

    def settle(self, frames: int = 3) -> None:
        """Wait until nothing has changed for some frames."""
        self._element.evaluate(SETTLE, [frames, PATIENCE])

    def picture(self) -> bytes:
        """The file of the picture on display."""
        return base64.b64decode(self._element.evaluate(PICTURE))

    def place(self) -> list[float]:
        """Size and place of the picture in the panel."""
        return list(self._element.evaluate(PLACE))

    def numbers(self) -> list[tuple[str, str]]:
        """Names and values beside the picture."""
        return shown_numbers(self._element.evaluate(RESULTS))

    def code(self) -> str:
        """The Python lines below the sliders."""
        return str(self._element.evaluate("panel => panel.querySelector('pre').textContent"))

    @staticmethod
    def name(control: Control) -> str:
        """What a screen reader calls a control."""
        return control.full_name if control.is_slider else control.label

    def element(self, control: Control) -> Locator:
        """What takes the keys of a control, found as a screen reader finds it."""
        role = (
            "checkbox"
            if control.is_box
            else "combobox"
            if control.choices
            else "textbox"
            if control.examples
            else "slider"
        )
        return self.panel.get_by_role(role, name=self.name(control), exact=True)  # type: ignore[arg-type]

    def readout(self, control: Control) -> Locator:
        """Where a slider shows its value and takes another."""
        return self.panel.get_by_role("textbox", name=control.full_name, exact=True)

    def values(self) -> dict[str, Any]:
        """What the panel says the values of all controls are."""
        shown = dict(self._element.evaluate(SHOWN))
        return {
            control.name: self._read(control, shown[self.name(control)])
            for control in self.explorer_class.controls
        }

    @staticmethod
    def _read(control: Control, shown: Any) -> Any:
        if control.is_box or control.choices or control.examples:
            return shown
        text = shown.replace("−", "-")
        return next((s for s in control.stops if f"{s:g}" == text), type(control.start)(text))

    def press(self, control: Control, *keys: str) -> None:
        """Press keys on a control."""
        self.element(control).focus()
        for key in keys:
            self.page.keyboard.press(key)

    def choose_preset(self, name: str) -> None:
        self._preset.select_option(label=name)
        self.settle()

    def reset(self) -> None:
        self.panel.get_by_role("button", name="Reset").click()
        self.settle()

    def preset(self) -> str:
        """What the preset menu says."""
        return str(self._preset.evaluate("menu => menu.value.replaceAll('\u00a0', ' ')"))

    def drag(self, control: Control) -> None:
        """Drag a slider to the farther end of its track and a quarter back."""
        handle = self.element(control)
        handle.scroll_into_view_if_needed()
        x, y, left, right = handle.evaluate(GRIP)
        far, near = (left, right) if x > (left + right) / 2 else (right, left)
        mouse = self.page.mouse
        mouse.move(x, y)
        mouse.down()
        mouse.move(far, y)
        mouse.move(0.75 * far + 0.25 * near, y)
        mouse.up()
        self.settle()

    def tab_through(self) -> Iterator[Control]:
        """Go from control to control with the Tab key, until none is left."""
        waiting = {self.name(control): control for control in self.explorer_class.controls}
        self._preset.focus()
        for _ in range(3 * len(waiting) + 3):
            self.page.keyboard.press("Tab")
            if control := waiting.pop(self.focused_name(), None):
                yield control
        assert not waiting, "Tab does not come here"

    def focused_name(self) -> str:
        """Accessible name of the element with the focus."""
        return str(self.page.evaluate(FOCUSED_NAME))

    def focus_is_visible(self) -> bool:
        """Tell by pixels whether the element with the focus looks different without it."""
        element = self.page.evaluate_handle("document.activeElement").as_element()
        assert element is not None
        element.scroll_into_view_if_needed()
        box = element.bounding_box()
        assert box is not None
        clip = {
            "x": box["x"] - 4, "y": box["y"] - 4,
            "width": box["width"] + 8, "height": box["height"] + 8,
        }  # fmt: skip
        with_focus = self.page.screenshot(clip=clip, caret="initial")
        element.evaluate("element => element.blur()")
        without = self.page.screenshot(clip=clip, caret="initial")
        element.focus()
        pixels = [
            np.asarray(Image.open(io.BytesIO(file)).convert("L"), int)
            for file in (with_focus, without)
        ]
        return bool(np.sum(np.abs(pixels[0] - pixels[1]) > 60) >= 20)

    def cut_off(self) -> list[str]:
        """What of the panel does not fit into the room it has."""
        return list(self._element.evaluate(CUT_OFF))

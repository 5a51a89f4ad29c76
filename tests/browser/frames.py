"""What a screen shows of a picture while something happens, frame by frame."""

from __future__ import annotations

import base64
import io
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from notebook_page import wait_until
from PIL import Image

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page

# The size of the picture and its place in the panel, at each frame; all that differ.
WATCH_SIZE = """(image) => {
  window.sizes = [];
  const watch = () => {
    const [box, panel] = [image, image.parentElement].map(e => e.getBoundingClientRect());
    const size = [box.width, box.height, box.x - panel.x, box.y - panel.y].join(" ");
    if (!window.sizes.includes(size)) window.sizes.push(size);
    window.watching = requestAnimationFrame(watch);
  };
  watch();
}"""
IN_SIGHT = """(image) => {
  const box = image.getBoundingClientRect();
  const corners = [[box.left + 1, box.top + 1], [box.right - 1, box.bottom - 1]];
  return corners.every(([x, y]) => document.elementFromPoint(x, y) === image);
}"""
# A spot in the corner of the page, of a colour that nothing else has: one of two, in turn.
MARK = """() => {
  window.mark ??= document.body.appendChild(document.createElement("div"));
  window.shade = window.shade ? 0 : 20;
  window.mark.style = "position: fixed; left: 0; top: 0; width: 16px; height: 16px;"
    + `z-index: 99999; pointer-events: none; background: rgb(255, ${window.shade}, 255)`;
}"""
UNMARK = "() => { window.mark.remove(); delete window.mark; }"
STOP_WATCHING = "() => { cancelAnimationFrame(window.watching); return window.sizes; }"


def frames_of(page: Page, picture: Locator, *acts: Callable[[], object]) -> list[np.ndarray]:
    """Record the frames that the browser composes during some acts, cut to the picture.

    The frame at the end of each act is among them: the next act waits for it.
    Whether the picture's file is loaded says nothing: the old one stays painted until then.
    """
    box = picture.bounding_box()
    assert box is not None
    assert picture.evaluate(IN_SIGHT), "the picture is not wholly in sight"
    cut = tuple(
        round(n) for n in (box["x"], box["y"], box["x"] + box["width"], box["y"] + box["height"])
    )
    recorded: list[bytes] = []
    session = page.context.new_cdp_session(page)

    def keep(frame: dict[str, Any]) -> None:
        recorded.append(base64.b64decode(frame["data"]))
        session.send("Page.screencastFrameAck", {"sessionId": frame["sessionId"]})

    session.on("Page.screencastFrame", keep)
    session.send("Page.startScreencast", {"format": "jpeg", "quality": 90})

    def marked() -> bool:
        page.evaluate(MARK)  # again and again: a browser that is busy leaves frames out
        if not recorded:
            return False
        red, green, blue = Image.open(io.BytesIO(recorded[-1])).getpixel((8, 8))
        return min(red, blue) > 200 and green < 60

    for act in acts:
        act()
        wait_until(page, marked, "a frame of the page")
        page.evaluate(UNMARK)
    session.send("Page.stopScreencast")
    session.detach()
    images = [Image.open(io.BytesIO(data)) for data in recorded]
    for image in images:
        image.draft("L", image.size)  # decodes no colours
    sizes = {image.size for image in images}
    # Pages of a window share its size: one that was opened meanwhile may have changed it.
    assert sizes == {tuple(page.viewport_size.values())}, f"frames of {sizes} are not the page"
    return [np.asarray(image.convert("L").crop(cut)) for image in images]


def ink(frame: np.ndarray) -> float:
    """Part of a frame that is not background."""
    return float(np.mean(frame < 200))


def blank_frames(frames: list[np.ndarray]) -> int:
    """Count the frames that have less than a fifth of the ink of the fullest.

    A white frame has none; bars that shrink to nothing leave a picture more than two fifths.
    """
    inks = [ink(frame) for frame in frames]
    return sum(each < 0.2 * max(inks) for each in inks)


def sizes_during(page: Page, picture: Locator, act: Callable[[], object]) -> list[str]:
    """All sizes and places in its panel that a picture has during `act`."""
    picture.evaluate(WATCH_SIZE)
    act()
    return list(page.evaluate(STOP_WATCHING))

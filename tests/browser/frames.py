"""What a screen shows of a picture while something happens, frame by frame."""

from __future__ import annotations

import base64
import io
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
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
STOP_WATCHING = "() => { cancelAnimationFrame(window.watching); return window.sizes; }"


def frames_of(page: Page, picture: Locator, act: Callable[[], object]) -> list[np.ndarray]:
    """Record every frame that the browser composes during `act`, cut to the picture.

    Whether the picture's file is loaded says nothing: the old one stays painted until then.
    """
    box = picture.bounding_box()
    assert box is not None
    assert picture.evaluate(IN_SIGHT), "the picture is not wholly in sight"
    cut = tuple(
        round(n) for n in (box["x"], box["y"], box["x"] + box["width"], box["y"] + box["height"])
    )
    recorded: list[str] = []
    session = page.context.new_cdp_session(page)

    def keep(frame: dict[str, Any]) -> None:
        recorded.append(frame["data"])
        session.send("Page.screencastFrameAck", {"sessionId": frame["sessionId"]})

    session.on("Page.screencastFrame", keep)
    session.send("Page.startScreencast", {"format": "png"})
    act()
    page.wait_for_timeout(300)
    session.send("Page.stopScreencast")
    session.detach()
    images = (Image.open(io.BytesIO(base64.b64decode(data))) for data in recorded)
    return [np.asarray(image.convert("L").crop(cut)) for image in images]


def ink(frame: np.ndarray) -> float:
    """Part of a frame that is not background."""
    return float(np.mean(frame < 200))


def blank_frames(frames: list[np.ndarray]) -> int:
    """Count the frames that have less than half the ink of the fullest."""
    inks = [ink(frame) for frame in frames]
    return sum(each < 0.5 * max(inks) for each in inks)


def sizes_during(page: Page, picture: Locator, act: Callable[[], object]) -> list[str]:
    """All sizes and places in its panel that a picture has during `act`."""
    picture.evaluate(WATCH_SIZE)
    act()
    return list(page.evaluate(STOP_WATCHING))

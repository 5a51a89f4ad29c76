"""How long a reader waits in a browser: from a key on a slider to the new picture on the screen."""

import tempfile
from itertools import cycle
from pathlib import Path

import numpy as np
from book_server import book_server
from chromium import NoBrowser, chromium
from frames import blank_frames, frames_of
from notebook_page import SCREENS, NotebookPage, new_page
from pages import notebook_of
from panel_page import PanelPage, time_of_move
from places import PLACES, Place

from driftlab import book

MOVES = 30

# The usual way: interact draws a new figure into an output area. The same picture as the panel.
INTERACT = """
%matplotlib inline
import numpy as np
from ipywidgets import interact
from driftlab.book.ch03_systematic_drift.experiments import drift_history
from driftlab.book.ch03_systematic_drift.figures.drift_history import DriftHistoryPicture
from driftlab.vectors import direction_from_angles
triad_error = 1e-3 * (np.ones((3, 3)) - np.eye(3))
@interact(azimuth=(-180.0, 180.0, 1.0))
def show(azimuth=45.0):
    axis = direction_from_angles(np.radians(azimuth), np.radians(15.0))
    display(DriftHistoryPicture.draw(drift_history(triad_error, axis)))
"""


def latencies() -> None:
    """Print the table, and the usual way below it."""
    print("from the key to the new picture in a browser, each panel in its chapter")
    try:
        with (
            tempfile.TemporaryDirectory() as folder,
            chromium() as browser,
            book_server(Path(folder)) as server,
        ):
            window = browser.new_context(viewport=SCREENS["1280x800"])
            with new_page(window, server) as page:
                for chapter in dict.fromkeys(place.chapter for place in PLACES):
                    page.open(chapter)
                    page.run_all()
                    for place in PLACES:
                        if place.chapter == chapter:
                            say(f"{chapter[:2]} {place.explorer}", panel_moves(page, place))
                page.open(server.add_notebook("interact.ipynb", notebook_of(INTERACT)))
                page.run_all()
                interact_moves(page)
    except NoBrowser as reason:
        print(f"  left out: {reason}")


def say(name: str, times: list[float], more: str = "") -> None:
    median, late = np.percentile(times, [50, 95])
    print(f"  {name:34} {median:8.0f} ms   95 % below {late:.0f} ms, {len(times)} moves{more}")


def panel_moves(page: NotebookPage, place: Place) -> list[float]:
    """Times of moves of all sliders in turn; a move that changes no picture has none."""
    page.show_cell(place.cell)
    panel = PanelPage(page.page, getattr(book, place.explorer))
    sliders = [control for control in panel.explorer_class.controls if control.is_slider]
    times: list[float] = []
    for turn, slider in enumerate(cycle(sliders)):
        # Forth in one round and back in the next.
        key = "ArrowRight" if turn // len(sliders) % 2 == 0 else "ArrowLeft"
        took = time_of_move(panel.element(slider), panel.panel, key)
        panel.settle()
        if took is not None:
            times.append(took)
        if len(times) == MOVES or turn == 10 * MOVES:
            return times
    return times


def interact_moves(page: NotebookPage) -> None:
    """The same with interact: how long, and how often nothing is on the screen."""
    place = page.page.locator(".widget-interact")
    handle = place.get_by_role("slider")
    place.locator("img").wait_for()
    times = []

    def move() -> None:
        for turn in range(MOVES):
            key = "ArrowLeft" if turn % 2 else "ArrowRight"
            took = time_of_move(handle, place, key)
            page.page.wait_for_timeout(200)
            if took is not None:
                times.append(took)

    move()
    frames = frames_of(page.page, place.locator("img"), move)
    blank = f", {blank_frames(frames)} of {len(frames)} frames blank"
    say("interact, the usual way, for 03", times, blank)

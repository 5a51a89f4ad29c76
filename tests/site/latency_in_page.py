"""How long a reader of a page waits: for the first panel, for others, and for a key on a slider."""

from itertools import cycle
from pathlib import Path
from time import perf_counter

from chromium import NoBrowser, chromium
from latency import MOVES, say
from lively import at_rest, awaken, figure_of, show
from panel_page import time_of_move
from served import served
from visitor import visit

from driftlab.book.panels import EXPLORERS
from grouped import opened


def page_latencies(site: Path) -> None:
    """Print from the click to the panel, and from a key to the new picture.

    Parameters
    ----------
    site : Path
        The built site. Its files come from this machine, in no time.
    """
    print("in a page of the site: from the click to the panel, and from a key to its picture")
    if not (site / "in_place").is_dir():
        print("  left out: there is no site; 'python3 lab.py site' builds it")
        return
    try:
        with chromium() as browser, served(site) as address, visit(browser) as page:
            show(page, address, *(opened(each) for each in EXPLORERS))
            for explorer_class in EXPLORERS:
                figure = figure_of(page, explorer_class)
                start = perf_counter()
                awaken(page, figure)
                awake = perf_counter() - start
                times = moves(page, figure)
                say(explorer_class.__name__, times, f"; begins in {awake:.1f} s")
    except NoBrowser as reason:
        print(f"  left out: {reason}")


def moves(page, figure) -> list[float]:
    """Times of moves of all sliders in turn; a move that changes no picture has none."""
    for fold in figure.locator("summary").all():
        fold.click()
    live = figure.locator(".in-place-live")
    sliders = live.locator(".in-place-slider input[type=range]").all()
    times: list[float] = []
    for turn, slider in enumerate(cycle(sliders)):
        # Forth in one round and back in the next.
        key = "ArrowRight" if turn // len(sliders) % 2 == 0 else "ArrowLeft"
        took = time_of_move(slider, live, key)
        at_rest(page, figure)
        if took is not None:
            times.append(took)
        if len(times) == MOVES or turn == 3 * MOVES:
            return times
    return times

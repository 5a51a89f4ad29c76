"""What tests of a panel in a page do: show it, make it live, wait for it, compare it."""

import json
import math
import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from notebook_page import answer

from driftlab.book.machinery.panel.panel import Explorer
from driftlab.book.machinery.panel.still import plain_values, still

PATIENCE = 240_000
"""Milliseconds that Python may take to begin on a busy machine; it is waited for no longer."""


def figure_of(page, panel_class: type[Explorer], number: int = 0):
    """The place of a panel in a page."""
    return page.locator(f"figure[data-panel={panel_class.__name__}]").nth(number)


def page_of(panels: Iterable[Explorer]) -> str:
    """HTML of a page with the stills of panels, as chapters have them, and the one script."""
    stills = [
        still(*panel.view.still(), panel.page.alt, type(panel).__name__, panel.values)
        for panel in panels
    ]
    return f"""<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<style>body {{ font: 16px/1.5 sans-serif; max-width: 46em; margin: auto; padding: 0 1em; }}</style>
<body data-theme="auto">
{"".join(f"<div>{each}</div><p>More of the chapter.</p>" for each in stills)}
<script src="in_place/begin.js"></script>
"""


def show(page, address: str, *panels: Explorer) -> None:
    """Go to a page with some panels, each as it stands."""
    name = f"{address}/panels-in-their-place.html"
    page.route(name, lambda route: route.fulfill(body=page_of(panels), content_type="text/html"))
    page.goto(name)


def awaken(page, figure) -> None:
    """Make a panel live by its button."""
    figure.locator(".in-place-begin").click()
    at_rest(page, figure)


def let_live(page, figure) -> None:
    """Make a panel live if it is not."""
    if not figure.locator(".in-place-live").count():
        awaken(page, figure)


def at_rest(page, figure) -> None:
    """Wait until a panel lives, and Python has nothing more to do for it."""
    page.wait_for_function(
        """figure => {
          const note = figure.querySelector('.in-place-note').textContent;
          if (note) throw new Error(note);
          const live = figure.querySelector('.in-place-live');
          return live && live.ariaBusy !== 'true';
        }""",
        arg=figure.element_handle(),
        timeout=PATIENCE,
    )


def values_of(figure) -> dict:
    """The values of a live panel."""
    return json.loads(figure.get_attribute("data-values"))


def close(shown: str, expected: str) -> bool:
    """Whether two texts say the same, but for the last digits of their numbers."""
    number = r"[-+]?\d+(?:\.\d+)?"
    if re.sub(number, "#", shown) != re.sub(number, "#", expected):
        return False
    pairs = zip(re.findall(number, shown), re.findall(number, expected), strict=True)
    return all(
        math.isclose(float(a), float(b), abs_tol=1.5 * 10.0 ** -len(a.partition(".")[2]))
        for a, b in pairs
    )


def at_full(value: object) -> object:
    """A value as Python has it: JSON knows nothing infinite."""
    return float(value) if value in ("inf", "-inf", "nan") else value


def same_as_native(page, figure, panel: Explorer) -> None:
    """Compare what a page shows with the package's panel, brought to the same values."""
    panel.set(**{name: at_full(value) for name, value in values_of(figure).items()})
    assert values_of(figure) == plain_values(panel.values)
    for where, html in (
        (".driftlab-headline", panel.headline.value),
        (".driftlab-results > :last-child", panel.text.value),
        (".driftlab-panel > .in-place-html", panel.code.value),
        (".driftlab-title > :nth-child(2)", panel.guide.value),
    ):
        text = page.evaluate(
            "html => Object.assign(document.createElement('div'), {innerHTML: html}).textContent",
            html,
        )
        shown = figure.locator(where).first.text_content()
        assert close(shown, text), f"{where}: {shown!r} for {text!r}"


@contextmanager
def probe(page, text: str) -> Iterator[None]:
    """Let a Python file stand beside those of the site."""
    place = "**/in_place/probe*.py"
    page.route(place, lambda route: route.fulfill(body=text))
    yield
    page.unroute(place)


def ask(page, call: str, *args: object) -> object:
    """Ask the page's Python something, as the scripts of the site do."""
    script = """async ([call, args]) => {
      const python = await import(`${location.origin}/in_place/python.js`);
      return python.ask(call, args);
    }"""
    return answer(page, script, [call, args], patience=PATIENCE / 1000)

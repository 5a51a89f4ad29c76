"""A page with every panel and scene of the package, as a chapter's page has them."""

from collections.abc import Iterable

from driftlab.book.machinery.panel.panel import Explorer
from driftlab.book.machinery.panel.still import still


def page_of(panels: Iterable[Explorer], theme: str = "auto") -> str:
    """HTML of a page with the stills of panels, and the one script that makes them live."""
    stills = "\n".join(
        f'<div class="output">{still_of(panel)}</div><p>More of the chapter.</p>'
        for panel in panels
    )
    return f"""<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>Panels in their place</title>
<style>body {{ font: 16px/1.5 sans-serif; max-width: 46em; margin: auto; padding: 0 1em; }}</style>
<body data-theme="{theme}">
<h1>Panels in their place</h1>
{stills}
<script src="in_place/begin.js"></script>
"""


def still_of(panel: Explorer) -> str:
    """What a page shows of a panel that is not live."""
    picture, kind = panel.view.still()
    return still(picture, kind, panel.page.alt, type(panel).__name__, panel.values)

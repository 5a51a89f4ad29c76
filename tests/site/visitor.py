"""A reader who was never here: a page in a browser that keeps what it complains of."""

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def visit(browser) -> Iterator:
    """Open a page in a context of its own.

    ``complaints`` has errors of the console, and what it asks of other places than this machine;
    that is not answered. Of Pyodide's own packages, which the published site asks a content
    network for, the folder DRIFTLAB_PYODIDE answers with the same bytes; where no folder is
    named, the network itself does.
    """
    context = browser.new_context(viewport={"width": 1280, "height": 900})
    page = context.new_page()
    page.complaints = []
    page.on("pageerror", lambda error: page.complaints.append(str(error)))
    page.on(
        "console",
        lambda said: page.complaints.append(said.text) if said.type == "error" else None,
    )
    folder = os.environ.get("DRIFTLAB_PYODIDE", "")

    def answer(route) -> None:
        url = route.request.url
        packaged = re.fullmatch(r"https://[^/]+/pyodide/v[\d.]+/full/([^/?]+)", url)
        if url.startswith(("http://127.0.0.1:", "file:", "data:", "blob:")) or (
            packaged and not folder
        ):
            route.continue_()
        elif packaged and (Path(folder) / packaged[1]).is_file():
            cross_origin = {"access-control-allow-origin": "*"}
            route.fulfill(path=Path(folder) / packaged[1], headers=cross_origin)
        else:
            page.complaints.append(url)
            route.abort()

    context.route("**/*", answer)
    yield page
    context.close()

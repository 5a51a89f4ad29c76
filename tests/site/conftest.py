"""The site as built, in a browser: what all tests of it start from.

``python3 lab.py test --site`` runs them; without a built site those that need one are skipped.
"""

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import ClassVar

import pytest
from chromium import chromium

from support import site_or_skip


class Quiet(SimpleHTTPRequestHandler):
    """Files of the site, as a web server hands them out."""

    extensions_map: ClassVar = {
        **SimpleHTTPRequestHandler.extensions_map,
        ".mjs": "text/javascript",
        ".wasm": "application/wasm",
    }

    def log_message(self, *_: object) -> None:
        pass


@pytest.fixture(scope="session")
def site() -> Path:
    """Folder of the built site."""
    return site_or_skip()


@pytest.fixture(scope="session")
def address(site) -> Iterator[str]:
    """Where the site is served, without a slash at the end."""
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=str(site)))
    Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()
    server.server_close()


@pytest.fixture(scope="session")
def browser(site) -> Iterator:
    """The browser; its contexts share nothing."""
    with chromium() as started:
        yield started


@pytest.fixture
def page(browser) -> Iterator:
    """A page of a reader who was never here, which keeps what it complains of."""
    with visit(browser) as page:
        yield page


@pytest.fixture(scope="module")
def kept_page(browser) -> Iterator:
    """Such a page that stays for all tests of a module: what lives in it need not begin anew."""
    with visit(browser) as page:
        yield page


@contextmanager
def visit(browser) -> Iterator:
    """Open a page in a context of its own.

    ``complaints`` has errors of the console, and what it asks of other places than this machine;
    that is not answered. Of Pyodide's own packages, which the published site asks a content
    network for, the folder DRIFTLAB_PYODIDE answers with the same bytes.
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
        if url.startswith(("http://127.0.0.1:", "file:", "data:", "blob:")):
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

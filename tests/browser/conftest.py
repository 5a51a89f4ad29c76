"""A browser and a server for the tests, or one sentence that says how to get them."""

import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from book_server import book_server

# Where lab.py puts what only these tests need. Last, so that it replaces nothing.
sys.path.append(str(Path(sys.prefix, "browser")))

try:
    from playwright.sync_api import Browser, sync_playwright
except ImportError:
    sync_playwright = None

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
QUIET = [  # a browser that asks nothing of the network of its own accord
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-gpu",
    "--disable-quic",
    "--disable-sync",
    "--no-first-run",
]


def missing() -> tuple[str, str]:
    """Return the path of a browser, and what has to be done if a thing is missing."""
    wanted = os.environ.get("DRIFTLAB_BROWSER", "")
    path = wanted or next(filter(None, map(shutil.which, NAMES)), "")
    if not path or not Path(path).exists():
        return path, (
            f"No browser{f' at {path}' if path else ''}: install Chromium (Debian, Ubuntu: sudo "
            "apt install chromium) or set DRIFTLAB_BROWSER to the path of a Chromium or Chrome."
        )
    if sync_playwright is None:
        return path, 'Playwright is missing: "python3 lab.py test" fetches it when online.'
    return path, ""


@pytest.fixture(scope="module")
def browser() -> Iterator["Browser"]:
    path, complaint = missing()
    if complaint:
        # Who names a browser wants it used; anybody else may do without.
        (pytest.fail if "DRIFTLAB_BROWSER" in os.environ else pytest.skip)(complaint)
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=path, args=QUIET)
        yield chromium
        chromium.close()


@pytest.fixture(scope="module")
def server(
    browser: "Browser", tmp_path_factory: pytest.TempPathFactory
) -> Iterator[tuple[str, str, Path]]:
    """Address and token of a JupyterLab, and the folder of its notebooks."""
    folder = tmp_path_factory.mktemp("book")
    with book_server(folder) as (address, token):
        yield address, token, folder / "notebooks"

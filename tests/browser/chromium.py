"""A headless Chromium for tests, or one sentence that says how to get it."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

try:
    from playwright.sync_api import Browser, sync_playwright
except ImportError:
    sync_playwright = None

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
QUIET = [  # it asks nothing of the network of its own accord
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-gpu",
    "--disable-quic",
    "--disable-sync",
    "--no-first-run",
]


class NoBrowser(Exception):
    """There is no browser to drive, or nothing to drive it with."""


def named() -> str:
    """Path of the browser that the user wants; empty if any will do."""
    return os.environ.get("DRIFTLAB_BROWSER", "")


def browser_path() -> str:
    """Path of the browser to use.

    Raises
    ------
    NoBrowser
        With a sentence on how to get one, or what drives it.
    """
    path = named() or next(filter(None, map(shutil.which, NAMES)), "")
    if not Path(path).is_file():
        raise NoBrowser(
            f"No browser{f' at {path}' if path else ''}: install Chromium (Debian, Ubuntu: sudo "
            "apt install chromium) or set DRIFTLAB_BROWSER to the path of a Chromium or Chrome."
        )
    if sync_playwright is None:
        raise NoBrowser("Playwright is missing: install the packages of environment.txt.")
    return path


def no_browser() -> str:
    """Say why the tests do without a browser; empty if they use one.

    Who names a browser wants it used: then the tests are run, and fail.
    """
    try:
        browser_path()
    except NoBrowser as reason:
        return "" if named() else str(reason)
    return ""


@contextmanager
def chromium() -> Iterator["Browser"]:
    """Start a browser for the ``with`` block; raises what `browser_path` does."""
    path = browser_path()
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=QUIET)
        yield browser
        browser.close()

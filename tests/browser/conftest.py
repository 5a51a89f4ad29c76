"""A browser and a server for the tests."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from book_server import Server, book_server
from chromium import NoBrowser, browser_path, chromium, named
from notebook_page import SCREENS, NotebookPage, opened


class Skipped(pytest.Module):
    """A module of tests that are not run, with the reason."""

    def collect(self):
        return pytest.skip(self.reason, allow_module_level=True)


def pytest_pycollect_makemodule(module_path: Path, parent: pytest.Collector):
    """Skip a whole module with one sentence if there is no browser.

    Who names a browser wants it used: then the tests are run, and fail.
    """
    try:
        browser_path()
    except NoBrowser as reason:
        if not named():
            skipped = Skipped.from_parent(parent, path=module_path)
            skipped.reason = str(reason)
            return skipped
    return None


@pytest.fixture(scope="session")
def browser() -> Iterator:
    """A window of the browser; its pages share what they have loaded already."""
    with chromium() as started:
        yield started.new_context(viewport=SCREENS["1280x800"])


@pytest.fixture(scope="session")
def server(browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    """A JupyterLab with a copy of the book."""
    with book_server(tmp_path_factory.mktemp("book")) as started:
        yield started


@pytest.fixture(scope="session")
def notebook(browser, server) -> Iterator[NotebookPage]:
    """A notebook of one cell, for code that a test brings along."""
    with opened(browser, server, server.add_notebook("panel.ipynb")) as page:
        yield page

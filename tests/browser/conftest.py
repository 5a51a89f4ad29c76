"""A browser and a server for the tests."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from book_server import book_server
from chromium import NoBrowser, browser_path, chromium, named


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


@pytest.fixture(scope="module")
def browser() -> Iterator:
    with chromium() as started:
        yield started


@pytest.fixture(scope="module")
def server(browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, str, Path]]:
    """Address and token of a JupyterLab, and the folder of its notebooks."""
    folder = tmp_path_factory.mktemp("book")
    with book_server(folder) as (address, token):
        yield address, token, folder / "notebooks"

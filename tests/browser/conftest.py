"""Without a browser the tests in one are left out, with one sentence that says why."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from chromium import no_browser


class Skipped(pytest.Module):
    """A module of tests that are not run, with the reason."""

    def collect(self):
        return pytest.skip(no_browser(), allow_module_level=True)


def pytest_pycollect_makemodule(module_path: Path, parent: pytest.Collector):
    """Skip a whole module at once."""
    return Skipped.from_parent(parent, path=module_path) if no_browser() else None


@pytest.fixture
def panel(request, notebook) -> Iterator:
    """A panel or scene, alone in the notebook; at the end nothing may have gone wrong anywhere."""
    from notebook_page import SCREENS
    from twin import Panel

    place = request.param
    arguments = ", ".join(map(repr, place.arguments))
    notebook.show_on(SCREENS[1])
    notebook.show(f"from driftlab.book import {place.explorer}\n{place.explorer}({arguments})")
    yield Panel.on(notebook.page, place)
    assert notebook.all_trouble() == []

"""Without a browser the tests in one are left out, with one sentence that says why."""

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

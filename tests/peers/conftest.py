"""Programs that others made, which compute the same: python3 lab.py peers fetches and asks them.

They are imported when a test wants them and no sooner, because one of them compiles itself.
"""

from types import ModuleType

import pytest

FETCH = '"python3 lab.py peers" fetches it'


@pytest.fixture(scope="session")
def pyins() -> ModuleType:
    """pyins, the package python-ins: strapdown navigation by N. Mayorov."""
    package = pytest.importorskip("pyins", reason=f"python-ins is not installed: {FETCH}.")
    import pyins.earth
    import pyins.kalman
    import pyins.sim
    import pyins.transform
    import pyins.util  # noqa: F401

    return package


@pytest.fixture(scope="session")
def navtk() -> ModuleType:
    """The navigation toolkit of the Air Force Institute of Technology, in C++."""
    package = pytest.importorskip("navtk", reason=f"navtk is not installed: {FETCH}.")
    import navtk.inertial  # noqa: F401

    return package

"""How long a fresh Python takes to import this package, and others."""

import subprocess
import sys
from collections.abc import Iterator
from functools import partial
from importlib.util import find_spec

from .measuring import Contender, Row

_PEERS = {
    "allantools": "allantools",
    "ahrs": "ahrs",
    "filterpy.kalman": "filterpy",
    "navtk.inertial": "navtk",
    "pyins.strapdown": "pyins",
    "quaternion": "quaternion",
}
"""Modules that a user imports, and the packages that must be there."""
_SCIPY = "import scipy.linalg, scipy.stats, scipy.spatial.transform"
_USED = "from driftlab import integrate, navigate, align, allan_deviation"


def rows() -> Iterator[Row]:
    floors = [
        Contender("Python alone", partial(_fresh, "pass")),
        Contender("NumPy", partial(_fresh, "import numpy")),
        Contender("SciPy's linalg, stats, Rotation", partial(_fresh, _SCIPY)),
    ]
    here = {name: find_spec(package) is not None for name, package in _PEERS.items()}
    peers = [
        Contender(f"import {name}", partial(_fresh, f"import {name}"))
        for name, found in here.items()
        if found
    ]
    left_out = [
        f"{name} left out: it is not installed." for name, found in here.items() if not found
    ]
    # Peers load all that they have; `import driftlab` alone loads nothing before it is asked for.
    yield Row(
        "import",
        f"`{_USED}`, in a fresh Python",
        Contender("driftlab", partial(_fresh, _USED)),
        peers,
        floors,
        [],
        left_out,
    )
    for code in ("import driftlab", "import driftlab.book"):
        yield Row(
            "import",
            f"`{code}`, in a fresh Python",
            Contender("driftlab", partial(_fresh, code)),
            floor=floors,
        )


def _fresh(code: str) -> None:
    subprocess.run([sys.executable, "-c", code], check=True, stderr=subprocess.DEVNULL)

"""For ``pytest --pyargs driftlab --doctest-modules``: every example of the installed package.

What needs more than NumPy and SciPy is left out where that is not installed.
"""

from importlib.util import find_spec
from typing import Any

collect_ignore = ["__main__.py", "book"]  # chapters have tests of their own
if find_spec("sympy") is None:
    collect_ignore.append("symbolic")
if find_spec("numba") is None:
    collect_ignore += [f"core/{name}.py" for name in ("compiled", "kernels")]


def pytest_configure(config: Any) -> None:
    """Compare results without regard to spaces, and let dots stand for what is not shown."""
    for flag in ("NORMALIZE_WHITESPACE", "ELLIPSIS"):
        config.addinivalue_line("doctest_optionflags", flag)

"""Imports run one way: numerics, symbolic, figures, exercises, explorers; the door loads none."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[1] / "src" / "driftlab"

# Lowest first; each may import what the lower ones may, and modules of its own and lower layers.
# A module or subpackage that is not named here belongs to the numerics.
LAYERS = {
    "numerics": {"numpy", "scipy"},
    "symbolic": {"sympy"},
    "figures": {"matplotlib"},
    "exercises": set(),
    # Pillow, which Matplotlib brings along, writes the picture of an explorer.
    "explorers": {"ipywidgets", "IPython", "PIL"},
}
ORDER = list(LAYERS)
# What a single module may import besides: its subject is the installed packages themselves.
EXTRAS = {"environment": {"packaging"}}

MODULES = [path.relative_to(PACKAGE) for path in sorted(PACKAGE.rglob("*.py"))]


def rank(module):
    """Place in the order of the layers of a dotted name inside the package."""
    first = module.split(".")[0]
    return ORDER.index(first) if first in LAYERS else 0


def imports(path, source):
    """Every imported name, dotted, relative ones resolved from `path` inside the package."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            package = ["driftlab", *path.parts[:-1]]
            base = package[: len(package) - node.level + 1] if node.level else []
            base = [*base, *(node.module or "").split(".")]
            yield from (".".join(filter(None, [*base, alias.name])) for alias in node.names)


def violations(path, source):
    """Imports that the module's layer does not allow."""
    own = rank(path.with_suffix("").as_posix().replace("/", "."))
    libraries = set().union(*(LAYERS[layer] for layer in ORDER[: own + 1]))
    libraries |= sys.stdlib_module_names | EXTRAS.get(path.stem, set())
    return [
        name
        for name in imports(path, source)
        if (
            rank(name.removeprefix("driftlab.")) > own
            if name.split(".")[0] == "driftlab"
            else name.split(".")[0] not in libraries
        )
    ]


@pytest.mark.parametrize("path", MODULES, ids=str)
def test_module_imports_its_own_layer_and_lower_ones_only(path):
    assert violations(path, (PACKAGE / path).read_text(encoding="utf-8")) == []


@pytest.mark.parametrize(
    ("path", "source", "found"),
    [
        ("drift.py", "import numpy as np, scipy.linalg, math", []),
        ("drift.py", "from .quaternion import multiply", []),
        ("drift.py", "import sympy", ["sympy"]),
        ("drift.py", "def f():\n    import matplotlib.pyplot", ["matplotlib.pyplot"]),
        (
            "drift.py",
            "from .figures import roots",
            ["driftlab.book.ch02_characteristic_equation.figures.roots"],
        ),
        ("drift.py", "from . import symbolic", ["driftlab.symbolic"]),
        ("drift.py", "import driftlab.book.panels", ["driftlab.book.panels"]),
        ("symbolic.py", "import sympy\nfrom . import drift", []),
        ("figures/roots.py", "from matplotlib.figure import Figure\nfrom ..drift import x", []),
        ("figures/roots.py", "from .picture import Picture", []),
        ("figures/roots.py", "import ipywidgets", ["ipywidgets"]),
        (
            "figures/roots.py",
            "from ..explorers.panel import x",
            ["driftlab.book.machinery.panel.x"],
        ),
        ("explorers/larin.py", "import ipywidgets\nfrom ..figures import roots", []),
        ("explorers/larin.py", "import pandas", ["pandas"]),
        ("environment.py", "from .symbolic import x", ["driftlab.symbolic.x"]),
    ],
)
def test_the_rule_itself(path, source, found):
    assert violations(Path(path), source) == found


def test_importing_the_package_is_quick_and_loads_no_library():
    heavy = {"matplotlib", "ipywidgets", "IPython", "sympy", "scipy", "numpy"}
    code = f"import sys, driftlab; print(sorted({heavy!r} & sys.modules.keys()))"
    answer = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60
    )
    assert answer.stdout.strip() == "[]"

"""``python -m driftlab``: what there is, module by module."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

PACKAGE = Path(__file__).parent
GROUND_FLOOR = (
    *("checks", "vectors", "quaternion", "earth", "axes", "conventions", "frames"),
    *("triad", "body_frames", "imu", "increments", "sampled_rates", "strapdown", "monte_carlo"),
)
SUBJECTS = ("motion", "drift", "attitude", "calibration", "gyrocompass", "symbolic", "book")


def first_line(tree: ast.Module | ast.FunctionDef | ast.ClassDef) -> str:
    """First line of a docstring."""
    return (ast.get_docstring(tree) or "").split("\n")[0]


def public_names(tree: ast.Module) -> list[str]:
    """Names that a module offers: constants, functions and classes, in their order.

    Checks of arguments, which the modules share, are left out.
    """
    names = []
    for node in tree.body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            names.append(node.name)
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            names += [t.id for t in targets if isinstance(t, ast.Name) and t.id.isupper()]
            if [t.id for t in targets if isinstance(t, ast.Name)] == ["__all__"] and node.value:
                names += ast.literal_eval(node.value)
    offered = dict.fromkeys(names)  # each once
    return [name for name in offered if not name.startswith(("_", "checked_"))]


def overview() -> Iterator[str]:
    """Lines that say what the package holds, without importing any of it."""
    yield first_line(ast.parse((PACKAGE / "__init__.py").read_text(encoding="utf-8")))
    for name in GROUND_FLOOR:
        yield from _module(PACKAGE / f"{name}.py", name)
    for name in SUBJECTS:
        tree = ast.parse((PACKAGE / name / "__init__.py").read_text(encoding="utf-8"))
        yield f"\ndriftlab.{name}: {first_line(tree)}"
        for path in sorted((PACKAGE / name).glob("[!_]*.py")):
            yield from _module(path, f"{name}.{path.stem}", indent="  ")


def _module(path: Path, name: str, indent: str = "") -> Iterator[str]:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    yield f"\n{indent}driftlab.{name}: {first_line(tree)}"
    names = ", ".join(public_names(tree))
    if names:
        yield f"{indent}    {names}"


if __name__ == "__main__":
    print("\n".join(overview()))

"""What Sphinx learns of this project: names of things at every door, and the papers behind them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.domains.python import PythonDomain
from sphinx.environment import BuildEnvironment

from reading.api_pages import plain_bars
from reading.doors import aliases
from reading.field_words import FieldWords, also
from reading.folds import fold_sections
from reading.glossary_words import GlossaryWords
from reading.papers import in_the_papers


def setup(app: Sphinx) -> dict[str, bool]:
    """Join the build."""
    app.connect("autodoc-process-docstring", add_papers, priority=900)  # numpydoc rewrites first
    app.add_transform(FieldWords)
    app.add_transform(GlossaryWords)
    app.connect("autodoc-skip-member", skip_fields)
    app.connect("doctree-read", fold_sections)
    app.connect("env-updated", add_aliases)
    app.connect("missing-reference", find_elsewhere)
    return {"parallel_read_safe": True}


def add_papers(
    app: Sphinx, what: str, name: str, found: Any, options: object, lines: list[str]
) -> None:
    """Let a docstring keep its bars, and end with words of the field and with the ledger."""
    lines[:] = plain_bars(lines)
    if what in ("function", "class"):
        place = f"{found.__module__}.{found.__qualname__}"
        lines += [*also(place), *in_the_papers(place)]


def skip_fields(
    app: Sphinx, what: str, name: str, found: Any, skip: bool, options: object
) -> bool | None:
    """Leave out the fields of a NamedTuple, which the docstring of the class explains."""
    return True if type(found).__name__ == "_tuplegetter" else None


def add_aliases(app: Sphinx, env: BuildEnvironment) -> Iterable[str]:
    """Let every other public name of a thing lead to its entry, in links and in objects.inv."""
    objects = env.domains.python_domain.objects
    for alias, name in aliases().items():
        objects.setdefault(alias, objects[name]._replace(aliased=True))
    return ()


def find_elsewhere(
    app: Sphinx, env: BuildEnvironment, node: Any, contnode: nodes.TextElement
) -> nodes.Node | None:
    """Find what docstrings name without its package; what is found nowhere stays text."""
    if node.get("refdomain") != "py":
        return None
    target = node["reftarget"]
    domain = env.domains.python_domain
    public = {**domain.modules, **domain.objects}
    ends = [name for name in public if name.endswith(f".{target}") and not _is_alias(domain, name)]
    for name in (f"driftlab.{target}", *(ends if len(ends) == 1 else [])):
        if name in public:
            return domain.resolve_xref(
                env, node["refdoc"], app.builder, "obj", name, node, contnode
            )
    return None


def _is_alias(domain: PythonDomain, name: str) -> bool:
    return name in domain.objects and domain.objects[name].aliased

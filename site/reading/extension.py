"""What Sphinx learns of this project: names of things at every door, and the papers behind them."""

from __future__ import annotations

import ast
from collections.abc import Iterable
from functools import cache
from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.domains.python import PythonDomain
from sphinx.environment import BuildEnvironment

from reading.api_pages import plain_bars
from reading.code_colours import use_few_tags
from reading.doors import FOLDER, aliases, names
from reading.field_words import FieldWords, also
from reading.folds import fold_sections, keep_places_single, note_figures
from reading.glossary_words import GlossaryWords
from reading.papers import in_the_papers


def setup(app: Sphinx) -> dict[str, bool]:
    """Join the build."""
    app.connect("autodoc-process-docstring", add_papers, priority=900)  # numpydoc rewrites first
    app.add_transform(FieldWords)
    app.add_transform(GlossaryWords)
    app.connect("autodoc-skip-member", skip_fields)
    app.connect("doctree-read", add_homes)
    app.connect("doctree-read", fold_sections)
    app.connect("doctree-read", note_figures)
    app.connect("doctree-resolved", keep_places_single)
    app.connect("env-updated", add_aliases)
    app.connect("env-updated", drop_sourceless)
    app.connect("missing-reference", find_elsewhere)
    app.add_config_value("scripts", "", "html", str)
    app.connect("builder-inited", add_scripts)
    use_few_tags(app)
    return {"parallel_read_safe": True}


def add_scripts(app: Sphinx) -> None:
    """Load the scripts that stand beside the pages, when the page is there; "" for none."""
    for script in app.config.scripts.split():
        app.add_js_file(f"../{script}", loading_method="defer")


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


def add_homes(app: Sphinx, doctree: nodes.document) -> None:
    """Let the pages of sources, which know where things are defined, find their entries."""
    homes = {name.documented: name.home for name in names()}
    for signature in doctree.findall(addnodes.desc_signature):
        if signature.get("module") and signature["ids"]:
            first, *rest = signature["fullname"].split(".")
            known = homes.get(f"{signature['module']}.{first}")
            places = [".".join([known, *rest])] if known else []
            package = signature["module"].rpartition(".")[0]
            if package != "driftlab":  # where one name of a module is, they look for all of them
                places.append(f"{package}.{signature['fullname']}")
            signature["ids"] += [place for place in places if place not in signature["ids"]]


def drop_sourceless(app: Sphinx, env: BuildEnvironment) -> Iterable[str]:
    """Forget modules without a source, of types by another name: their list would link to them."""
    env._viewcode_modules = {  # type: ignore[attr-defined]
        name: found for name, found in getattr(env, "_viewcode_modules", {}).items() if found
    }
    return ()


def add_aliases(app: Sphinx, env: BuildEnvironment) -> Iterable[str]:
    """Let every other public name of a thing lead to its entry, in links and in objects.inv."""
    objects = env.domains.python_domain.objects
    for alias, name in aliases().items():
        objects.setdefault(alias, objects[name]._replace(aliased=True))
    return ()


def find_elsewhere(
    app: Sphinx, env: BuildEnvironment, node: Any, contnode: nodes.TextElement
) -> nodes.Node | None:
    """Find what docstrings name without its package; arguments and names inside stay text."""
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
    parts = target.split(".")
    is_name = all(part.isidentifier() for part in parts)
    return None if is_name and not words().issuperset(parts) else contnode


def _is_alias(domain: PythonDomain, name: str) -> bool:
    return name in domain.objects and domain.objects[name].aliased


@cache
def words() -> frozenset[str]:
    """Every name in the code: what stands between backticks in a docstring is one of them."""
    found = set()
    for path in FOLDER.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            found |= {getattr(node, key, None) for key in ("id", "arg", "name", "attr", "module")}
    return frozenset(part for name in found if name for part in name.split("."))

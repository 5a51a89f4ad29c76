"""Writes what must agree in many places about a version: ``python3 lab.py release`` runs this.

The version itself is in ``src/driftlab/__init__.py``, dependencies and words in pyproject.toml.
Words are written as JSON writes them, which is YAML, too.
"""

import json
import re
import sys
import tomllib
from collections.abc import Iterator
from datetime import date
from pathlib import Path
from typing import Any

sys.path.append(str(Path(__file__).resolve().parents[1]))

from bootstrap.environment import PYPROJECT, project, write
from bootstrap.steps import HOME, Trouble

RELEASE = HOME / "release/release.toml"
TITLE = "Drift Lab: an interactive textbook on gyro triads, drift and calibration"
NOTE = '# Written by "python3 lab.py release" from release/release.toml; do not edit.'
URLS = re.compile(r"(?<=^\[project\.urls\]).*?(?=^\[)", re.DOTALL | re.MULTILINE)


def version() -> str:
    """Return the version that the package states."""
    text = (HOME / "src/driftlab/__init__.py").read_text("utf-8")
    return re.findall(r'^__version__ = "(.+)"$', text, re.MULTILINE)[0]


def fields() -> dict[str, Any]:
    """Return what release.toml says; refuse what cannot be an address, a date, a digest."""
    try:
        found = tomllib.loads(RELEASE.read_text("utf-8"))
    except (OSError, ValueError) as error:
        raise Trouble(f"release.toml cannot be read: {error}.") from error
    if not isinstance(found["date"], date):
        raise Trouble(f"release.toml: date must be like 2026-11-23, it is {found['date']!r}.")
    for name, url in (*found["urls"].items(), ("sdist", found["sdist"]["url"])):
        if url and not re.fullmatch(r"https://[^\s/]+\S*", url):
            raise Trouble(f"release.toml: {name} must be an address with https://, it is {url!r}.")
    if found["doi"] and not re.fullmatch(r"10\.\d{4,9}/\S+", found["doi"]):
        raise Trouble(f"release.toml: doi must be like 10.5281/zenodo.1, it is {found['doi']!r}.")
    if bool(found["sdist"]["url"]) != bool(re.fullmatch("[0-9a-f]{64}", found["sdist"]["sha256"])):
        raise Trouble("release.toml: the sdist needs both its url and its SHA-256, or neither.")
    return found


def written() -> dict[Path, str]:
    """Return all files that depend on release.toml, each with its text."""
    found = fields()
    return {
        HOME / "CITATION.cff": "\n".join(citation(found)) + "\n",
        HOME / "CITATION.bib": "\n\n".join(bibliography(found)) + "\n",
        HOME / "release/recipe.yaml": "\n".join(recipe(found)) + "\n",
        PYPROJECT: URLS.sub(lambda _: addresses(found), PYPROJECT.read_text("utf-8")),
    }


def quoted(text: object) -> str:
    return json.dumps(text, ensure_ascii=False)


def addresses(found: dict[str, Any]) -> str:
    """Return what stands under [project.urls] in pyproject.toml."""
    lines = [f"{name} = {quoted(url)}\n" for name, url in found["urls"].items() if url]
    return f'  # written by "python3 lab.py release" from release/release.toml\n{"".join(lines)}\n'


def citation(found: dict[str, Any]) -> Iterator[str]:
    """Yield the lines of CITATION.cff."""
    urls = found["urls"]
    yield NOTE
    yield "cff-version: 1.2.0"
    yield f"title: {quoted(TITLE)}"
    yield 'message: "If you use this book or its package, please cite it as below."'
    yield "type: software"
    yield f"authors:\n  - name: {quoted(found['authors'])}"
    yield f"version: {version()}"
    yield f"date-released: {found['date']}"
    known = {"doi": found["doi"], "url": urls["Homepage"], "repository-code": urls["Repository"]}
    yield from (f"{name}: {quoted(value)}" for name, value in known.items() if value)
    yield "license: [BSD-3-Clause, CC-BY-4.0]"
    yield f"keywords: {quoted(project()['project']['keywords'])}"
    yield "references:"
    for paper in found["paper"]:
        yield f"  - type: {'article' if 'journal' in paper else 'generic'}"
        yield "    authors:"
        for family, given in (author.split(", ") for author in paper["authors"]):
            yield f"      - family-names: {quoted(family)}\n        given-names: {quoted(given)}"
        names = ("title", "journal", "volume", "issue", "year", "notes")
        values = {**paper, "notes": paper["note"]}
        yield from (f"    {name}: {quoted(values[name])}" for name in names if name in values)


def bibliography(found: dict[str, Any]) -> Iterator[str]:
    """Yield the entries of CITATION.bib: this version, then the four papers."""
    yield "% " + NOTE.removeprefix("# ")
    day = found["date"]
    yield entry(
        "software",
        "driftlab",
        author="{" + found["authors"] + "}",  # a group, not a person with a family name
        title="{Drift Lab}" + TITLE.removeprefix("Drift Lab"),
        version=version(),
        year=day.year,
        month=day.month,
        doi=found["doi"],
        url=found["urls"]["Homepage"] or found["urls"]["Repository"],
    )
    for paper in found["paper"]:
        yield entry(
            "article" if "journal" in paper else "misc",
            paper["key"],
            author=" and ".join(paper["authors"]),
            title=paper["title"],
            journal=paper.get("journal", ""),
            volume=paper.get("volume", ""),
            number=paper.get("issue", ""),
            year=paper.get("year", ""),
            note=paper["note"],
        )


def entry(kind: str, key: str, **values: object) -> str:
    lines = (f"  {name:8}= {{{value}}},\n" for name, value in values.items() if value)
    return f"@{kind}{{{key},\n{''.join(lines)}}}"


def recipe(found: dict[str, Any]) -> Iterator[str]:
    """Yield the lines of the conda recipe, in the form of rattler-build and conda-forge."""
    about, sdist = project()["project"], found["sdist"]
    python = about["requires-python"].removeprefix(">=")
    build = [need.replace("_", "-") for need in project()["build-system"]["requires"]]
    yield NOTE
    yield "schema_version: 1"
    yield f'context:\n  version: "{version()}"'
    yield "package:\n  name: driftlab\n  version: ${{ version }}"
    if sdist["url"]:
        yield f"source:\n  url: {quoted(sdist['url'])}\n  sha256: {sdist['sha256']}"
    else:
        yield "source:\n  path: ..  # this folder, until a release names an sdist"
    yield "build:\n  number: 0\n  noarch: python"
    yield "  script: ${{ PYTHON }} -m pip install . --no-deps --no-build-isolation -vv"
    yield "requirements:\n  host:"
    yield from (f"    - {need}" for need in (f"python {python}.*", "pip", *build))
    yield "  run:"
    yield from (f"    - {need}" for need in (f"python >={python}", *about["dependencies"]))
    yield "tests:"
    yield "  - python:\n      imports: [driftlab, driftlab.calibration, driftlab.gyrocompass]"
    yield "      pip_check: true"
    yield "  - script: [python -m driftlab, pytest --pyargs driftlab --doctest-modules]"
    yield "    requirements:\n      run: [pytest]"
    yield f"about:\n  summary: {quoted(about['description'])}"
    yield f"  license: {about['license']}"
    yield "  license_file: [LICENSE, LICENSES/BSD-3-Clause.txt, LICENSES/CC-BY-4.0.txt]"
    shown = {"homepage": "Homepage", "repository": "Repository", "documentation": "Documentation"}
    for name, url in ((name, found["urls"][key]) for name, key in shown.items()):
        if url:
            yield f"  {name}: {quoted(url)}"
    yield f"extra:\n  recipe-maintainers: {quoted(found['conda_maintainers'])}"


if __name__ == "__main__":
    if sys.argv[1:]:
        sys.exit(f"release: expected nothing more, got {' '.join(sys.argv[1:])}.")
    try:
        for path, text in written().items():
            write(path, text)
    except Trouble as trouble:
        sys.exit(str(trouble))
    print(f"Written for version {version()}; release/README.md says what comes next.")

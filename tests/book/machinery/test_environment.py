"""The environment check: silent when all is well, one sentence for each thing that is not."""

import sys
from importlib import metadata

import pytest

from driftlab.book.machinery import environment

IN_A_BROWSER = {
    "anywidget": "0.9.13",
    "ipywidgets": "8.1.8",
    "matplotlib": "3.8.4",
    "numpy": "2.0.2",
    "packaging": "24.2",
    "scipy": "1.14.1",
    "sympy": "1.14.0",
    "tqdm": "4.67.1",
}
"""What the live book of the site has, with Pyodide 0.27: neither JupyterLab nor pooch."""


def test_this_environment_will_do() -> None:
    assert environment.problems() == []
    assert environment.report().startswith("All is well: Python")


def test_names_what_is_missing() -> None:
    assert environment.problems("no-such-book") == ["The package no-such-book is not installed."]
    assert "lab.py" in environment.report("no-such-book")


def test_names_what_is_wrong(monkeypatch: pytest.MonkeyPatch) -> None:
    real = metadata.version

    def version(name: str) -> str:
        if name == "sympy":
            raise metadata.PackageNotFoundError(name)
        return "9.0" if name == "ipywidgets" else real(name)

    monkeypatch.setattr(environment.metadata, "version", version)
    monkeypatch.setattr(environment.platform, "python_version", lambda: "3.9.1")
    assert environment.problems() == [
        "Python >=3.11 is needed; this is 3.9.1.",
        "ipywidgets 9.0 is installed; ipywidgets!=8.1.9,<9,>=7.7 is needed.",
        "sympy is not installed; sympy>=1.13 is needed.",
    ]


def test_a_browser_is_no_place_to_install_a_package(monkeypatch: pytest.MonkeyPatch) -> None:
    there = dict(IN_A_BROWSER)

    def version(name: str) -> str:
        if name not in there:
            raise metadata.PackageNotFoundError(name)
        return there[name]

    monkeypatch.setattr(environment.metadata, "version", version)
    monkeypatch.setattr(sys, "platform", "emscripten")
    assert environment.problems() == []
    assert "matplotlib 3.8.4" in environment.report()
    del there["tqdm"]
    said = environment.report()
    assert "tqdm is not installed" in said
    assert "reload the page" in said
    assert "lab.py" not in said

"""The environment check: silent when all is well, one sentence for each thing that is not."""

from importlib import metadata

import pytest

from driftlab.book.machinery import environment


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

"""Killed before whichever change of a file: nobody's work is lost, and the next start mends all."""

import json
import os
from pathlib import Path

import pytest
from killed import CHAPTER, PHASES, killed

pytestmark = pytest.mark.skipif(os.name == "nt", reason="Windows has no fork")
STARTED = [phase for phase in PHASES if phase != "save"]
PATH = f"my-book/{CHAPTER}"
ANSWERS = ("my answer", "my better answer")


def answer_in(text: str) -> str:
    """The answer in a notebook, empty if it is cut or is no notebook."""
    try:
        cells = json.loads(text)["cells"]
    except ValueError:
        return ""
    return "".join(cells[0]["source"]) if cells else ""


def answers_in(files: dict[str, str]) -> list[str]:
    """The answers in all notebooks of the reader."""
    return [
        answer_in(text)
        for name, text in files.items()
        if name.startswith("my-book/") and name.endswith(".ipynb")
    ]


@pytest.mark.parametrize("phase", STARTED)
def test_the_next_start_mends_a_killed_one(tiny: Path, phase: str) -> None:
    told = killed(tiny, phase)
    for left, mended in zip(told["left"], told["mended"], strict=True):
        assert mended == told["whole"]
        assert phase == "first" or ANSWERS[0] in answers_in(left)
    assert phase == "first" or ANSWERS[0] in answers_in(told["whole"])


def test_an_answer_survives_a_kill_of_jupyterlab_while_it_is_saved(tiny: Path) -> None:
    """The one before, or the new one, is in the chapter when it is opened again.

    After a clean copy of it as well, where JupyterLab would bring nothing back: it is put aside
    under a name that JupyterLab opens.
    """
    told = killed(tiny, "save")
    left, mended = ([answer_in(files[PATH]) for files in told[when]] for when in ("left", "mended"))
    assert "" in left, "none is cut"
    assert set(mended) == set(ANSWERS)
    for files in told["cleaned"]:
        aside = [name for name in files if name.startswith("my-book/03_drift.20")]
        assert len(aside) == 1
        assert answer_in(files[aside[0]]) in ANSWERS
        assert answer_in(files[PATH]) == "2 + 2"

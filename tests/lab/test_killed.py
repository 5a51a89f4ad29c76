"""Killed before whichever change of a file: nobody's work is lost, and the next start mends all."""

import json
import os
from pathlib import Path

import pytest
from killed import CHAPTER, PHASES, killed

pytestmark = pytest.mark.skipif(os.name == "nt", reason="Windows has no fork")
STARTED = [phase for phase in PHASES if "save" not in phase]
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
    """The one before, or the new one, is in the chapter when it is opened again."""
    told = killed(tiny, "save")
    found = [answer_in(files[f"my-book/{CHAPTER}"]) for files in told["mended"]]
    assert set(found) == set(ANSWERS)
    assert "" in [answer_in(files[f"my-book/{CHAPTER}"]) for files in told["left"]], "none is cut"


def test_an_answer_survives_a_kill_while_it_is_saved_and_a_clean_copy_after_it(tiny: Path) -> None:
    """What JupyterLab would bring back is put aside under a name that it opens."""
    told = killed(tiny, "save, then fresh")
    for files in told["mended"]:
        aside = [name for name in files if name.startswith("my-book/03_drift.20")]
        assert len(aside) == 1
        assert answer_in(files[aside[0]]) in ANSWERS
        assert answer_in(files[f"my-book/{CHAPTER}"]) == "2 + 2"

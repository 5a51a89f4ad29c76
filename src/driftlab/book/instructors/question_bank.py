"""The exercises as a question bank: ``python -m driftlab.book questions FOLDER`` writes it."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

from .moodle_xml import moodle_xml
from .questions import questions
from .quiz_text import fits, quiz_text

NOTEBOOKS = Path(__file__).parents[4] / "notebooks"
NO_TEXT2QTI = (
    "No QTI is written, because text2qti is not installed; `pip install text2qti` brings it, or "
    "it makes QTI of drift-lab.txt on another computer."
)


def write_question_bank(folder: Path, *, students: int = 20, notebooks: Path = NOTEBOOKS) -> None:
    """Write the exercises with numbers and with statements for Moodle and for Canvas.

    The folder gets ``drift-lab-moodle.xml``, ``drift-lab.txt`` in the language of text2qti and, if
    this is installed, ``drift-lab-qti.zip``. What is left out is printed.
    """
    if students < 1:
        raise ValueError(f"students: expected 1 or more, got {students}.")
    if not any(notebooks.glob("*.ipynb")):
        raise ValueError(f"notebooks: expected the folder of the chapters, got {notebooks}.")
    asked, left_out = questions(notebooks, students)
    plain = [each for each in asked if fits(each)]
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "drift-lab-moodle.xml").write_text(moodle_xml(asked), "utf-8", newline="\n")
    text = quiz_text(plain)
    (folder / "drift-lab.txt").write_text(text, "utf-8", newline="\n")
    for number, why in left_out.items():
        print(f"{number} is left out: {why}.")
    finer = {each.exercise: "" for each in asked if not fits(each)}
    if finer:
        print(f"For Moodle only, because Canvas keeps four decimals: {', '.join(finer)}.")
    print(f"{len({each.exercise for each in asked})} exercises are in {folder}.")
    if find_spec("text2qti") is None:
        print(NO_TEXT2QTI)
    else:
        _write_qti(text, folder / "drift-lab-qti.zip")


def _write_qti(text: str, path: Path) -> None:
    from text2qti.config import Config
    from text2qti.qti import QTI
    from text2qti.quiz import Quiz

    QTI(Quiz(text, config=Config(), source_name=path.stem)).save(path)

"""Of several notebooks the newest counts, unless it has nothing to say."""

import json
import os

import pytest

from hand_ins import notebook, put, rows

UNRUN = json.dumps(
    {"cells": [{"cell_type": "code", "source": f'check("3.{i}", ...)'} for i in range(1, 7)]}
).encode()
ERROR = {"output_type": "error", "ename": "NameError"}
FAILED = json.dumps(
    {"cells": [{"cell_type": "code", "source": 'check("3.2", x)', "outputs": [ERROR]}]}
).encode()
DONE = "\n".join(f"Exercise 3.{i}: {'right' if i % 2 else 'not yet'}." for i in range(1, 7))


@pytest.mark.parametrize(
    ("older", "newer", "note"),
    [
        (notebook(DONE), UNRUN, "but was not run: 3.1 to 3.6 count as in a.ipynb."),
        (
            notebook("Exercise 3.2: right.\nExercise 3.4: not yet."),
            notebook("Exercise 3.2: not answered yet.\nExercise 3.4: not answered yet."),
            "but has no answer there: 3.2, 3.4 count as in a.ipynb.",
        ),
        (notebook("Exercise 3.2: right."), UNRUN, "but was not run: 3.2 counts as in a.ipynb."),
        (
            notebook("Exercise 3.2: right."),
            FAILED,
            "but an error came before the answer there: 3.2 counts as in a.ipynb.",
        ),
        (UNRUN, notebook(DONE), "and counts."),
        (notebook("Exercise 3.1: not answered yet."), UNRUN, "and counts."),
    ],
    ids=["unrun", "open", "one", "error", "run", "neither"],
)  # fmt: skip
def test_what_was_judged_stays(tmp_path, older, newer, note):
    put(tmp_path, {"Ada/a.ipynb": older, "Ada/b.ipynb": newer})
    os.utime(tmp_path / "Ada/a.ipynb", (1e9, 1e9))
    ada = rows(tmp_path)["Ada"]
    assert ada.notes == [f"b.ipynb came after a.ipynb, {note}"]
    if "3.2" in note:
        assert ada.status("3.2") == "right"


def test_each_exercise_is_the_newest_that_was_judged(tmp_path):
    put(tmp_path, {
        "Ada/a.ipynb": notebook("Exercise 3.1: right.\nExercise 3.2: not yet. x"),
        "Ada/b.ipynb": notebook("Exercise 3.1: not answered yet.\nExercise 3.2: right."),
    })  # fmt: skip
    os.utime(tmp_path / "Ada/a.ipynb", (1e9, 1e9))
    ada = rows(tmp_path)["Ada"]
    assert [ada.status(number) for number in ("3.1", "3.2")] == ["right", "right"]
    assert ada.notes == [
        "b.ipynb came after a.ipynb, and counts.",
        "b.ipynb came after a.ipynb, but has no answer there: 3.1 counts as in a.ipynb.",
    ]

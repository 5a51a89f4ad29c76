"""Who handed in what another did is told, without a judgement."""

import json

from driftlab.book.machinery.exercise.records import MIME
from hand_ins import notebook, put, rows

LONG = "The axis enters twice, so its sign cannot matter."


def explained(because, number="3.3"):
    record = {"exercise": number, "word": "right", "because": because, "attempt": 1}
    return {"cell_type": "code", "outputs": [{"data": {MIME: record}}]}


def saved(*cells, **more):
    return json.dumps({"cells": cells, **more}).encode()


def test_the_same_file_is_told_to_both_and_to_none_where_nothing_is_answered(tmp_path):
    empty = saved({"cell_type": "code", "source": 'check("3.1", ...)'})
    put(tmp_path, {
        "Ada/a.ipynb": notebook(), "Bob/b.ipynb": notebook(), "Eve/a.ipynb": notebook() + b"\n",
        "Cy/a.ipynb": empty, "Dan/a.ipynb": empty,
    })  # fmt: skip
    assert {name: each.notes for name, each in rows(tmp_path).items()} == {
        "Ada": ["a.ipynb is byte for byte a notebook that Bob handed in, too."],
        "Bob": ["b.ipynb is byte for byte a notebook that Ada handed in, too."],
        "Cy": [], "Dan": [], "Eve": [],
    }  # fmt: skip


def test_the_same_words_are_told_if_they_are_many(tmp_path):
    put(tmp_path, {
        "Ada/a.ipynb": saved(explained(LONG), explained(LONG, "3.6")),
        "Bob/a.ipynb": saved(explained(LONG.upper()), explained("Only the path counts.", "3.6")),
        "Eve/a.ipynb": saved(explained("No.", "3.3"), explained("Only the path counts.", "3.6")),
        "Zoe/a.ipynb": saved(explained(LONG, "3.1")),
    })  # fmt: skip
    assert {name: each.notes for name, each in rows(tmp_path).items()} == {
        "Ada": ["The words on 3.3 are those of Bob."],
        "Bob": ["The words on 3.3 are those of Ada."],
        "Eve": [], "Zoe": [],
    }  # fmt: skip

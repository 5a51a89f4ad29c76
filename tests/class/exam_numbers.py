"""What the tests of the examination read from a sheet."""

import re
from functools import cache

import numpy as np

from driftlab.book.instructors.examination import exam_paper

EDITIONS = [f"edition {number}" for number in range(25)]
NUMBER = r"[−-]?\d+(?:\.\d+)?"


@cache
def questions(edition):
    paper = exam_paper(edition)
    return [*paper.compulsory, *paper.by_choice]


def question(edition, chapter):
    (found,) = [each for each in questions(edition) if each.chapter == chapter]
    return found


def asked(found, name):
    """The numbers that are right in the part whose first answer has this name, and its text.

    None if this edition asks something else.
    """
    for part in found.parts:
        if part.answers and part.answers[0].name == name:
            return [answer.value for answer in part.answers], part.asks
    return None


def numbers(text):
    return [float(n.replace("−", "-")) for n in re.findall(NUMBER, text)]


def matrix_in(text):
    (body,) = re.findall(r"\\begin\{pmatrix\}(.*?)\\end\{pmatrix\}", text)
    return np.array([numbers(row) for row in body.split(r"\\")])


def powers(text):
    """The numbers before a power of ten."""
    return re.findall(rf"({NUMBER})\\cdot10", text)

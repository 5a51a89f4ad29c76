"""Every answer of the page *I want to …* runs alone, is short, and is known to the package."""

import re
import tomllib
from importlib import import_module
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import nbformat
import numpy as np
import pytest

import driftlab
from driftlab.__main__ import RECIPES, tasks
from support import ROOT, printed_numbers

PAGE = ROOT / RECIPES
TASKS = tomllib.loads(Path(driftlab.__file__).with_name("tasks.toml").read_text("utf-8"))["task"]
LINES = 10
CELLS = nbformat.read(PAGE, as_version=4).cells


class Recipe(NamedTuple):
    """What stands under one heading."""

    subject: str
    title: str
    text: str
    code: str


def recipes() -> list[Recipe]:
    found, subject = [], ""
    for cell, after in pairwise(CELLS):
        level, title = re.match(r"(?:(#+) (.*))?", cell.source).groups()
        if level == "##":
            subject = title
        elif level == "###":
            found.append(Recipe(subject, title, cell.source, after.source))
    return found


RECIPES_FOUND = recipes()


@pytest.mark.parametrize("recipe", RECIPES_FOUND, ids=lambda recipe: recipe.title)
def test_recipe_runs_alone_and_prints(recipe, capsys):
    """In a namespace of its own, so that nothing comes from a cell above; warnings fail."""
    exec(compile(recipe.code, recipe.title, "exec"), {"__name__": "__main__"})
    numbers = printed_numbers(capsys.readouterr().out)
    assert numbers
    assert np.isfinite(numbers).all()


def test_recipes_are_short_and_say_what_is_the_readers():
    for recipe in RECIPES_FOUND:
        assert recipe.title.startswith("I want ")
        assert len([line for line in recipe.code.splitlines() if line.strip()]) <= LINES
        assert max(map(len, recipe.code.splitlines())) <= 100, recipe.title
        assert "# yours" in recipe.code, recipe.title


def test_every_code_cell_belongs_to_a_recipe():
    assert [cell.source for cell in CELLS if cell.cell_type == "code"] == [
        recipe.code for recipe in RECIPES_FOUND
    ]


def test_contents_list_every_recipe_and_nothing_else():
    """JupyterLab makes the address of a heading of its words, with hyphens between them."""
    contents = next(cell.source for cell in CELLS if cell.source.startswith("## Contents"))
    assert re.findall(r"^\*\*(.*)\*\*$", contents, re.MULTILINE) == [
        *dict.fromkeys(recipe.subject for recipe in RECIPES_FOUND)
    ]
    assert re.findall(r"^- \[(.*)\]\(#(.*)\)$", contents, re.MULTILINE) == [
        (recipe.title.removeprefix("I want "), recipe.title.replace(" ", "-"))
        for recipe in RECIPES_FOUND
    ]


def test_package_knows_the_tasks_as_the_page_has_them():
    for task, recipe in zip(TASKS, RECIPES_FOUND, strict=True):
        assert (task["subject"], task["title"]) == (recipe.subject, recipe.title)
        more = re.search(r"^More: \[.*\]\((.*)\.ipynb\), (.*)\.$", recipe.text, re.M)
        assert more[1].split("_")[0] == task["chapter"]
        assert re.findall(r"`driftlab\.([\w.]+)`", more[2]) == task["functions"]
        assert f"{task['functions'][0].split('.')[-1]}" in recipe.code
        for word in task["words"]:  # who looks for it on the page finds it too
            assert word.lower() in recipe.text.lower()
        for name in task["functions"]:
            module, _, function = f"driftlab.{name}".rpartition(".")
            assert getattr(import_module(module), function) is not None


@pytest.mark.parametrize(
    ("word", "function"),
    [
        ("boresight", "triad.split_error_matrix"),
        ("cross-coupling", "drift.drift_per_revolution"),
        ("turntable", "calibration.calibrate"),
        ("log", "recordings.read_csv"),
        ("Allan", "allan.allan_deviation"),
        ("gyrocompassing", "gyrocompass.align"),
        ("covariance analysis", "calibration.covariance_analysis"),
        ("coning", "attitude.coning_drift"),
        ("log turntable", "calibration.calibrate"),
        ("observab", "calibration.unobservable_subspace"),
        ("kalibr", "calibration.KalibrMatrices"),
        ("ENU", "axes.convert_attitude"),
        ("northing error", "gyrocompass.speed_error"),
    ],
)
def test_word_of_the_field_leads_to_the_task(word, function):
    found = "\n".join(tasks(word))
    assert re.search(rf"driftlab\.{function}\b", found)
    assert found.count("I want") < 0.4 * len(TASKS)


def test_word_that_nobody_wants_leads_to_no_task():
    assert list(tasks("flux capacitor")) == []

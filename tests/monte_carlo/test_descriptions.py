"""A task is told from every other one, and known again in every process."""

import importlib
import subprocess
import sys
from dataclasses import dataclass, replace
from enum import Enum
from functools import partial
from typing import NamedTuple
from zipfile import ZipFile

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.spatial.transform import Rotation

from driftlab.calibration.simulation import TableTrial
from driftlab.monte_carlo._descriptions import _own_modules, code_of, describe


class Kind(Enum):
    ONE = 1
    OTHER = 2


class Pair(NamedTuple):
    first: object
    second: object


@dataclass(frozen=True)
class Study:
    told: object

    def run(self, rng, runs):
        return self.told


def work(rng, runs, told=None):
    return told


DIFFERENT = [
    *(None, True, 1, 1.0, np.nextafter(1.0, 2.0).item(), -0.0, 0.0, 1j, "1", b"1", 10**400),
    *((1, 2), [1, 2], (1, (2,)), ((1,), 2), {1, 2}, {1: 2}, {2: 1}, {"1": 2}, Pair(1, 2)),
    *(np.float64(1), np.float32(1), np.int8(1), np.bool_(True)),
    *(np.zeros(2), np.zeros(3), np.zeros((2, 1)), np.zeros(2, np.float32), -np.zeros(2)),
    *(Kind.ONE, Kind.OTHER, Study, Pair, work, Study(1), Study(2), Study((1,))),
    *(Rotation.identity(), Rotation.from_rotvec([0, 0, 1e-9])),
    *(Study(1).run, Study(2).run, partial(work, told=1), partial(work, told=2), partial(work, 1)),
    *(TableTrial().run, replace(TableTrial(), keep=21).run, TableTrial(frame="upper triangle").run),
]  # fmt: skip


def test_what_differs_is_told_apart():
    assert len({describe(thing) for thing in DIFFERENT}) == len(DIFFERENT)


@given(st.floats(allow_nan=False), st.floats(allow_nan=False))
def test_numbers_are_told_apart_to_the_last_bit(one, other):
    same = np.float64(one).tobytes() == np.float64(other).tobytes()
    assert (describe(Study(one).run) == describe(Study(other).run)) == same
    assert (describe(np.array([one])) == describe(np.array([other]))) == same


def test_how_an_array_lies_in_memory_does_not_matter():
    rows = np.arange(6.0).reshape(2, 3)
    assert describe(rows) == describe(np.asfortranarray(rows)) == describe(rows[::-1][::-1])


def test_it_is_the_same_in_another_process():
    lines = (
        "from driftlab.calibration.simulation import TableTrial\n"
        "from driftlab.monte_carlo._descriptions import _own_modules, code_of, describe\n"
        "task = TableTrial(states=('lever arms',)).run\n"
        "print(describe(task), describe({'b', 'a', 'c'}), code_of(task))"
    )
    found = {
        subprocess.run(
            [sys.executable, "-c", lines],
            env={"PYTHONHASHSEED": seed, "PYTHONPATH": ":".join(filter(None, sys.path))},
            capture_output=True,
            check=True,
            text=True,
        ).stdout
        for seed in ("1", "2")
    }
    assert len(found) == 1


@pytest.mark.parametrize(
    "task",
    [
        lambda rng, runs: runs,
        partial(work, told=lambda: 1),
        Study(np.array([object()])).run,
        Study(object()).run,
        Study(iter([])).run,
    ],
)
def test_what_cannot_be_known_again_is_refused_in_a_sentence(task):
    with pytest.raises(ValueError, match=r"^task: expected, to be kept, .* got .*\.$"):
        describe(task)


def test_the_code_of_a_task_is_that_of_its_modules(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(tmp_path)
    module = tmp_path / "my_study_of_code.py"
    module.write_text("def run(rng, runs):\n    return 1\n")
    import my_study_of_code

    first = code_of(partial(my_study_of_code.run, 2))
    assert first != code_of(work)
    module.write_text("def run(rng, runs):\n    return 2\n")
    assert code_of(partial(my_study_of_code.run, 2)) != first
    assert describe(my_study_of_code.run) == "my_study_of_code.run"


BOTH = """from typing import NamedTuple
class Pair(NamedTuple):
    first: int
def run(rng, runs, told=None):
    return helper()
def helper():
    return {number}
"""


@pytest.mark.parametrize("task", ["run", "Pair(1)", "partial(run, told=Pair(1))", "[Pair(1)]"])
def test_what_else_stands_in_the_module_of_a_task_is_its_code(task, tmp_path, monkeypatch):
    """A function, or the class of a tuple with names, may call whatever stands beside it."""
    monkeypatch.syspath_prepend(tmp_path)
    name = f"my_{tmp_path.name}"
    (tmp_path / f"{name}.py").write_text(BOTH.format(number=1))
    given = eval(task, {**vars(importlib.import_module(name)), "partial": partial})
    first = code_of(given)
    (tmp_path / f"{name}.py").write_text(BOTH.format(number=2))
    assert code_of(given) != first


IMPORTS = ["import {0}", "from {0} import number", "import {0} as other", "from {0} import Kind"]


@pytest.mark.parametrize("line", IMPORTS)
def test_a_module_of_ones_own_that_a_task_imports_is_its_code(line, tmp_path, monkeypatch):
    """However it is imported, over two steps as well; another one beside it is not."""
    monkeypatch.syspath_prepend(tmp_path)
    names = [f"{each}_{tmp_path.name}" for each in ("task", "middle", "helper", "stranger")]
    task, middle, helper, stranger = (tmp_path / f"{name}.py" for name in names)
    task.write_text(f"from {names[1]} import go_on\ndef run(rng, runs):\n    return go_on()\n")
    middle.write_text(f"import math\n{line.format(names[2])}\ndef go_on():\n    return 1\n")
    defined = "class Kind: pass\ndef number(): return {}\n"
    helper.write_text(defined.format(1))
    stranger.write_text(defined.format(1))
    importlib.import_module(names[3])
    run = importlib.import_module(names[0]).run
    first = code_of(run)
    stranger.write_text(defined.format(2))
    assert code_of(run) == first
    helper.write_text(defined.format(2))
    assert code_of(run) != first


def test_libraries_are_not_read():
    """Their number is in their version; to read them would take long."""
    own = _own_modules({__name__, "json", "numpy", "driftlab.triad"})
    assert __name__ in own
    assert not any(name.partition(".")[0] in {"json", "numpy", "driftlab"} for name in own)


def test_the_code_of_a_task_in_an_archive_is_its_own_text(tmp_path, monkeypatch):
    found = []
    for number in (1, 2):
        name = f"my_study_in_an_archive_{number}"
        with ZipFile(tmp_path / f"{number}.zip", "w") as archive:
            archive.writestr(f"{name}.py", f"def run(rng, runs):\n    return {number}\n")
        monkeypatch.syspath_prepend(tmp_path / f"{number}.zip")
        found.append(code_of(importlib.import_module(name).run))
    assert found[0] != found[1]

"""A task is told from every other one, and known again in every process."""

import subprocess
import sys
from dataclasses import dataclass, replace
from enum import Enum
from functools import partial
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.spatial.transform import Rotation

from driftlab.calibration.simulation import TableTrial
from driftlab.monte_carlo._descriptions import describe


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
        "from driftlab.monte_carlo._code import code_of\n"
        "from driftlab.monte_carlo._descriptions import describe\n"
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

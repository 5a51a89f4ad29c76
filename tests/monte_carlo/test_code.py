"""Where the code of a task is another one, so is its digest; and nothing else changes it."""

import importlib
import subprocess
import sys
import textwrap
from functools import partial
from types import ModuleType
from zipfile import ZipFile

import pytest

from driftlab.calibration.simulation import TableTrial
from driftlab.monte_carlo import _code
from driftlab.monte_carlo._code import _add_module, code_of, names_of_no_file


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder for modules of one's own, which are forgotten at the end."""
    monkeypatch.syspath_prepend(tmp_path)
    before = {*sys.modules}
    yield tmp_path
    for name in {*sys.modules} - before:
        module = sys.modules[name]
        place = [getattr(module, "__file__", None), *getattr(module, "__path__", ())]
        if any(str(tmp_path) in str(each) for each in place):
            del sys.modules[name]


def write(folder, **texts):
    """Modules by name; a double underscore stands for a folder, or for a package alone."""
    for name, text in texts.items():
        path = folder / f"{name.replace('__', '/')}.py"
        if name.endswith("__"):
            path = folder / name.rstrip("_").replace("__", "/") / "__init__.py"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(textwrap.dedent(text))


def test_it_is_that_of_its_module(folder):
    write(folder, my_study="def run(rng, runs):\n    return 1\n")
    run = importlib.import_module("my_study").run
    first = code_of(partial(run, 2))
    assert first == code_of(partial(run, 3)) != code_of(TableTrial().run)
    write(folder, my_study="def run(rng, runs):\n    return 2\n")
    assert code_of(partial(run, 2)) != first


BOTH = """from typing import NamedTuple
class Pair(NamedTuple):
    first: int
def run(rng, runs, told=None):
    return helper()
def helper():
    return {number}
"""


@pytest.mark.parametrize("task", ["run", "Pair(1)", "partial(run, told=Pair(1))", "[Pair(1)]"])
def test_what_else_stands_in_its_module_counts(task, folder):
    """A function, or the class of a tuple with names, may call whatever stands beside it."""
    write(folder, my_study=BOTH.format(number=1))
    given = eval(task, {**vars(importlib.import_module("my_study")), "partial": partial})
    first = code_of(given)
    write(folder, my_study=BOTH.format(number=2))
    assert code_of(given) != first


@pytest.mark.parametrize(
    "line",
    [
        "import helper",
        "import helper as other",
        "from helper import GAIN",
        "from helper import number",
        "from helper import *",
        "import parts.helper",
        "from parts import helper",
        "from parts.helper import GAIN",
        "def late():\n    from helper import GAIN",
        "try:\n    import of_nobody\nexcept ImportError:\n    import helper",
    ],
)
@pytest.mark.parametrize("packed", [False, True], ids=["folder", "package"])
def test_a_module_of_ones_own_that_a_task_imports_counts(line, packed, folder):
    """However it is imported, over two steps as well; another one beside it does not."""
    write(
        folder,
        task="from middle import go_on\ndef run(rng, runs):\n    return go_on()\n",
        middle=f"import math\n{line}\ndef go_on():\n    return 1\n",
    )
    if packed:
        write(folder, parts__="")
    helper = "parts__helper" if "parts" in line else "helper"
    text = "GAIN = {}\ndef number(): return GAIN\n"
    write(folder, **{helper: text.format(1), "stranger": text.format(1)})
    importlib.import_module("stranger")
    run = importlib.import_module("task").run
    first = code_of(run)
    write(folder, stranger=text.format(2))
    assert code_of(run) == first
    write(folder, **{helper: text.format(2)})
    assert code_of(run) != first


def test_a_package_imports_from_itself(folder):
    task = "from .inner.deep import GAIN\nfrom . import beside\ndef run(rng, runs): pass\n"
    write(folder, own__="WIDTH = 1\n", own__task=task, own__beside="A = 1\n")
    write(folder, own__inner__="", own__inner__deep="from ..far import B\nGAIN = 1\n")
    write(folder, own__far="from own import task\nB = 1\n")  # in a circle
    run = importlib.import_module("own.task").run
    seen = {code_of(run)}
    changed = ("own/__init__", "own/beside", "own/inner/deep", "own/far")
    for count, name in enumerate(changed, 2):
        path = folder / f"{name}.py"
        path.write_text(path.read_text() + "C = 1\n")
        seen.add(code_of(run))
        assert len(seen) == count, name


def test_two_modules_that_exchange_their_texts_are_others(folder):
    write(folder, low="GAIN = 1.0\n", high="GAIN = 2.0\n")
    write(folder, task="import low, high\ndef run(rng, runs):\n    return low.GAIN\n")
    run = importlib.import_module("task").run
    first = code_of(run)
    write(folder, low="GAIN = 2.0\n", high="GAIN = 1.0\n")
    assert code_of(run) != first


def test_what_happens_to_be_loaded_changes_nothing(folder):
    write(folder, lazy__="def table():\n    from . import numbers\n", lazy__numbers="A = 1\n")
    write(folder, task="import lazy\ndef run(rng, runs):\n    return 1\n")
    run = importlib.import_module("task").run
    first = code_of(run)
    importlib.import_module("lazy.numbers")
    assert code_of(run) == first


def test_strange_things_in_a_module_are_left_alone(folder):
    write(
        folder,
        task="""
        class Strange:
            @property
            def __module__(self):
                raise RuntimeError("outside of context")
            def __getattr__(self, name):
                raise RuntimeError(name)
        thing = Strange()
        def run(rng, runs):
            return 1
        """,
    )
    assert len(code_of(importlib.import_module("task").run)) == 64


def test_libraries_are_not_read(folder):
    """Their number is in their version; to read them would take long."""
    (folder / "site-packages").mkdir()
    write(folder / "site-packages", of_others="A = 1\n")
    sys.path.insert(1, str(folder / "site-packages"))
    write(folder, task="import json, numpy.fft, of_others\nfrom driftlab import triad\n")
    try:
        found = {}
        _add_module("task", found)
    finally:
        sys.path.remove(str(folder / "site-packages"))
    assert list(found) == ["task"]


def test_in_an_archive_it_is_its_own(folder):
    found = []
    for number in (1, 1, 2):
        archive = folder / f"{len(found)}.zip"
        with ZipFile(archive, "w") as file:
            file.writestr("packed.py", f"def run(rng, runs):\n    return {number}\n")
        sys.path.insert(0, str(archive))
        found.append(code_of(importlib.import_module("packed").run))
        sys.path.remove(str(archive))
        del sys.modules["packed"]
    assert found[0] == found[1] != found[2]


def test_of_this_package_all_counts_but_its_book(tmp_path, monkeypatch):
    monkeypatch.setattr(_code, "PACKAGE", tmp_path)
    seen = set()
    for change, count in (("core/earth", 1), ("book/panels", 1), ("core/earth", 2), ("imu", 3)):
        write(tmp_path, **{change.replace("/", "__"): f"A = {len(seen)}\n"})
        seen.add(_code._package.__wrapped__())
        assert len(seen) == count, change


TYPED = """
from dataclasses import dataclass
import helper
GAIN = {gain}
def inner(x, by=1):
    return {power} * x
@dataclass
class Study:
    told: int
    def run(self, rng, runs):
        return inner(GAIN)
def task(rng, runs):
    return [helper.GAIN for _ in range(runs)] or inner(GAIN)
"""
AS_TYPED = """
import sys
from driftlab.monte_carlo._code import code_of
exec(sys.argv[1], globals())
print(code_of(task), code_of(Study(1).run))
"""


PARTS = """
class Task:
    def plain(self, rng, runs): return {0}
    @property
    def told(self): return {1}
    @staticmethod
    def alone(x): return {2}
    @classmethod
    def of(cls, x): return {3}
    def deep(self): return [x * {4} for x in range(3)]
    def usual(self, x={5}, *, y={6}): return x
"""


def test_of_a_class_that_was_typed_each_method_counts(monkeypatch):
    module = ModuleType("typed")
    monkeypatch.setitem(sys.modules, "typed", module)

    def found(*numbers):
        exec(PARTS.format(*numbers), vars(module))
        return code_of(module.Task)

    first = found(*range(10, 17))
    assert found(*range(10, 17)) == first
    for place in range(7):
        changed = [number + 100 * (number == place + 10) for number in range(10, 17)]
        assert found(*changed) != first, place


def test_what_was_typed_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "__main__", ModuleType("__main__"))
    exec("def run(rng, runs): pass", typed := {"__name__": "__main__"})
    assert names_of_no_file(partial(typed["run"], told=write)) == ["run"]
    sys.modules["__main__"].__file__ = "study.py"
    assert names_of_no_file(typed["run"]) == []


def test_of_what_was_typed_it_is_what_it_does_and_names(folder):
    def found(helper=1, **values):
        write(folder, helper=f"GAIN = {helper}\n")
        text = TYPED.format(**{"gain": 1.0, "power": 2} | values)
        done = subprocess.run(
            [sys.executable, "-c", AS_TYPED, text],
            env={"PYTHONPATH": ":".join(filter(None, sys.path))},
            capture_output=True,
            check=True,
            text=True,
        )
        return done.stdout.split()

    first = found()
    assert found() == first
    assert first[0] != first[1]
    for changed in ({"gain": 2.0}, {"power": 3}):
        assert all(a != b for a, b in zip(found(**changed), first, strict=True)), changed
    task, study = found(helper=2)
    assert task != first[0]
    assert study == first[1]  # it does not name the helper

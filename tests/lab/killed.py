"""Kills a phase of lab.py before each of its changes to a file, and lets the next start mend it.

``python killed.py FOLDER PHASE`` works on copies of FOLDER, a tiny project, and prints as JSON what
files are there after the phase alone (``whole``), and, for each moment of a kill, what is there
right after it (``left``) and after the next start (``mended``). A file that is opened to be written
gives two moments: before, and when it is empty. What takes long is replaced by something cheap.
"""

import json
import os
import shutil
import signal
import subprocess
import sys
import traceback
from collections.abc import Callable
from functools import cached_property, partial
from pathlib import Path
from tempfile import TemporaryDirectory
from types import SimpleNamespace

CHANGES = {
    *("os.rename", "os.remove", "os.rmdir", "os.mkdir", "os.link", "os.symlink"),
    *("os.truncate", "os.chmod"),
}
WRITES = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC
CHAPTER = "03_drift.ipynb"
NEWER = json.dumps({"cells": [], "metadata": {"of": "a newer book"}})
MOMENTS = {"first": 50, "update of the packages": 50, "move": 10}
"""Kills that there are at least: with none the tests below would say nothing."""
NOTEBOOK = {
    "cells": [
        {
            **{"cell_type": "code", "execution_count": None, "id": "sum", "metadata": {}},
            **{"outputs": [], "source": ["2 + 2"]},
        }
    ],
    "metadata": {"kernelspec": {"display_name": "Python 3", "name": "python3"}},
    "nbformat": 4,
    "nbformat_minor": 5,
}


def kill_at(moment: int, folder: Path) -> None:
    """Kill this process at one of the moments, counted from 1, in which it changes a folder."""
    passed = 0
    emptying = False

    def is_it() -> bool:
        nonlocal passed
        passed += 1
        return passed == moment

    def kill() -> None:
        os.kill(os.getpid(), signal.SIGKILL)

    def watch(event: str, arguments: tuple) -> None:
        nonlocal emptying
        opens = event == "open" and bool(arguments[2] & WRITES)
        if emptying or not (opens or event in CHANGES) or isinstance(arguments[0], int):
            return
        # A path that is relative belongs to a folder's descriptor, as in shutil.rmtree.
        path = os.fsdecode(arguments[0])
        if os.path.isabs(path) and not path.startswith(str(folder)):
            return
        if is_it():
            kill()
        if opens and is_it():
            emptying = True
            os.open(path, arguments[2])
            kill()

    sys.addaudithook(watch)


class Project:
    """A tiny project, and what its lab.py does; packages come from nowhere."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        sys.path.insert(0, str(folder))
        from bootstrap import copies, environment

        self.copies, self.environment = copies, environment
        copies.language_of = lambda python: {"version": "3"}
        environment.make_venv = self.make_venv
        environment.run_step = self.run_step
        environment.subprocess = SimpleNamespace(run=self.run, CalledProcessError=OSError)

    def make_venv(self, venv: Path) -> None:
        scripts = venv / self.environment.BIN
        scripts.mkdir(parents=True)
        (scripts / "python").symlink_to(sys.executable)
        (scripts / "pip").write_text(f"#!{scripts}/python\n", "utf-8")
        self.environment.site_packages(venv).mkdir(parents=True)

    def run_step(self, command: list[str]) -> str:
        packages = self.environment.site_packages(Path(command[0]).parents[1])
        about = packages / "driftlab-0.dist-info"
        about.mkdir(exist_ok=True)
        (packages / "driftlab.pth").write_text("as pip leaves it", "utf-8")
        (about / "METADATA").write_text("Name: driftlab\nVersion: 0\n", "utf-8")
        (about / "RECORD").write_text("driftlab.pth,sha256=ab,16\n", "utf-8")
        return ""

    def run(self, command: list[Path], **_: object) -> None:
        """Fail if a Python is not there; it is not asked whether it runs."""
        os.stat(command[0])

    def work(self) -> None:
        """Answer an exercise of chapter 03."""
        path = self.copies.COPIES / CHAPTER
        notebook = json.loads(path.read_text("utf-8"))
        notebook["cells"][0]["source"] = ["my answer"]
        path.write_text(json.dumps(notebook), "utf-8")

    def begin(self) -> None:
        """Set the project up and begin to work in a chapter."""
        self.environment.set_up()
        self.copies.bring_copies()
        self.work()

    def change_the_book(self) -> None:
        for name in ("00_start_here.ipynb", CHAPTER):
            (self.copies.BOOK / name).write_text(NEWER, "utf-8")

    def change_the_list(self) -> None:
        with self.environment.ENVIRONMENT.open("a", encoding="utf-8") as listed:
            listed.write("# newer\n")

    def open(self) -> None:
        self.environment.set_up()
        self.copies.bring_copies()

    def clean(self) -> None:
        self.environment.set_up()
        self.copies.bring_clean(["03"])

    def save(self) -> None:
        """Save another answer, as JupyterLab does."""
        path = f"my-book/{CHAPTER}"
        model = self.contents.get(path)
        model["content"]["cells"][0]["source"] = "my better answer"
        self.contents.save(model, path)

    def read(self) -> None:
        self.contents.get(f"my-book/{CHAPTER}")

    @cached_property
    def contents(self) -> object:
        from jupyter_server.services.contents.filemanager import FileContentsManager

        return FileContentsManager(root_dir=str(self.folder))


OPENED = {"mended": ["open"]}
PHASES: dict[str, tuple[list[str], str, dict[str, list[str]]]] = {
    "first": ([], "open", OPENED),
    "update of the packages": (["begin", "change_the_list"], "open", OPENED),
    "update of the book": (["begin", "change_the_book"], "open", OPENED),
    "move": (["begin"], "open", OPENED),
    "fresh": (["begin"], "clean", {"mended": ["clean"]}),
    "save": (["begin"], "save", {"mended": ["open", "read"], "cleaned": ["clean"]}),
}
"""What comes before, what is killed, and what the next start does; there may be several."""


LEFT_OUT = (".setup.", "bootstrap/", "src/")


def files(folder: Path) -> dict[str, str]:
    """What is in a folder; where it lies, and names of processes, are left out."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        if path.is_symlink():
            found[name] = os.readlink(path)
        elif path.is_file() and path.suffix != ".pyc" and not name.startswith(LEFT_OUT):
            found[name] = path.read_text("utf-8").replace(str(folder), "HERE")
    return found


def apart(act: Callable[[], None]) -> bool:
    """Do something in a process of its own; tell whether it was killed."""
    child = os.fork()
    if child == 0:
        code = 1
        try:
            os.dup2(2, 1)
            act()
            code = 0
        except BaseException:
            traceback.print_exc()
        finally:
            sys.stderr.flush()
            os._exit(code)
    status = os.waitpid(child, 0)[1]
    if status and not (os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGKILL):
        raise SystemExit(f"a phase failed: {status}")
    return bool(status)


def kills(folder: Path, phase: str) -> dict[str, object]:
    """Kill a phase at each moment."""
    before, act, after = PHASES[phase]
    here, prepared = folder.with_name("here"), folder.with_name("prepared")
    # The environment notices that it was moved, which is the matter of one phase only.
    begun = prepared if phase == "move" else here
    shutil.copytree(folder, begun)
    apart(lambda: do(Project(begun), before))
    if begun == here:
        here.rename(prepared)
    shutil.copytree(prepared, here, symlinks=True)
    project = Project(here)
    if phase == "save":
        assert project.contents  # which takes a second, here and not at each kill
    for copy in (here, prepared):
        shutil.rmtree(copy / "bootstrap")  # it is imported
    result: dict[str, list] = {"left": [], **{name: [] for name in after}}
    moment = 1
    while apart(partial(do, project, [act], moment)):
        result["left"].append(files(here))
        left = here.rename(here.with_name("left"))
        for name, acts in after.items():
            shutil.copytree(left, here, symlinks=True)
            apart(partial(do, project, acts))
            result[name].append(files(here))
            shutil.rmtree(here)
        shutil.rmtree(left)
        shutil.copytree(prepared, here, symlinks=True)
        moment += 1
    return {"whole": files(here), **result}


def do(project: Project, acts: list[str], moment: int = 0) -> None:
    """Let lab.py do something, and be killed at a moment, if one is given."""
    if moment:
        kill_at(moment, project.folder)
    for act in acts:
        getattr(project, act)()


def killed(tiny: Path, phase: str, python: str = sys.executable) -> dict:
    """Run this file on a copy of a tiny project, and return what it prints."""
    (tiny / "notebooks" / CHAPTER).write_text(json.dumps(NOTEBOOK), "utf-8")
    memory = "/dev/shm"  # thousands of files come and go
    with TemporaryDirectory(dir=memory if os.access(memory, os.W_OK) else None) as place:
        folder = shutil.copytree(tiny, Path(place).resolve() / "tiny")
        call = [python, __file__, str(folder), phase]
        done = subprocess.run(call, capture_output=True, encoding="utf-8", timeout=300)
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    assert len(told["left"]) >= MOMENTS.get(phase, 5)
    return told


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    print(json.dumps(kills(Path(sys.argv[1]), sys.argv[2])))

"""Runs a notebook's cells in the process of the tests: what its page would show, without a kernel.

Imports are shared by all notebooks that are run so; names are not.
"""

import atexit
import contextlib
import io
import sys
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib
from IPython.core.displayhook import DisplayHook
from IPython.core.displaypub import DisplayPublisher
from IPython.core.interactiveshell import InteractiveShell
from matplotlib import pyplot
from nbformat import NotebookNode
from nbformat.v4 import new_output
from no_network import no_network
from traitlets import List, Type
from traitlets.config import Config


class Publisher(DisplayPublisher):
    """Keeps what a cell displays."""

    def publish(self, data: dict, metadata: dict | None = None, **_: Any) -> None:
        self.shell.outputs.append(new_output("display_data", data, metadata=metadata or {}))


class Result(DisplayHook):
    """Keeps the value of a cell's last line, in all its representations."""

    def write_output_prompt(self) -> None:
        pass

    def write_format_data(self, format_dict: dict, md_dict: dict | None = None) -> None:
        self.shell.outputs.append(
            new_output("execute_result", format_dict, metadata=md_dict or {}, execution_count=None)
        )

    def finish_displayhook(self) -> None:
        self._is_active = False


class Interpreter(InteractiveShell):
    """IPython as a kernel has it: outputs and errors are kept, not printed."""

    displayhook_class = Type(Result)
    display_pub_class = Type(Publisher)
    outputs = List()

    def _showtraceback(self, etype: type, evalue: BaseException, stb: list[str]) -> None:
        # Comes here from a cell, and from a representation that fails.
        self.outputs.append(
            new_output("error", ename=etype.__name__, evalue=str(evalue), traceback=stb)
        )


class Stream(io.TextIOBase):
    """Keeps what is printed among the outputs, in its place."""

    def __init__(self, name: str, outputs: list) -> None:
        self.name, self.outputs = name, outputs

    def write(self, text: str) -> int:
        last = self.outputs[-1] if self.outputs else {}
        if last.get("name") == self.name:
            last["text"] += text
        elif text:
            self.outputs.append(new_output("stream", name=self.name, text=text))
        return len(text)


@contextlib.contextmanager
def interpreter(folder: Path) -> Iterator[Interpreter]:
    """Start IPython with its files in `folder`, and leave this process as it was.

    Which warnings are errors in a cell is said outside; IPython would only show them.
    """
    config = Config({"HistoryManager": {"enabled": False}})
    path = list(sys.path)
    with warnings.catch_warnings(), matplotlib.rc_context():
        with warnings.catch_warnings():  # IPython's own filters end here
            shell = Interpreter.instance(config=config, ipython_dir=str(folder))
        # At the end of the process each shell would collect garbage for a second.
        atexit.unregister(shell.atexit_operations)
        try:
            yield shell
        finally:
            pyplot.close("all")
            shell.restore_sys_module_state()
            Interpreter.clear_instance()
            sys.path[:] = path


def run_here(notebook: NotebookNode, folder: Path) -> NotebookNode:
    """Run the cells one after the other; raise the first error that a cell does not catch."""
    with interpreter(folder) as shell, no_network():
        for cell in notebook.cells:
            if cell.cell_type != "code":
                continue
            shell.outputs = cell.outputs = []
            with (
                contextlib.redirect_stdout(Stream("stdout", shell.outputs)),
                contextlib.redirect_stderr(Stream("stderr", shell.outputs)),
            ):
                shell.run_cell(cell.source).raise_error()
    return notebook

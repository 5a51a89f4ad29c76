"""The command line: from words to a command, and from its findings to the eye and to files."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import NoReturn

import driftlab

from . import COMMANDS
from .findings import Findings
from .log_files import readable_again
from .options import (
    add_log_options,
    add_output_options,
    allowed_doubts,
    output_files,
    recording_of,
)
from .origin import Origin, origin
from .outputs import as_csv, as_json, checked_outputs, write
from .plots import NoMatplotlib, checked_matplotlib
from .progress import steps
from .report import page
from .terminal import PLAIN, text

WRONG = 2
"""Exit code for what the reader can mend; argparse has the same."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Do what the words say; the exit code.

    A log that cannot be read, a wrong option and a file in the way are one sentence and code 2.
    """
    given = list(sys.argv[1:] if arguments is None else arguments)
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):  # a terminal that lacks a sign shows another
            stream.reconfigure(errors=PLAIN)
    try:
        options = parser(given[0] if given else "").parse_args(given)
        found = _made_up(options) if options.command == "example" else _found(options, given)
        print(text(found), end="", flush=True)
    except BrokenPipeError:  # "| head" has read enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except (ValueError, NoMatplotlib) as error:
        return _refuse(str(error))
    except OSError as error:
        return _refuse(f"{error.filename or 'output'}: {error.strerror}.")
    return 0


class Parser(argparse.ArgumentParser):
    """A parser that says what is wrong in one sentence, without the usage."""

    def error(self, message: str) -> NoReturn:
        """Refuse the words typed."""
        raise ValueError(f"{message.removeprefix('argument ')}; {self.prog} --help explains.")


def parser(chosen: str = "") -> argparse.ArgumentParser:
    """All commands by name, and the chosen one with its options and an example that runs."""
    whole = Parser(
        prog="python -m driftlab",
        description="What a log of your own gyros and accelerometers says.",
        formatter_class=lambda prog: argparse.HelpFormatter(prog, max_help_position=14),
        epilog="'python -m driftlab COMMAND --help' explains a command, with an example that runs. "
        "'python -m driftlab find WORD' lists the modules that speak of a word.",
        allow_abbrev=False,
    )
    whole.add_argument("--version", action="version", version=f"driftlab {driftlab.__version__}")
    commands = whole.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, purpose in COMMANDS.items():
        one = commands.add_parser(
            name,
            help=purpose,
            description=f"{purpose[0].upper()}{purpose[1:]}.",
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
        )
        if name == chosen:  # the others need not be imported
            _complete(one, name)
    return whole


def _complete(one: argparse.ArgumentParser, name: str) -> None:
    module = command(name)
    one.epilog = f"example:\n\n{module.EXAMPLE}"
    if name == "example":
        one.add_argument("log", type=Path, help="the file to write")
        one.add_argument("--force", action="store_true", help="overwrite a file that is there")
        return
    add_log_options(one)
    if hasattr(module, "add_options"):
        module.add_options(one)
    add_output_options(one)


def command(name: str) -> ModuleType:
    """The module of a command."""
    return import_module(f"driftlab.commands.{name}")


def _found(options: argparse.Namespace, given: list[str]) -> Findings:
    """Read the log, do what the command does, write the files that were asked for."""
    outputs = output_files(options)
    checked_outputs(options.log, outputs, options.force)
    if options.report:
        checked_matplotlib()
    module = command(options.command)
    with readable_again(options.log) as options.log, steps(2 + module.STEPS) as step:
        step("read")
        recording = recording_of(options)
        warnings = allowed_doubts(recording, options)
        found = module.find(recording, options, step)
        found = replace(found, warnings=(*warnings, *found.warnings))
        step("write")
        _write(found, origin(options.log, recording, given, options.date), options)
    return found


def _write(found: Findings, origin: Origin, options: argparse.Namespace) -> None:
    if options.report:
        write(options.report, page(found, origin, options.title), options.force)
    if options.json:
        write(options.json, as_json(found, origin), options.force)
    if options.csv:
        write(options.csv, as_csv(found), options.force)


def _made_up(options: argparse.Namespace) -> Findings:
    from .example import as_log, example, findings

    checked_outputs([], {"log": options.log}, options.force)
    record = example()
    write(options.log, as_log(record), options.force)
    return findings(record)


def _refuse(sentence: str) -> int:
    print(f"driftlab: {sentence}", file=sys.stderr)
    return WRONG

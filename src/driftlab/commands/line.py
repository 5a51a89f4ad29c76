"""The command line: from words to a command, and from its findings to the eye and to files."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from importlib import import_module
from importlib.util import find_spec
from itertools import count
from types import ModuleType
from typing import NoReturn

import driftlab

from . import COMMANDS
from .findings import Findings, Step
from .log_files import readable_again
from .options import add_log_options, add_output_options, allowed_doubts, recording_of
from .outputs import PLAIN, as_csv, as_json, as_text, checked_outputs, origin, write
from .report import page

WRONG = 2  # exit code for what the reader can mend; argparse has the same


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
        print(as_text(found), end="", flush=True)
    except BrokenPipeError:  # "| head" has read enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except ValueError as error:
        return _refuse(str(error))
    except OSError as error:
        return _refuse(f"{error.filename or 'output'}: {error.strerror}.")
    return 0


def _refuse(sentence: str) -> int:
    print(f"driftlab: {sentence}", file=sys.stderr)
    return WRONG


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
            module = command(name)
            one.epilog = f"example:\n\n{module.EXAMPLE}"
            if name != "example":
                add_log_options(one)
            if hasattr(module, "add_options"):
                module.add_options(one)
            if name != "example":
                add_output_options(one)
    return whole


def command(name: str) -> ModuleType:
    """The module of a command."""
    return import_module(f"driftlab.commands.{name}")


def _found(options: argparse.Namespace, given: list[str]) -> Findings:
    """Read the log, do what the command does, write the files that were asked for."""
    outputs = {f"--{name}": getattr(options, name) for name in ("report", "csv", "json")}
    checked_outputs(options.log, outputs, options.force)
    if options.report and find_spec("matplotlib") is None:
        raise ValueError(
            "--report: expected Matplotlib to draw the plots, got none; install it by "
            "'pip install matplotlib', or leave --report out."
        )
    module = command(options.command)
    with readable_again(options.log) as options.log, steps(2 + module.STEPS) as step:
        step("read")
        recording = recording_of(options)
        warnings = allowed_doubts(recording, options)
        found = module.find(recording, options, step)
        found = replace(found, warnings=(*warnings, *found.warnings))
        step("write")
        source = origin(recording, options, given)
        if options.report:
            write(options.report, page(found, source, options.title), options.force)
        if options.json:
            write(options.json, as_json(found, source), options.force)
        if options.csv:
            write(options.csv, as_csv(found), options.force)
    return found


@contextmanager
def steps(number: int) -> Iterator[Step]:
    """Say at the foot of a terminal how far a command has come."""
    done, seen = count(1), sys.stderr.isatty()

    def step(name: str) -> None:
        if seen:
            print(f"\r{name:24.24} {next(done)}/{number}", end="", file=sys.stderr, flush=True)

    try:
        yield step
    finally:
        if seen:
            print(f"\r{'':40}\r", end="", file=sys.stderr, flush=True)


def _made_up(options: argparse.Namespace) -> Findings:
    from .example import as_log, example, findings

    checked_outputs([], {"log": options.log}, options.force)
    record = example()
    write(options.log, as_log(record), options.force)
    return findings(record)

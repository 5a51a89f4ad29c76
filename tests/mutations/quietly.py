"""How pytest is run here: in a forked process, without a word, leaving nothing behind."""

import os
import signal
import sys
from collections.abc import Callable
from contextlib import suppress
from multiprocessing import get_context
from multiprocessing.process import BaseProcess
from pathlib import Path

from hypothesis import Phase, settings

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "src/driftlab"
LONG = ("browser", "kernel", "setup")
ARGUMENTS = (
    *("-q", "--tb=no", "--assert=plain", "-p", "no:cacheprovider", "-p", "no:xdist"),
    *("--hypothesis-profile=mutations", "-m", " and ".join(f"not {mark}" for mark in LONG)),
)

# As few examples as the quick tests, and a failure is not made smaller: only that it fails counts.
settings.register_profile(
    "mutations",
    derandomize=True,
    deadline=None,
    database=None,
    max_examples=20,
    phases=(Phase.explicit, Phase.generate),
)


def compile_elsewhere(folder: Path) -> None:
    """Keep all compiled Python in a folder, also that of processes started later."""
    sys.pycache_prefix = os.environ["PYTHONPYCACHEPREFIX"] = str(folder)


def forked(work: Callable[..., None], *arguments: object) -> BaseProcess:
    """Begin work in a process that has what this one has imported."""
    process = get_context("fork").Process(target=_quiet, args=(work, *arguments))
    process.start()
    return process


def _quiet(work: Callable[..., None], *arguments: object) -> None:
    os.setsid()  # so that what it starts ends with it
    nothing = os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1, 2):
        os.dup2(nothing, stream)
    os.chdir(ROOT)
    work(*arguments)
    os._exit(0)


def end(process: BaseProcess) -> None:
    """End a process and all that it has started."""
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.join()
    process.close()

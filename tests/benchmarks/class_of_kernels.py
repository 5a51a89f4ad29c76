"""How much memory and processor a class takes, measured with one kernel a student (Linux).

python tests/benchmarks/class_of_kernels.py 03:30 08:8

starts thirty kernels with chapter 03 and, when they are done, eight with chapter 08. All cells of
a chapter wait in each kernel from the start, so this is a class that runs everything at the same
moment. What panels and figures send is thrown away, as with a browser that is closed. Writes
deployment/measured.md.
"""

import argparse
import os
import platform
import subprocess
import sys
from contextlib import ExitStack
from importlib.metadata import version
from pathlib import Path
from queue import Empty
from statistics import mean
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import NamedTuple

import nbformat
import psutil
from jupyter_client import BlockingKernelClient, KernelManager

ROOT = Path(__file__).resolve().parents[2]
MEASURED = ROOT / "deployment/measured.md"
MIB = 2**20
PAGE = os.sysconf("SC_PAGE_SIZE")


class Memory(NamedTuple):
    """In MiB, summed over processes or of one."""

    private: float  # what ends with the process
    proportional: float  # pages that n processes share count 1/n in each


class Class(NamedTuple):
    kernels: int
    chapter: str
    idle: Memory  # of all
    after: Memory
    peak: float  # private, the greatest sum that was seen
    processor: float  # seconds of one kernel, mean
    wall: float  # seconds until the last was done


def memory(processes: list[psutil.Process]) -> Memory:
    full = [process.memory_full_info() for process in processes]
    return Memory(sum(one.uss for one in full) / MIB, sum(one.pss for one in full) / MIB)


def private_now(processes: list[psutil.Process]) -> float:
    """About the private memory, in MiB; unlike `memory` it costs the processes next to nothing."""
    pages = 0
    for process in processes:
        _, resident, shared, *_ = Path(f"/proc/{process.pid}/statm").read_text().split()
        pages += int(resident) - int(shared)
    return pages * PAGE / MIB


def processor_seconds(process: psutil.Process) -> float:
    times = process.cpu_times()
    return times.user + times.system


def cells_of(chapter: str) -> tuple[str, list[str]]:
    [path] = (ROOT / "notebooks").glob(f"{chapter}_*.ipynb")
    cells = nbformat.read(path, as_version=4).cells
    return path.stem, [cell.source for cell in cells if cell.cell_type == "code"]


def start(folder: Path, closing: ExitStack) -> tuple[BlockingKernelClient, psutil.Process]:
    """Start a kernel in a folder of its own and wait until it answers."""
    folder.mkdir()
    manager = KernelManager(connection_file=str(folder / "connection.json"))
    manager.start_kernel(cwd=str(folder))
    closing.callback(manager.shutdown_kernel, now=True)
    client = manager.client()
    client.start_channels(iopub=False, stdin=False, hb=False)
    closing.callback(client.stop_channels)
    client.kernel_info()
    client.get_shell_msg(timeout=None)
    return client, psutil.Process(manager.provisioner.pid)


def take_class(chapter: str, count: int) -> Class:
    """Let `count` kernels run a chapter at the same time."""
    name, cells = cells_of(chapter)
    with TemporaryDirectory() as folder, ExitStack() as closing:
        began = [start(Path(folder, str(number)), closing) for number in range(count)]
        processes = [process for _, process in began]
        idle = memory(processes)
        before = sum(map(processor_seconds, processes))
        start_time = perf_counter()
        waiting = {}
        for client, process in began:
            requests = [client.execute(cell, store_history=False) for cell in cells]
            waiting[process.pid] = (client, requests[-1])
        peak = private_now(processes)
        while waiting:
            for pid, (client, last) in list(waiting.items()):
                if finished(client, last, 1 / len(waiting)):
                    del waiting[pid]
            peak = max(peak, private_now(processes))
        wall = perf_counter() - start_time
        processor = (sum(map(processor_seconds, processes)) - before) / count
        return Class(count, name, idle, memory(processes), peak, processor, wall)


def finished(client: BlockingKernelClient, last: str, patience: float) -> bool:
    """Tell whether the last cell is done; wait so many seconds for the next reply."""
    try:
        reply = client.get_shell_msg(timeout=patience)
    except Empty:
        return False
    if reply["content"]["status"] != "ok":
        raise SystemExit("\n".join(reply["content"].get("traceback", ["a cell was not run"])))
    return reply["parent_header"]["msg_id"] == last


def server() -> Memory:
    """Measure a JupyterLab server that has answered and has nothing open."""
    with TemporaryDirectory() as folder:
        asked = ["--no-browser", "--allow-root", "--ip=127.0.0.1", "--port=0"]
        asked.append(f"--ServerApp.root_dir={folder}")
        with subprocess.Popen(
            [sys.executable, "-m", "jupyterlab", *asked], stderr=subprocess.PIPE, text=True
        ) as process:
            if not any("is running at" in line for line in process.stderr or ()):
                raise SystemExit("JupyterLab did not start.")
            found = memory([psutil.Process(process.pid)])
            process.terminate()
            process.communicate()
    return found


def report(classes: list[Class], served: Memory) -> str:
    """Return the tables as Markdown."""
    versions = ", ".join(f"{name} {version(name)}" for name in ("ipykernel", "jupyterlab", "numpy"))
    threads = os.environ.get("OPENBLAS_NUM_THREADS", "as many as cores")
    lines = [
        "# Measured",
        "",
        "Written by `tests/benchmarks/class_of_kernels.py`. Memory is in MiB. *Private* is what a",
        "process has to itself; *proportional* adds its share of what processes hold in common.",
        "",
        "| | " + " | ".join(f"{one.kernels} × {one.chapter}" for one in classes) + " |",
        "|---|" + "---:|" * len(classes),
    ]
    rows = {
        "one kernel, started: private": [one.idle.private / one.kernels for one in classes],
        "one kernel, started: proportional": [
            one.idle.proportional / one.kernels for one in classes
        ],
        "one kernel, chapter run: private": [one.after.private / one.kernels for one in classes],
        "one kernel, chapter run: proportional": [
            one.after.proportional / one.kernels for one in classes
        ],
        "all kernels, chapter run: proportional": [one.after.proportional for one in classes],
        "all kernels at the peak: private": [one.peak for one in classes],
        "processor seconds of one kernel for the chapter": [one.processor for one in classes],
        "seconds until the last kernel was done": [one.wall for one in classes],
        "**thirty students, a server each: GiB**": [
            30 * (one.after.proportional / one.kernels + served.proportional) / 1024
            for one in classes
        ],
        "**cores for thirty who all run it at once and wait a minute**": [
            30 * one.processor / 60 for one in classes
        ],
    }
    for name, values in rows.items():
        lines.append(f"| {name} | " + " | ".join(f"{value:.0f}" for value in values) + " |")
    load = mean(os.getloadavg()) / (os.cpu_count() or 1)
    lines += [
        "",
        f"One JupyterLab server with nothing open: {served.private:.0f} private, "
        f"{served.proportional:.0f} proportional.",
        "",
        "The last two rows are reckoned from the others: thirty times the kernel after the chapter",
        "and a server; thirty times the processor's seconds, by sixty.",
        "",
        f"Machine: {platform.system()} {platform.machine()}, {os.cpu_count()} cores, "
        f"{psutil.virtual_memory().total / 2**30:.0f} GiB; load of a core at the end "
        f"{load:.1f}. Python {platform.python_version()}, {versions}; threads of OpenBLAS: "
        f"{threads}.",
        "The seconds on the clock are those of this machine, with whatever else it did; those of",
        "the processor hardly depend on that.",
    ]
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("classes", nargs="*", default=["03:30"], metavar="CHAPTER:KERNELS")
    parser.add_argument("--output", type=Path, default=MEASURED)
    options = parser.parse_args()
    asked = [one.partition(":")[::2] for one in options.classes]
    classes = [take_class(chapter, int(count or 30)) for chapter, count in asked]
    text = report(classes, server())
    options.output.write_text(text, "utf-8")
    print(text)


if __name__ == "__main__":
    main()

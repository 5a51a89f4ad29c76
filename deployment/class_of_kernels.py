"""How much memory and processor a class takes, measured with one kernel a student (Linux).

python deployment/class_of_kernels.py 03:30 11:8

starts thirty kernels with chapter 03 and, when they are done, eight with chapter 11. All cells of
a chapter wait in each kernel from the start, so this is a class that runs everything at the same
moment. What panels and figures send is thrown away, as with a browser that is closed. Writes
deployment/measured.md.
"""

import os
import platform
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

import nbformat
import psutil
from jupyter_client import BlockingKernelClient, KernelManager

ROOT = Path(__file__).resolve().parents[1]
ROWS = (
    "one kernel, started",
    "one kernel, chapter run",
    "all kernels, chapter run",
    "all kernels, each at its own peak, shared pages counted in each",
    "processor seconds of one kernel for the chapter",
    "seconds until the last kernel was done",
    "**thirty students, a server each: GiB**",
    "**cores for thirty who all run it at once and wait a minute**",
)


def memory(processes: list[psutil.Process]) -> float:
    """Sum in MiB; pages that n processes share count 1/n in each."""
    return sum(process.memory_full_info().pss for process in processes) / 2**20


def peak(processes: list[psutil.Process]) -> float:
    """Sum in MiB of the most that each process ever had."""
    status = [Path(f"/proc/{process.pid}/status").read_text() for process in processes]
    return sum(float(text.partition("VmHWM:")[2].split()[0]) for text in status) / 2**10


def processor_seconds(processes: list[psutil.Process]) -> float:
    return sum(sum(process.cpu_times()[:2]) for process in processes)


def take_class(chapter: str, count: int, served: float) -> tuple[str, list[float]]:
    """Let `count` kernels run a chapter at the same time; the name of it and the rows."""
    [path] = (ROOT / "notebooks").glob(f"{chapter}_*.ipynb")
    cells = [cell.source for cell in nbformat.read(path, 4).cells if cell.cell_type == "code"]
    with TemporaryDirectory() as folder:
        managers = [KernelManager() for _ in range(count)]
        clients = []
        for number, manager in enumerate(managers):
            own = Path(folder, str(number))
            own.mkdir()
            manager.start_kernel(cwd=str(own))
            clients.append(manager.client())
            clients[-1].start_channels(iopub=False, stdin=False, hb=False)
            clients[-1].kernel_info()
            clients[-1].get_shell_msg(timeout=60)
        try:
            processes = [psutil.Process(manager.provisioner.pid) for manager in managers]
            idle, before, begin = memory(processes), processor_seconds(processes), perf_counter()
            asked = [[client.execute(cell) for cell in cells] for client in clients]
            for client, requests in zip(clients, asked, strict=True):
                wait_for(client, requests[-1])
            wall = perf_counter() - begin
            each, after = (processor_seconds(processes) - before) / count, memory(processes)
            most = peak(processes)
        finally:
            for client, manager in zip(clients, managers, strict=False):
                client.stop_channels()
                manager.shutdown_kernel(now=True)
    thirty = 30 * (after / count + served) / 1024
    rows = [idle / count, after / count, after, most, each, wall, thirty, 30 * each / 60]
    return f"{count} × {path.stem}", rows


def wait_for(client: BlockingKernelClient, last: str) -> None:
    """Wait for the reply to the last cell, and at most half an hour for each before it."""
    while True:
        reply = client.get_shell_msg(timeout=1800)
        if reply["content"]["status"] != "ok":
            raise SystemExit("\n".join(reply["content"].get("traceback", ["a cell was not run"])))
        if reply["parent_header"]["msg_id"] == last:
            return


def server() -> float:
    """Memory of a JupyterLab server that has answered and has nothing open, in MiB."""
    with TemporaryDirectory() as folder:
        asked = ["--no-browser", "--allow-root", "--ip=127.0.0.1", "--port=0"]
        asked.append(f"--ServerApp.root_dir={folder}")
        command = [sys.executable, "-m", "jupyterlab", *asked]
        with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
            if not any("is running at" in line for line in process.stderr or ()):
                raise SystemExit("JupyterLab did not start.")
            found = memory([psutil.Process(process.pid)])
            process.terminate()
            process.communicate()
    return found


def report(classes: list[tuple[str, list[float]]], served: float) -> str:
    """The table as Markdown."""
    names, columns = zip(*classes, strict=True)
    lines = [f"| | {' | '.join(names)} |", "|---|" + "---:|" * len(names)]
    for name, *values in zip(ROWS, *columns, strict=True):
        lines.append(f"| {name} | {' | '.join(f'{value:.0f}' for value in values)} |")
    versions = ", ".join(f"{name} {version(name)}" for name in ("ipykernel", "jupyterlab", "numpy"))
    return "\n".join(
        [
            "# Measured\n",
            "Written by `deployment/class_of_kernels.py`. Memory is in MiB, with each process's",
            "share of what processes hold in common.\n",
            *lines,
            f"\nOne JupyterLab server with nothing open: {served:.0f}.\n",
            "The last two rows are reckoned from the others: thirty times the kernel after the",
            "chapter and a server; thirty times the processor's seconds, by sixty.\n",
            f"Machine: {platform.system()} {platform.machine()}, {os.cpu_count()} cores, "
            f"{psutil.virtual_memory().total / 2**30:.0f} GiB; load of a core at the end "
            f"{os.getloadavg()[0] / (os.cpu_count() or 1):.1f}. Python "
            f"{platform.python_version()}, {versions}; threads of OpenBLAS: "
            f"{os.environ.get('OPENBLAS_NUM_THREADS', 'as many as cores')}.",
            "The seconds on the clock are those of this machine, with whatever else it did; those",
            "of the processor hardly depend on that.\n",
        ]
    )


def main() -> None:
    served = server()
    asked = [one.partition(":")[::2] for one in sys.argv[1:] or ["03:30"]]
    classes = [take_class(chapter, int(count or 30), served) for chapter, count in asked]
    text = report(classes, served)
    (ROOT / "deployment/measured.md").write_text(text, "utf-8")
    print(text)


if __name__ == "__main__":
    main()

"""lab.py, run as a reader runs it, on the whole book."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import urllib.error
from contextlib import ExitStack
from pathlib import Path

import pytest
from tiny_project import ROOT, WITH_UV, ask, command, refuses, told_by_a_kernel

MADE = (".git", ".venv*", ".jupyter", ".setup.*", "__pycache__", "build", "my-book", "_site")


def opened(stack: ExitStack, folder: Path, variables: dict[str, str]) -> subprocess.Popen[str]:
    """Run ``lab.py --no-browser``."""
    process = subprocess.Popen(
        command(folder, "--no-browser"),
        env={**os.environ, **variables},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        start_new_session=True,  # so that Ctrl-C can be sent as a terminal does: to all in it
    )
    stack.enter_context(process)
    stack.callback(process.terminate)
    return process


def address_of(process: subprocess.Popen[str]) -> tuple[str, str]:
    """Wait until the book is open; return the server's address and its token."""
    said = ""
    for line in process.stdout:
        said += line
        if "Ctrl-C stops it" in line:
            break
    if "package index cannot be reached" in said and "CI" not in os.environ:
        pytest.skip("the package index cannot be reached")
    page = r"(http://127\.0\.0\.1:\d+)/lab/tree/my-book/00_start_here\.ipynb\?(token=\w{48})\n"
    found = re.search(page, said)
    assert found, said
    return found[1], found[2]


@pytest.mark.setup
@pytest.mark.xdist_group("book")
def test_the_book_opens_on_a_machine_that_never_saw_it(tmp_path: Path) -> None:
    """It is even started twice at once, all that can mislead it is there, and a HOME is not."""
    folder = tmp_path / "Дрейф #1, lab"
    shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns(*MADE))
    for name in ("config", "misleading", "stranger/kernels/python3"):
        (tmp_path / name).mkdir(parents=True)
    for name in ("driftlab", "jupyterlab", "pip", "zmq"):
        (tmp_path / f"misleading/{name}.py").write_text("1 / 0\n", "utf-8")
    careless = "c.IdentityProvider.token = ''\nc.ServerApp.ip = '0.0.0.0'\nc.ServerApp.port = 1\n"
    (tmp_path / "config/jupyter_server_config.py").write_text(careless, "utf-8")
    stranger = {"argv": ["nothing"], "display_name": "strange", "language": "python"}
    (tmp_path / "stranger/kernels/python3/kernel.json").write_text(json.dumps(stranger), "utf-8")
    misleading = str(tmp_path / "misleading")
    cache = [sys.executable, "-m", "uv", "cache", "dir"]
    variables = {
        **dict.fromkeys(("PYTHONPATH", "VIRTUAL_ENV", "CONDA_PREFIX"), misleading),
        "JUPYTER_CONFIG_DIR": str(tmp_path / "config"),
        "JUPYTER_RUNTIME_DIR": str(tmp_path / "runtime"),
        "JUPYTER_PATH": str(tmp_path / "stranger"),
        "JUPYTER_PREFER_ENV_PATH": "0",
        "PYTHONHOME": sys.base_prefix,
        "HOME": str(tmp_path / "home"),
        # The one thing that is kept elsewhere.
        "UV_CACHE_DIR": subprocess.check_output(cache, encoding="utf-8").strip(),
        "PATH": WITH_UV,
    }
    with ExitStack() as stack:
        process, second = (opened(stack, folder, variables) for _ in "12")
        base, token = address_of(process)
        assert address_of(second)[0] != base

        with pytest.raises(urllib.error.HTTPError, match="403") as refusal:
            ask(f"{base}/api/contents")
        refusal.value.close()
        assert refuses("127.0.0.2", base.rpartition(":")[2])

        notebook = ask(f"{base}/api/contents/my-book/00_start_here.ipynb?{token}")
        assert notebook["content"]["cells"]
        assert notebook["writable"]

        kernel = ask(f"{base}/api/kernels?{token}", "POST")
        connection = tmp_path / f"runtime/kernel-{kernel['id']}.json"
        there = told_by_a_kernel(connection, "import driftlab", "driftlab.__file__")
        assert Path(there) == folder / "src/driftlab/__init__.py"
        assert "curve_publickey" in json.loads(connection.read_text("utf-8"))  # it is encrypted

        if os.name != "nt":  # Windows has no way to send Ctrl-C from here
            for started in (process, second):
                os.killpg(started.pid, signal.SIGINT)
                last = started.stdout.read()
                assert started.wait(60) == 0
                assert "Stopping ..." in last
                assert "Traceback" not in last
            assert not list((tmp_path / "runtime").glob("jpserver-*"))
    assert not list((tmp_path / "home").glob("*"))

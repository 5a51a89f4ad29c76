"""lab.py, run as a reader runs it, on the whole book."""

import ast
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import threading
import urllib.error
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from jupyter_client import BlockingKernelClient
from tiny_project import ROOT, WITH_UV, command


def copy_of_the_project(folder: Path) -> Path:
    """Copy what git would clone, with the present contents of the files."""
    if not (ROOT / ".git").exists():
        pytest.skip("this is not a git checkout, so there is nothing to clone")
    listing = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    names = subprocess.run(listing, cwd=ROOT, capture_output=True, check=True).stdout
    for name in filter(None, names.decode("utf-8").split("\0")):
        if (ROOT / name).exists():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)
    return folder


@contextmanager
def opened(folder: Path, **variables: str) -> Iterator[subprocess.Popen[str]]:
    """Run ``lab.py --no-browser`` for the ``with`` block."""
    process = subprocess.Popen(
        command(folder, "--no-browser"),
        env={**os.environ, **variables},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        start_new_session=True,  # so that Ctrl-C can be sent as a terminal does: to all in it
    )
    too_long = threading.Timer(900, process.terminate)
    too_long.start()
    with process:
        try:
            yield process
        finally:
            too_long.cancel()
            process.terminate()


def address_of(process: subprocess.Popen[str]) -> tuple[str, str]:
    """Wait until the book is open; return the server's address and its token."""
    said = ""
    for line in process.stdout:
        said += line
        if "Ctrl-C stops it" in line:
            break
    if "package index cannot be reached" in said and "CI" not in os.environ:
        pytest.skip("the package index cannot be reached")
    page = r"(http://127\.0\.0\.1:\d+)/lab/tree/my-book/00_start_here\.ipynb\?token=(\w{48})\n"
    found = re.search(page, said)
    assert found, said
    return found[1], found[2]


def ask(url: str, token: str = "", method: str = "GET") -> object:
    """Return what the server answers."""
    headers = {"Authorization": f"token {token}"} if token else {}
    request = urllib.request.Request(url, headers=headers, method=method)
    direct = urllib.request.build_opener(urllib.request.ProxyHandler({}))
    with direct.open(request, timeout=60) as answer:
        return json.load(answer)


@pytest.mark.setup
@pytest.mark.xdist_group("book")
def test_the_book_opens_on_a_machine_that_never_saw_it(tmp_path: Path) -> None:
    """It is even started twice at once, all that can mislead it is there, and a HOME is not."""
    folder = copy_of_the_project(tmp_path / "Дрейф #1, lab")
    for name in ("config", "misleading", "stranger/kernels/python3"):
        (tmp_path / name).mkdir(parents=True)
    (tmp_path / "misleading/jupyterlab.py").write_text("1 / 0\n", "utf-8")
    careless = "c.IdentityProvider.token = ''\nc.ServerApp.ip = '0.0.0.0'\nc.ServerApp.port = 1\n"
    (tmp_path / "config/jupyter_server_config.py").write_text(careless, "utf-8")
    stranger = {"argv": ["nothing"], "display_name": "strange", "language": "python"}
    (tmp_path / "stranger/kernels/python3/kernel.json").write_text(json.dumps(stranger), "utf-8")
    variables = {
        "JUPYTER_CONFIG_DIR": str(tmp_path / "config"),
        "JUPYTER_RUNTIME_DIR": str(tmp_path / "runtime"),
        "JUPYTER_PATH": str(tmp_path / "stranger"),
        "JUPYTER_PREFER_ENV_PATH": "0",
        "IPYTHONDIR": str(tmp_path / "ipython"),
        "PYTHONPATH": str(tmp_path / "misleading"),
        "PYTHONHOME": sys.base_prefix,
        "VIRTUAL_ENV": str(tmp_path / "misleading"),
        "CONDA_PREFIX": str(tmp_path / "misleading"),
        "HOME": str(tmp_path / "home"),
        "UV_CACHE_DIR": cache_of_uv(),  # the one thing that is kept elsewhere
        "PATH": WITH_UV,
    }
    with opened(folder, **variables) as process, opened(folder, **variables) as second:
        base, token = address_of(process)
        other, _ = address_of(second)
        assert other != base

        with pytest.raises(urllib.error.HTTPError, match="403") as refusal:
            ask(f"{base}/api/contents")
        refusal.value.close()
        with pytest.raises(OSError):  # noqa: PT011 - refused or without a route, by system
            socket.create_connection(("127.0.0.2", int(base.rpartition(":")[2])), timeout=5)

        notebook = ask(f"{base}/api/contents/my-book/00_start_here.ipynb", token)
        assert notebook["content"]["cells"]
        assert notebook["writable"]

        kernel = ask(f"{base}/api/kernels", token, "POST")
        connection = tmp_path / f"runtime/kernel-{kernel['id']}.json"
        assert path_of_the_package(connection) == folder / "src/driftlab/__init__.py"
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


def cache_of_uv() -> str:
    asked = [sys.executable, "-m", "uv", "cache", "dir"]
    return subprocess.run(asked, capture_output=True, text=True, check=True).stdout.strip()


def path_of_the_package(connection_file: Path) -> Path:
    """Ask the kernel which `driftlab` it imports."""
    client = BlockingKernelClient()
    client.load_connection_file(str(connection_file))
    client.start_channels()
    try:
        # Not wait_for_ready: it takes a kernel for dead whose heart is late by one second.
        reply = client.execute(
            "import driftlab",
            user_expressions={"path": "driftlab.__file__"},
            reply=True,
            timeout=120,
        )
    finally:
        client.stop_channels()
    assert reply["content"]["status"] == "ok", reply["content"]
    path = reply["content"]["user_expressions"]["path"]["data"]["text/plain"]
    return Path(ast.literal_eval(path))

"""A JupyterLab on loopback that serves a copy of the book, for the browser to open."""

import json
import os
import secrets
import shutil
import socket
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from runpy import run_path
from typing import NamedTuple

import nbformat
from nbformat import NotebookNode
from no_network import block_kernels
from notebook_page import PATIENCE
from pages import FOLDER, NOTEBOOKS

# Starts JupyterLab as lab.py does: its token comes from DRIFTLAB_TOKEN and wins over any
# configuration that switches tokens off.
SERVER = FOLDER.parent / "bootstrap/server.py"


class Server(NamedTuple):
    """A JupyterLab that runs."""

    address: str
    token: str
    folder: Path

    def add_notebook(self, name: str, notebook: NotebookNode) -> str:
        """Write a notebook into the folder that is served; return its name."""
        nbformat.write(notebook, self.folder / name)
        return name


@contextmanager
def book_server(folder: Path) -> Iterator[Server]:
    """Serve copies of all chapters from `folder`.

    Settings, workspaces and runtime files of the server lie in `folder` as well, and none of the
    user's is read or written. Kernels have no network.
    """
    root = folder / "book"
    book = root / "notebooks"
    serve_copies(book)
    shutil.copytree(FOLDER.parent / "figures", root / "figures")  # chapters show some by name
    widgets = folder / "settings/@jupyter-widgets/jupyterlab-manager"
    widgets.mkdir(parents=True)
    # A notebook that is saved tells what its widgets show.
    (widgets / "plugin.jupyterlab-settings").write_text(json.dumps({"saveState": True}), "utf-8")
    notebooks = folder / "settings/@jupyterlab/notebook-extension"
    notebooks.mkdir(parents=True)
    # A page shows the cells that are near, and the browser has half of the work. It is not what
    # JupyterLab does by itself, which hides the others but keeps them.
    (notebooks / "tracker.jupyterlab-settings").write_text('{"windowingMode": "full"}', "utf-8")
    block_kernels(folder / "ipython")
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    address, token = f"http://127.0.0.1:{port}", secrets.token_hex(24)
    environment = {
        **{name: value for name, value in os.environ.items() if not name.startswith("JUPYTER")},
        "JUPYTER_CONFIG_DIR": str(folder / "config"),
        "JUPYTER_CONFIG_PATH": str(SERVER.with_name("jupyter")),
        "JUPYTER_RUNTIME_DIR": str(folder / "runtime"),
        "JUPYTER_DATA_DIR": str(folder / "data"),
        "JUPYTERLAB_SETTINGS_DIR": str(folder / "settings"),
        "JUPYTERLAB_WORKSPACES_DIR": str(folder / "workspaces"),
        "IPYTHONDIR": str(folder / "ipython"),
        "DRIFTLAB_TOKEN": token,
    }
    command = [
        *[sys.executable, "-P", str(SERVER), "--no-browser", f"--ServerApp.root_dir={root}"],
        f"--ServerApp.port={port}",
        # So that a test can ask the application for its notebook and its kernel.
        "--LabApp.expose_app_in_browser=True",
    ]
    log = folder / "server.log"
    with log.open("wb") as output:
        server = subprocess.Popen(command, env=environment, stdout=output, stderr=output)
    try:
        wait_for(server, f"{address}/api/status", token, log)
        yield Server(address, token, book)
    finally:
        server.terminate()
        try:
            server.wait(30)
        except subprocess.TimeoutExpired:  # it waits for kernels that nobody needs any more
            server.kill()
            server.wait()


def serve_copies(folder: Path) -> None:
    """Write the copies of all notebooks that a reader has."""
    run_path(str(FOLDER.parent / "lab.py"), run_name="lab")  # it says where its modules are
    from bootstrap.copies import clean_text

    for path in NOTEBOOKS:
        copy = folder / path.relative_to(FOLDER)
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_text(clean_text(path.read_text("utf-8")), "utf-8")


def wait_for(server: subprocess.Popen[bytes], url: str, token: str, log: Path) -> None:
    """Return when the server answers to the token."""
    request = urllib.request.Request(url, headers={"Authorization": f"token {token}"})
    direct = urllib.request.build_opener(urllib.request.ProxyHandler({}))
    deadline = time.monotonic() + PATIENCE
    while server.poll() is None and time.monotonic() < deadline:
        try:
            with direct.open(request, timeout=5):
                return
        except OSError:
            time.sleep(0.1)
    raise RuntimeError("JupyterLab did not start: " + log.read_text("utf-8", "replace")[-2000:])

"""A project so small that lab.py sets it up in a second, and how tests run lab.py in it."""

import hashlib
import importlib
import importlib.util
import json
import os
import shutil
import socket
import subprocess
import sys
import urllib.request
import zipfile
from pathlib import Path
from types import SimpleNamespace

from jupyter_client import BlockingKernelClient

ROOT = Path(__file__).resolve().parents[2]
NO_INDEX = {  # a port where nobody listens, whatever pip is configured to use otherwise
    "PIP_INDEX_URL": "http://127.0.0.1:9/simple",
    "PIP_EXTRA_INDEX_URL": "",
    "PIP_FIND_LINKS": "",
    "PIP_CONFIG_FILE": os.devnull,
}
# The tests' own uv is the user's.
WITH_UV = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
# No packages, a build backend that makes by hand what flit makes of the real project, and a
# JupyterLab that ends at once.
TINY_PYPROJECT = """\
[build-system]
requires = []
build-backend = "backend"
backend-path = ["."]

[project]
name = "driftlab"
version = "0"
dependencies = []

[project.optional-dependencies]
book = []
site = []

[tool.uv.pip]
extra = ["book"]
"""
TINY_BACKEND = """\
import zipfile

def build_editable(folder, config_settings=None, metadata_directory=None):
    name = "driftlab-0-py3-none-any.whl"
    with zipfile.ZipFile(folder + "/" + name, "w") as wheel:
        wheel.writestr("driftlab.pth", "replaced by lab.py")
        head = "driftlab-0.dist-info/"
        wheel.writestr(head + "METADATA", "Metadata-Version: 2.1\\nName: driftlab\\nVersion: 0\\n")
        wheel.writestr(head + "WHEEL", "Wheel-Version: 1.0\\nTag: py3-none-any\\n"
                                       "Root-Is-Purelib: true\\n")
        wheel.writestr(head + "RECORD", "")
    return name
"""
TINY_JUPYTERLAB = """\
import os
from types import SimpleNamespace

class LabApp:
    def initialize_server(arguments):
        os.makedirs(os.environ.get("JUPYTER_RUNTIME_DIR", "."), exist_ok=True)
        return SimpleNamespace(
            port=8888,
            default_url="/lab",
            web_app=SimpleNamespace(settings={"static_custom_path": []}),
            io_loop=SimpleNamespace(add_callback=lambda act, *words, **options: act(*words)),
            start=lambda: None,
        )
"""
PARTS = ("environment", "steps", "copies", "installer", "server")


def load(folder: Path) -> SimpleNamespace:
    """Import lab.py of a folder and its parts; no other folder's is mixed in."""
    before = forget()
    sys.path.insert(0, str(folder))
    try:
        spec = importlib.util.spec_from_file_location("lab", folder / "lab.py")
        lab = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(lab)
        parts = {name: importlib.import_module(f"bootstrap.{name}") for name in PARTS}
    finally:
        sys.path[:] = [path for path in sys.path if path != str(folder)]
        forget()
        sys.modules.update(before)
    return SimpleNamespace(lab=lab, **parts)


def forget() -> dict[str, object]:
    """Let Python forget the modules of lab.py."""
    names = [name for name in sys.modules if name.partition(".")[0] == "bootstrap"]
    return {name: sys.modules.pop(name) for name in names}


def command(folder: Path, *arguments: str, python: str = sys.executable) -> list[str]:
    return [python, str(folder / "lab.py"), *arguments]


def around(**variables: str | None) -> dict[str, str]:
    """Variables of a run without an index; one that is None is taken away."""
    found = {**os.environ, **NO_INDEX, "PATH": WITH_UV, **variables}
    return {name: value for name, value in found.items() if value is not None}


def run(folder: Path, *arguments: str, **variables: str | None) -> SimpleNamespace:
    """Run lab.py from a directory that is not its own; no traceback may appear."""
    done = subprocess.run(
        command(folder, *arguments),
        cwd=ROOT.anchor,
        env=around(**variables),
        capture_output=True,
        encoding="utf-8",
        timeout=900,
    )
    assert "Traceback" not in done.stderr, done.stderr
    return SimpleNamespace(code=done.returncode, said=done.stdout, complained=done.stderr.strip())


def make_tiny(folder: Path) -> Path:
    (folder / "src/driftlab").mkdir(parents=True)
    (folder / "src/jupyterlab").mkdir()
    (folder / "notebooks").mkdir()
    (folder / "notebooks/00_start_here.ipynb").write_text('{"cells": [], "metadata": {}}', "utf-8")
    shutil.copy(ROOT / "lab.py", folder)
    unwanted = shutil.ignore_patterns("__pycache__")
    shutil.copytree(ROOT / "bootstrap", folder / "bootstrap", ignore=unwanted)
    (folder / "pyproject.toml").write_text(TINY_PYPROJECT, "utf-8")
    (folder / "backend.py").write_text(TINY_BACKEND, "utf-8")
    (folder / "src/driftlab/book.py").write_text("print('figures drawn')\n", "utf-8")
    (folder / "src/jupyterlab/labapp.py").write_text(TINY_JUPYTERLAB, "utf-8")
    (folder / "src/zmq.py").write_text("def has(feature):\n    return True\n", "utf-8")
    (folder / "environment.txt").write_text("# no packages\n", "utf-8")
    return folder


def ask(url: str, method: str = "GET", content: object = None) -> object:
    """Return what a server answers."""
    request = urllib.request.Request(url, method=method, data=json.dumps(content).encode())
    direct = urllib.request.build_opener(urllib.request.ProxyHandler({}))
    with direct.open(request, timeout=60) as answer:
        return json.load(answer)


def told_by_a_kernel(connection_file: Path, code: str, expression: str) -> str:
    """Run code in a kernel, and return an expression as it has it."""
    client = BlockingKernelClient()
    client.load_connection_file(str(connection_file))
    client.start_channels()
    try:
        # Not wait_for_ready: it takes a kernel for dead whose heart is late by one second.
        asked = {"user_expressions": {"it": expression}, "reply": True, "timeout": 120}
        reply = client.execute(code, **asked)["content"]
    finally:
        client.stop_channels()
    assert reply["status"] == "ok", reply
    return reply["user_expressions"]["it"]["data"]["text/plain"].strip("'")


def refuses(host: str, port: str) -> bool:
    """Tell whether nobody listens there."""
    try:
        socket.create_connection((host, int(port)), timeout=5).close()
    except OSError:  # refused or without a route, by system
        return True
    return False


def listed(folder: Path, lines: str) -> Path:
    """Add lines to environment.txt."""
    with (folder / "environment.txt").open("a", encoding="utf-8") as file:
        file.write(lines)
    return folder


def make_wheel(folder: Path) -> str:
    """Put the package sixth-sense into a folder; return its line of environment.txt."""
    path = folder / "sixth_sense-1.0-py3-none-any.whl"
    head = "sixth_sense-1.0.dist-info/"
    about = {
        "sixth_sense.py": "sense = 6\n",
        head + "METADATA": "Metadata-Version: 2.1\nName: sixth-sense\nVersion: 1.0\n",
        head + "WHEEL": "Wheel-Version: 1.0\nTag: py3-none-any\nRoot-Is-Purelib: true\n",
        head + "RECORD": "sixth_sense.py,,10\n",
    }
    with zipfile.ZipFile(path, "w") as wheel:
        for name, text in about.items():
            wheel.writestr(name, text)
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    return f"sixth-sense==1.0 ; python_version > '3' \\\n    --hash=sha256:{digest}\n"


def sense(folder: Path) -> list[Path]:
    """Where the package sixth-sense is installed."""
    return [*folder.glob(".venv/**/sixth_sense.py")]

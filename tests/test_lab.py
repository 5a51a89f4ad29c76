"""lab.py, run as a reader runs it: on a tiny project of its own and, once, on the whole book."""

import ast
import hashlib
import http.server
import importlib
import importlib.util
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
import urllib.error
import urllib.request
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

import pytest
import yaml
from jupyter_client import BlockingKernelClient
from packaging.requirements import Requirement

ROOT = Path(__file__).resolve().parents[1]
NO_INDEX = {  # a port where nobody listens, whatever pip is configured to use otherwise
    "PIP_INDEX_URL": "http://127.0.0.1:9/simple",
    "PIP_EXTRA_INDEX_URL": "",
    "PIP_FIND_LINKS": "",
    "PIP_CONFIG_FILE": os.devnull,
}
pytestmark = pytest.mark.xdist_group("lab")

# A project that lab.py can set up in seconds and without a network: no packages, a build backend
# that makes by hand what flit makes of the real one, and a JupyterLab that ends at once.
TINY_PYPROJECT = """\
[build-system]
requires = []
build-backend = "backend"
backend-path = ["."]

[project]
name = "driftlab"
version = "0"

[tool]
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

class LabApp:
    port, default_url = 8888, "/lab"

    class web_app:
        settings = {"static_custom_path": []}

    @classmethod
    def initialize_server(cls, argv):
        open(os.path.join(os.environ.get("JUPYTER_RUNTIME_DIR", "."), "jupyter.new"), "w").close()
        cls.io_loop = cls
        return cls

    def add_callback(act):
        act()

    def start():
        pass
"""


PARTS = ("environment", "steps", "copies", "beside", "release", "server")


def load(folder: Path) -> SimpleNamespace:
    """Import lab.py of a folder and what it consists of."""
    sys.path.insert(0, str(folder))
    try:
        spec = importlib.util.spec_from_file_location("lab", folder / "lab.py")
        lab = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(lab)
        parts = {name: importlib.import_module(f"bootstrap.{name}") for name in PARTS}
    finally:
        while str(folder) in sys.path:
            sys.path.remove(str(folder))
        for name in ("bootstrap", *(f"bootstrap.{name}" for name in PARTS)):
            sys.modules.pop(name, None)
    return SimpleNamespace(lab=lab, **parts)


def command(folder: Path, *arguments: str) -> list[str]:
    return [sys.executable, str(folder / "lab.py"), *arguments]


def run(folder: Path, *arguments: str, **variables: str) -> SimpleNamespace:
    """Run lab.py from a directory that is not its own; no traceback may appear."""
    done = subprocess.run(
        command(folder, *arguments),
        cwd=ROOT.anchor,
        env={**os.environ, **variables},
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
    shutil.copytree(
        ROOT / "bootstrap", folder / "bootstrap", ignore=shutil.ignore_patterns("__pycache__")
    )
    (folder / "pyproject.toml").write_text(TINY_PYPROJECT, "utf-8")
    (folder / "backend.py").write_text(TINY_BACKEND, "utf-8")
    (folder / "src/driftlab/book.py").write_text("print('figures drawn')\n", "utf-8")
    (folder / "src/jupyterlab/labapp.py").write_text(TINY_JUPYTERLAB, "utf-8")
    (folder / "src/zmq.py").write_text("def has(feature):\n    return True\n", "utf-8")
    (folder / "environment.txt").write_text(load(folder).environment.lock_line(), "utf-8")
    return folder


def listed(folder: Path, lines: str) -> Path:
    """Add lines to environment.txt."""
    with (folder / "environment.txt").open("a", encoding="utf-8") as file:
        file.write(lines)
    return folder


def make_wheel(folder: Path) -> str:
    """Put the package sixth-sense into a folder; return its line of environment.txt."""
    path = folder / "sixth_sense-1.0-py3-none-any.whl"
    head = "sixth_sense-1.0.dist-info/"
    with zipfile.ZipFile(path, "w") as wheel:
        wheel.writestr("sixth_sense.py", "")
        wheel.writestr(
            head + "METADATA", "Metadata-Version: 2.1\nName: sixth_sense\nVersion: 1.0\n"
        )
        wheel.writestr(
            head + "WHEEL", "Wheel-Version: 1.0\nTag: py3-none-any\nRoot-Is-Purelib: true\n"
        )
        wheel.writestr(head + "RECORD", "")
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    return f"sixth-sense==1.0 ; python_version > '3' \\\n    --hash=sha256:{digest}\n"


@pytest.fixture
def tiny(tmp_path: Path) -> Path:
    """A tiny project that was never set up."""
    return make_tiny(tmp_path / "Übung 1")


@pytest.fixture(scope="module")
def two_starts(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[SimpleNamespace]]:
    """A tiny project, and what its first two starts said, which were at the same time."""
    folder = make_tiny(tmp_path_factory.mktemp("finished") / "Übung 2")
    outputs = []
    threads = [
        threading.Thread(target=lambda: outputs.append(run(folder, "figures", **NO_INDEX)))
        for _ in range(2)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return folder, outputs


@pytest.fixture(scope="module")
def finished(two_starts: tuple[Path, list[SimpleNamespace]]) -> Path:
    """A tiny project that is set up; tests leave it as they found it."""
    folder, outputs = two_starts
    assert [done.code for done in outputs] == [0, 0], [done.complained for done in outputs]
    return folder


@pytest.fixture
def copied(finished: Path, tmp_path: Path) -> Path:
    """A copy of a tiny project that is set up."""
    return copy_of(finished, tmp_path / "a copy")


def copy_of(folder: Path, copy: Path) -> Path:
    """Copy a project or its environment; packages, which nobody writes to, are linked."""

    def copy_file(source: str, target: str) -> None:
        (os.link if "site-packages" in source else shutil.copy2)(source, target)

    return shutil.copytree(folder, copy, symlinks=True, copy_function=copy_file)


@pytest.fixture
def modules(copied: Path, finished: Path, monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """The modules of a tiny project that is set up; it makes another environment in no time."""
    found = load(copied)
    found.environment.set_up()  # it was moved

    def make_venv(folder: Path) -> None:
        copy_of(finished / ".venv", folder)
        (folder / "driftlab.json").unlink()

    monkeypatch.setattr(found.environment, "make_venv", make_venv)
    for name, value in NO_INDEX.items():
        monkeypatch.setenv(name, value)
    return found


# ------------------------------------------------------------------ sentences


def test_environment_txt_was_written_from_the_present_pyproject_toml() -> None:
    line = load(ROOT).environment.lock_line()
    assert line in (ROOT / "environment.txt").read_text("utf-8"), "run 'python3 lab.py lock'"


def test_environment_txt_pins_every_package_with_hashes_and_names_no_index() -> None:
    text = (ROOT / "environment.txt").read_text("utf-8")
    pin = r"[a-z0-9-]+==[^ \n]+( ; [^\\\n]+)?( \\\n    --hash=sha256:[0-9a-f]{64})+"
    assert re.fullmatch(rf"(#.*\n)*({pin}\n)+", text)
    pins = load(ROOT).environment.pins()
    assert len(pins) == text.count("==") - text.count(" == ")
    assert "ipywidgets==8.1.8" in pins  # 8.1.9 draws nothing in VS Code


def test_the_library_needs_numpy_and_scipy_only() -> None:
    needs = load(ROOT).environment.project()["project"]["dependencies"]
    assert [need.split()[0] for need in needs] == ["numpy", "scipy"]


def test_the_list_of_the_oldest_packages_begins_where_pyproject_toml_does() -> None:
    """`python3 lab.py lowest` would else try something newer than what is allowed."""
    about = load(ROOT).environment.project()["project"]
    wanted = [*about["dependencies"], *about["optional-dependencies"]["book"]]
    listed = (ROOT / "bootstrap/lowest.txt").read_text("utf-8")
    for need in map(Requirement, wanted):
        (floor,) = (one.version for one in need.specifier if one.operator == ">=")
        pinned = re.search(rf"^{need.name}==([^\s;]+)", listed, re.MULTILINE)[1]
        assert need.specifier.contains(pinned)
        assert f"{pinned}.".startswith(f"{floor}."), need


def test_binder_pins_what_environment_txt_pins_and_no_jupyter() -> None:
    """Binder's own JupyterLab and Notebook go together; another JupyterLab would part them."""
    lines = (ROOT / ".binder/requirements.txt").read_text("utf-8").splitlines()
    *pins, package = (line for line in lines if not line.startswith("#"))
    assert package == "-e .[book]"
    assert set(pins) <= set(load(ROOT).environment.pins())
    assert {pin.partition("==")[0] for pin in pins} >= {"numpy", "scipy", "matplotlib", "sympy"}
    assert "jupyter" not in "".join(pins)
    about = load(ROOT).environment.project()["project"]
    assert "jupyterlab" not in "".join(about["optional-dependencies"]["book"])
    python = (ROOT / ".binder/runtime.txt").read_text("utf-8").strip()
    tried = "Programming Language :: Python :: " + python.removeprefix("python-")
    assert tried in about["classifiers"]


def test_the_site_is_published_with_no_more_rights_than_that_takes() -> None:
    workflow = yaml.safe_load((ROOT / ".github/workflows/pages.yml").read_text("utf-8"))
    assert workflow["permissions"] == {"contents": "read"}
    jobs = workflow["jobs"]
    assert "permissions" not in jobs["build"]
    said = [step["run"] for step in jobs["build"]["steps"] if "run" in step]
    assert said == [
        "python3 lab.py site",
        "test -f _site/live/lab/index.html",
        'DRIFTLAB_BROWSER="$(command -v google-chrome)" python3 lab.py test --site',
    ]
    assert "upload-pages-artifact" in jobs["build"]["steps"][-1]["uses"], "tested before"
    assert jobs["publish"]["permissions"] == {"pages": "write", "id-token": "write"}
    used = [step["uses"] for job in jobs.values() for step in job["steps"] if "uses" in step]
    assert all(re.fullmatch(r"actions/[\w-]+@v\d+", action) for action in used)


def test_an_old_python_reads_lab_py_as_far_as_the_refusal() -> None:
    ast.parse((ROOT / "lab.py").read_text("utf-8"), feature_version=(3, 6))
    pretend = (
        "import platform, runpy, sys; sys.version_info = (3, 9, 18);"
        "platform.python_version = lambda: '3.9.18'; runpy.run_path(sys.argv[1])"
    )
    done = subprocess.run(
        [sys.executable, "-c", pretend, str(ROOT / "lab.py")], capture_output=True, text=True
    )
    assert done.returncode == 1
    assert done.stderr.startswith("Drift Lab needs Python 3.11 or newer; this is 3.9.18. Install")
    assert done.stderr.count("\n") == 1


def test_help_names_every_command(capsys: pytest.CaptureFixture[str]) -> None:
    lab = load(ROOT).lab
    assert lab.main(["--help"]) == 0
    said = capsys.readouterr().out
    assert all(f"\n  {name} " in said for name in lab.COMMANDS)


def test_unknown_command(tiny: Path) -> None:
    done = run(tiny, "opne", PYTHONSAFEPATH="1")
    assert done.code == 1
    commands = ", ".join(load(ROOT).lab.COMMANDS)
    assert done.complained == f'There is no command "opne"; there are {commands}.'


@pytest.mark.parametrize(
    ("output", "start"),
    [
        ("OSError: [Errno 28] No space left on device", "The disk is full"),
        ("after connection broken by 'NewConnectionError(", "The package index cannot be reached"),
        ("Max retries exceeded with url: /simple", "The package index cannot be reached"),
        ("('Connection broken: IncompleteRead(9)')", "The package index cannot be reached"),
        ("[SSL: CERTIFICATE_VERIFY_FAILED] after connection broken", "What answers is not the pa"),
        (
            "403 Client Error: Forbidden for url: x",
            'The package index answers "403 Client Error: F',
        ),
        ("DO NOT MATCH THE HASHES FROM.\n    six==1 from x", "What came as six==1 is not what"),
        ("something new", "The set-up failed; "),
    ],
)
def test_what_pip_prints_becomes_a_sentence(output: str, start: str) -> None:
    sentence = str(load(ROOT).steps.diagnosis(output, sys.executable))
    assert sentence.startswith(start)
    assert "\n" not in sentence


@pytest.mark.parametrize(
    ("status", "page", "start"),
    [
        (200, "<html>Please log in</html>", "What answers is not the package index: "),
        (401, "", 'The package index answers "401 Client Error: Unauthorized for url'),
        (500, "", 'The package index answers "too many 500 error responses"'),
        (404, "", "The package index has no ready-made sixth-sense==1.0 for this computer"),
        (
            200,
            "<a href='/sixth_sense-1.0-cp34-none-any.whl'>sixth_sense-1.0-cp34-none-any.whl</a>",
            "The package index has no ready-made sixth-sense==1.0 for this computer",
        ),
    ],
)
def test_an_index_that_lacks_a_package_is_told_from_one_that_fails(
    status: int, page: str, start: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Index(http.server.BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self.send_response(status)
            self.send_header("Content-Type", "text/html")
            self.send_header("Content-Length", str(len(page)))
            self.end_headers()
            self.wfile.write(page.encode())

        def log_message(self, *_: object) -> None:
            pass

    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), Index) as index:
        threading.Thread(target=index.serve_forever, daemon=True).start()
        for name, value in NO_INDEX.items():
            monkeypatch.setenv(name, value)
        monkeypatch.setenv("PIP_INDEX_URL", f"http://127.0.0.1:{index.server_port}/simple")
        monkeypatch.setenv("PIP_NO_CACHE_DIR", "1")
        monkeypatch.setenv("NO_PROXY", "127.0.0.1")
        printed = "ERROR: No matching distribution found for sixth-sense==1.0 (from -r x)"
        sentence = str(load(ROOT).steps.diagnosis(printed, sys.executable))
        index.shutdown()
    assert sentence.startswith(start)
    assert "\n" not in sentence


@pytest.mark.parametrize(
    ("name", "contents"),
    [
        ("environment.txt", None),
        ("environment.txt", b"\xff\xfe"),
        ("pyproject.toml", None),
        ("pyproject.toml", b"[project"),
        ("pyproject.toml", b"\xff\xfe"),
        ("pyproject.toml", b""),
    ],
)
def test_lost_or_damaged_files(tiny: Path, name: str, contents: bytes | None) -> None:
    (tiny / name).unlink()
    if contents is not None:
        (tiny / name).write_bytes(contents)
    done = run(tiny, "figures")
    assert (done.code, done.said) == (1, "")
    assert done.complained.startswith("The project is incomplete or damaged, get it afresh: ")
    assert not (tiny / ".venv").exists()


@pytest.mark.skipif(os.name == "nt", reason="Windows separates paths with ;")
def test_a_folder_that_venv_refuses(tiny: Path) -> None:
    refused = tiny.rename(tiny.with_name(f"a{os.pathsep}b"))
    done = run(refused, "figures")
    assert done.code == 1
    assert done.complained.startswith('Python cannot work in a folder with ":" in its name')


def test_a_python_without_ensurepip(tiny: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    environment = load(tiny).environment
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(environment.Trouble, match=r"sudo apt install python3\.\d+-venv"):
        environment.make_venv(tiny / ".venv")


@pytest.mark.parametrize(
    ("error", "sentence"),
    [
        (PermissionError(13, "Permission denied", "here"), "here cannot be written"),
        (OSError(28, "No space left on device"), "The disk is full"),
    ],
)
def test_writing_fails(tiny: Path, error: OSError, sentence: str) -> None:
    environment = load(tiny).environment
    with pytest.raises(environment.Trouble, match=sentence), environment.alone():
        raise error


def test_a_port_in_use(tiny: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        done = run(tiny, "--no-browser", "--port", str(port))
    assert done.code == 1
    assert done.complained.startswith(f"Port {port} cannot be had")


def test_a_terminal_shows_the_latest_line(
    tiny: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    steps = load(tiny).steps
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    monkeypatch.setenv("COLUMNS", "11")
    printed = "Collecting everything\nInstalling collected packages: a, b\n"
    assert steps.run_step([sys.executable, "-c", f"print({printed!r}, end='')"]) == printed
    shown = capsys.readouterr().out.split("\r")
    texts = [text.strip() for text in shown if text.strip()]
    assert texts == ["Collecting", "Installing", "Installing 2 packages; this may take a minute."]
    assert shown[-2:] == [10 * " ", ""]  # the line is clear again
    assert (tiny / ".setup.log").read_text("utf-8") == printed


# ------------------------------------------------------------------ set-up


def test_of_two_starts_one_sets_up_and_one_waits(
    two_starts: tuple[Path, list[SimpleNamespace]],
) -> None:
    said = "".join(done.said for done in two_starts[1])
    assert said.count("Setting up Drift Lab") == 1
    assert said.count("Another start of Drift Lab is setting up this folder") == 1
    assert said.count("figures drawn") == 2


def test_a_second_start_writes_nothing(finished: Path) -> None:
    """Neither log nor lock, so that a folder that can only be read can be used."""
    (finished / ".setup.lock").unlink()
    log = finished / ".setup.log"
    before = log.stat().st_mtime_ns
    again = run(finished, "figures", **NO_INDEX)
    assert (again.code, again.said.strip()) == (0, "figures drawn")
    assert log.stat().st_mtime_ns == before
    assert not (finished / ".setup.lock").exists()


def test_a_stale_environment_txt_is_mentioned_and_used(copied: Path) -> None:
    pyproject = copied / "pyproject.toml"
    text = pyproject.read_text("utf-8")
    pyproject.write_text(text.replace("[tool]", 'dependencies = ["numpy"]\n[tool]'), "utf-8")
    done = run(copied, "figures", **NO_INDEX)
    assert done.said.startswith("environment.txt is older than pyproject.toml; ")
    assert "figures drawn" in done.said


def test_without_network_the_old_environment_stays_and_the_book_opens(
    modules: SimpleNamespace, copied: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    before = (copied / "environment.txt").read_text("utf-8")
    listed(copied, f"sixth-sense==1.0 --hash=sha256:{64 * '0'}\n")
    with pytest.raises(modules.lab.Trouble, match="The package index cannot be reached: "):
        modules.lab.main(["figures"])
    said = capfd.readouterr().out
    assert said.startswith("The project has changed since the last set-up; updating")
    assert "figures drawn" not in said

    assert modules.lab.main(["--no-browser"]) == 0
    said = capfd.readouterr().out
    assert "\nMeanwhile the book opens with the packages of the last set-up.\n" in said
    assert "Drift Lab is open at" in said

    (copied / "environment.txt").write_text(before, "utf-8")
    assert modules.lab.main(["figures"]) == 0
    assert capfd.readouterr().out.strip() == "figures drawn"


def test_what_jupyterlab_cannot_write_is_named(copied: Path) -> None:
    done = run(copied, "open", "--no-browser", JUPYTER_RUNTIME_DIR=str(copied / "nowhere"))
    assert done.code == 1
    assert "nowhere" in done.complained
    assert len(done.complained.splitlines()) == 2


def test_a_moved_project_works_at_once(copied: Path) -> None:
    done = run(copied, "figures", **NO_INDEX)
    assert (done.code, done.said.strip()) == (0, "figures drawn")
    python = load(copied).steps.PYTHON
    where = "import driftlab, jupyterlab; print(jupyterlab.__path__[0])"
    found = subprocess.run([python, "-c", where], capture_output=True, encoding="utf-8")
    assert Path(found.stdout.strip()) == copied / "src/jupyterlab"
    pip = subprocess.run([python.with_name("pip"), "--version"], capture_output=True)
    assert str(copied) in pip.stdout.decode()


@pytest.mark.parametrize(
    ("stamp", "sentence"),
    [
        ({"python": "CPython 3.1"}, "Making the environment anew, for "),
        ({"environment": "older"}, "The project has changed since the last set-up"),
        ({"contents": ["lib/numpy"]}, "The environment is damaged"),
        ({"contents": None}, "The environment is damaged"),
        (None, "The environment is damaged"),
        ([], "The environment is damaged"),
        (5, "The environment is damaged"),
        ({}, ""),
    ],
)
def test_reasons_to_make_the_environment(finished: Path, stamp: object, sentence: str) -> None:
    path = finished / ".venv/driftlab.json"
    before = path.read_text("utf-8")
    changed = json.loads(before) | stamp if isinstance(stamp, dict) else stamp
    path.write_text(json.dumps(changed), "utf-8")
    try:
        reason = load(finished).environment.reason_to_build()
    finally:
        path.write_text(before, "utf-8")
    assert reason.startswith(sentence)
    assert bool(reason) == bool(sentence)


def test_an_environment_whose_python_is_gone_is_damaged(
    finished: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    environment = load(finished).environment
    monkeypatch.setattr(environment, "PYTHON", finished / "nowhere")
    assert environment.reason_to_build().startswith("The environment is damaged")


@pytest.mark.parametrize("kind", ["folder", "file"])
def test_what_lab_py_did_not_make_is_left_alone(tiny: Path, kind: str) -> None:
    mine = tiny / ".venv" if kind == "file" else tiny / ".venv/mine.txt"
    mine.parent.mkdir(exist_ok=True)
    mine.write_text("mine", "utf-8")
    other = tiny / ".venv.old/mine.txt"
    other.parent.mkdir()
    other.write_text("mine", "utf-8")
    done = run(tiny, "figures", **NO_INDEX)
    assert (done.code, done.said) == (1, "")
    assert done.complained.endswith("was not made by lab.py: move it away and run this again.")
    assert mine.read_text("utf-8") == other.read_text("utf-8") == "mine"


def test_an_environment_may_lie_on_another_disk(
    modules: SimpleNamespace, copied: Path, tmp_path: Path
) -> None:
    shutil.rmtree(copied / ".venv")
    (copied / ".venv").symlink_to(tmp_path / "disk/venv", target_is_directory=True)
    (tmp_path / "disk").mkdir()
    elsewhere = load(copied)
    elsewhere.environment.make_venv = modules.environment.make_venv
    elsewhere.environment.set_up()
    assert (copied / ".venv").is_symlink()
    assert [path.name for path in (tmp_path / "disk").iterdir()] == ["venv"]
    assert run(copied, "figures", **NO_INDEX).said.strip() == "figures drawn"


def test_an_interrupted_update_leaves_the_old_environment(
    modules: SimpleNamespace, copied: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = (copied / "environment.txt").read_text("utf-8")
    stamp = modules.environment.read_stamp()
    listed(copied, "# newer\n")
    monkeypatch.setattr(
        modules.environment, "run_step", lambda command: signal.raise_signal(signal.SIGINT)
    )
    with pytest.raises(KeyboardInterrupt):
        modules.environment.set_up()
    assert modules.environment.read_stamp() == stamp
    assert not list(copied.glob(".venv.*"))
    (copied / "environment.txt").write_text(before, "utf-8")
    assert run(copied, "figures", **NO_INDEX).said.strip() == "figures drawn"


@pytest.mark.setup
def test_a_killed_update_leaves_the_old_environment_and_heals(copied: Path) -> None:
    assert run(copied, "figures", **NO_INDEX).code == 0
    old = (copied / ".venv/driftlab.json").read_bytes()
    listed(copied, "# newer\n")
    with subprocess.Popen(command(copied, "figures"), stdout=subprocess.PIPE) as process:
        while not list(copied.glob(".venv.lab*/pyvenv.cfg")):
            assert process.poll() is None
            time.sleep(0.01)
        process.kill()
    assert (copied / ".venv/driftlab.json").read_bytes() == old
    assert load(copied).environment.is_whole()
    done = run(copied, "figures", **NO_INDEX)
    assert "The project has changed since the last set-up" in done.said
    assert "figures drawn" in done.said
    assert not list(copied.glob(".venv.lab*/driftlab.json"))


def test_an_environment_that_lacks_only_its_place_gets_it(copied: Path) -> None:
    """This is what is left if lab.py is killed in the moment between two names."""
    (copied / ".venv").rename(copied / ".venv.lab7.old")
    done = run(copied, "figures", **NO_INDEX)
    assert (done.code, done.said.strip()) == (0, "figures drawn")
    assert not list(copied.glob(".venv.*"))


def test_an_environment_that_cannot_be_put_in_place_brings_the_old_one_back(
    modules: SimpleNamespace, copied: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    real = Path.rename

    def rename(path: Path, target: Path) -> Path:
        if path.name.startswith(".venv.lab") and not path.name.endswith(".old"):
            raise PermissionError(13, "in use", str(path))
        return real(path, target)

    listed(copied, "# newer\n")
    monkeypatch.setattr(Path, "rename", rename)
    with pytest.raises(modules.environment.Trouble, match="cannot be written"):
        modules.environment.set_up()
    assert modules.environment.is_whole()
    assert not list(copied.glob(".venv.*"))


@pytest.mark.parametrize("setting", ["target", "prefix"])
def test_pip_settings_that_lead_packages_elsewhere_are_noticed(
    modules: SimpleNamespace, copied: Path, tmp_path: Path, setting: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    listed(copied, make_wheel(tmp_path))
    settings = tmp_path / "pip.conf"
    elsewhere = tmp_path / "elsewhere"
    settings.write_text(
        f"[install]\n{setting} = {elsewhere}\n[global]\nfind-links = {tmp_path}\n", "utf-8"
    )
    monkeypatch.setenv("PIP_CONFIG_FILE", str(settings))
    with pytest.raises(modules.environment.Trouble, match=r"did not put sixth-sense==1\.0 into"):
        modules.environment.set_up()
    assert modules.environment.is_whole()  # the old one


def test_variables_that_mislead_pip_do_nothing(
    modules: SimpleNamespace, copied: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    listed(copied, make_wheel(tmp_path))
    listed(copied, f"seventh==1.0 ; python_version < '3' --hash=sha256:{64 * '0'}\n")
    (tmp_path / "constraints.txt").write_text("sixth-sense==2.0\n", "utf-8")
    for name in ("TARGET", "PREFIX", "ROOT"):
        monkeypatch.setenv(f"PIP_{name}", str(tmp_path / "elsewhere"))
    for name in ("DRY_RUN", "USER", "REQUIRE_HASHES", "QUIET"):
        monkeypatch.setenv(f"PIP_{name}", "1")
    monkeypatch.setenv("PIP_CONSTRAINT", str(tmp_path / "constraints.txt"))
    monkeypatch.setenv("PIP_PYTHON", sys.executable)
    monkeypatch.setenv("PIP_FIND_LINKS", str(tmp_path))
    modules.environment.set_up()
    assert any(copied.glob(".venv/**/sixth_sense.py"))
    assert not (tmp_path / "elsewhere").exists()


def test_python_may_keep_what_it_has_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTHONDONTWRITEBYTECODE", "1")
    assert "PYTHONDONTWRITEBYTECODE" not in load(ROOT).steps.surroundings()


def test_a_package_with_other_contents_is_not_installed(
    modules: SimpleNamespace, copied: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    listed(copied, make_wheel(tmp_path))
    with zipfile.ZipFile(tmp_path / "sixth_sense-1.0-py3-none-any.whl", "a") as wheel:
        wheel.writestr("more.py", "")
    monkeypatch.setenv("PIP_FIND_LINKS", str(tmp_path))
    with pytest.raises(modules.environment.Trouble, match=r"What came as sixth-sense==1\.0"):
        modules.environment.set_up()
    assert modules.environment.is_whole()


# ------------------------------------------------------------------ commands


@pytest.fixture
def checks(monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """The project's own lab.py; what it would run is noted, and all but mypy succeed."""
    lab, ran = load(ROOT).lab, []

    def run(*arguments: str) -> int:
        ran.append(list(arguments))
        return int("mypy" in arguments)

    monkeypatch.setattr(lab, "run", run)
    monkeypatch.setattr(lab, "set_up", lambda: None)
    return SimpleNamespace(lab=lab, ran=ran)


@pytest.mark.parametrize("configured", [True, False])
def test_test_checks_everything_and_ends_with_pytest(
    checks: SimpleNamespace,
    configured: bool,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    tool = {"importlinter": {}} if configured else {}
    monkeypatch.setattr(checks.lab, "project", lambda: {"tool": tool})
    assert checks.lab.main(["test"]) == 1
    assert [command[1] for command in checks.ran if command[0] == "-m"] == [
        "ruff",
        "mypy",
        "pytest",
    ]
    assert any("importlinter" in " ".join(command) for command in checks.ran) == configured
    assert checks.ran[-1][2:6] == ["-n", "2", "--dist", "loadgroup"]
    assert "--durations=10" in checks.ran[-1]
    assert re.fullmatch(r"mypy failed; \d+ min \d+ s in all\n", capsys.readouterr().out)


def test_test_quick_leaves_out_what_is_slow(checks: SimpleNamespace) -> None:
    checks.lab.main(["test", "--quick"])
    assert checks.ran[-1][-4:] == [
        "--hypothesis-profile=quick",
        "--ignore=tests/peers",
        "-m",
        "not browser and not kernel and not setup and not slow",
    ]
    assert checks.ran[0] == ["-m", "ruff", "check"]


def test_arguments_of_test_go_to_pytest_alone(checks: SimpleNamespace) -> None:
    assert checks.lab.main(["test", "tests/test_drift.py", "-x"]) == 0
    assert checks.lab.main(["test", "--quick", "-x"]) == 0
    assert checks.ran[0] == ["-m", "pytest", "tests/test_drift.py", "-x"]
    assert checks.ran[1][:2] == ["-m", "pytest"]
    assert checks.ran[1][2:] == [*checks.lab.QUICK, "-x"]


def test_the_benchmark_fetches_its_peers_and_goes_on_without(
    checks: SimpleNamespace, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    failing = checks.lab.run
    monkeypatch.setattr(checks.lab, "run", lambda *words: failing(*words) + int("pip" in words))
    assert checks.lab.main(["bench", "filter", "--repeats", "5"]) == 0
    fetched, measured = checks.ran
    peers = {"python-ins", "ahrs", "numpy-quaternion", "filterpy", "navtk"}
    assert peers <= {word.split()[0] for word in fetched}
    assert any(word.startswith("numpy==") for word in fetched)  # the pins stay
    assert measured == ["tests/benchmarks/bench.py", "filter", "--repeats", "5"]
    assert capsys.readouterr().out == "Going on without the packages to compare with.\n"


def test_peers_are_fetched_within_the_pins_and_asked(
    checks: SimpleNamespace, capsys: pytest.CaptureFixture[str]
) -> None:
    assert checks.lab.main(["peers"]) == 0
    *fetched, asked = checks.ran
    of_each = "python-ins", "distributed", "numba", "polars"
    for command, name in zip(fetched, of_each, strict=True):
        assert name in {word.split()[0] for word in command}
        assert any(word.startswith("numpy==") for word in command)  # the pins stay
    assert asked == ["-m", "pytest", "tests/peers"]
    assert capsys.readouterr().out == ""


def test_breaking_the_package_fetches_what_it_needs(checks: SimpleNamespace) -> None:
    assert checks.lab.main(["mutate", "core.earth", "--breaks", "5"]) == 0
    fetched, broken = checks.ran
    assert "coverage" in {word.split()[0] for word in fetched}
    assert broken == ["tests/mutations/mutate.py", "core.earth", "--breaks", "5"]


def test_test_leaves_out_the_peers(checks: SimpleNamespace) -> None:
    checks.lab.main(["test"])
    assert checks.ran[-1][-1] == "--ignore=tests/peers"


def test_a_lock_that_fails_leaves_environment_txt(
    checks: SimpleNamespace, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = (ROOT / "environment.txt").read_bytes()
    monkeypatch.setattr(checks.lab, "run", lambda *words: 2)
    with pytest.raises(checks.lab.Trouble, match=r"environment\.txt stays as it is"):
        checks.lab.main(["lock"])
    assert (ROOT / "environment.txt").read_bytes() == before


def test_a_lock_writes_packages_below_what_they_were_found_for(
    tiny: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    modules = load(tiny)
    (tiny / "environment.txt").write_text("", "utf-8")

    def resolve(*words: str) -> int:
        (tiny / words[-1]).write_text("numpy==2.0\n", "utf-8")
        return 0

    monkeypatch.setattr(modules.lab, "run", resolve)
    monkeypatch.setattr(modules.lab, "set_up", lambda: None)
    assert modules.lab.main(["lock"]) == 0
    assert modules.environment.pins() == ["numpy==2.0"]
    written = (tiny / "environment.txt").read_text("utf-8")
    assert written.startswith(modules.environment.lock_line())
    assert not (tiny / "environment.new").exists()


def test_a_lock_writes_the_oldest_packages_too(tiny: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    modules = load(tiny)
    with (tiny / "pyproject.toml").open("a", encoding="utf-8") as file:
        file.write('[project.optional-dependencies]\nbook = ["sympy >=1.13"]\n')

    def resolve(*words: str) -> int:
        found = "sympy==1.13\n" if "lowest-direct" in words else "sympy==1.14\n"
        (tiny / words[-1]).write_text(found, "utf-8")
        return 0

    monkeypatch.setattr(modules.lab, "run", resolve)
    monkeypatch.setattr(modules.lab, "set_up", lambda: None)
    assert modules.lab.main(["lock"]) == 0
    assert modules.environment.pins() == ["sympy==1.14"]
    lowest = (tiny / "bootstrap/lowest.txt").read_text("utf-8")
    assert lowest == modules.beside.LOWEST_HEAD + "sympy==1.13\n"
    assert not (tiny / "bootstrap/lowest.new").exists()


def test_a_lock_writes_what_the_site_needs_beside_that(
    tiny: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    modules = load(tiny)
    (tiny / "site").mkdir()
    with (tiny / "pyproject.toml").open("a", encoding="utf-8") as file:
        file.write('[project.optional-dependencies]\nsite = ["furo"]\n')
    pins = {"environment.new": "numpy==2.0 \\\n    --hash=sha256:ab\n"}
    pins["site/packages.new"] = (
        f"furo==1 ; sys_platform \\\n    --hash=sha256:cd\n{pins['environment.new']}"
    )

    def resolve(*words: str) -> int:
        (tiny / words[-1]).write_text(pins[Path(words[-1]).as_posix()], "utf-8")
        return 0

    monkeypatch.setattr(modules.lab, "run", resolve)
    monkeypatch.setattr(modules.lab, "set_up", lambda: None)
    assert modules.lab.main(["lock"]) == 0
    first, *rest = (tiny / "site/packages.txt").read_text("utf-8").splitlines()
    assert first.startswith("# ")
    assert rest == ["furo==1 ; sys_platform \\", "    --hash=sha256:cd"]
    assert not (tiny / "site/packages.new").exists()


def test_the_site_is_built_in_an_environment_that_sees_the_other(
    modules: SimpleNamespace, copied: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With no packages of its own; it is made once, and anew when its list changes."""
    made = []

    def make_venv(folder: Path) -> None:  # the pip that it sees is enough here
        made.append(folder)
        subprocess.run(
            [sys.executable, "-m", "venv", "--clear", "--without-pip", folder], check=True
        )

    monkeypatch.setattr(modules.beside, "make_venv", make_venv)
    (copied / "site").mkdir()
    wanted = copied / "site/packages.txt"
    wanted.write_text("", "utf-8")
    python = modules.beside.beside(wanted)
    show = [python, "-E", "-c", "import driftlab, sys; print(*driftlab.__path__, sys.prefix)"]
    told = subprocess.run(show, capture_output=True, encoding="utf-8", check=True).stdout
    assert told == f"{copied / 'src/driftlab'} {copied / '.venv-site'}\n"
    assert modules.beside.beside(wanted) == python
    assert len(made) == 1
    wanted.write_text("# another\n", "utf-8")
    assert modules.beside.beside(wanted) == python
    assert len(made) == 2


def test_the_paths_of_a_class_are_seen_from_where_the_caller_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lab = load(ROOT).lab
    globals_ = lab.COMMANDS["class"].__globals__
    asked: list[list[str]] = []

    @contextmanager
    def running(command: list[str]) -> Iterator[SimpleNamespace]:
        asked.append(command)
        yield SimpleNamespace(wait=lambda: 1)

    monkeypatch.setitem(globals_, "running", running)
    monkeypatch.setitem(globals_, "set_up", lambda: None)
    monkeypatch.chdir(tmp_path)
    assert lab.main(["class", "mine", "--roster", "names.csv"]) == 1
    here = Path.cwd()
    assert asked[0][-4:] == ["class", str(here / "mine"), "--roster", str(here / "names.csv")]
    lab.main(["class", "mine", "--roster=a.csv", "-oout", "--output=b=c"])
    assert asked[1][-3:] == [
        f"--roster={here / 'a.csv'}", f"-o{here / 'out'}", f"--output={here / 'b=c'}",
    ]  # fmt: skip
    with pytest.raises(globals_["Trouble"], match="Say what to read"):
        lab.main(["class"])


def test_the_oldest_packages_are_an_environment_of_their_own(
    modules: SimpleNamespace, copied: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Which sees nothing of the other, has the package, and is made anew when it asks for more."""
    steps: list[list[str]] = []
    made: list[Path] = []

    def make_venv(folder: Path) -> None:
        made.append(folder)
        (folder / modules.beside.BIN).mkdir(parents=True, exist_ok=True)
        (folder / modules.beside.BIN / modules.beside.PYTHON_NAME).touch()

    monkeypatch.setattr(modules.beside, "make_venv", make_venv)
    monkeypatch.setattr(modules.beside, "run_step", steps.append)
    listed = copied / "bootstrap/lowest.txt"
    listed.write_text("", "utf-8")
    python = modules.beside.apart(listed)
    assert modules.beside.apart(listed) == python
    assert made == [copied / ".venv-lowest"]
    assert not list(made[0].rglob("*.pth"))
    assert steps[0][-3:] == ["--require-hashes", "-r", str(listed)]
    assert steps[1][-2:] == ["--editable", "."]
    with (copied / "pyproject.toml").open("a", encoding="utf-8") as file:
        file.write("# other dependencies\n")
    modules.beside.apart(listed)
    assert len(made) == 2


def test_the_quick_tests_run_with_the_oldest_packages(
    checks: SimpleNamespace, monkeypatch: pytest.MonkeyPatch
) -> None:
    ran: list[list[str]] = []

    @contextmanager
    def running(command: list[str], env: dict[str, str]) -> Iterator[SimpleNamespace]:
        assert env["VIRTUAL_ENV"] == "there"
        assert not env["JUPYTER_PATH"].startswith(str(ROOT))
        ran.append(command)
        yield SimpleNamespace(wait=lambda: 1)

    monkeypatch.setattr(checks.lab, "apart", lambda listed: Path("there/bin/old"))
    monkeypatch.setattr(checks.lab, "running", running)
    assert checks.lab.main(["lowest"]) == 1
    assert checks.lab.main(["lowest", "tests/drift"]) == 1
    whole, chosen = ran
    assert whole[:3] == [str(Path("there/bin/old")), "-m", "pytest"]
    assert {*checks.lab.QUICK, *checks.lab.AT_ONCE} <= set(whole)
    assert chosen[-1] == "tests/drift"
    assert "loadgroup" not in chosen
    assert set(checks.lab.QUICK) <= set(chosen)


# ------------------------------------------------------------------ the whole book


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
    """It is even started twice at once, and all that can mislead it is there."""
    folder = copy_of_the_project(tmp_path / "Дрейф lab")
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

"""lab.py, run as a reader runs it: on a tiny project of its own and, once, on the whole book."""

import ast
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
import urllib.error
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest
from jupyter_client import BlockingKernelClient

ROOT = Path(__file__).resolve().parents[1]
NO_INDEX = {  # a port where nobody listens, whatever pip is configured to use otherwise
    "PIP_INDEX_URL": "http://127.0.0.1:9/simple",
    "PIP_EXTRA_INDEX_URL": "",
    "PIP_FIND_LINKS": "",
    "PIP_CONFIG_FILE": os.devnull,
}

# A project that lab.py can set up in seconds and without a network: no packages, and a build
# backend that makes by hand what flit makes of the real one.
TINY_PYPROJECT = """\
[build-system]
requires = []
build-backend = "backend"
backend-path = ["."]

[project]
name = "driftlab"
version = "0"
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


def load(path: Path) -> ModuleType:
    """Import a copy of lab.py."""
    spec = importlib.util.spec_from_file_location("lab", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


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
        timeout=300,
    )
    assert "Traceback" not in done.stderr, done.stderr
    return SimpleNamespace(code=done.returncode, said=done.stdout, complained=done.stderr.strip())


def make_tiny(folder: Path) -> Path:
    (folder / "src/driftlab").mkdir(parents=True)
    shutil.copy(ROOT / "lab.py", folder)
    (folder / "pyproject.toml").write_text(TINY_PYPROJECT, "utf-8")
    (folder / "backend.py").write_text(TINY_BACKEND, "utf-8")
    (folder / "src/driftlab/figures.py").write_text("print('figures drawn')\n", "utf-8")
    lab = load(folder / "lab.py")
    lab.write(lab.ENVIRONMENT, f"{lab.LOCK_HEADER}{lab.dependency_digest()}\n")
    return folder


@pytest.fixture
def tiny(tmp_path: Path) -> Path:
    """A tiny project that was never set up."""
    return make_tiny(tmp_path / "Übung 1")


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A tiny project that was set up once; tests leave it as they found it."""
    folder = make_tiny(tmp_path_factory.mktemp("finished") / "Übung 2")
    first = run(folder, "figures", **NO_INDEX)
    assert first.code == 0, first.complained
    assert "Setting up Drift Lab" in first.said
    assert "figures drawn" in first.said
    return folder


@pytest.fixture
def lab(tiny: Path) -> ModuleType:
    """lab.py as a module, at home in a tiny project."""
    return load(tiny / "lab.py")


# ------------------------------------------------------------------ sentences


def test_environment_txt_was_written_from_the_present_pyproject_toml() -> None:
    assert load(ROOT / "lab.py").lock_is_current(), "run 'python3 lab.py lock'"


def test_environment_txt_pins_every_package_and_names_no_index() -> None:
    lines = (ROOT / "environment.txt").read_text("utf-8").splitlines()
    packages = [line for line in lines if not line.startswith("#")]
    pin = re.compile(r"[a-z0-9-]+==[^ ]+( ; .+)?")
    assert [line for line in packages if not pin.fullmatch(line)] == []


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


def test_help_names_every_command(lab: ModuleType, capsys: pytest.CaptureFixture[str]) -> None:
    assert lab.main(["--help"]) == 0
    said = capsys.readouterr().out
    assert all(f"\n  {name} " in said for name in lab.COMMANDS)


def test_unknown_command(tiny: Path) -> None:
    done = run(tiny, "opne")
    assert done.code == 1
    assert done.complained == (
        'There is no command "opne"; there are open, test, figures, bench, lock.'
    )


@pytest.mark.parametrize(
    ("output", "start"),
    [
        ("OSError: [Errno 28] No space left on device", "The disk is full"),
        ("after connection broken by 'NewConnectionError(", "The package index cannot be reached"),
        ("Max retries exceeded with url: /simple", "The package index cannot be reached"),
        ("No matching distribution found for scipy==0.1", "The package index has no ready-made sc"),
        ("something new", "The set-up failed; "),
    ],
)
def test_what_pip_prints_becomes_a_sentence(lab: ModuleType, output: str, start: str) -> None:
    sentence = str(lab.diagnosis(output))
    assert sentence.startswith(start)
    assert "\n" not in sentence


def test_missing_environment_txt(tiny: Path) -> None:
    (tiny / "environment.txt").unlink()
    done = run(tiny, "figures")
    assert (done.code, done.said) == (1, "")
    assert done.complained.startswith("environment.txt is missing from ")


@pytest.mark.skipif(os.name == "nt", reason="Windows separates paths with ;")
def test_a_folder_that_venv_refuses(tiny: Path) -> None:
    refused = tiny.rename(tiny.with_name(f"a{os.pathsep}b"))
    done = run(refused, "figures")
    assert done.code == 1
    assert done.complained.startswith('Python cannot work in a folder with ":" in its name')


def test_a_python_without_ensurepip(lab: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(lab.Trouble, match=r"sudo apt install python3\.\d+-venv"):
        lab.make_venv(lab.VENV)


@pytest.mark.parametrize(
    ("error", "sentence"),
    [
        (PermissionError(13, "Permission denied", "here"), "here cannot be written"),
        (OSError(28, "No space left on device"), "The disk is full"),
    ],
)
def test_writing_fails(lab: ModuleType, error: OSError, sentence: str) -> None:
    with pytest.raises(lab.Trouble, match=sentence), lab.alone():
        raise error


def test_a_port_in_use(tiny: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        done = run(tiny, "--no-browser", "--port", str(port))
    assert done.code == 1
    assert done.complained.startswith(f"Port {port} cannot be had")


# ------------------------------------------------------------------ set-up


def test_a_second_start_calls_no_pip(finished: Path) -> None:
    log = finished / ".setup.log"
    before = log.stat().st_mtime_ns
    again = run(finished, "figures", **NO_INDEX)
    assert (again.code, again.said.strip()) == (0, "figures drawn")
    assert log.stat().st_mtime_ns == before


def test_a_stale_environment_txt_is_mentioned_and_used(tiny: Path) -> None:
    with (tiny / "pyproject.toml").open("a", encoding="utf-8") as file:
        file.write('dependencies = ["numpy"]\n')
    done = run(tiny, "figures", **NO_INDEX)
    assert done.said.startswith("environment.txt is older than pyproject.toml; run ")
    assert "figures drawn" in done.said


def test_without_network_the_old_environment_stays(finished: Path) -> None:
    environment = finished / "environment.txt"
    before = environment.read_text("utf-8")
    try:
        environment.write_text(before + "sixth-sense==1.0\n", "utf-8")
        failed = run(finished, "figures", **NO_INDEX)
    finally:
        environment.write_text(before, "utf-8")
    assert failed.code == 1
    assert failed.said.startswith("The project has changed since the last set-up; updating")
    assert failed.complained.startswith("The package index cannot be reached: ")
    assert "\n" not in failed.complained
    assert run(finished, "figures", **NO_INDEX).said.strip() == "figures drawn"


@pytest.mark.parametrize("wish", ["bench", "test"])
def test_what_lies_aside_may_be_missing(tiny: Path, wish: str) -> None:
    lists = {
        "bench": tiny / "tests/benchmarks/peers.txt",
        "test": tiny / "tests/browser/driver.txt",
    }
    for path in lists.values():
        path.parent.mkdir(parents=True)
        path.write_text("", "utf-8")
    (tiny / "tests/benchmarks/bench.py").write_text("print('measured')\n", "utf-8")
    lists[wish].write_text("sixth-sense==1.0\n", "utf-8")
    done = run(tiny, wish, **NO_INDEX)
    assert re.search(r"Going on without .*\. The package index cannot be reached", done.said)
    went_on = "measured" if wish == "bench" else "No module named pytest"
    assert went_on in done.said + done.complained

    lists[wish].write_text("", "utf-8")
    assert "Fetching" in run(tiny, wish, **NO_INDEX).said
    assert "Fetching" not in run(tiny, wish, **NO_INDEX).said


@pytest.mark.parametrize("listing", ["tests/benchmarks/peers.txt", "tests/browser/driver.txt"])
def test_what_lies_aside_is_pinned_and_none_of_the_environment_s(listing: str) -> None:
    pins = [
        {line.split("==")[0] for line in path.read_text("utf-8").splitlines() if line[:1] != "#"}
        for path in (ROOT / listing, ROOT / "environment.txt")
    ]
    text = (ROOT / listing).read_text("utf-8")
    assert all("==" in line for line in text.splitlines() if line[:1] != "#")
    assert pins[0].isdisjoint(pins[1])


def test_a_moved_project_is_set_up_afresh(finished: Path, tmp_path: Path) -> None:
    moved = shutil.copytree(finished, tmp_path / "moved", symlinks=True)
    done = run(moved, "figures", **NO_INDEX)
    assert done.said.startswith("The project folder has moved; building its environment afresh.")
    assert "figures drawn" in done.said


@pytest.mark.parametrize(
    ("found", "sentence"),
    [
        ({}, "The last set-up did not finish"),
        ({"folder": "elsewhere"}, "The project folder has moved"),
        ({"python": "CPython 3.1"}, "Building the environment afresh, now for "),
        ({"environment": "older"}, "The environment's Python no longer runs"),
    ],
)
def test_reasons_to_start_afresh(lab: ModuleType, found: dict[str, str], sentence: str) -> None:
    lab.VENV.mkdir()  # it holds no Python at all
    wanted = lab.wanted_stamp()
    assert lab.reason_to_start_afresh(found and wanted | found, wanted).startswith(sentence)


def test_an_interrupted_update_does_not_count_as_finished(
    lab: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    lab.write(lab.STAMP, json.dumps(lab.wanted_stamp() | {"environment": "older"}))
    monkeypatch.setattr(lab, "reason_to_start_afresh", lambda found, wanted: "")
    monkeypatch.setattr(lab, "install_packages", lambda: signal.raise_signal(signal.SIGINT))
    with pytest.raises(KeyboardInterrupt):
        lab.set_up()
    assert lab.read_stamp() == {}


def test_a_killed_set_up_heals(tiny: Path) -> None:
    with subprocess.Popen(command(tiny, "figures"), stdout=subprocess.PIPE) as process:
        while not (tiny / ".venv/pyvenv.cfg").exists():
            assert process.poll() is None
        process.kill()
    assert not (tiny / ".venv/driftlab.json").exists()
    done = run(tiny, "figures", **NO_INDEX)
    assert "The last set-up did not finish; starting it afresh." in done.said
    assert "figures drawn" in done.said


def test_of_two_starts_one_sets_up_and_one_waits(tiny: Path) -> None:
    outputs = []
    threads = [
        threading.Thread(target=lambda: outputs.append(run(tiny, "figures", **NO_INDEX).said))
        for _ in range(2)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    said = "".join(outputs)
    assert said.count("Setting up Drift Lab") == 1
    assert said.count("Another start of Drift Lab is setting up this folder") == 1
    assert said.count("figures drawn") == 2


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
def opened(folder: Path, **variables: str) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """Run ``lab.py --no-browser`` until the address appears; yield the process and the address."""
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
            said = ""
            for line in process.stdout:
                said += line
                if "Ctrl-C stops it" in line:
                    break
            if "package index cannot be reached" in said and "CI" not in os.environ:
                pytest.skip("the package index cannot be reached")
            address = re.search(r"http://127\.0\.0\.1:\d+/\S+", said)
            assert address, said
            yield process, address[0]
        finally:
            too_long.cancel()
            process.terminate()


def ask(url: str, token: str = "", method: str = "GET") -> object:
    """Return what the server answers."""
    headers = {"Authorization": f"token {token}"} if token else {}
    request = urllib.request.Request(url, headers=headers, method=method)
    direct = urllib.request.build_opener(urllib.request.ProxyHandler({}))
    with direct.open(request, timeout=60) as answer:
        return json.load(answer)


def test_the_book_opens_on_a_machine_that_never_saw_it(tmp_path: Path) -> None:
    folder = copy_of_the_project(tmp_path / "Дрейф lab")
    config = tmp_path / "config"
    config.mkdir()
    misleading = tmp_path / "misleading"
    misleading.mkdir()
    (misleading / "jupyterlab.py").write_text("1 / 0\n", "utf-8")
    careless = "c.IdentityProvider.token = ''\nc.ServerApp.ip = '0.0.0.0'\nc.ServerApp.port = 1\n"
    (config / "jupyter_server_config.py").write_text(careless, "utf-8")
    variables = {
        "JUPYTER_CONFIG_DIR": str(config),
        "JUPYTER_RUNTIME_DIR": str(tmp_path / "runtime"),
        "IPYTHONDIR": str(tmp_path / "ipython"),
        "PYTHONPATH": str(misleading),
    }
    with opened(folder, **variables) as (process, address):
        base, token = re.fullmatch(
            r"(http://127\.0\.0\.1:\d+)/lab/tree/notebooks/00_start_here\.ipynb\?token=(\w{48})",
            address,
        ).groups()

        with pytest.raises(urllib.error.HTTPError, match="403") as refusal:
            ask(f"{base}/api/contents")
        refusal.value.close()
        with pytest.raises(OSError):  # noqa: PT011 - refused or without a route, by system
            socket.create_connection(("127.0.0.2", int(base.rpartition(":")[2])), timeout=5)

        notebook = ask(f"{base}/api/contents/notebooks/00_start_here.ipynb", token)
        assert notebook["content"]["cells"]
        assert notebook["writable"]

        kernel = ask(f"{base}/api/kernels", token, "POST")
        path = path_of_the_package(tmp_path / f"runtime/kernel-{kernel['id']}.json")
        assert path == folder / "src/driftlab/__init__.py"

        if os.name != "nt":  # Windows has no way to send Ctrl-C from here
            os.killpg(process.pid, signal.SIGINT)
            last = process.stdout.read()
            assert process.wait(30) == 0
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

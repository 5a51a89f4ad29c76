"""JupyterLab is private, keeps its files in the project's folder, and ends with lab.py."""

import json
import os
import signal
import socket
import subprocess
import sys
import urllib.request
from pathlib import Path

import pytest
from jupyter_client import BlockingKernelClient
from tiny_project import comes_true, command, is_alive, load, make_tiny, run

# It opens the project with the Python of the tests, whose JupyterLab is a real one.
OPEN = """
import sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
from bootstrap import server, steps
server.PYTHON = Path(sys.executable)
steps.catch_signals()
server.serve("notebooks/00_start_here.ipynb", 0, browser=False)
"""
# It leaves the number of its process and waits for a stop, as JupyterLab does.
WAITING_JUPYTERLAB = """
def start():
    import os, signal, time
    signal.signal(signal.SIGTERM, lambda *_: (print("in order", flush=True), os._exit(0)))
    with open("number.new", "w") as file:
        file.write(str(os.getpid()))
    os.rename("number.new", "number")
    time.sleep(600)

LabApp.start = start
"""
IN_A_KERNEL = """
import IPython, matplotlib
get_ipython().run_line_magic("save", "-a history.new 1")
places = [IPython.paths.get_ipython_dir(), matplotlib.get_configdir(), matplotlib.get_cachedir()]
"""


def ask(url: str, method: str = "GET", content: object = None) -> object:
    request = urllib.request.Request(url, method=method, data=json.dumps(content).encode())
    direct = urllib.request.build_opener(urllib.request.ProxyHandler({}))
    with direct.open(request, timeout=60) as answer:
        return json.load(answer)


def places_of_a_kernel(connection_file: Path) -> list[str]:
    client = BlockingKernelClient()
    client.load_connection_file(str(connection_file))
    client.start_channels()
    try:
        reply = client.execute(
            IN_A_KERNEL, user_expressions={"places": "'|'.join(places)"}, reply=True, timeout=120
        )["content"]
    finally:
        client.stop_channels()
    assert reply["status"] == "ok", reply
    return reply["user_expressions"]["places"]["data"]["text/plain"].strip("'").split("|")


def seen_by_others(token: str) -> list[str]:
    """The command lines, and of kernels the environments too, that have the token."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            line = (process / "cmdline").read_text("utf-8", "replace")
            around = (process / "environ").read_text("utf-8", "replace")
        except OSError:
            continue  # it has ended, or is of another user
        if token in line or ("ipykernel" in line and token in around):
            found.append(line)
    return found


@pytest.mark.kernel
@pytest.mark.skipif(os.name == "nt", reason="SIGKILL is not of Windows")
@pytest.mark.filterwarnings("ignore::ResourceWarning", "ignore::DeprecationWarning")
@pytest.mark.parametrize("there_is_a_home", [True, False])
def test_home_stays_empty_and_a_killed_lab_py_takes_jupyterlab_along(
    tmp_path: Path, there_is_a_home: bool
) -> None:
    """A notebook is opened and saved, and a kernel runs; nobody else gets at them."""
    folder, home = make_tiny(tmp_path / "book"), tmp_path / "home"
    if there_is_a_home:
        home.mkdir()
    else:
        home.write_text("a file, so that there can be none", "utf-8")
    places = ("JUPYTER", "XDG_", "IPYTHONDIR", "MPLCONFIGDIR")
    environment = {name: value for name, value in os.environ.items() if not name.startswith(places)}
    environment["HOME"] = str(home)
    call = [sys.executable, "-c", OPEN, str(folder)]
    with subprocess.Popen(call, env=environment, stdout=subprocess.PIPE, text=True) as process:
        try:
            said = next(line.strip() for line in process.stdout if "token=" in line)
            address, token = said.partition("/lab/")[0], said.rpartition("?")[2]
            chapter = f"{address}/api/contents/notebooks/00_start_here.ipynb?{token}"
            notebook = {"type": "notebook", "content": ask(chapter)["content"]}
            ask(chapter, "PUT", notebook)
            kernel = ask(f"{address}/api/kernels?{token}", "POST", {})
            runtime = folder / ".jupyter/runtime"
            places = places_of_a_kernel(runtime / f"kernel-{kernel['id']}.json")
            (running,) = runtime.glob("jpserver-*.json")
            assert not (runtime / "jupyter_cookie_secret").exists(), "it is new at each start"
            server = json.loads(running.read_text("utf-8"))["pid"]
            assert seen_by_others(token.partition("=")[2]) == []
            with pytest.raises(OSError):  # noqa: PT011 - refused or without a route, by system
                socket.create_connection(("127.0.0.2", int(address.rpartition(":")[2])), timeout=5)
        finally:
            process.kill()
        assert comes_true(lambda: not is_alive(server))
    assert not running.exists(), "JupyterLab did not end in order"
    assert not there_is_a_home or [*home.iterdir()] == []
    assert {Path(place).parent for place in places} == {folder / ".jupyter"}
    assert (folder / ".jupyter/data/nbsignatures.db").exists()


def test_places_that_the_user_has_set_stay(tiny: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    places = load(tiny).server
    for name in places.PLACES:
        monkeypatch.delenv(name, raising=False)
    expected = {
        name: str(tiny / ".jupyter" / folder)
        for name, folder in places.PLACES.items()
        if os.name != "nt" or name not in places.SECRET
    }
    assert places.own_places() == expected
    monkeypatch.setenv("IPYTHONDIR", "mine")
    assert places.own_places().keys() == expected.keys() - {"IPYTHONDIR"}


@pytest.mark.skipif(os.name == "nt", reason="Windows has other rights")
def test_keys_lie_in_no_folder_that_others_can_read(
    tiny: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As on a stick, where rights cannot be changed; or the folder is another user's."""
    places = load(tiny).server
    places.OWN.mkdir(mode=0o755)
    assert places.own_places() != {}
    assert places.OWN.stat().st_mode & 0o777 == 0o700
    with monkeypatch.context() as other:
        other.setattr(os, "geteuid", lambda: places.OWN.stat().st_uid + 1)
        assert places.own_places() == {}
    places.OWN.chmod(0o755)
    monkeypatch.setattr(Path, "chmod", lambda path, mode: None)
    assert places.own_places() == {}


@pytest.mark.setup
@pytest.mark.skipif(os.name == "nt", reason="a console of Windows ends it")
@pytest.mark.parametrize("end", ["SIGTERM", "SIGHUP"])
def test_jupyterlab_ends_in_order(copied: Path, end: str) -> None:
    with (copied / "src/jupyterlab/labapp.py").open("a", encoding="utf-8") as file:
        file.write(WAITING_JUPYTERLAB)
    call = command(copied, "--no-browser")
    with subprocess.Popen(call, stdout=subprocess.PIPE, encoding="utf-8") as process:
        assert comes_true((copied / "number").exists)
        server = int((copied / "number").read_text("utf-8"))
        process.send_signal(getattr(signal, end))
        assert comes_true(lambda: not is_alive(server), 20)
        assert "in order" in process.stdout.read()


def test_what_jupyterlab_cannot_write_is_named(copied: Path) -> None:
    (copied / "nowhere").write_text("", "utf-8")
    done = run(copied, "open", "--no-browser", JUPYTER_RUNTIME_DIR=str(copied / "nowhere"))
    assert done.code == 1
    assert "nowhere" in done.complained
    assert len(done.complained.splitlines()) == 2


def test_a_port_in_use(tiny: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        done = run(tiny, "--no-browser", "--port", str(port))
    assert done.code == 1
    assert done.complained.startswith(f"Port {port} cannot be had")

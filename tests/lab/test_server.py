"""JupyterLab is private, keeps its files in the project's folder, and ends in order."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from tiny_project import ROOT, ask, load, refuses, run, told_by_a_kernel

IN_A_KERNEL = """
import IPython, matplotlib
get_ipython().run_line_magic("save", "-a history.new 1")
places = [IPython.paths.get_ipython_dir(), matplotlib.get_configdir(), matplotlib.get_cachedir()]
"""


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
@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGHUP")
@pytest.mark.filterwarnings("ignore::ResourceWarning", "ignore::DeprecationWarning")
def test_home_stays_empty_and_nobody_else_gets_in(tiny: Path, tmp_path: Path) -> None:
    """A notebook is opened and saved, a kernel runs, and the terminal is closed."""
    (tmp_path / "home").mkdir()
    places = ("JUPYTER", "XDG_", "IPYTHONDIR", "MPLCONFIGDIR")
    environment = {name: value for name, value in os.environ.items() if not name.startswith(places)}
    environment["HOME"] = str(tmp_path / "home")
    call = [sys.executable, "-P", tiny / "bootstrap/server.py", f"--ServerApp.root_dir={tiny}"]
    call += ["--ServerApp.open_browser=False", "--ServerApp.port=0"]
    options = {"env": environment, "cwd": tiny, "stdout": subprocess.PIPE, "text": True}
    with subprocess.Popen(call, **options) as process:
        try:
            said = next(line.strip() for line in process.stdout if "token=" in line)
            address, token = said.partition("/lab?")[0], said.rpartition("?")[2]
            chapter = f"{address}/api/contents/notebooks/00_start_here.ipynb?{token}"
            notebook = {"type": "notebook", "content": ask(chapter)["content"]}
            ask(chapter, "PUT", notebook)
            kernel = ask(f"{address}/api/kernels?{token}", "POST", {})
            runtime = tiny / ".jupyter/runtime"
            connection = runtime / f"kernel-{kernel['id']}.json"
            places = told_by_a_kernel(connection, IN_A_KERNEL, "'|'.join(places)").split("|")
            (running,) = runtime.glob("jpserver-*.json")
            assert not (runtime / "jupyter_cookie_secret").exists(), "it is new at each start"
            assert seen_by_others(token.partition("=")[2]) == []
            assert refuses("127.0.0.2", address.rpartition(":")[2])
        finally:
            process.send_signal(signal.SIGHUP)
            last = process.stdout.read()
    assert process.returncode == 0
    assert "Stopping ..." in last
    assert not running.exists(), "JupyterLab did not end in order"
    assert [*(tmp_path / "home").iterdir()] == []
    assert {Path(place).parent for place in places} == {tiny / ".jupyter"}
    assert (tiny / ".jupyter/data/nbsignatures.db").exists()


@pytest.mark.skipif(os.name == "nt", reason="Windows has other rights")
def test_files_lie_in_the_project_where_nobody_else_can_read_them(
    tiny: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """But those that the user keeps elsewhere; all are in HOME if others could read them."""
    server = load(tiny).server
    for name in server.PLACES:
        monkeypatch.delenv(name, raising=False)
    expected = {name: str(tiny / ".jupyter" / place) for name, place in server.PLACES.items()}
    assert server.own_places() == expected
    assert server.OWN.stat().st_mode & 0o777 == 0o700
    monkeypatch.setenv("IPYTHONDIR", "mine")
    assert server.own_places().keys() == expected.keys() - {"IPYTHONDIR"}
    with monkeypatch.context() as other:
        other.setattr(os, "geteuid", lambda: server.OWN.stat().st_uid + 1)
        assert server.own_places() == {}
    server.OWN.chmod(0o755)
    assert server.own_places() == {}


def test_what_jupyterlab_cannot_write_is_named(finished: Path) -> None:
    nowhere = str(ROOT / "lab.py/nowhere")
    done = run(finished, "open", "--no-browser", JUPYTER_RUNTIME_DIR=nowhere)
    assert done.code == 1
    assert done.complained.startswith("JupyterLab cannot start: ")
    assert "nowhere" in done.complained
    assert len(done.complained.splitlines()) == 1

"""Mirrors that are set for pip are used; nothing else that a user has set misleads a set-up."""

import http.server
import os
import re
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from tiny_project import WITH_UV, listed, load, make_wheel, run, sense

pytestmark = pytest.mark.xdist_group("lab")
TOOLS = pytest.mark.parametrize("path", [WITH_UV, ""], ids=["uv", "pip"])


@contextmanager
def index(folder: Path, status: int = 200, page: str = "") -> Iterator[str]:
    """Serve a package index with sixth-sense alone, or one page; give its address."""

    class Index(http.server.SimpleHTTPRequestHandler):
        def do_GET(self) -> None:
            if self.path.endswith(".whl"):
                return super().do_GET()
            name = "sixth_sense-1.0-py3-none-any.whl"
            text = page or f'<!DOCTYPE html><a href="/{name}">{name}</a>'
            self.send_response(status)
            self.send_header("Content-Type", "text/html")
            self.send_header("Content-Length", str(len(text)))
            self.end_headers()
            return self.wfile.write(text.encode())

        def log_message(self, *_: object) -> None:
            pass

    def handler(*arguments: object) -> Index:
        return Index(*arguments, directory=str(folder))

    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/simple"
        server.shutdown()


@pytest.mark.setup
@pytest.mark.parametrize(
    ("way", "path"),
    [("file", WITH_UV), ("file", ""), *((way, WITH_UV) for way in ("variable", "extra", "folder"))],
)
def test_a_mirror_that_is_set_for_pip_is_used(
    tiny: Path, tmp_path: Path, path: str, way: str
) -> None:
    listed(tiny, make_wheel(tmp_path))
    with index(tmp_path) as url:
        pip_conf = tmp_path / "pip.conf"
        pip_conf.write_text(f"[global]\nindex-url = {url}\n", "utf-8")
        settings = {
            "file": {"PIP_CONFIG_FILE": str(pip_conf), "PIP_INDEX_URL": None},
            "variable": {"PIP_INDEX_URL": url},
            "extra": {"PIP_EXTRA_INDEX_URL": url},
            "folder": {"PIP_FIND_LINKS": tmp_path.as_uri(), "PIP_NO_INDEX": "1"},
        }[way]
        direct = {"NO_PROXY": "127.0.0.1", "no_proxy": "127.0.0.1"}
        if way == "extra":  # where nobody listens uv stops
            settings["PIP_INDEX_URL"] = url.replace("simple", "other")
        done = run(tiny, "figures", PATH=path, **direct, **settings)
    assert (done.code, done.complained) == (0, "")
    assert "uv could not" not in done.said
    assert sense(tiny)


@pytest.mark.setup
@TOOLS
def test_settings_that_mislead_pip_and_uv_do_nothing(tiny: Path, tmp_path: Path, path: str) -> None:
    listed(tiny, make_wheel(tmp_path))
    (tmp_path / "constraints.txt").write_text("sixth-sense==2.0\n", "utf-8")
    (tmp_path / "uv.toml").write_text("offline = true\n[pip]\ntarget = 'there'\n", "utf-8")
    elsewhere = str(tmp_path / "elsewhere")
    pip_conf = f"[install]\ntarget = {elsewhere}\n[global]\nconstraint = {tmp_path}/constraints.txt"
    (tmp_path / "pip.conf").write_text(pip_conf, "utf-8")
    misleading = {
        **dict.fromkeys(("PIP_TARGET", "PIP_PREFIX", "PIP_ROOT", "UV_TARGET"), elsewhere),
        **dict.fromkeys(("PIP_DRY_RUN", "PIP_USER", "PIP_QUIET", "PIP_REQUIRE_VIRTUALENV"), "1"),
        **dict.fromkeys(("UV_OFFLINE", "UV_SYSTEM_PYTHON", "UV_MANAGED_PYTHON"), "1"),
        "PIP_CONSTRAINT": str(tmp_path / "constraints.txt"),
        "UV_CONSTRAINT": str(tmp_path / "constraints.txt"),
        "PIP_PYTHON": sys.executable,
        "UV_PYTHON": "3.5",
        "UV_PROJECT_ENVIRONMENT": elsewhere,
        "UV_CONFIG_FILE": str(tmp_path / "uv.toml"),
        "PIP_CONFIG_FILE": str(tmp_path / "pip.conf"),
        "PIP_FIND_LINKS": tmp_path.as_uri(),
        "PIP_NO_INDEX": "1",
    }
    done = run(tiny, "figures", PATH=path, **misleading)
    assert (done.code, done.complained) == (0, "")
    assert "uv could not" not in done.said
    assert sense(tiny)
    assert not Path(elsewhere).exists()


@pytest.mark.setup
def test_where_uv_cannot_work_pip_does(tiny: Path) -> None:
    tiny.joinpath("bin").mkdir()
    uv = tiny / "bin/uv"
    uv.write_text("#!/bin/sh\n[ $1 = --version ] && echo uv 0.5.0 || exit 2\n", "utf-8")
    uv.chmod(0o755)
    done = run(tiny, "figures", PATH=f"{tiny}/bin{os.pathsep}/bin")
    assert (done.code, done.complained) == (0, "")
    assert "uv could not do it; pip tries, which takes longer.\n" in done.said
    assert done.said.endswith("figures drawn\n")


@pytest.mark.setup
def test_variables_of_strangers_do_nothing(tiny: Path, tmp_path: Path) -> None:
    """Of an environment that is active, of other packages; no HOME and no programs."""
    for name in ("driftlab", "jupyterlab", "pip", "zmq"):
        (tmp_path / f"{name}.py").write_text("raise SystemExit('a stranger')\n", "utf-8")
    misleading: dict[str, str | None] = {
        **dict.fromkeys(("PYTHONPATH", "VIRTUAL_ENV", "CONDA_PREFIX"), str(tmp_path)),
        "PYTHONHOME": sys.base_prefix,
        "HOME": None,
        "USERPROFILE": None,
        "PATH": "",
    }
    done = run(tiny, "figures", **misleading)
    assert (done.code, done.complained) == (0, "")
    assert done.said.endswith("figures drawn\n")
    done = run(tiny, "--no-browser", HOME=str(tiny / "lab.py/home"), XDG_CACHE_HOME=None)
    assert (done.code, done.complained) == (0, "")
    settings = (tiny / ".venv/pyvenv.cfg").read_text("utf-8")
    home = dict(re.findall(r"^([\w-]+) = (.*)$", settings, re.M))["home"]
    if sys.prefix != sys.base_prefix:  # when the tests' environment goes, the book's stays
        assert not Path(home).is_relative_to(sys.prefix)


@pytest.mark.setup
@pytest.mark.parametrize(
    ("status", "page", "start"),
    [
        (200, "<html>Please log in</html>", "The package index has no ready-made sixth-sense==1"),
        (401, "-", 'The package index answers "401 Unauthorized"'),
        (404, "-", "The package index has no ready-made sixth-sense==1.0 for this computer"),
    ],
)
def test_an_index_that_fails_is_told_in_a_sentence(
    tiny: Path, tmp_path: Path, status: int, page: str, start: str
) -> None:
    listed(tiny, make_wheel(tmp_path))
    with index(tmp_path, status, page) as url:
        done = run(tiny, "figures", PIP_INDEX_URL=url, NO_PROXY="127.0.0.1", PIP_NO_CACHE_DIR="1")
    assert done.code == 1
    assert done.complained.startswith(start)
    assert done.complained.count("\n") == 0


def test_what_lab_py_starts_belongs_to_its_own_environment(
    tiny: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("PYTHONPATH", "PYTHONHOME", "VIRTUAL_ENV", "PYTHONDONTWRITEBYTECODE"):
        monkeypatch.setenv(name, "strange")
    monkeypatch.setenv("PATH", "")
    steps = load(tiny).steps
    around = steps.surroundings()
    assert not {"PYTHONPATH", "PYTHONHOME", "PYTHONDONTWRITEBYTECODE"} & around.keys()
    assert around["VIRTUAL_ENV"] == str(tiny / ".venv")
    assert around["PATH"] == str(tiny / ".venv" / steps.BIN)

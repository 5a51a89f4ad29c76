"""Mirrors that are set for pip are used; nothing else that a user has set misleads a set-up."""

import http.server
import os
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

import pytest
from tiny_project import listed, load, make_wheel, run, sense

DIRECT = {"NO_PROXY": "127.0.0.1", "no_proxy": "127.0.0.1"}


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


def test_a_mirror_that_is_set_for_pip_is_used_and_what_misleads_is_not(
    either: SimpleNamespace, tmp_path: Path
) -> None:
    listed(either.folder, make_wheel(tmp_path))
    (tmp_path / "constraints.txt").write_text("sixth-sense==2.0\n", "utf-8")
    (tmp_path / "uv.toml").write_text("offline = true\n[pip]\ntarget = 'there'\n", "utf-8")
    elsewhere = str(tmp_path / "elsewhere")
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
        "PIP_INDEX_URL": None,
    }
    with index(tmp_path) as url:
        pip_conf = f"[global]\nindex-url = {url}\nconstraint = {tmp_path}/constraints.txt\n"
        pip_conf += f"[install]\ntarget = {elsewhere}\n"
        (tmp_path / "pip.conf").write_text(pip_conf, "utf-8")
        done = run(either.folder, "figures", **either.programs, **DIRECT, **misleading)
    assert (done.code, done.complained) == (0, "")
    assert sense(either.folder)
    assert not Path(elsewhere).exists()


def test_both_installers_are_told_what_is_set_for_pip(
    tiny: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of files and variables, which count more; uv is told in its own words."""
    for name in [name for name in os.environ if name.startswith(("PIP_", "UV_", "SSL_"))]:
        monkeypatch.delenv(name)
    (tmp_path / "pip.conf").write_text(
        "[global]\ncert = here.pem\nindex-url = https://a/simple\nretries = 9\n"
        "[install]\nfind-links =\n  https://c\n  wheels\n",
        "utf-8",
    )
    monkeypatch.setenv("PIP_CONFIG_FILE", str(tmp_path / "pip.conf"))
    monkeypatch.setenv("PIP_INDEX_URL", "https://b/simple")
    monkeypatch.setenv("PIP_TRUSTED_HOST", "b")
    monkeypatch.setenv("UV_INDEX", "https://mine/simple")
    monkeypatch.setenv("UV_LINK_MODE", "symlink")
    told = load(tiny).installer.variables()
    assert told["PIP_INDEX_URL"] == told["UV_DEFAULT_INDEX"] == "https://b/simple"
    assert told["PIP_CERT"] == told["SSL_CERT_FILE"] == "here.pem"
    assert told["PIP_TRUSTED_HOST"] == told["UV_INSECURE_HOST"] == "b"
    assert told["PIP_FIND_LINKS"].split() == told["UV_FIND_LINKS"].split(",")
    assert told["UV_INDEX"] == "https://mine/simple"
    assert told["PIP_RETRIES"] == "2"
    (tmp_path / "two words").mkdir()
    monkeypatch.setenv("PIP_FIND_LINKS", str(tmp_path / "two words"))
    assert load(tiny).installer.variables()["UV_FIND_LINKS"].endswith("/two%20words")
    assert told["PIP_CONFIG_FILE"] == os.devnull
    assert told.get("UV_LINK_MODE") != "symlink"


def test_a_page_that_asks_to_log_in_is_told_in_a_sentence(tiny: Path, tmp_path: Path) -> None:
    listed(tiny, make_wheel(tmp_path))
    with index(tmp_path, page="<html>Please log in</html>") as url:
        done = run(tiny, "figures", PIP_INDEX_URL=url, **DIRECT)
    assert done.code == 1
    assert done.complained.startswith("The package index has no ready-made sixth-sense==1.0")
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

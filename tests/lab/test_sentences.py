"""What goes wrong is told in one sentence."""

import http.server
import importlib
import importlib.util
import os
import socket
import sys
import threading
from pathlib import Path

import pytest
from tiny_project import NO_INDEX, ROOT, load, run


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

"""What goes wrong is told in one sentence, whoever reads it, on whatever Python."""

import ast
import contextlib
import os
import subprocess
import sys
from pathlib import Path

import pytest
from tiny_project import ROOT, load, make_tiny, run

FULL = "The disk is full: free some space (a set-up takes up to 2 GB) and run this again."
WRITABLE = "cannot be written: make the project folder writable"


@pytest.mark.parametrize(
    ("output", "start"),
    [
        ("OSError: [Errno 28] No space left on device", "The disk is full"),
        ("failed to write: No space left on device (os error 28)", "The disk is full"),
        ("after connection broken by 'NewConnectionError(", "The package index cannot be reached"),
        ("Max retries exceeded with url: /simple", "The package index cannot be reached"),
        ("error sending request for url", "The package index cannot be reached"),
        ("[SSL: CERTIFICATE_VERIFY_FAILED] certificate is not yet valid", "The certificate of the "
         "package index is not valid today: check the date"),
        ("invalid peer certificate: NotValidYet", "The certificate of the package index is not v"),
        ("[SSL: CERTIFICATE_VERIFY_FAILED] self-signed", "The certificate of the package index is "
         "not trusted"),
        ("invalid peer certificate: UnknownIssuer", "The certificate of the package index is"),
        ("403 Client Error: Forbidden for url: x", 'The package index answers "403 Client Error'),
        ("status client error (403 Forbidden) for", 'The package index answers "403 Forbidden"'),
        ("DO NOT MATCH THE HASHES FROM.\n    six==1 from x", "The package six==1 differs from"),
        ("Hash mismatch for `six==1`", "The package six==1 differs from its entry"),
        ("registry and you require six==1, we can conclude", "The package index has no ready-made "
         "six==1 for this computer"),
        ("No matching distribution found for six==1", "The package index has no ready-made six==1"),
        ("index (http://a) returned a 403 Forbidden", 'The package index answers "403 For'),
        ("something new", "The set-up failed; "),
    ],
)  # fmt: skip
def test_what_uv_and_pip_print_becomes_a_sentence(output: str, start: str) -> None:
    sentence = str(load(ROOT).steps.diagnosis(output))
    assert sentence.startswith(start)
    assert "\n" not in sentence


def test_unknown_command(tiny: Path) -> None:
    done = run(tiny, "opne", PYTHONSAFEPATH="1")
    assert done.code == 1
    assert done.complained.startswith('There is no command "opne"; there are open, fresh, test, ')


@pytest.mark.parametrize("name", ["environment.txt", "pyproject.toml"])
def test_a_lost_file(tiny: Path, name: str) -> None:
    (tiny / name).unlink()
    environment = load(tiny).environment
    with pytest.raises(environment.Trouble, match=f"get it afresh: it has no {name}"):
        environment.set_up()
    assert not (tiny / ".venv").exists()


@pytest.mark.skipif(os.name == "nt", reason="Windows separates paths with ;")
def test_a_folder_that_venv_refuses(tiny: Path) -> None:
    environment = load(tiny).environment
    environment.HOME = Path(f"a{os.pathsep}b")
    with pytest.raises(environment.Trouble, match='in a folder with ":" in its name'):
        environment.set_up()


def test_a_python_without_venv(tiny: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    installer = load(tiny).installer
    monkeypatch.setattr(installer.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(installer.Trouble, match=r"sudo apt install python3\.\d+-venv"):
        installer.make_venv(tiny / ".venv")


@pytest.mark.parametrize(
    ("error", "sentence"),
    [
        (PermissionError(13, "Permission denied", "here"), f"here {WRITABLE}"),
        (OSError(28, "No space left on device"), "The disk is full"),
    ],
)
def test_writing_fails(tiny: Path, error: OSError, sentence: str) -> None:
    environment = load(tiny).environment
    with pytest.raises(environment.Trouble, match=sentence), environment.alone():
        raise error


@pytest.mark.skipif(sys.platform != "linux" or os.geteuid() != 0, reason="only root mounts a disk")
def test_a_disk_that_is_full_or_can_only_be_read(tmp_path: Path) -> None:
    """With room the next start makes everything; what is set up is used without writing."""

    def mount(*options: str) -> None:
        call = ["mount", "-t", "tmpfs", "-o", ",".join(options), "tmpfs", str(tmp_path)]
        subprocess.run(call, check=True, capture_output=True)

    try:
        mount("size=1m")
    except (OSError, subprocess.CalledProcessError):
        pytest.skip("no disk can be mounted here")
    try:
        folder = make_tiny(tmp_path / "book")
        filling = folder / "filling"
        with contextlib.suppress(OSError), filling.open("wb", buffering=0) as file:
            while file.write(bytes(4096)):
                pass
        done = run(folder, "figures")
        assert (done.code, done.complained) == (1, FULL)
        assert not list(folder.glob(".venv"))
        mount("remount", "size=100m")
        assert run(folder, "figures").said.endswith("figures drawn\n")
        mount("remount", "ro")
        assert run(folder, "figures").said == "figures drawn\n"
        assert WRITABLE in run(folder, "fresh").complained
        assert "keeps no changes" in run(folder, "--no-browser").said
    finally:
        subprocess.run(["umount", "--lazy", str(tmp_path)], check=True)


def test_an_old_python_is_refused() -> None:
    ast.parse((ROOT / "lab.py").read_text("utf-8"), feature_version=(3, 6))
    pretend = (
        "import platform, runpy, sys; sys.version_info = (3, 9, 18);"
        "platform.python_version = lambda: '3.9.18'; runpy.run_path(sys.argv[1])"
    )
    called = [sys.executable, "-c", pretend, str(ROOT / "lab.py")]
    done = subprocess.run(called, capture_output=True, text=True)
    assert done.returncode == 1
    assert done.stderr.startswith("Drift Lab needs Python 3.11 or newer; this is 3.9.18. Install")
    assert done.stderr.count("\n") == 1

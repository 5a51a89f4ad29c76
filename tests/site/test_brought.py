"""What others made comes whole or not at all, and what is missing is said in a sentence."""

import hashlib
import os
import shutil
from pathlib import Path

import pytest

from live.brought import OFFICIAL, bring_runtime
from live.make import reason_not
from live.versions import VERSIONS
from unfinished import Unfinished

DIGESTS = VERSIONS["pyodide"]["sha256"]


def program(folder, name, text):
    """A program of a folder, which a shell runs."""
    path = folder / name
    path.write_text(f"#!/bin/sh\n{text}\n", "utf-8")
    path.chmod(0o755)


def npm_brings(programs, files):
    """An npm that brings a package of some files."""
    packed = programs / "packed"
    packed.mkdir(exist_ok=True)
    for name, data in files.items():
        (packed / name).write_bytes(data)
    mkdir, copy = (shutil.which(name, path="/usr/bin:/bin") for name in ("mkdir", "cp"))
    place = '"${3#--prefix=}/node_modules"'
    program(programs, "npm", f'{mkdir} {place}\n{copy} -r "{packed}" {place}/pyodide')


@pytest.fixture
def programs(tmp_path, monkeypatch) -> Path:
    """The folder that programs are looked for in, and no other; empty."""
    if os.name == "nt":
        pytest.skip("the stand-ins are scripts of a shell")
    folder = tmp_path / "programs"
    folder.mkdir()
    monkeypatch.setenv("PATH", str(folder))
    return folder


def test_without_node_a_sentence_says_so(programs, tmp_path):
    assert reason_not(tmp_path) == (
        "The site is not made: that needs Node.js, which is not installed."
    )


def test_an_old_node_is_named(programs, tmp_path):
    program(programs, "node", "echo v12.1.0")
    assert reason_not(tmp_path).endswith("needs Node.js 18; this is v12.1.0.")


def test_without_npm_or_its_network_a_sentence_says_so(programs, tmp_path):
    program(programs, "node", "echo v20.0.0")
    begin = "The site is not made: npm does not bring pyodide@"
    assert reason_not(tmp_path).startswith(begin)
    program(programs, "npm", "echo no network >&2; exit 1")
    assert reason_not(tmp_path).startswith(begin)
    assert reason_not(tmp_path).endswith("no network")


def test_other_contents_than_those_published_are_refused(programs, tmp_path):
    npm_brings(programs, dict.fromkeys(DIGESTS, b"other"))
    with pytest.raises(Unfinished, match=r"other contents than versions\.toml says"):
        bring_runtime(tmp_path / "runtime")
    assert not (tmp_path / "runtime").exists()


@pytest.fixture
def package(programs, monkeypatch) -> dict[str, bytes]:
    """Small files in place of the runtime's, as npm brings them and versions.toml has them."""
    files = {name: name.encode() for name in DIGESTS}
    npm_brings(programs, files)
    digests = {name: hashlib.sha256(data).hexdigest() for name, data in files.items()}
    monkeypatch.setitem(VERSIONS["pyodide"], "sha256", digests)
    return files


def there(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_a_runtime_that_is_kept_whole_is_not_brought_again(package, programs, tmp_path):
    folder = tmp_path / "kept/runtime"
    bring_runtime(folder)
    assert there(folder) == package
    assert list(folder.parent.iterdir()) == [folder], "nothing is left beside it"
    program(programs, "npm", "exit 1")
    bring_runtime(folder)


@pytest.mark.parametrize("name", DIGESTS)
@pytest.mark.parametrize("spoilt", ["missing", "changed"])
def test_a_runtime_that_is_not_whole_is_brought_anew(spoilt, name, package, programs, tmp_path):
    folder = tmp_path / "kept/runtime"
    bring_runtime(folder)
    (folder / name).unlink()
    if spoilt == "changed":
        (folder / name).write_bytes(b"other")
    bring_runtime(folder)
    assert there(folder) == package
    assert list(folder.parent.iterdir()) == [folder]


def test_a_package_whose_files_are_others_is_refused(package, monkeypatch, tmp_path):
    monkeypatch.setitem(VERSIONS["pyodide"]["sha256"], OFFICIAL, "0" * 64)
    with pytest.raises(Unfinished, match=r"other contents than versions\.toml says"):
        bring_runtime(tmp_path / "kept/runtime")
    assert list((tmp_path / "kept").iterdir()) == []

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

pytestmark = pytest.mark.xdist_group("site")


@pytest.fixture
def program(tmp_path, monkeypatch):
    """Puts a program of a shell into the one folder where programs are looked for."""
    if os.name == "nt":
        pytest.skip("the stand-ins are scripts of a shell")
    folder = tmp_path / "programs"
    folder.mkdir()
    monkeypatch.setenv("PATH", str(folder))

    def put(name: str, text: str) -> None:
        (folder / name).write_text(f"#!/bin/sh\n{text}\n", "utf-8")
        (folder / name).chmod(0o755)

    return put


def test_without_node_or_npm_or_its_network_a_sentence_says_so(program, tmp_path):
    begin = "The site is not made: "
    assert reason_not(tmp_path) == f"{begin}that needs Node.js, which is not installed."
    program("node", "echo v12.1.0")
    assert reason_not(tmp_path) == f"{begin}that needs Node.js 18; this is v12.1.0."
    program("node", "echo v20.0.0")
    assert reason_not(tmp_path).startswith(f"{begin}npm does not bring pyodide@")
    program("npm", "echo no network >&2; exit 1")
    assert reason_not(tmp_path).endswith("no network")


@pytest.fixture
def package(program, tmp_path, monkeypatch) -> dict[str, bytes]:
    """Small files in place of the runtime's, as npm brings them and versions.toml has them."""
    files = {name: name.encode() for name in VERSIONS["pyodide"]["sha256"]}
    (tmp_path / "packed").mkdir()
    for name, data in files.items():
        (tmp_path / "packed" / name).write_bytes(data)
    mkdir, copy = (shutil.which(name, path="/usr/bin:/bin") for name in ("mkdir", "cp"))
    place = '"${3#--prefix=}/node_modules"'
    program("npm", f'{mkdir} {place}\n{copy} -r "{tmp_path}/packed" {place}/pyodide')
    digests = {name: hashlib.sha256(data).hexdigest() for name, data in files.items()}
    monkeypatch.setitem(VERSIONS["pyodide"], "sha256", digests)
    return files


def test_a_runtime_is_brought_whole_once_and_anew_if_it_is_spoilt(package, program, tmp_path):
    folder: Path = tmp_path / "kept/runtime"
    for spoilt in ("", "missing", "changed"):
        if spoilt:
            (folder / OFFICIAL).unlink()
        if spoilt == "changed":
            (folder / OFFICIAL).write_bytes(b"other")
        bring_runtime(folder)
        assert {path.name: path.read_bytes() for path in folder.iterdir()} == package
        assert list(folder.parent.iterdir()) == [folder], "nothing is left beside it"
    program("npm", "exit 1")
    bring_runtime(folder)


def test_other_contents_than_those_published_are_refused(package, monkeypatch, tmp_path):
    monkeypatch.setitem(VERSIONS["pyodide"]["sha256"], OFFICIAL, "0" * 64)
    with pytest.raises(Unfinished, match=r"other contents than versions\.toml says"):
        bring_runtime(tmp_path / "kept/runtime")
    assert list((tmp_path / "kept").iterdir()) == []

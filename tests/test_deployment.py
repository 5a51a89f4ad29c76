"""What the page for a class says is there."""

import json
import re
import tomllib

import student
from packaging.specifiers import SpecifierSet

from support import ROOT

FOLDER = ROOT / "deployment"
PAGE = (FOLDER / "README.md").read_text("utf-8")
DOCKERFILE = (FOLDER / "Dockerfile").read_text("utf-8")
COPIED = re.findall(r"^COPY (?:--\S+ )?(.*) \S+$", DOCKERFILE, re.M)


def test_the_image_takes_files_that_the_project_and_a_students_copy_have() -> None:
    names = [name for line in COPIED for name in line.split()]
    assert {"src", "notebooks", "environment.txt"} <= set(names)
    for name in names:
        assert (ROOT / name).exists(), name
        assert name in student.TAKEN, name


def test_the_image_is_sent_what_it_takes() -> None:
    """What is not in the list of exceptions does not reach Docker."""
    sent = re.findall(r"^!(\S+)$", (FOLDER / "Dockerfile.dockerignore").read_text("utf-8"), re.M)
    assert sorted(sent) == sorted(name for line in COPIED for name in line.split())


def test_the_image_has_a_python_that_the_book_allows_and_was_tried_with() -> None:
    [python] = re.findall(r"^FROM python:(3\.\d+)-slim-\w+$", DOCKERFILE, re.M)
    about = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    assert python in SpecifierSet(about["requires-python"])
    assert f"Programming Language :: Python :: {python}" in about["classifiers"]


def test_a_container_is_open_to_this_computer_and_asks_for_its_token() -> None:
    ports = re.findall(r"-p (\S*\d)", DOCKERFILE + PAGE)
    assert set(ports) == {"127.0.0.1:8888:8888"}
    assert len(ports) == 2
    command = json.loads(DOCKERFILE.rpartition("\nCMD ")[2])
    assert not any("token" in part or "password" in part for part in command)
    assert DOCKERFILE.rindex("\nUSER student") > DOCKERFILE.rindex("\nRUN ")

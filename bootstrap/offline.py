"""Fetches the packages of environment.txt into a folder, for computers without a network.

The environment's Python runs it: what a line of environment.txt is for, its marker says, and pip
would answer that for the computer that fetches, not for the one that installs.
"""

import argparse
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from packaging.markers import Marker

from bootstrap.installer import ENVIRONMENT
from bootstrap.steps import VERSION, Trouble, say


class System(NamedTuple):
    wheels: tuple[str, ...]
    """Names by which wheels say that they are for it."""
    markers: dict[str, str]


def _linux(machine: str) -> tuple[str, ...]:
    # Up to the glibc of Debian 12; pip adds nothing to a name of this kind, so all are listed.
    modern = (f"manylinux_2_{minor}_{machine}" for minor in range(36, 16, -1))
    return *modern, f"manylinux2014_{machine}"


_WINDOWS = {"sys_platform": "win32", "os_name": "nt", "platform_system": "Windows"}
_MAC = {"sys_platform": "darwin", "os_name": "posix", "platform_system": "Darwin"}
_LINUX = {"sys_platform": "linux", "os_name": "posix", "platform_system": "Linux"}
SYSTEMS = {
    "windows": System(("win_amd64",), {**_WINDOWS, "platform_machine": "AMD64"}),
    "mac": System(("macosx_14_0_arm64",), {**_MAC, "platform_machine": "arm64"}),
    "linux": System(_linux("x86_64"), {**_LINUX, "platform_machine": "x86_64"}),
}


def fetch(folder: Path, system: str, python: str) -> None:
    """Bring the wheels of one system and one Python; an empty `system` is this computer's."""
    markers: dict[str, str] = {}
    options = ["--no-deps", "--only-binary=:all:", "--require-hashes", "--dest", str(folder)]
    if system:
        there = SYSTEMS[system]
        markers = {"python_version": python, "python_full_version": f"{python}.0", **there.markers}
        options += ["--implementation", "cp", "--python-version", python]
        options += [part for name in there.wheels for part in ("--platform", name)]
    with TemporaryDirectory() as aside:
        asked = Path(aside, "asked.txt")
        asked.write_text("\n".join(wanted(markers)), "utf-8")
        pip = [sys.executable, "-m", "pip", "download", "--quiet", "--no-input", "--retries=2"]
        if subprocess.run([*pip, *options, "-r", str(asked)]).returncode:
            raise Trouble(f"{folder} is not complete; the messages above tell why.")


def wanted(markers: dict[str, str]) -> Iterator[str]:
    """Give the lines of environment.txt that count where `markers` are so."""
    text = ENVIRONMENT.read_text("utf-8").replace("\\\n", " ")
    for pin, marker, hashes in re.findall(r"^([^\s#]+)(?: ; (.*?))? +(--hash.*)$", text, re.M):
        if not marker or Marker(marker).evaluate(markers):
            yield f"{pin} {hashes}"


def main(arguments: list[str]) -> None:
    parser = argparse.ArgumentParser(prog="lab.py wheels", usage="python3 lab.py help wheels")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--system", choices=SYSTEMS, default="")
    parser.add_argument("--python", default=VERSION)
    options = parser.parse_args(arguments)
    if not re.fullmatch(r"3\.\d+", options.python):
        raise Trouble(f'--python wants a version like "3.12", got "{options.python}".')
    if options.python != VERSION and not options.system:
        raise Trouble("--python wants --system, too: for which computers is it?")
    options.folder.mkdir(parents=True, exist_ok=True)
    fetch(options.folder, options.system, options.python)
    count = len(list(options.folder.glob("*.whl")))
    say(
        f"{options.folder} has {count} wheels. Where there is no network, set PIP_NO_INDEX=1 and "
        "PIP_FIND_LINKS to this folder before the first 'python3 lab.py'."
    )


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except Trouble as trouble:
        sys.exit(str(trouble))

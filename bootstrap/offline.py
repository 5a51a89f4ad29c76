"""Fetches the packages of environment.txt into a folder, for computers without a network.

The environment's Python runs it, for its pip and packaging: pip alone would choose the lines of
environment.txt for the computer that fetches, not for the one that installs.
"""

import argparse
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from packaging.markers import Marker

from bootstrap.installer import ENVIRONMENT
from bootstrap.steps import VERSION, Trouble, say

# Of each system the names of its wheels, and the values of its markers. Of Linux all names up to
# the glibc of Debian 12 are listed: pip adds nothing to a name of this kind.
LINUX = (*(f"manylinux_2_{minor}_x86_64" for minor in range(36, 16, -1)), "manylinux2014_x86_64")
MARKERS = ("sys_platform", "os_name", "platform_system", "platform_machine")
SYSTEMS = {
    "windows": (("win_amd64",), ("win32", "nt", "Windows", "AMD64")),
    "mac": (("macosx_14_0_arm64",), ("darwin", "posix", "Darwin", "arm64")),
    "linux": (LINUX, ("linux", "posix", "Linux", "x86_64")),
}


def fetch(folder: Path, system: str, python: str) -> None:
    """Fetch the wheels of one system and one Python; an empty `system` is this computer's."""
    options = ["--no-deps", "--only-binary=:all:", "--require-hashes", "--dest", str(folder)]
    if system:
        options += ["--implementation", "cp", "--python-version", python]
        options += [part for name in SYSTEMS[system][0] for part in ("--platform", name)]
    with TemporaryDirectory() as aside:
        asked = Path(aside, "asked.txt")
        asked.write_text("\n".join(wanted(system, python)), "utf-8")
        pip = [sys.executable, "-m", "pip", "download", "--quiet", "--no-input", "--retries=2"]
        if subprocess.run([*pip, *options, "-r", str(asked)]).returncode:
            raise Trouble(f"{folder} is not complete; the messages above tell why.")


def wanted(system: str, python: str) -> Iterator[str]:
    """Yield the lines of environment.txt that count on a system."""
    markers = {"python_version": python, "python_full_version": f"{python}.0"} if system else {}
    markers |= dict(zip(MARKERS, SYSTEMS[system][1], strict=True)) if system else {}
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
        raise Trouble(f'--python: expected a version like "3.12", got "{options.python}".')
    if options.python != VERSION and not options.system:
        raise Trouble("--python needs --system, too: for which computers is it?")
    options.folder.mkdir(parents=True, exist_ok=True)
    fetch(options.folder, options.system, options.python)
    say(
        f"{options.folder} has {len([*options.folder.glob('*.whl')])} wheels. Where there is no "
        "network, set PIP_NO_INDEX=1 and PIP_FIND_LINKS to this folder before the first "
        "'python3 lab.py'."
    )


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except Trouble as trouble:
        sys.exit(str(trouble))

"""Refuses this process every other computer, as if there were no network.

Nothing that a reader runs may depend on one unseen. Only Python's own sockets are watched, and not
those of other programs or of what a notebook starts.
"""

import errno
import ipaddress
import socket
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

SENDS = ("socket.connect", "socket.sendto", "socket.sendmsg")
ASKS_FOR_A_NAME = ("socket.getaddrinfo", "socket.gethostbyname", "socket.gethostbyaddr")
REFUSAL = "this test has no network"
_blocked = False


@cache
def _watch() -> None:
    """Ask at each use of a socket; once, for nothing ends that."""
    sys.addaudithook(_refuse)


def block_network() -> None:
    """Refuse from now on."""
    global _blocked
    _watch()
    _blocked = True


@contextmanager
def no_network() -> Iterator[None]:
    """Refuse within a ``with`` block."""
    global _blocked
    block_network()
    try:
        yield
    finally:
        _blocked = False


def line_for_a_kernel() -> str:
    """The line that blocks a kernel which is started with it; it leaves no name behind."""
    path = str(Path(__file__).resolve())
    return f"import runpy; runpy.run_path({path!r})['block_network'](); del runpy\n"


def block_kernels(ipython: Path) -> None:
    """Have every kernel refuse that has its settings in a folder."""
    startup = ipython / "profile_default/startup"
    startup.mkdir(parents=True)
    (startup / "no_network.py").write_text(line_for_a_kernel(), "utf-8")


def _refuse(event: str, arguments: tuple) -> None:
    if not _blocked:
        return
    if event in SENDS:
        over, address = arguments
        if over.family in (socket.AF_INET, socket.AF_INET6) and not _is_here(address[0]):
            raise OSError(errno.ENETUNREACH, REFUSAL)
    elif event in ASKS_FOR_A_NAME and not _is_here(arguments[0]):
        raise socket.gaierror(socket.EAI_NONAME, REFUSAL)


def _is_here(host: str | bytes | None) -> bool:
    name = host.decode() if isinstance(host, bytes) else host or "localhost"
    if name in ("localhost", "0.0.0.0", "::", socket.gethostname()):
        return True
    try:
        return ipaddress.ip_address(name).is_loopback
    except ValueError:
        return False

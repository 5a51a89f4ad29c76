"""A folder as a web server hands it out, and one that is another but for a part of it."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import ClassVar


class Quiet(SimpleHTTPRequestHandler):
    """Files of the site, as a web server hands them out."""

    extensions_map: ClassVar = {
        **SimpleHTTPRequestHandler.extensions_map,
        ".mjs": "text/javascript",
        ".wasm": "application/wasm",
    }

    def log_message(self, *_: object) -> None:
        pass


class Server(ThreadingHTTPServer):
    """One that does not mind a page that leaves before it has all that it asked for."""

    def handle_error(self, request: object, client_address: object) -> None:
        if not isinstance(sys.exception(), ConnectionError):
            super().handle_error(request, client_address)


@contextmanager
def served(folder: Path) -> Iterator[str]:
    """Serve a folder as long as the ``with`` block lasts."""
    server = Server(("127.0.0.1", 0), partial(Quiet, directory=str(folder)))
    Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()
    server.server_close()


def linked(there: Path, own: Path, without: str) -> Path:
    """Make a folder that has all that another has, but for what stands at a path in it."""
    name, _, rest = without.partition("/")
    own.mkdir()
    for path in there.iterdir():
        if path.name != name:
            (own / path.name).symlink_to(path)
        elif rest:
            linked(path, own / name, rest)
    return own

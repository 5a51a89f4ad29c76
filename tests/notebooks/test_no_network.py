"""Notebooks are run without a network: other computers are refused them, this one is not."""

import socket
from pathlib import Path

import pytest
from chromium import no_browser
from interpreter import run_here
from no_network import REFUSAL, no_network
from pages import notebook_of
from test_runs import run_in_browser, run_in_kernel

NOBODY = "192.0.2.1"  # an address that no computer has
TRY = f"""
import socket
refused = []
for attempt in (
    lambda: socket.create_connection(("{NOBODY}", 80), timeout=1),
    lambda: socket.getaddrinfo("example.org", 443),
    lambda: socket.socket(type=socket.SOCK_DGRAM).sendto(b"", ("{NOBODY}", 53)),
):
    try:
        attempt()
    except OSError as error:
        refused.append(error.strerror)
with socket.create_server(("127.0.0.1", 0)) as server:
    socket.create_connection(server.getsockname()).close()
sorted(set(refused)), len(refused), "runpy" in globals()
"""


def test_a_process_is_refused_as_long_as_it_is_told() -> None:
    with no_network():
        with pytest.raises(OSError, match=REFUSAL):
            socket.create_connection((NOBODY, 80), timeout=1)
        with pytest.raises(OSError, match=REFUSAL):
            socket.gethostbyname("example.org")
        assert socket.gethostbyname("127.0.0.1") == "127.0.0.1"
    with socket.socket(type=socket.SOCK_DGRAM) as afterwards:
        said = ""
        try:
            afterwards.sendto(b"", (NOBODY, 9))
        except OSError as error:  # the system's own words, on a computer without a network
            said = error.strerror
        assert said != REFUSAL


@pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::ResourceWarning")
@pytest.mark.parametrize(
    "way",
    [
        "here",
        pytest.param("kernel", marks=pytest.mark.kernel),
        pytest.param(
            "browser",
            marks=[
                *(pytest.mark.kernel, pytest.mark.browser),
                pytest.mark.xdist_group("browser"),
                pytest.mark.skipif(bool(no_browser()), reason=no_browser()),
            ],
        ),
    ],
)
def test_a_notebook_is_refused(way: str, request, tmp_path: Path) -> None:
    notebook = notebook_of(TRY)
    if way == "here":
        run_here(notebook, tmp_path)
    elif way == "kernel":
        run_in_kernel(notebook)
    else:
        page = request.getfixturevalue("chapter_page")
        notebook = run_in_browser(page, "network.ipynb", notebook)
    (cell,) = notebook.cells
    shown = cell.outputs[0].data["text/plain"]
    assert shown == f"(['{REFUSAL}'], 3, False)"

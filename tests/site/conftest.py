"""The site as built, in a browser: what all tests of it start from.

``python3 lab.py test --site`` runs them; without a built site those that need one are skipped.
"""

import json
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from urllib.request import urlopen

import pytest
from served import linked, served
from visitor import visit

from live.brought import OFFICIAL, bring, digest_of
from live.make import BUILD
from live.packages import make_packages
from live.versions import VERSIONS
from support import site_or_skip

KEPT = BUILD / "live"
"""What the build of the site brought, and keeps."""


@pytest.fixture(scope="session")
def site() -> Path:
    """Folder of the built site."""
    return site_or_skip()


@pytest.fixture(scope="session")
def site_python(site) -> Path:
    """Python that has the site's tools, as lab.py lays it beside this one.

    What is made with them takes minutes, and is tried when the site is.
    """
    python = Path(os.environ.get("DRIFTLAB_SITE_PYTHON", f"{sys.prefix}-site/bin/python"))
    if not python.exists():
        pytest.skip("the site's tools are not there; 'python3 lab.py site' brings them")
    return python


@pytest.fixture(scope="session")
def address(site) -> Iterator[str]:
    """Where the site is served, without a slash at the end."""
    with served(site) as address:
        yield address


@pytest.fixture(scope="session")
def distribution() -> Path:
    """Folder with the distribution's files."""
    folder = os.environ.get("DRIFTLAB_PYODIDE")
    if not folder:
        pytest.skip("DRIFTLAB_PYODIDE names no folder with Pyodide's distribution")
    return Path(folder)


@pytest.fixture(scope="session")
def packages(site) -> None:
    """Pyodide's packages can be had: the site holds them, or a folder does, or the network."""
    lock = json.loads((site / "live/static/pyodide" / OFFICIAL).read_text("utf-8"))
    address = lock["packages"]["cycler"]["file_name"]
    folder = os.environ.get("DRIFTLAB_PYODIDE")
    if not address.startswith("https:") or folder:
        return
    try:
        urlopen(address, timeout=20).close()
    except OSError:
        pytest.skip("DRIFTLAB_PYODIDE names no folder, and Pyodide's address cannot be reached")


@pytest.fixture(scope="session")
def official() -> dict:
    """The lock that Pyodide publishes, which came with the runtime."""
    path = KEPT / "runtime" / OFFICIAL
    if not path.exists():
        pytest.skip("Pyodide's runtime was not brought; 'python3 lab.py site' brings it")
    assert digest_of(path) == VERSIONS["pyodide"]["sha256"][OFFICIAL]
    return json.loads(path.read_text("utf-8"))["packages"]


@pytest.fixture(scope="session")
def all_here(distribution, official, tmp_path_factory) -> Path:
    """Folder with what a browser loads of a site that needs no network."""
    made = tmp_path_factory.mktemp("self-contained") / "pyodide"
    make_packages(bring(KEPT), KEPT, made, distribution)
    return made


@pytest.fixture(scope="session")
def own_address(request, site, tmp_path_factory) -> Iterator[str]:
    """Where a site is served that needs no network, if Pyodide's distribution is at hand.

    It has all of Pyodide in the place of what the lock of the other leaves elsewhere.
    """
    if not os.environ.get("DRIFTLAB_PYODIDE"):
        request.getfixturevalue("packages")
        yield request.getfixturevalue("address")
        return
    own = linked(site, tmp_path_factory.mktemp("own") / "site", without="live/static/pyodide")
    (own / "live/static/pyodide").symlink_to(request.getfixturevalue("all_here"))
    with served(own) as address:
        yield address


@pytest.fixture(scope="session")
def browser(site, started_browser):
    """The browser, where there is a site to look at."""
    return started_browser


@pytest.fixture
def page(browser) -> Iterator:
    """A page of a reader who was never here, which keeps what it complains of."""
    with visit(browser) as page:
        yield page


@pytest.fixture(scope="module")
def kept_page(browser) -> Iterator:
    """Such a page that stays for all tests of a module: what lives in it need not begin anew."""
    with visit(browser) as page:
        yield page

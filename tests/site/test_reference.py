"""The API reference: every public name has an entry, where readers import it, and says its kin."""

import inspect
import re
import zlib
from importlib import import_module

import pytest
from numpydoc.docscrape import ClassDoc, FunctionDoc

from driftlab.book.references import all_references
from reading.doors import BOOK, DOORS, aliases, documented, first_door, home, names, thing
from reading.papers import entries_by_home, place_label

pytestmark = pytest.mark.xdist_group("site")


@pytest.fixture(scope="module")
def page(site):
    """Reads a page of the reference."""
    return lambda name: (site / f"reference/{name}.html").read_text("utf-8")


def test_the_inventory_has_every_name_at_every_door_once(site):
    """In objects.inv are names, kinds and addresses, to which other projects link."""
    head, _, packed = (site / "objects.inv").read_bytes().partition(b"zlib.\n")
    assert head.startswith(b"# Sphinx inventory version 2")
    lines = zlib.decompress(packed).decode("utf-8").splitlines()
    rows = [re.fullmatch(r"(.+?) (\S+:\S+) (-?\d+) (\S*) (.*)", line).groups() for line in lines]
    built = {name: address for name, kind, _, address, _ in rows if kind.startswith("py:")}
    offered = {f"{door}.{key}" for door in DOORS for key in import_module(door).__all__}
    offered = {name for name in offered if not inspect.ismodule(thing(name))}
    assert (offered | set(documented())) - built.keys() == set()
    assert {aliases().get(name, name) for name in offered} <= set(documented().values())
    for address in set(built.values()):
        assert (site / address.partition("#")[0]).exists()


def test_a_name_is_documented_where_readers_import_it():
    assert documented()["driftlab.drift.systematic_drift.drift_per_revolution"] == (
        "driftlab.drift.drift_per_revolution"
    )
    assert aliases()["driftlab.ImuErrors"] == "driftlab.imu.ImuErrors"
    for name in names():
        assert home(name.documented) == name.home
        assert thing(name.documented) is thing(name.home)


def test_functions_of_the_first_door_say_what_else_to_see():
    ends = {shown.rpartition(".")[2] for shown in documented().values()}
    for name in first_door():
        if name.kind == "function" and not name.home.startswith("driftlab.core."):
            seen = FunctionDoc(inspect.unwrap(thing(name.home)))["See Also"]
            others = {other.rpartition(".")[2] for group, _ in seen for other, _ in group}
            assert others, name.home
            # A method of a recording has its entry with the class.
            assert others - {"increments"} <= ends - {name.home.rpartition(".")[2]}, name.home


def test_papers_that_docstrings_cite_are_those_of_the_book():
    known = tuple({re.sub(r"\s+", " ", str(entry)) for entry in all_references()})
    cited = 0
    for name in names():
        if name.kind != "data" and not name.home.startswith(BOOK):
            found = inspect.unwrap(thing(name.home))
            if "References\n" in (found.__doc__ or ""):
                doc = ClassDoc(found) if name.kind == "class" else FunctionDoc(found)
                text = " ".join(line.strip() for line in doc["References"])
                items = [*filter(None, re.split(r"(?:^|\s)- ", text))]
                assert all(item.startswith(known) for item in items), (name.home, items)
                cited += len(items)
    assert cited > 20


def test_a_page_has_formulas_outputs_values_and_the_papers(page):
    text = page("modules/drift.systematic_drift")
    entry = text[text.index('id="driftlab.drift.drift_coefficient"') :]
    entry = entry[: entry.index("</dd></dl>")]
    for part in ("array([0.02, 0.", "In the papers", "ledger/larin.html#ledger-larin-"):
        assert part in re.sub(r"<[^a][^>]*>", "", entry), part
    places = [
        place_label(each) for each in entries_by_home()[home("driftlab.drift.drift_coefficient")]
    ]
    assert all(f'#{place}"' in entry for place in places)
    assert 'class="math' in entry
    assert "7.292" in re.sub(r"<[^>]*>", "", page("modules/earth"))
    index = set(re.findall(r'title="driftlab\.([\w.]+)"', page("index")))
    assert {"attitude.integrate", "gyrocompass.align", "calibration.calibrate"} <= index

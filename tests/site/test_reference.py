"""The API reference: every public name has an entry, on one page, where readers import it."""

import inspect
import re
import zlib
from importlib import import_module

import pytest
from numpydoc.docscrape import ClassDoc, FunctionDoc

from driftlab.__main__ import SUBJECTS
from driftlab.book.references import all_references
from reading.api_pages import api_pages, module_page, module_title, plain_bars
from reading.doors import BOOK, DOORS, aliases, documented, first_door, home, modules, names, thing
from reading.field_words import also, words_of_functions, words_of_tasks


@pytest.fixture(scope="module")
def api():
    """Pages of the reference; the whole package is imported for them, so not before it is asked."""
    return api_pages()


def offered():
    """Names at all doors, of what is no module."""
    for door in DOORS:
        for key in import_module(door).__all__:
            if not inspect.ismodule(thing(f"{door}.{key}")):
                yield f"{door}.{key}"


def test_every_name_at_a_door_leads_to_an_entry():
    entries, others = set(documented().values()), aliases()
    assert [name for name in offered() if others.get(name, name) not in entries] == []


def test_every_entry_stands_on_one_page_once(api):
    text = "\n".join(api.values())
    found = re.findall(r"^\.\. auto(?:function|class):: (\S+)$", text, re.M)
    constants = re.findall(r"^\.\. py:data:: (\S+)\n   :module: (\S+)$", text, re.M)
    found += [f"{module}.{key}" for key, module in constants]
    assert sorted(found) == sorted(name.documented for name in names())


def test_a_name_is_documented_where_readers_import_it():
    assert documented()["driftlab.drift.systematic_drift.drift_per_revolution"] == (
        "driftlab.drift.drift_per_revolution"
    )
    assert aliases()["driftlab.drift_per_revolution"] == "driftlab.drift.drift_per_revolution"
    assert aliases()["driftlab.ImuErrors"] == "driftlab.imu.ImuErrors"
    assert "driftlab.earth.EARTH_RATE" in documented().values()  # its home is a core


def test_the_index_leads_with_the_first_door_and_ends_with_the_book(api):
    page = api["reference/index"]
    listed = re.findall(r"^- :py:obj:`\w+ <driftlab\.([\w.]+)>`: \S", page, re.M)
    assert {"attitude.integrate", "gyrocompass.align", "calibration.calibrate"} <= set(listed)
    assert len(listed) == len(set(listed)) == len(first_door()) > 25
    assert page.index("gyrocompass.align>") < page.index("   motion") < page.index("   book")
    assert page.rstrip().endswith("   book")


def test_pages_are_titled_by_their_subject_and_say_their_module(api):
    floors = ["", *(subject for subject in SUBJECTS if subject != "book")]
    titles = [module_title(module) for floor in floors for module in modules(floor)]
    assert len(set(titles)) == len(titles)
    page = api["reference/modules/calibration.filter"]
    assert page.startswith("Calibrating a whole unit on a turntable with a Kalman filter\n====")
    assert "\n``driftlab.calibration.filter``\n" in page


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
    known = {re.sub(r"\s+", " ", str(entry)) for entry in all_references()}
    cited = 0
    for name in names():
        if name.kind != "data" and not name.home.startswith(BOOK):
            found = inspect.unwrap(thing(name.home))
            doc = ClassDoc(found) if name.kind == "class" else FunctionDoc(found)
            text = " ".join(line.strip() for line in doc["References"])
            for item in filter(None, re.split(r"(?:^|\s)- ", text)):
                assert any(item.startswith(entry) for entry in known), (name.home, item)
                cited += 1
    assert cited > 20


def test_words_of_the_field_stand_on_the_page_of_their_function():
    words = words_of_functions()
    assert "gyrocompassing" in words["driftlab.gyrocompass.alignment.align"]
    assert "ZUPT" in words["driftlab.recordings.static_detection.static_intervals"]
    # The modules of the ground floor are one subject.
    assert "bias instability" in words["driftlab.noise_terms.fit_noise_terms"]
    # A helper of another subject does not get them.
    assert "driftlab.axes.convert_vectors" in documented()
    assert "gyrocompassing" not in words["driftlab.axes.convert_vectors"]
    assert "heading" in also("driftlab.gyrocompass.alignment.align")[1]
    assert also("driftlab.vectors.unit") == []
    assert words.keys() <= documented().keys()
    assert len(words_of_tasks()) > 30


def test_every_documented_name_means_its_thing():
    for name in names():
        assert home(name.documented) == name.home
        # A constant handed on from a core is the same thing, too.
        assert thing(name.documented) is thing(name.home)


def test_pages_and_their_contents_lead_to_each_other(api):
    listed = {
        f"{page.rpartition('/')[0]}/{target}"
        for page, text in api.items()
        for target in re.findall(r"^   (?:\w+ <)?([\w./]+)>?$", text, re.M)
    }
    assert api.keys() - {"reference/index"} <= listed
    for subject in ("", *(subject for subject in SUBJECTS if subject != "book")):
        assert modules(subject)
        assert all(module_page(module) in api for module in modules(subject))


def test_a_constant_shows_its_value_and_its_words(api):
    page = api["reference/modules/earth"]
    assert ".. py:data:: EARTH_RATE\n   :module: driftlab.earth\n   :value: " in page
    schemes = api["reference/modules/motion.scheme"]
    (text,) = re.findall(r"NINETEEN_POSITIONS\n(?:   :.*\n)*\n((?:   .+\n)+)", schemes)
    assert len(text.split()) > 3


def test_bars_stay_bars_but_where_they_are_code_or_formulas():
    formulas = [".. math:: |w|", "   |v|", "", ".. math::", "", "   |s| &= 1", "", "   |t|", ""]
    lines = ["|w| is `a|b` here", "", ">>> a | b", "|x|", "", *formulas, "|u|"]
    assert plain_bars(lines) == [
        r"\|w\| is `a|b` here",
        *["", ">>> a | b", "|x|", "", *formulas, r"\|u\|"],
    ]


def inventory(site):
    """Names, kinds and addresses in objects.inv, to which other projects link."""
    head, _, packed = (site / "objects.inv").read_bytes().partition(b"zlib.\n")
    assert head.startswith(b"# Sphinx inventory version 2")
    lines = zlib.decompress(packed).decode("utf-8").splitlines()
    rows = [re.fullmatch(r"(.+?) (\S+:\S+) (-?\d+) (\S*) (.*)", line).groups() for line in lines]
    return {name: address for name, domain, _, address, _ in rows if domain.startswith("py:")}


def test_the_inventory_has_every_name_at_every_door(site):
    built = inventory(site)
    assert set(offered()) - built.keys() == set()
    assert set(documented()) - built.keys() == set()
    for address in set(built.values()):
        assert (site / address.partition("#")[0]).exists()


def test_a_page_has_formulas_outputs_and_the_papers(site):
    page = (site / "reference/modules/drift.systematic_drift.html").read_text("utf-8")
    entry = page[page.index('id="driftlab.drift.drift_coefficient"') :]
    entry = entry[: entry.index("</dd></dl>")]
    for part in ("array([0.02, 0.", "In the papers", "ledger/larin.html#ledger-larin-"):
        assert part in re.sub(r"<[^a][^>]*>", "", entry), part
    assert "03_systematic_drift.html#chapter-03-only-the-symmetric-part" in entry
    assert 'class="math' in entry

"""Every public function gets numbers as they come: in other forms, of other sizes, or none at all.

It answers rightly or refuses in one sentence that names the argument. It never answers NaN without
saying so in its docstring, lets no warning of NumPy through, changes no argument, and keeps no
window into one. `doors` has the right calls, `fuzzing` what is changed in them, `fuzz_rules` what
holds of each.
"""

from itertools import islice

import pytest
from hypothesis import given, settings, strategies as st

from doors import CORES, Door, doors
from fuzz_rules import answered, arrays, compared, refused
from fuzzing import no_numbers, other_numbers, same_numbers, slots
from support import helper_modules

# Calls that take a hundredth of a second or more are made with a few of the changes only.
LONG = {
    *(
        "DesignTask.value",
        "design_scheme",
        "calibrate_multi_position",
        "fit_noise_terms",
        "calibrate",
    ),
    *("align_in_inertial_frame", "fit_gyro_noise", "TurntableTrial.run", "marine_type_test"),
    *("allan_deviation", "integrate_riccati", "navigate_static", "stripped_observability"),
    *("covariance_analysis", "standard_deviation_history", "read_csv", "ferraris_sections"),
}
QUICK = settings.default.max_examples < 40
every_module = pytest.mark.parametrize(
    "module", helper_modules(), ids=lambda module: module.__name__[9:]
)


def some(changes, door: Door):
    """Every third change of a call, every sixth in the quick tests, fewer of long ones."""
    step = (6 if QUICK else 3) * (4 if door.name in LONG else 1)
    return islice(changes, sum(map(ord, door.name)) % step, None, step)


def checked_doors(module):
    """Doors of a module that look at what they are given."""
    return [door for door in doors(module) if door.name not in CORES]


def told(complaints):
    """Complaints with the changes that they are about."""
    return "\n".join(f"{change}: {what}" for change, what in complaints)


@every_module
def test_the_same_numbers_in_another_form_have_the_same_answer(module):
    """Of any real word, layout or owner; each is computed with in double."""
    complaints = [
        (other, complaint)
        for door in checked_doors(module)
        for double, other in some((p for slot in slots(door) for p in same_numbers(slot)), door)
        for complaint in compared(double, other)
    ]
    assert not complaints, told(complaints)


@every_module
def test_what_is_no_number_is_refused_by_name(module):
    """NaN, infinite, too large, complex, true or false, masked, text, or another object."""
    complaints = [
        (change, complaint)
        for door in checked_doors(module)
        for slot in slots(door)
        for change in no_numbers(slot)
        for complaint in refused(change)
    ]
    assert not complaints, told(complaints)


@every_module
def test_any_numbers_are_answered_or_refused_in_a_sentence(module):
    """Of any size and shape, subnormal and empty ones among them."""
    choices = {
        door.name: [slot for slot in slots(door) if next(other_numbers(slot, 0, 0), None)]
        for door in checked_doors(module)
    }
    choices = {name: found for name, found in choices.items() if found}
    if not choices:
        return

    def drawn(name):
        return st.sampled_from(choices[name]).flatmap(
            lambda slot: st.builds(
                lambda exponent, place, which: nth(other_numbers(slot, exponent, place), which),
                st.integers(-330, 50),
                st.integers(0, 99),
                st.integers(0, 17),
            )
        )

    for name in choices:
        count = settings.default.max_examples // (20 if name in LONG else 4)

        @settings(max_examples=max(count, 2))
        @given(drawn(name))
        def holds(change):
            complaints = answered(change)
            assert not complaints, told((change, each) for each in complaints)

        holds()


def nth(changes, number):
    """One of a few changes, counted round."""
    known = list(changes)
    return known[number % len(known)]


def test_nobody_changes_a_constant():
    """Whoever writes into one would change the answers of all others."""
    public = {
        f"{module.__name__}.{name}": value
        for module in helper_modules()
        for name, value in vars(module).items()
        if name.isupper() and not name.startswith("_")
    }
    found = [place for name, value in public.items() for place in arrays(value, name)]
    assert len(found) > 5
    assert [name for name, array in found if array.flags.writeable] == []


def test_slots_are_found_in_every_module_that_computes():
    """Without slots the tests above would try nothing."""
    found = {module: sum(len(slots(door)) for door in doors(module)) for module in helper_modules()}
    assert sum(map(bool, found.values())) > 50
    assert sum(found.values()) > 400
    names = {slot.name for module in found for door in doors(module) for slot in slots(door)}
    assert {"start.latitude", "increments.angle", "imu_errors.gyro_bias", "interval"} <= names

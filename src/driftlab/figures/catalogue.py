"""Every published figure, in the order of the chapters."""

from . import (
    catalogue_larin,
    catalogue_perelyaev_chelnokov,
    catalogue_plotnikov,
    catalogue_wu,
)
from .entry import Entry

CATALOGUE: tuple[Entry, ...] = (
    *catalogue_larin.ENTRIES,
    *catalogue_perelyaev_chelnokov.ENTRIES,
    *catalogue_wu.ENTRIES,
    *catalogue_plotnikov.ENTRIES,
)

"""Experiments of chapter 09: local axes on the way, and where errors lead a navigator at rest."""

from .carried_level import carried_level as carried_level
from .mission import SETTABLE as SETTABLE, mission as mission
from .position_error import CAUSES as CAUSES, position_error as position_error
from .stops import stops as stops

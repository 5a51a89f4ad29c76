"""Exercises of chapter 14: the errors of a compass under way."""

from .under_way import EXERCISES as EXERCISES

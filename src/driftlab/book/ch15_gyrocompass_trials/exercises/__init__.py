"""Exercises of chapter 15: a damped compass, what chance shows, and what a standard asks."""

from driftlab.book.machinery.exercise.exercise import Exercise

from . import damping, judging, passing

EXERCISES: dict[str, Exercise] = {
    **damping.EXERCISES,
    **judging.EXERCISES,
    **passing.EXERCISES,
}

"""Exercises of chapter 14: the gyrocompass at work."""

from driftlab.book.machinery.exercise.exercise import Exercise

from . import damping, judging, under_way

EXERCISES: dict[str, Exercise] = {
    **under_way.EXERCISES,
    **judging.EXERCISES,
    **damping.EXERCISES,
}

"""Exercises of chapter 13: aligning a gyrocompass."""

from driftlab.book.machinery.exercise.exercise import Exercise

from . import one_position, waiting

EXERCISES: dict[str, Exercise] = {
    **one_position.EXERCISES,
    **waiting.EXERCISES,
}

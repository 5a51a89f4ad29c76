"""What chapter 13 makes of published recordings: numbers, not yet pictures."""

from .hand_turns import SOURCES, TURNS, HandTurns, hand_turns

__all__ = ["SOURCES", "TURNS", "HandTurns", "hand_turns"]

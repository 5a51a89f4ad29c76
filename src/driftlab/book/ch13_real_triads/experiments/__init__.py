"""What chapter 13 makes of published recordings: numbers, not yet pictures."""

from .parked_car import METHODS, ParkedCar, Spread, chance_of_ratio, parked_car, spread

__all__ = ["METHODS", "ParkedCar", "Spread", "chance_of_ratio", "parked_car", "spread"]

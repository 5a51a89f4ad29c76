"""The experiments of chapter 06: Cayley vectors, and the Riccati equation through whole turns."""

from .circles import circles_of_steady_turns as circles_of_steady_turns
from .riccati import WAYS as WAYS, riccati_turns as riccati_turns
from .vectors import (
    EXAMPLE as EXAMPLE,
    REACH as REACH,
    VECTORS as VECTORS,
    cayley_map as cayley_map,
    shadow_steps as shadow_steps,
)

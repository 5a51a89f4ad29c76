"""The experiments of chapter 05: Cayley vectors, and the Riccati equation through whole turns."""

from .riccati import (
    MISSES as MISSES,
    STEPS as STEPS,
    TOLERANCES as TOLERANCES,
    TURNS as TURNS,
    RiccatiTurns as RiccatiTurns,
    riccati_turns as riccati_turns,
)
from .vectors import (
    ANGLES as ANGLES,
    EXAMPLE as EXAMPLE,
    MOMENTS as MOMENTS,
    CayleyMap as CayleyMap,
    ShadowSteps as ShadowSteps,
    cayley_curves as cayley_curves,
    cayley_map as cayley_map,
    shadow_steps as shadow_steps,
)
